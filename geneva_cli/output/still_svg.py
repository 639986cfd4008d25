"""A scene as a picture at one input angle, also for machines without drawings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from html import escape

from geneva_cli.errors import clean
from geneva_cli.output.inks import INKS
from geneva_cli.output.svg_paths import element
from geneva_cli.scene import Bar, Body, Place, Scene, body_pose, place_at, pose, value_at

GREY, BROWN = "#757575", "#a56752"


def chunks(scene: Scene) -> Iterator[str]:
    """The file's text, legible on light and on dark pages."""
    x0, y0, x1, y1 = scene.box
    size = max(x1 - x0, y1 - y0)
    # after 0.12 of the turn the first roller is in its slot
    margin, t = 0.02 * size, 0.12 * scene.turn_deg
    wide, high = x1 - x0 + 2.0 * margin, y1 - y0 + 2.0 * margin
    view = " ".join(f"{v:.6g}" for v in (x0 - margin, -y1 - margin, wide, high))
    width_px = 640.0
    yield (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width_px:g}" '
        f'height="{width_px * high / wide:.6g}" viewBox="{view}" fill="none" '
        f'stroke-width="{0.004 * size:.6g}" stroke-linejoin="round" stroke-linecap="round">\n'
        f"<title>{escape(clean(scene.title), quote=False)}</title>\n"
    )
    if scene.frame:
        (x, y), turned = scene.frame.centre, -math.degrees(value_at(scene.frame.angle, t))
        yield f'<g transform="rotate({turned:.6g} {x:.6g} {0.0 - y:.6g})">\n'
    for body in scene.bodies:
        yield from _body(body, t)
    for bar in scene.bars:
        yield from _bar(bar, t, size)
    ink = INKS["ROLLER"].rgb
    for place in scene.rollers:
        yield _circle(_at(place, t), scene.roller_radius, f'stroke="{ink}" fill="{ink}66"')
    yield "</g>\n</svg>\n" if scene.frame else "</svg>\n"


def _body(body: Body, t: float) -> Iterator[str]:
    x, y, angle = body_pose(body, t)
    yield f"<g {_placed(x, y, angle)}>\n"
    for shape in body.shapes:
        ink = INKS[shape.layer].rgb if shape.layer in INKS else GREY
        if shape.layer == "HOLLOW":
            ink = INKS["WHEEL"].rgb
        is_open = shape.layer in ("PITCH", "GROOVE", "SLOT", "BORE", "HOLLOW")  # lines and holes
        fill = "none" if is_open else f"{ink}26"
        yield f'<g stroke="{ink}" fill="{fill}">{element(shape).strip()}</g>\n'
    yield "</g>\n"


def _placed(x: float, y: float, angle: float) -> str:
    """The attribute that puts a body in its place; y points down, and 0 has no sign."""
    down, turned = 0.0 - y, 0.0 - math.degrees(angle)
    return f'transform="translate({x:.6g} {down:.6g}) rotate({turned:.6g})"'


def _bar(bar: Bar, t: float, size: float) -> Iterator[str]:
    joints = [_at(place, t) for place in bar.joints]
    if bar.radius:
        yield _circle(joints[0], bar.radius, f'stroke="{GREY}"')
        return
    for plate in bar.plates:
        x, y, angle = pose(bar, plate, t)
        yield f'<g {_placed(x, y, angle)} stroke="{BROWN}">\n'
        for i, shape in enumerate(plate.shapes):
            yield f'<g fill="{"none" if i else BROWN + "33"}">{element(shape).strip()}</g>\n'
        yield "</g>\n"
    if bar.plates:
        return
    if len(joints) > 1:
        points = " ".join(f"{x:.6g},{y:.6g}" for x, y in joints)
        yield (
            f'<polygon points="{points}" stroke="{BROWN}" fill="{BROWN}33" '
            f'stroke-width="{0.012 * size:.6g}"/>\n'
        )
    for joint in joints:
        yield _circle(joint, 0.008 * size, f'stroke="{GREY}" fill="#ffffff"')


def _circle(at: tuple[float, float], r: float, paint: str) -> str:
    return f'<circle cx="{at[0]:.6g}" cy="{at[1]:.6g}" r="{r:.6g}" {paint}/>\n'


def _at(place: Place, t: float) -> tuple[float, float]:
    x, y = place_at(place, t)
    return x, -y
