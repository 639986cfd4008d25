"""Drawings of the parts, each in its own frame, and of the machine put together.

Layers: WHEEL, CRANK, ARM, LINK, GROOVE and BORE are cut; ROLLER is a circle; PITCH is where rollers
run, and where gears roll; CENTER has marks.
"""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geneva_cli.curves import fit
from geneva_cli.curves.measure import mapped, turned
from geneva_cli.curves.plates import Group, Member
from geneva_cli.curves.shapes import (
    Annotations,
    Arc,
    Circle,
    Contour,
    Drawing,
    LevelDistance,
    Line,
    Segment,
    Shape,
    about,
    closed,
    joined,
)
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Engagement
from geneva_cli.parts.arm import LAYER as ARM
from geneva_cli.parts.arm import CrankArm, bolts, crank_arm, has_arm
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.crank import crank_circles, roller_centres
from geneva_cli.parts.link_drawings import once, titled, together
from geneva_cli.parts.links import drawn_links
from geneva_cli.parts.outlines import Outlines, slot_walls
from geneva_cli.parts.plates import arm_plate, crank_group, wheel_plate
from geneva_cli.parts.walls.ways import beside
from geneva_cli.parts.wheel import wheel_circles, wheel_contour

PITCH = "PITCH"
BEYOND = 0.04  # of the centre distance: between a part and the arrow that says how it turns


def wheel(found: Outlines, tolerance: float, curves: str) -> Drawing:
    """The wheel: its axis the origin, the first slot ahead."""
    contour, *circles = _wheel(found, tolerance, curves)
    solid = wheel_plate(found, contour)
    return Drawing(_title(found, "wheel"), (contour, *circles), solid=solid)


def crank(found: Outlines, tolerance: float, curves: str) -> Drawing:
    """The crank: its axis the origin, the first roller ahead; what lies in the wheel's plane."""
    return Drawing(_title(found, "crank"), tuple(_crank(found)), solid=crank_group(found))


def arm(found: Outlines, tolerance: float, curves: str) -> Drawing:
    """The crank arm below the wheel's plane: outline, bore, and holes for pins and bolts."""
    made = crank_arm(found)
    return Drawing(
        _title(found, "arm"),
        (made.outline, made.bore, *made.pins, *made.bolts),
        solid=arm_plate(found, made),
    )


def slot(found: Outlines, tolerance: float, curves: str) -> Drawing:
    """The first slot, closed along the rim, and the roller's way in it."""
    engagement = found.assembly.slots[0][0]
    walls = slot_walls(found.assembly, found.sizes, engagement, tolerance, curves)
    start, end = walls.segments[0].start, walls.segments[-1].end
    back = math.atan2(start[1], start[0]) - math.atan2(end[1], end[0])
    level = abs(math.hypot(*start) - math.hypot(*end)) < 1e-9 * found.assembly.L
    rim: Segment = Arc(end, start, math.tan(0.25 * back)) if level else Line(end, start)
    pitch = pitch_line(found.assembly, engagement, tolerance, curves)
    return Drawing(_title(found, "slot"), (closed("WHEEL", [*walls.segments, rim]), pitch))


def assembly(found: Outlines, tolerance: float, curves: str) -> Drawing:
    """The machine at input angle 0: the wheel's axis the origin, the crank's on the x axis."""
    assembly = found.assembly
    at = np.zeros(1)
    psi, angle = float(assembly.wheel(at)[0]), float(assembly.crank(at)[0])
    contour, *circles = _wheel(found, tolerance, curves)
    shapes: list[Shape] = [turned(contour, psi), *(turned(s, psi) for s in circles)]
    carrier = crank_arm(found) if has_arm(found) else None
    bars = drawn_links(assembly.given, found)
    carried = [*_crank(found), *_arm(found, carrier)]
    shapes += [mapped(turned(s, angle), lambda p: (p[0] + assembly.L, p[1])) for s in carried]
    shapes += together(bars)
    shapes += _ways(found, psi, tolerance, curves)
    solid = Group(
        _title(found, ""),
        (
            Member(wheel_plate(found, contour), turn=psi),
            Member(crank_group(found, carrier, bars.pin_low), (assembly.L, 0.0), angle),
            *bars.cut,
            *bars.joined,
        ),
    )
    look = Annotations((LevelDistance((0.0, 0.0), (assembly.L, 0.0), "L"),), tuple(_turns(found)))
    return Drawing(_title(found, ""), tuple(once(shapes)), look, solid)


