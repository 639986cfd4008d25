"""Additions to an SVG to view: light or dark page, and the elements of notes."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape

from geneva_cli.geometry.measure import Box
from geneva_cli.geometry.shapes import Layer
from geneva_cli.output.inks import inks, mixed
from geneva_cli.output.notes import LETTERS, Notes
from geneva_cli.output.plot.strokes import DARK, LIGHT
from geneva_cli.output.svg.svg_fill import tints
from geneva_cli.output.svg.svg_paths import element, number, path, place, point


def style(layers: tuple[str, ...], plates: tuple[Layer, ...], frame: Box, margin: float) -> str:
    """The page behind the drawing, and its colours; programs without CSS show the light one.

    ``plates`` are the layers of its filled plates.
    """
    dark = "".join(
        f"g[id='{layer}'] {{ stroke: {brighter(ink.rgb)} }}\n"
        for layer, ink in inks(layers).items()
    )
    dark += "".join(
        f"path[class='{layer}'] {{ fill: {tint} }}\n" for layer, tint in tints(plates, DARK).items()
    )
    x, y = number(frame.x0 - margin), number(-frame.y1 - margin)
    wide, high = frame.x1 - frame.x0 + 2.0 * margin, frame.y1 - frame.y0 + 2.0 * margin
    return (
        "<style>\n@media screen and (prefers-color-scheme: dark) {\n"
        f".page {{ fill: {DARK.page} }}\n"
        f"#NOTES {{ stroke: {DARK.axis} }}\n"
        f"#TEXT, #ARROWS {{ fill: {DARK.text} }}\n{dark}"
        "}\n</style>\n"
        f'<rect class="page" fill="{LIGHT.page}" x="{x}" y="{y}" width="{number(wide)}"'
        f' height="{number(high)}"/>\n'
    )


def noted(shown: Notes, mm: float) -> Iterator[str]:
    """Yield the elements of annotations."""
    grey = "#757575"
    yield f'<g id="NOTES" stroke="{grey}" stroke-width="{number(mm * 0.25)}">\n'
    yield from map(element, shown.lines)
    yield f'<path id="SCALE_BAR" d="{" ".join(map(path, shown.scale_bar))}"/>\n</g>\n'
    yield f'<g id="ARROWS" fill="{grey}">\n'
    yield from (f'<path d="M {" L ".join(map(point, head))} Z"/>\n' for head in shown.heads)
    yield f'</g>\n<g id="TEXT" fill="{LIGHT.text}" font-family="sans-serif"'
    yield f' font-size="{number(mm * LETTERS)}">\n'
    for at, text in shown.texts:
        yield f"<text {place(at)}>{escape(text, quote=False)}</text>\n"
    yield "</g>\n"


def brighter(rgb: str) -> str:
    """An ink for a dark page: 0.45 of the step to white is added."""
    return mixed(rgb, 0.55, "#ffffff")
