"""A scene as one page of HTML without network: moving outlines, curves, and a slider."""

from __future__ import annotations

import json
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

from geneva_cli.errors import clean
from geneva_cli.geometry.shapes import Shape
from geneva_cli.output.inks import INKS
from geneva_cli.output.plot.plot_layout import labels, ticks
from geneva_cli.output.svg import element
from geneva_cli.output.templates import filled, template

if TYPE_CHECKING:
    from geneva_cli.output.scene import Body, Place, Rotation, Scene, Track


def chunks(scene: Scene) -> Iterator[str]:
    """Yield the page's text; the same scene gives the same bytes."""
    x0, y0, x1, y1 = scene.box
    size = max(x1 - x0, y1 - y0)
    margin = 0.02 * size
    view = x0 - margin, -y1 - margin, x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin
    data = json.dumps(_data(scene, size), separators=(",", ":"), allow_nan=False)
    parts = {"TITLE": escape(clean(scene.title)), "CAPTION": escape(clean(scene.caption))}
    parts |= {"SPEC": escape(scene.spec), "DRAWING": "", "LINKS": ""}
    parts |= {"STYLE": template("page.css"), "SCRIPT": template("page.js")}
    parts["MOTION"] = template("motion.js")
    parts |= {"DATA": data.replace("<", "\\u003c"), "VIEW": " ".join(f"{v:.6g}" for v in view)}
    for body in scene.bodies:
        shapes = [_shape(shape, shape.layer.lower()) for shape in body.shapes]
        parts["DRAWING"] += f'<g id="{_id(body.name)}">{"".join(shapes)}</g>\n'
    for number, bar in enumerate(scene.bars):
        for i, plate in enumerate(bar.plates):
            shapes = [_shape(one, "hole" if k else "edge") for k, one in enumerate(plate.shapes)]
            parts["LINKS"] += f'<g id="link-{number}-{i}" class="link">{"".join(shapes)}</g>\n'
    yield filled("page.html", parts)


def _id(name: str) -> str:
    return name.replace(" ", "-")


def _shape(shape: Shape, name: str) -> str:
    return f'<g class="{name}">{element(shape).strip()}</g>'


def _data(scene: Scene, size: float) -> dict[str, Any]:
    data: dict[str, Any] = {"start": scene.start_deg, "turn": scene.turn_deg, "stops": scene.stops}
    data |= {"seconds": scene.seconds, "pauses": scene.pauses, "stop_s": scene.stop_s, "size": size}
    data["bodies"] = [
        {"id": _id(one.name), **_turn(one), "travel": one.travel and _track(one.travel)}
        for one in scene.bodies
    ]
    data["frame"] = scene.frame and _turn(scene.frame)
    data["bars"] = []
    for bar in scene.bars:
        own = {"name": bar.name, "joints": list(map(_place, bar.joints)), "radius": bar.radius}
        data["bars"].append({**own, "plates": [plate.joint for plate in bar.plates]})
    data |= {"rollers": list(map(_place, scene.rollers)), "radius": scene.roller_radius}
    data["pushes"] = [[list(map(_short, column)) for column in push] for push in scene.pushes]
    data["states"] = [[_short(s.start), _short(s.end), s.moves, s.words] for s in scene.states]
    data |= {"panels": list(_panels(scene)), "window": scene.figure.window}
    data["angles"] = _ticks(*scene.figure.window, 7, "deg")
    return {**data, "inks": {layer.lower(): ink.rgb for layer, ink in INKS.items()}}


def _turn(one: Body | Rotation) -> dict[str, Any]:
    return {"centre": one.centre, "angle": _track(one.angle)}


def _track(track: Track) -> dict[str, Any]:
    columns = (track.at, track.value, track.slope)
    # angles and places to 1e-9 of a turn
    exact = ([float(f"{x:.10g}") for x in column] for column in columns)
    named = dict(zip("avs", exact, strict=True))
    return {**named, "g": track.gain} if track.gain else named


def _place(place: Place) -> list[dict[str, Any]]:
    return [_track(track) for track in place]


def _panels(scene: Scene) -> Iterator[dict[str, Any]]:
    for panel in scene.figure.panels:
        low, high = panel.span()
        pieces = []
        for x, y in (piece for curve in panel.curves for piece in curve.pieces):
            every = max(1, len(x) // 120)  # leaves 120 to 240 points, and the ends
            chosen = sorted({*range(0, len(x), every), len(x) - 1})
            piece = []
            for column in (x, y):
                values = [column[i] for i in chosen]
                # 0 for one that no screen shows beside the others
                least = 1e-9 * max(map(abs, values))
                piece.append([_short(v) if abs(v) > least else 0.0 for v in values])
            pieces.append(piece)
        name = panel.y.label + (f", {panel.y.unit}" if panel.y.unit else "")
        shown = {"name": name, "low": low, "high": high}
        yield {**shown, "ticks": _ticks(low, high, 4), "pieces": pieces}


def _ticks(low: float, high: float, most: int, unit: str = "") -> list[tuple[float, str]]:
    places = ticks(low, high, most, unit)
    degree = "°" if unit == "deg" else ""
    return [(x, text + degree) for x, text in zip(places, labels(places), strict=True)]


def _short(value: float) -> float:
    return float(f"{value:.5g}")
