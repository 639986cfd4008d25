"""A scene as one page of HTML without network, which moves; and as a picture of one input angle.

In the picture a hole is a shape of the page's colour, behind the shapes that it opens.
"""

from __future__ import annotations

import json
import math
import os
import re
from collections.abc import Iterator
from html import escape
from typing import TYPE_CHECKING, Any

from geneva_cli.errors import clean
from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape
from geneva_cli.output.inks import DARK, INKS
from geneva_cli.output.plot.plot_layout import labels, ticks
from geneva_cli.output.scene import body_pose, place_at, pose, value_at
from geneva_cli.output.svg import element

if TYPE_CHECKING:
    from geneva_cli.output.scene import Place, Scene, Track

GREY, BROWN, PAGE = "#757575", "#a56752", "#ffffff"
BODY, LINK, ROLLER = "30", "33", "66"  # opacity of fills, of 255 in hexadecimal


def chunks(scene: Scene) -> Iterator[str]:
    """Yield the page's text; the same scene gives the same bytes."""
    data = json.dumps(_data(scene), separators=(",", ":"), allow_nan=False)
    x, y, wide, high, _ = _view(scene)
    parts = {
        "TITLE": escape(clean(scene.title)),
        "CAPTION": escape(clean(scene.caption)),
        "SPEC": escape(scene.spec),
        "STYLE": _file("page.css"),
        "DRAWING": "",
        "LINKS": "",
        "DATA": data.replace("<", "\\u003c"),
        "MOTION": _file("motion.js"),
        "SCRIPT": _file("page.js"),
        "VIEW": " ".join(f"{v:.6g}" for v in (x, y, wide, high)),
    }
    for body in scene.bodies:
        shapes = [_shape(shape, shape.layer.lower()) for shape in body.shapes]
        parts["DRAWING"] += f'<g id="{_id(body.name)}">{"".join(shapes)}</g>\n'
    for number, bar in enumerate(scene.bars):
        for i, plate in enumerate(bar.plates):
            shapes = [_shape(one, "hole" if k else "edge") for k, one in enumerate(plate.shapes)]
            parts["LINKS"] += f'<g id="link-{number}-{i}" class="link">{"".join(shapes)}</g>\n'
    # One pass: a title with the name of another part is not replaced.
    yield re.sub("%([A-Z]+)%", lambda place: parts[place[1]], _file("page.html"))


def _file(name: str) -> str:
    with open(os.path.join(os.path.dirname(__file__), name), encoding="utf-8") as file:
        return file.read()


def _view(scene: Scene) -> tuple[float, float, float, float, float]:
    """The upper left corner, width, height and size of what the scene shows; y down."""
    x0, y0, x1, y1 = scene.box
    size = max(x1 - x0, y1 - y0)
    margin = 0.02 * size
    return x0 - margin, -y1 - margin, x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin, size


def _id(name: str) -> str:
    return name.replace(" ", "-")


def _shape(shape: Shape, name: str) -> str:
    return f'<g class="{name}">{element(shape).strip()}</g>'