def _turns(found: Outlines) -> Iterator[Arc]:
    """The senses of rotation of wheel and crank, as arcs outside of them."""
    assembly, sizes = found.assembly, found.sizes
    reach = max(math.hypot(*s.start) for s in found.wheel.segments)
    beyond = (sizes.outer or reach) + BEYOND * assembly.L
    yield about((0.0, 0.0), beyond, math.radians(115.0), math.radians(50.0))
    if not assembly.given.spec.drive.CRANKED:
        return
    step = math.remainder(float(np.diff(assembly.crank(np.array([-0.5, 0.5])))[0]), math.tau)
    sense = math.copysign(1.0, step)
    # inside, the crank turns within the wheel: the arrow is near its shaft
    far = max(math.hypot(*c) for c in roller_centres(assembly)) + 2.0 * sizes.roller
    radius = far + BEYOND * assembly.L if assembly.sign > 0.0 else 0.5 * sizes.arm
    yield about((assembly.L, 0.0), radius, -sense * 0.5, sense)


def groove(found: Outlines, tolerance: float, curves: str) -> Drawing:
    """The fixed groove of a cam-Geneva, both flanks all round, about the crank's axis."""
    guide = found.assembly.rollers[0][0].groove
    if guide is None:
        kind = found.assembly.mechanism.spec.drive.NAME
        raise GenevaError(f'--part groove: kind = "{kind}" has none; kind = "cam" has')
    from geneva_cli.parts.groove import groove_curve

    motion = guide.motion
    ends = (motion.entry_deg, motion.exit_deg, motion.entry_deg + 360.0)
    shapes = []
    for layer, side in (("GROOVE", 1.0), ("GROOVE", -1.0), (PITCH, 0.0)):
        curve = groove_curve(guide, found.assembly.L, side * found.sizes.half_width)
        pieces: list[Segment] = []
        for a, b in zip(ends, ends[1:], strict=False):
            pieces += fit.KINDS[curves](curve, a, b, tolerance)
        shapes.append(closed(layer, pieces))
    return Drawing(_title(found, "groove"), tuple(shapes))


def _title(found: Outlines, part: str) -> str:
    name = titled(found.assembly.mechanism)
    return f"{name}: {part}" if part else name


def _wheel(found: Outlines, tolerance: float, curves: str) -> tuple[Contour, *tuple[Shape, ...]]:
    assembly, sizes = found.assembly, found.sizes
    return (_outline(found, tolerance, curves), *wheel_circles(assembly, sizes))


def _outline(found: Outlines, tolerance: float, curves: str) -> Contour:
    """The wheel's outline: that of the full turn, unless other curves, or finer, are asked for."""
    if curves == "arcs" and tolerance == found.fine:
        return found.wheel
    walls = {s: slot_walls(found.assembly, found.sizes, s, tolerance, curves) for s in found.slots}
    return wheel_contour(found.assembly, found.sizes, walls)


def _crank(found: Outlines) -> list[Shape]:
    return [*found.crank, *crank_circles(found.assembly, found.sizes), *bolts(found)]


def _arm(found: Outlines, made: CrankArm | None) -> list[Shape]:
    """The visible part of the crank arm: its outline, and its bore where the disc has none."""
    if made is None:
        return []
    through = found.sizes.crank_bore > 0.0
    return [made.outline] if through else [made.outline, made.bore._replace(layer=ARM)]


def _ways(found: Outlines, psi: float, tolerance: float, curves: str) -> list[Shape]:
    """The line of centres, and the rollers' paths: on their circles and in their slots."""
    assembly = found.assembly
    shapes: list[Shape] = [Contour(PITCH, (Line((0.0, 0.0), (assembly.L, 0.0)),), closed=False)]
    arms = set()
    for number, (engagement, behind) in enumerate(assembly.rollers):
        if not engagement.crank_sense and engagement.groove is None:
            x, y = assembly.pin(number, np.array([behind]))[0]
            arms.add(round(math.hypot(x - assembly.L, y), 9))
    shapes += [Circle(PITCH, (assembly.L, 0.0), arm) for arm in sorted(arms)]
    pitches = {s: pitch_line(assembly, s, tolerance, curves) for s in found.slots}
    shapes += [
        turned(pitches[engagement], direction + psi) for engagement, direction in assembly.slots
    ]
    return shapes


def pitch_line(
    assembly: Assembly, engagement: Engagement, tolerance: float, curves: str
) -> Contour:
    """The slot's pitch curve, the first half of the way where the roller comes back on it."""
    at = np.array([engagement.entry_deg, 0.0])
    x, y = engagement.slot(at, 0)
    if not engagement.slot.curved:
        mouth, end = assembly.L * np.column_stack((x.c[0], y.c[0] + 0.0 * at))
        ends = [(float(p[0]), float(p[1])) for p in (mouth, end)]
        return Contour(PITCH, (Line(*ends),), closed=False)
    pieces: list[Segment] = []
    for a, b in ((engagement.entry_deg, 0.0), (0.0, engagement.exit_deg)):
        pieces += fit.KINDS[curves](beside(assembly, engagement, 0.0, b > 0.0), a, b, tolerance)
    return Contour(PITCH, joined(pieces), closed=False)
