"""A scene as one page of HTML without network: moving outlines, curves, and a slider."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from geneva_cli.errors import clean
from geneva_cli.figure import Curve, Panel
from geneva_cli.output.inks import INKS
from geneva_cli.output.plot.plot_layout import labels, ticks
from geneva_cli.output.svg.drawing_svg import element

if TYPE_CHECKING:
    from geneva_cli.output.scene import Bar, Body, Place, Scene, Track


def chunks(scene: Scene) -> Iterator[str]:
    """The page's text; the same scene gives the same bytes."""
    data = json.dumps(_data(scene), separators=(",", ":"), allow_nan=False)
    parts = {
        "TITLE": escape(clean(scene.title)),
        "CAPTION": escape(clean(scene.caption)),
        "SPEC": escape(scene.spec),
        "STYLE": _file("page.css"),
        "DRAWING": "".join(_group(body) for body in scene.bodies),
        "LINKS": "".join(_links(i, bar) for i, bar in enumerate(scene.bars)),
        "DATA": data.replace("<", "\\u003c"),
        "MOTION": _file("motion.js"),
        "SCRIPT": _file("page.js"),
        "VIEW": _view(scene),
    }
    # One pass: a title with the name of another part is not replaced.
    yield re.sub("%([A-Z]+)%", lambda place: parts[place[1]], _file("page.html"))


def _file(name: str) -> str:
    with open(os.path.join(os.path.dirname(__file__), name), encoding="utf-8") as file:
        return file.read()


def _view(scene: Scene) -> str:
    x0, y0, x1, y1 = scene.box
    margin = 0.02 * max(x1 - x0, y1 - y0)
    box = (x0 - margin, -y1 - margin, x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin)
    return " ".join(f"{v:.6g}" for v in box)


def _group(body: Body) -> str:
    shapes = [
        f'<g class="{shape.layer.lower()}">{element(shape).strip()}</g>' for shape in body.shapes
    ]
    return f'<g id="{body.name.replace(" ", "-")}">{"".join(shapes)}</g>\n'


def _links(number: int, bar: Bar) -> str:
    return "".join(
        f'<g id="link-{number}-{i}" class="link">'
        + "".join(
            f'<g class="{"edge" if k == 0 else "hole"}">{element(shape).strip()}</g>'
            for k, shape in enumerate(plate.shapes)
        )
        + "</g>\n"
        for i, plate in enumerate(bar.plates)
    )


def _data(scene: Scene) -> dict[str, Any]:
    x0, y0, x1, y1 = scene.box
    return {
        "start": scene.start_deg,
        "turn": scene.turn_deg,
        "stops": scene.stops,
        "seconds": scene.seconds,
        "pauses": scene.pauses,
        "stop_s": scene.stop_s,
        "size": max(x1 - x0, y1 - y0),
        "bodies": [
            {
                "id": b.name.replace(" ", "-"),
                "centre": b.centre,
                "angle": _track(b.angle),
                "travel": b.travel and _track(b.travel),
            }
            for b in scene.bodies
        ],
        "frame": scene.frame and {"centre": scene.frame.centre, "angle": _track(scene.frame.angle)},
        "bars": [
            {
                "name": bar.name,
                "joints": list(map(_place, bar.joints)),
                "radius": bar.radius,
                "plates": [plate.joint for plate in bar.plates],
            }
            for bar in scene.bars
        ],
        "rollers": list(map(_place, scene.rollers)),
        "radius": scene.roller_radius,
        "pushes": [[[_short(v) for v in column] for column in push] for push in scene.pushes],
        "states": [[_short(s.start), _short(s.end), s.moves, s.words] for s in scene.states],
        "panels": [_panel(panel) for panel in scene.figure.panels],
        "window": scene.figure.window,
        "angles": _ticks(*scene.figure.window, 7, "deg"),
        "inks": {layer.lower(): ink.rgb for layer, ink in INKS.items()},
    }


def _track(track: Track) -> dict[str, Any]:
    columns = (track.at, track.value, track.slope)
    # angles and places to 1e-9 of a turn
    exact = ([float(f"{x:.10g}") for x in column] for column in columns)
    named = dict(zip("avs", exact, strict=True))
    return {**named, "g": track.gain} if track.gain else named


def _place(place: Place) -> list[dict[str, Any]]:
    return [_track(track) for track in place]


def _panel(panel: Panel) -> dict[str, Any]:
    low, high = panel.span()
    unit = f", {panel.y.unit}" if panel.y.unit else ""
    return {
        "name": panel.y.label + unit,
        "low": low,
        "high": high,
        "ticks": _ticks(low, high, 4),
        "pieces": [piece for curve in panel.curves for piece in _pieces(curve)],
    }


def _ticks(low: float, high: float, most: int, unit: str = "") -> list[tuple[float, str]]:
    places = ticks(low, high, most, unit)
    degree = "°" if unit == "deg" else ""
    return [(x, text + degree) for x, text in zip(places, labels(places), strict=True)]


def _pieces(curve: Curve) -> Iterator[list[list[float]]]:
    """The curve with a limited number of points in each piece, its ends kept."""
    for x, y in curve.pieces:
        every = max(1, len(x) // 120)  # leaves 120 to 240 points
        chosen = sorted({*range(0, len(x), every), len(x) - 1})
        yield [_viewed([values[i] for i in chosen]) for values in (x, y)]


def _viewed(values: Sequence[float]) -> list[float]:
    """Values of a curve that are only viewed; 0 for one that no screen shows beside the others."""
    least = 1e-9 * max(map(abs, values))
    return [_short(value) if abs(value) > least else 0.0 for value in values]


def _short(value: float) -> float:
    return float(f"{value:.5g}")
