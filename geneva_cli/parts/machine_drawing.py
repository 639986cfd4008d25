"""The assembled machine at input angle 0: moving parts, and plates that stand still.

The wheel's axis is the origin, and the crank's is on the x axis. Layers are those of the parts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.curves.drawing import Annotations, Drawing, LevelDistance
from geneva_cli.curves.measure import mapped, turned
from geneva_cli.curves.plates import Group
from geneva_cli.curves.shapes import Arc, Circle, Contour, Line, Shape, about
from geneva_cli.machine.layout import Joint
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.arm import LAYER as ARM
from geneva_cli.parts.arm import CrankArm
from geneva_cli.parts.built import built
from geneva_cli.parts.crank import roller_centres
from geneva_cli.parts.drawings import PITCH, crank_shapes, pitch_lines, wheel_shapes
from geneva_cli.parts.frame import LAYER as STANDING
from geneva_cli.parts.gear_drawings import gear_shapes
from geneva_cli.parts.link_drawings import once, shapes, titled, together
from geneva_cli.parts.link_positions import links_at
from geneva_cli.parts.link_sizes import places
from geneva_cli.parts.model import PartsModel
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.placed import PlacedParts

BEYOND = 0.04  # of the centre distance: from a part to the arrow that shows how it turns


def machine(parts: Outlines, tolerance: float, curves: str) -> Drawing:
    """Return the machine at input angle 0, from the frame up to the wheel."""
    return machine_and_parts(parts, tolerance, curves)[0]


def machine_and_parts(
    parts: Outlines, tolerance: float, curves: str
) -> tuple[Drawing, PlacedParts[CrankArm]]:
    """Return the drawing of the machine at input angle 0, and its parts."""
    assembly = parts.assembly
    contour, *circles = wheel_shapes(parts, tolerance, curves)
    whole = built(parts, contour, tolerance, curves)
    psi, angle = whole.wheel.turn, whole.crank.turn
    drawn: list[Shape] = [turned(contour, psi), *(turned(s, psi) for s in circles)]
    carried = [*crank_shapes(parts), *_arm(parts, whole.arm)]
    drawn += [mapped(turned(s, angle), lambda p: (p[0] + assembly.L, p[1])) for s in carried]
    # a first wheel is drawn itself, not as its pitch circle
    drawn += together(whole.links._replace(gears=()) if whole.first else whole.links)
    drawn += gear_shapes(PartsModel(assembly.full, parts), tolerance, curves)
    drawn += shapes(whole.first)
    drawn += _standing(whole, drawn)
    drawn += _roller_lines(parts, psi, tolerance, curves)
    title = titled(assembly.mechanism)
    solid = Group(title, whole.members)
    look = Annotations((LevelDistance((0.0, 0.0), (assembly.L, 0.0), "L"),), tuple(_turns(parts)))
    return Drawing(title, tuple(once(drawn)), look, solid), whole


def _standing(whole: PlacedParts[CrankArm], drawn: list[Shape]) -> list[Shape]:
    """Return the plates that stand still: outlines, grooves, and holes not covered by a bore."""
    seen = {_round(shape) for shape in drawn if isinstance(shape, Circle)}
    standing = shapes(whole.standing)
    return [
        shape._replace(layer=STANDING) if isinstance(shape, Circle) else shape
        for shape in standing
        if not (isinstance(shape, Circle) and _round(shape) in seen)
    ]


def _round(circle: Circle) -> tuple[float, ...]:
    return tuple(round(value, 6) for value in (*circle.centre, circle.radius))


def _turns(parts: Outlines) -> Iterator[Arc]:
    """Yield the senses of rotation of wheel and crank, as arcs outside of them."""
    assembly, sizes = parts.assembly, parts.sizes
    reach = max(math.hypot(*s.start) for s in parts.wheel.segments)
    beyond = (sizes.outer or reach) + BEYOND * assembly.L
    yield about((0.0, 0.0), beyond, math.radians(115.0), math.radians(50.0))
    if not assembly.full.spec.drive.ONE_ARM:
        yield from _link_turns(parts)
        return
    step = math.remainder(float(np.diff(assembly.crank(np.array([-0.5, 0.5])))[0]), math.tau)
    sense = math.copysign(1.0, step)
    # an internal wheel's crank turns within the wheel, so its arrow is near its shaft
    far = max(math.hypot(*c) for c in roller_centres(assembly)) + 2.0 * sizes.roller
    radius = far + BEYOND * assembly.L if assembly.sign > 0.0 else 0.5 * sizes.arm
    yield about((assembly.L, 0.0), radius, -sense * 0.5, sense)


def _link_turns(parts: Outlines) -> Iterator[Arc]:
    """Yield the sense of rotation of the link on the crank's shaft, beyond its end or the disc."""
    mechanism, L = parts.assembly.full, parts.assembly.L
    for link in links_at(mechanism, np.array([-0.5, 0.0, 0.5])):
        first, *others = places(link)
        if (
            link.kinds[0] is not Joint.SHAFT
            or not others
            or np.abs(first - L).max() > SAME_LENGTH * L
        ):
            continue
        ahead = others[0] - first
        sense = math.copysign(1.0, float(np.angle(ahead[2] / ahead[0])))
        far = max(float(np.abs(ahead).max()), parts.sizes.lock) + 2.0 * BEYOND * L
        yield about((L, 0.0), far, -sense * 0.5, sense)


def _arm(parts: Outlines, arm: CrankArm | None) -> list[Shape]:
    """Return the visible part of the crank arm: its outline, and its bore unless the disc's."""
    if arm is None:
        return []
    through = parts.sizes.crank_bore > 0.0
    return [arm.outline] if through else [arm.outline, arm.bore._replace(layer=ARM)]


def _roller_lines(parts: Outlines, psi: float, tolerance: float, curves: str) -> list[Shape]:
    """Return the line of centres, and the rollers' paths on their circles and in their slots."""
    assembly = parts.assembly
    shapes: list[Shape] = [Contour(PITCH, (Line((0.0, 0.0), (assembly.L, 0.0)),), closed=False)]
    arms = set()
    for number, (engagement, behind) in enumerate(assembly.rollers):
        if not engagement.crank_sense and engagement.groove is None:
            x, y = assembly.pin(number, np.array([behind]))[0]
            arms.add(round(math.hypot(x - assembly.L, y), 9))
    shapes += [Circle(PITCH, (assembly.L, 0.0), arm) for arm in sorted(arms)]
    pitches = {s: pitch_lines(assembly, s, tolerance, curves) for s in parts.slots}
    shapes += [
        turned(line, direction + psi)
        for engagement, direction in assembly.slots
        for line in pitches[engagement]
    ]
    return shapes