def _data(scene: Scene) -> dict[str, Any]:
    return {
        "start": scene.start_deg,
        "turn": scene.turn_deg,
        "stops": scene.stops,
        "seconds": scene.seconds,
        "pauses": scene.pauses,
        "stop_s": scene.stop_s,
        "size": _view(scene)[-1],
        "bodies": [
            {
                "id": _id(b.name),
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
        "panels": list(_panels(scene)),
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
        yield {
            "name": panel.y.label + (f", {panel.y.unit}" if panel.y.unit else ""),
            "low": low,
            "high": high,
            "ticks": _ticks(low, high, 4),
            "pieces": pieces,
        }


def _ticks(low: float, high: float, most: int, unit: str = "") -> list[tuple[float, str]]:
    places = ticks(low, high, most, unit)
    degree = "°" if unit == "deg" else ""
    return [(x, text + degree) for x, text in zip(places, labels(places), strict=True)]


def _short(value: float) -> float:
    return float(f"{value:.5g}")


def still_chunks(scene: Scene) -> Iterator[str]:
    """Yield a picture's text, as SVG, legible on light and on dark pages."""
    x, y, wide, high, size = _view(scene)
    t = 0.12 * scene.turn_deg  # then the first roller is in its slot
    view = " ".join(f"{v:.6g}" for v in (x, y, wide, high))
    width_px, line = 640.0, 0.004 * size
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width_px:g}" '
        f'height="{width_px * high / wide:.6g}" viewBox="{view}" fill="none" '
        f'stroke-width="{line:.6g}" stroke-linejoin="round" stroke-linecap="round">\n'
        f"<title>{escape(clean(scene.title), quote=False)}</title>\n"
        "<style>@media screen and (prefers-color-scheme: dark) "
        f"{{ .page {{ fill: {DARK.page} }} }}</style>\n"
        f'<rect class="page" fill="{PAGE}" x="{x:.6g}" y="{y:.6g}" '
        f'width="{wide:.6g}" height="{high:.6g}"/>\n'
    )
    if scene.frame:
        (x, y), turned = scene.frame.centre, -math.degrees(value_at(scene.frame.angle, t))
        yield f'<g transform="rotate({turned:.6g} {x:.6g} {0.0 - y:.6g})">\n'
    yield from _placed(scene, t, size, line)
    yield "</g>\n</svg>\n" if scene.frame else "</svg>\n"


def _placed(scene: Scene, t: float, size: float, line: float) -> Iterator[str]:
    """Yield the shapes of bodies and rollers, and circles, links or bars; ``line`` is their width.

    A fill is PAGE for a hole, "" for a line, otherwise the ink with an opacity.
    """
    here, joint = (0.0, 0.0, 0.0), 0.008 * size
    for body in scene.bodies:
        at = body_pose(body, t)
        for shape in body.shapes:
            layer = "WHEEL" if shape.layer == "HOLLOW" else shape.layer
            ink = INKS[layer].rgb if layer in INKS else GREY
            is_closed = isinstance(shape, Circle) or shape.closed
            is_line = shape.layer in ("PITCH", "GROOVE", "SLOT") or not is_closed
            fill = "" if is_line else ink + BODY
            yield _group(shape, at, ink, PAGE if shape.layer in ("BORE", "HOLLOW") else fill)
    for bar in scene.bars:
        ends = [place_at(place, t) for place in bar.joints]
        if bar.radius:
            yield _group(Circle("", ends[0], bar.radius), here, GREY)
            continue
        for plate in bar.plates:
            at = pose(bar, plate, t)
            for k, shape in enumerate(plate.shapes):
                yield _group(shape, at, BROWN, PAGE if k else BROWN + LINK)
        if bar.plates:
            continue
        if len(ends) > 1:
            sides = tuple(map(Line, ends, [*ends[1:], ends[0]]))
            yield _group(Contour("LINK", sides), here, BROWN, BROWN + LINK, 2.0 * line)
        for end in ends:
            yield _group(Circle("", end, joint), here, GREY, PAGE)
    ink, roller = INKS["ROLLER"].rgb, Circle("ROLLER", (0.0, 0.0), scene.roller_radius)
    for place in scene.rollers:
        yield _group(roller, (*place_at(place, t), 0.0), ink, ink + ROLLER)


def _group(
    shape: Shape, at: tuple[float, float, float], ink: str, fill: str = "", width: float = 0.0
) -> str:
    x, y, angle = at
    down, turned = 0.0 - y, 0.0 - math.degrees(angle)  # y points down, and 0 has no sign
    paint = f' stroke="{ink}"' + (f' fill="{fill}"' if fill else "")
    paint += ' class="page"' if fill == PAGE else ""
    paint += f' stroke-width="{width:.6g}"' if width else ""
    place = f'transform="translate({x:.6g} {down:.6g}) rotate({turned:.6g})"'
    return f"<g {place}{paint}>{element(shape).strip()}</g>\n"
