"""A figure as PNG, by Matplotlib, which is an extra."""

from __future__ import annotations

import io
from collections.abc import Iterable
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.figure import Figure
from geneva_cli.output.inks import LIGHT, colour, dashes
from geneva_cli.output.plot.plot_layout import (
    INCH,
    PAGE,
    TEXT,
    Kind,
    Look,
    Path,
    Pen,
    Point,
    blocks,
)

PT = 72.0 / INCH  # points per px


def png_bytes(figure: Figure) -> bytes:
    """Return the file's bytes, equal for equal figures.

    Raises GenevaError if Matplotlib is not installed.
    """
    try:
        import matplotlib as mpl
        from matplotlib.figure import Figure as Page
    except ImportError:
        raise GenevaError(
            "png needs matplotlib, which is not installed: pip install 'geneva-cli[plot]', or "
            "write an .svg or a .pdf"
        ) from None
    parts = list(blocks(figure))
    tall = sum(block.high for block in parts)
    # Lines are not moved to whole pixels, dashes are in points, and paths are not simplified.
    with mpl.rc_context({"path.snap": False, "lines.scale_dashes": False, "path.simplify": False}):
        page = Page(figsize=(PAGE / INCH, tall / INCH))
        axes = page.add_axes((0.0, 0.0, 1.0, 1.0), xlim=(0.0, PAGE), ylim=(tall, 0.0))
        axes.set_axis_off()
        top = 0.0
        for block in parts:
            block.draw(_PngPen(axes), top)
            top += block.high
        out = io.BytesIO()
        # a file holds neither its date nor the program's version
        page.savefig(out, format="png", dpi=150, metadata={"Software": None})
    return out.getvalue()


class _PngPen(Pen):
    """Lines and texts on axes as large as the page, in px."""

    def __init__(self, axes: Any) -> None:
        self.axes = axes

    def rest(self, x: float, y: float, wide: float, high: float) -> None:
        corners = [x, x + wide, x + wide, x], [y, y, y + high, y + high]
        self.axes.fill(*corners, color=LIGHT.rest, linewidth=0.0)

    def draw(self, kind: Kind, paths: Iterable[Path], number: int = 0) -> None:
        if kind == "points":
            for (place,) in paths:
                self._dot(number, place, 4.0)
            return
        ink = {"grid": LIGHT.grid, "axis": LIGHT.axis}.get(kind) or colour(number, LIGHT)
        pattern = dashes(number) if kind in ("curve", "sample") else ()
        style: Any = (0.0, [PT * x for x in pattern]) if pattern else "-"
        width = PT * {"grid": 0.6, "axis": 1.0, "jump": 0.8}.get(kind, 1.6)
        for path in paths:
            self.axes.plot(*zip(*path, strict=True), color=ink, lw=width, ls=style)

    def dot(self, number: int, place: Point) -> None:
        self._dot(number, place, 5.6)

    def text(self, place: Point, text: str, size: float = TEXT, look: Look = "start") -> None:
        plain = text.replace("$", r"\$")  # not a formula
        words = self.axes.text(*place, plain, va="baseline", color=LIGHT.text, size=PT * size)
        words.set_ha({"middle": "center", "end": "right"}.get(look, "left"))
        words.set_weight("bold" if look == "bold" else "normal")

    def _dot(self, number: int, place: Point, size: float) -> None:
        ink = colour(number, LIGHT)
        self.axes.plot(*([v] for v in place), "o", ms=PT * size, mew=0.0, color=ink)
