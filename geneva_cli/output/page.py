"""A scene as one page of HTML without network: moving outlines, curves, and a slider."""

from __future__ import annotations

import json
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

from geneva_cli.errors import clean
from geneva_cli.geometry.shapes import Shape
from geneva_cli.output.plot.plot_layout import labels, named, ticks
from geneva_cli.output.svg import element
from geneva_cli.output.templates import filled, template

if TYPE_CHECKING:
    from geneva_cli.figure import Figure
    from geneva_cli.output.scene import Scene

NOT_DATA = {"shapes", "figure", "title", "caption", "spec", "box"}  # fields that the page has


def chunks(scene: Scene) -> Iterator[str]:
    """Yield the page's text; the same scene gives the same bytes."""
    x0, y0, x1, y1 = scene.box
    size = max(x1 - x0, y1 - y0)
    margin = 0.02 * size
    view = x0 - margin, -y1 - margin, x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin
    values = {**_data(scene), "size": size, **_curves(scene.figure)}
    data = json.dumps(values, separators=(",", ":"), allow_nan=False)
    parts = {"TITLE": escape(clean(scene.title)), "CAPTION": escape(clean(scene.caption))}
    parts |= {"SPEC": escape(scene.spec), "DRAWING": "", "LINKS": ""}
    parts |= {"STYLE": template("page.css"), "SCRIPT": template("page.js")}
    parts["MOTION"] = template("motion.js")
    parts |= {"DATA": data.replace("<", "\\u003c"), "VIEW": " ".join(f"{v:.6g}" for v in view)}
    for body in scene.bodies:
        shapes = [_shape(shape, shape.layer.lower()) for shape in body.shapes]
        parts["DRAWING"] += f'<g id="{body.name}">{"".join(shapes)}</g>\n'
    for number, bar in enumerate(scene.bars):
        for i, plate in enumerate(bar.plates):
            shapes = [_shape(one, "hole" if k else "edge") for k, one in enumerate(plate.shapes)]
            parts["LINKS"] += f'<g id="link-{number}-{i}" class="link">{"".join(shapes)}</g>\n'
    yield filled("page.html", parts)


def _shape(shape: Shape, name: str) -> str:
    return f'<g class="{name}">{element(shape).strip()}</g>'


def _data(value: Any) -> Any:
    """Records and tuples as the page's script reads them, numbers to ten digits."""
    if fields := vars(type(value)).get("_fields"):
        own = zip(fields, value, strict=True)
        return {name: _data(one) for name, one in own if name not in NOT_DATA}
    if isinstance(value, tuple):
        return [*map(_data, value)]
    return float(f"{value:.10g}") if isinstance(value, float) else value


def _curves(figure: Figure) -> dict[str, Any]:
    """The curves with their axes, thinned to 120 to 240 points a piece."""
    panels = []
    for panel in figure.panels:
        pieces = []
        for piece in (piece for curve in panel.curves for piece in curve.pieces):
            last = len(piece[0]) - 1
            chosen = sorted({*range(0, last, max(1, last // 120)), last})
            pieces.append([[float(f"{column[i]:.5g}") for i in chosen] for column in piece])
        low, high = panel.span()
        shown = {"name": named(panel.y), "low": low, "high": high, "pieces": pieces}
        panels.append({**shown, "ticks": _ticks(low, high, 4)})
    angles = [(x, f"{text}°") for x, text in _ticks(*figure.window, 7, "deg")]
    return {"panels": panels, "window": figure.window, "angles": angles}


def _ticks(low: float, high: float, most: int, unit: str = "") -> list[tuple[float, str]]:
    places = ticks(low, high, most, unit)
    return [*zip(places, labels(places), strict=True)]
