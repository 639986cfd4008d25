"""A figure as PNG or PDF, by Matplotlib, which is an extra."""

from __future__ import annotations

import io
from typing import Any

from geneva_cli.errors import GenevaError, clean
from geneva_cli.figure import LINE, POINTS, Curve, Figure, Panel
from geneva_cli.output.plot_svg import BESIDE, HEIGHT, HEIGHTS, LEFT, PAGE, RIGHT, padded
from geneva_cli.output.strokes import LIGHT, colour, dashes
from geneva_cli.output.ticks import named, said, ticks

INCH = 82.0  # px of the SVG: the page is ten inches wide
DPI = 150
SETTINGS = {"font.size": 8.5, "axes.grid": True, "axes.axisbelow": True, "pdf.fonttype": 42}
# What a file would hold of the day it was written, and of the program's version.
METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def written(figure: Figure, format: str) -> bytes:
    """The file's bytes, ``format`` png or pdf; the same figure gives the same.

    Raises GenevaError where Matplotlib is not installed.
    """
    try:
        import matplotlib as mpl
        from matplotlib.figure import Figure as Page
    except ImportError:
        raise GenevaError(
            f"{format} needs matplotlib, which is not here: pip install 'geneva-cli[plot]', or "
            "write an .svg"
        ) from None
    count = len(figure.panels)
    high = HEIGHTS.get(count, HEIGHT) * count
    marked = any(curve.marks for panel in figure.panels for curve in panel.curves)
    settings: Any = {**SETTINGS, "grid.color": LIGHT.grid}
    with mpl.rc_context(settings):
        tall = (high + 34.0 * count + 70.0 + 16.0 * len(figure.curves())) / INCH
        page = Page(figsize=(PAGE / INCH, tall), layout="constrained")
        axes = page.subplots(count, 1, sharex=True, squeeze=False)[:, 0]
        for panel, ax in zip(figure.panels, axes, strict=True):
            _panel(figure, panel, ax, marked)
        axes[-1].set_xlabel(_plain(named(figure.x)))
        page.suptitle(_plain(figure.title), fontweight="bold", x=0.02, ha="left")
        known = figure.curves()
        if len(known) > 1:
            lines = [axes[0].plot([], [], **_look(curve))[0] for curve in known.values()]
            names = [f"{n + 1}: {_plain(curve.name)}" for n, curve in known.items()]
            page.legend(lines, names, loc="outside lower center", ncols=2, frameon=False)
        out = io.BytesIO()
        page.savefig(out, format=format, dpi=DPI, metadata=METADATA[format])
    return out.getvalue()


def _plain(text: str) -> str:
    """A text in which Matplotlib finds no formula."""
    return clean(text).strip().replace("$", r"\$")


def _panel(figure: Figure, panel: Panel, ax: Any, marked: bool) -> None:
    ax.set_title(_plain(named(panel.y)), loc="left", fontsize=8.5, fontweight="bold")
    ax.set_xlim(*figure.window)
    ax.set_ylim(*padded(panel))
    wide = PAGE - LEFT - (BESIDE if marked else RIGHT)
    ax.set_xticks(ticks(*figure.window, int(wide / 70.0), figure.x.unit))
    for side in ("top", "right"):
        ax.spines[side].set_visible(False)
    for a, b in figure.shaded:
        ax.axvspan(a, b, color=LIGHT.rest, linewidth=0.0, zorder=0)
    ax.axhline(0.0, color=LIGHT.axis, linewidth=0.6, zorder=1)
    several, place = len(figure.curves()) > 1, 1.0
    for curve in panel.curves:
        _curve(curve, ax)
        for mark in curve.marks:
            ink = colour(curve.number, LIGHT)
            if mark.y is not None:
                ax.plot([mark.x], [mark.y], "o", markersize=3.5, color=ink)
            text = said(mark, "°" if figure.x.unit else "")
            ax.annotate(
                f"{curve.number + 1}: {text}" if several else text,
                (1.015, place),
                xycoords="axes fraction",
                va="top",
                color=ink if several else LIGHT.text,
            )
            place -= 0.15


def _look(curve: Curve) -> dict[str, Any]:
    pattern = dashes(curve.number)
    style: Any = "none" if curve.style == POINTS else (0.0, pattern) if pattern else "-"
    look = {"color": colour(curve.number, LIGHT), "linestyle": style, "linewidth": 1.4}
    return look if curve.style == LINE else {**look, "marker": "o", "markersize": 3.0}


def _curve(curve: Curve, ax: Any) -> None:
    look = _look(curve)
    for x, y in curve.pieces:
        ax.plot(x, y, **look)
    if curve.style != LINE:
        return
    for at, before, after in curve.jumps():
        ax.plot([at, at], [before, after], color=look["color"], linewidth=0.7)
