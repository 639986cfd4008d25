"""A scene as a picture at one input angle, also for machines without drawings.

A hole is a shape of the page's colour, behind the shapes that it opens.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from html import escape
from typing import NamedTuple

from geneva_cli.errors import clean
from geneva_cli.geometry.shapes import Circle, Contour, Line, Shape
from geneva_cli.output.inks import DARK, INKS
from geneva_cli.output.scene import Bar, Scene, body_pose, place_at, pose, value_at
from geneva_cli.output.svg.drawing_svg import element

GREY, BROWN = "#757575", "#a56752"
PAGE = "#ffffff"
BODY, LINK, ROLLER = "30", "33", "66"  # opacity of fills, of 255 in hexadecimal


class _PlacedShape(NamedTuple):
    """A shape, the place and rotation of its frame, the ink of its line, and its fill.

    The fill is PAGE for a hole, "" for a line, otherwise the ink with an opacity.
    """

    shape: Shape
    pose: tuple[float, float, float]  # x, y, and radians
    ink: str
    fill: str = ""
    wide: bool = False  # a line twice as wide


def chunks(scene: Scene) -> Iterator[str]:
    """The file's text, legible on light and on dark pages."""
    x0, y0, x1, y1 = scene.box
    size = max(x1 - x0, y1 - y0)
    # after 0.12 of the turn the first roller is in its slot
    margin, t = 0.02 * size, 0.12 * scene.turn_deg
    wide, high = x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin
    corner = f'x="{x0 - margin:.6g}" y="{-y1 - margin:.6g}"'
    view = " ".join(f"{v:.6g}" for v in (x0 - margin, -y1 - margin, wide, high))
    width_px, line = 640.0, 0.004 * size
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width_px:g}" '
        f'height="{width_px * high / wide:.6g}" viewBox="{view}" fill="none" '
        f'stroke-width="{line:.6g}" stroke-linejoin="round" stroke-linecap="round">\n'
        f"<title>{escape(clean(scene.title), quote=False)}</title>\n"
        "<style>@media screen and (prefers-color-scheme: dark) "
        f"{{ .page {{ fill: {DARK.page} }} }}</style>\n"
        f'<rect class="page" fill="{PAGE}" {corner} width="{wide:.6g}" height="{high:.6g}"/>\n'
    )
    if scene.frame:
        (x, y), turned = scene.frame.centre, -math.degrees(value_at(scene.frame.angle, t))
        yield f'<g transform="rotate({turned:.6g} {x:.6g} {0.0 - y:.6g})">\n'
    yield from (_group(one, line) for one in _placed(scene, t))
    yield "</g>\n</svg>\n" if scene.frame else "</svg>\n"


def _placed(scene: Scene, t: float) -> Iterator[_PlacedShape]:
    for body in scene.bodies:
        at = body_pose(body, t)
        yield from (_of_body(shape, at) for shape in body.shapes)
    size = max(scene.box[2] - scene.box[0], scene.box[3] - scene.box[1])
    for bar in scene.bars:
        yield from _of_bar(bar, t, 0.008 * size)
    ink, roller = INKS["ROLLER"].rgb, Circle("ROLLER", (0.0, 0.0), scene.roller_radius)
    for place in scene.rollers:
        yield _PlacedShape(roller, (*place_at(place, t), 0.0), ink, ink + ROLLER)


def _of_body(shape: Shape, at: tuple[float, float, float]) -> _PlacedShape:
    layer = "WHEEL" if shape.layer == "HOLLOW" else shape.layer
    ink = INKS[layer].rgb if layer in INKS else GREY
    if shape.layer in ("BORE", "HOLLOW"):
        return _PlacedShape(shape, at, ink, PAGE)
    is_closed = isinstance(shape, Circle) or shape.closed
    is_line = shape.layer in ("PITCH", "GROOVE", "SLOT") or not is_closed
    return _PlacedShape(shape, at, ink, "" if is_line else ink + BODY)


def _of_bar(bar: Bar, t: float, joint: float) -> Iterator[_PlacedShape]:
    """Yield a circle, a link with its blocks, or a bar; ``joint`` is the radius of its joints."""
    here = (0.0, 0.0, 0.0)
    ends = [place_at(place, t) for place in bar.joints]
    if bar.radius:
        yield _PlacedShape(Circle("", ends[0], bar.radius), here, GREY)
        return
    for plate in bar.plates:
        at = pose(bar, plate, t)
        outline, *holes = plate.shapes
        yield _PlacedShape(outline, at, BROWN, BROWN + LINK)
        yield from (_PlacedShape(hole, at, BROWN, PAGE) for hole in holes)
    if bar.plates:
        return
    if len(ends) > 1:
        sides = tuple(map(Line, ends, [*ends[1:], ends[0]]))
        yield _PlacedShape(Contour("LINK", sides), here, BROWN, BROWN + LINK, wide=True)
    for end in ends:
        yield _PlacedShape(Circle("", end, joint), here, GREY, PAGE)


def _group(placed: _PlacedShape, line: float) -> str:
    x, y, angle = placed.pose
    down, turned = 0.0 - y, 0.0 - math.degrees(angle)  # y points down, and 0 has no sign
    paint = f' stroke="{placed.ink}"' + (f' fill="{placed.fill}"' if placed.fill else "")
    paint += ' class="page"' if placed.fill == PAGE else ""
    paint += f' stroke-width="{2.0 * line:.6g}"' if placed.wide else ""
    place = f'transform="translate({x:.6g} {down:.6g}) rotate({turned:.6g})"'
    return f"<g {place}{paint}>{element(placed.shape).strip()}</g>\n"
