"""A subject's plot: error against time ratio, both logarithmic, as SVG text."""

from __future__ import annotations

import io
import math
from collections.abc import Iterable, Sequence
from typing import Any

from bench.method import BenchRow, Subject
from geneva_cli.errors import GenevaError

OUR_COLOUR = "#c8102e"
COLOURS = ("#1f5fa8", "#2e8540", "#b36b00", "#6b4fa0", "#00808a", "#555555", "#a83279", "#7a7a00")


def require() -> None:
    """Raise GenevaError if matplotlib is not installed."""
    try:
        import matplotlib.figure  # noqa: F401
    except ImportError:
        raise GenevaError(
            "--plots needs matplotlib, which is not installed: pip install --group bench"
        ) from None


def svg(subject: Subject, rows: Sequence[BenchRow]) -> str:
    """SVG text of the plot; equal rows give equal bytes."""
    require()
    import matplotlib as mpl
    from matplotlib.figure import Figure

    settings: Any = {
        "svg.hashsalt": "geneva",
        "font.size": 9.0,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": "#e3e3e3",
        "axes.spines.top": False,
        "axes.spines.right": False,
    }
    with mpl.rc_context(settings):
        panels = [p for p in _panels(subject, rows) if p[2]]
        bars = all(not row.error for row in rows)
        if bars:
            height = 0.9 + 0.26 * sum(len(p[2]) + 1 for p in panels)
            figure = Figure(figsize=(8.0, height), layout="constrained")
            _bars(figure.add_subplot(), panels)
        else:
            columns = min(2, len(panels))
            lines = math.ceil(len(panels) / columns)
            size = (5.4 * columns + (2.0 if columns == 1 else 0.0), 4.0 * lines + 1.2)
            figure = Figure(figsize=size, layout="constrained")
            _curves(figure, subject, panels, lines, columns)
        figure.suptitle(subject.title, fontweight="bold")
        out = io.StringIO()
        figure.savefig(out, format="svg", metadata={"Date": None, "Creator": None}, dpi=80)
    return out.getvalue()


# title, label of the x axis, rows, field of the x values
Panel = tuple[str, str, list[BenchRow], str]


def _panels(subject: Subject, rows: Sequence[BenchRow]) -> list[Panel]:
    """One panel for each task; a second one if answers have pieces."""
    panels: list[Panel] = []
    for task in subject.tasks:
        own = [r for r in rows if r.task == task.name and r.error is not None]
        if own and all(r.pieces for r in own):
            panels.append((task.name, "pieces", own, "pieces"))
        panels.append((task.name, f"time / baseline: {task.baseline}", own, "time_ratio"))
    return panels


def _styles(panels: Iterable[Panel]) -> dict[str, tuple[str, str]]:
    """Colour and marker of each method that is not ours."""
    markers = "os^Dv<>p"
    names = dict.fromkeys(row.method for _, _, rows, _ in panels for row in rows if not row.ours)
    return {
        name: (COLOURS[i % len(COLOURS)], markers[i % len(markers)]) for i, name in enumerate(names)
    }


def _curves(figure: Any, subject: Subject, panels: list[Panel], lines: int, columns: int) -> None:
    """Draw panels of errors over times or numbers of pieces, a curve for each method."""
    styles = _styles(panels)
    curves: dict[str, Any] = {}
    own = list(dict.fromkeys(r.method for p in panels for r in p[2] if r.ours))
    for number, (title, label, rows, what) in enumerate(panels):
        axes = figure.add_subplot(lines, columns, number + 1)
        for name in dict.fromkeys(row.method for row in rows):
            points = [row for row in rows if row.method == name]
            x = [getattr(row, what) for row in points]
            y = [max(row.error or 0.0, 1e-17) for row in points]  # also for an error of 0
            if points[0].ours:
                marker = "*P"[own.index(name) % 2]
                colour, size, above = OUR_COLOUR, 15.0 if marker == "*" else 10.0, 5
            else:
                colour, marker = styles[name]
                size, above = 6.0, 3
            (line,) = axes.plot(
                x,
                y,
                marker=marker,
                color=colour,
                markersize=size,
                zorder=above,
                linewidth=1.2,
                markeredgecolor="white",
                markeredgewidth=0.6,
            )
            curves.setdefault(name, line)
        axes.set(xscale="log", yscale="log", xlabel=label, ylabel=subject.error)
        axes.set_title(title, fontsize=9.0)
        axes.margins(0.08)
    order = sorted(curves, key=lambda name: name not in own)
    figure.legend(
        [curves[n] for n in order],
        order,
        loc="outside lower center",
        ncols=3 if columns > 1 else 2,
        frameon=False,
        fontsize=8.5,
    )


def _bars(axes: Any, panels: list[Panel]) -> None:
    """Bars of times, for methods without an error: one group for each task."""
    place, ticks, labels = 0.0, [], []
    for title, _, rows, _ in panels:
        for row in rows:
            colour = OUR_COLOUR if row.ours else "#9db7d5"
            axes.barh(place, row.time_ratio, color=colour, height=0.8)
            axes.annotate(
                f"{row.time_ratio:.2f}  {row.method}",
                (row.time_ratio, place),
                (4, 0),
                textcoords="offset points",
                va="center",
                fontsize=7.5,
                color=OUR_COLOUR if row.ours else "#333333",
            )
            if row is rows[0]:
                ticks.append(place + 0.5 * (len(rows) - 1))
                labels.append(title)
            place += 1.0
        place += 0.7
    axes.set_yticks(ticks, labels)
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    longest = max(row.time_ratio for _, _, rows, _ in panels for row in rows)
    axes.set_xlim(0.0, 1.3 * longest)
    axes.axvline(1.0, color="#555555", linewidth=0.8)
    axes.set_xlabel(panels[0][1])
