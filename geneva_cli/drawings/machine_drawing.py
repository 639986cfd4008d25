"""The assembled machine at input angle 0: moving parts, and plates that stand still.

The wheel's axis is the origin, and the crank's is on the x axis. Layers are those of the parts.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from geneva_cli.drawings.part_drawings import pitch_lines
from geneva_cli.geometry.measure import turned
from geneva_cli.geometry.plates import Group, Member, placed
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Shape, about
from geneva_cli.geometry.sheet import Annotations, Drawing, LevelDistance
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.links.link_sizes import places
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.projection import once, outlines_of, shapes, titled, uncovered
from geneva_cli.parts.slots.roller_paths import roller_reaches

BEYOND = 0.04  # of the centre distance: from a part to the arrow that shows how it turns


def machine(parts: FlatParts) -> Drawing:
    """Return the machine at input angle 0, from the frame up to the wheel."""
    outlines, title = parts.outlines, titled(parts.mechanism)
    drawn = [shape for one in (parts.wheel, *parts.orbiting) for shape in _seen(one)]
    for one in parts.about_wheel(parts.crank_without_arm):
        drawn += [*_seen(one), *_arm(parts, one)]
    drawn += _links(parts)
    drawn += outlines_of(Group("", parts.gear_pair))
    drawn += shapes(parts.first)
    drawn += [
        shape._replace(layer="FRAME") if isinstance(shape, Circle) else shape
        for shape in uncovered(parts.standing, drawn)
    ]
    drawn += _roller_lines(parts)
    L = outlines.assembly.L
    look = Annotations((LevelDistance((0.0, 0.0), (L, 0.0), "L"),), tuple(_turns(outlines)))
    return Drawing(title, tuple(once(drawn)), look, Group(title, parts.members))


def _seen(member: Member) -> list[Shape]:
    return [placed(shape, member.at, member.turn) for shape in outlines_of(member.part)]


def _links(parts: FlatParts) -> Iterator[Shape]:
    """Yield the links, and the round gears by their pitch circles, with all holes."""
    yield from (shape._replace(layer="LINK") for shape in shapes(parts.links.cut))
    blanks = list(shapes(parts.round_gears))
    yield from (shape for shape in blanks if shape.layer == "PITCH")
    yield from (shape._replace(layer="LINK") for shape in blanks if shape.layer != "PITCH")


def _turns(parts: Outlines) -> Iterator[Arc]:
    """Yield the senses of rotation of wheel and crank, as arcs outside of them."""
    assembly, sizes = parts.assembly, parts.sizes
    reach = max(math.hypot(*s.start) for s in parts.wheel.segments)
    beyond = (sizes.outer or reach) + BEYOND * assembly.L
    half = math.radians(25.0)
    yield about((0.0, 0.0), beyond, _free_direction(assembly.full) - half, 2.0 * half)
    frame = assembly.full.frame
    if frame:  # the finger stands, and the carrier turns
        yield about((assembly.L, 0.0), assembly.L + beyond, -frame * 0.5, frame)
        return
    if not assembly.full.spec.drive.ONE_ARM:
        yield from _link_turns(parts)
        return
    step = math.remainder(float(np.diff(assembly.crank(np.array([-0.5, 0.5])))[0]), math.tau)
    sense = math.copysign(1.0, step)
    # an internal wheel's crank turns within the wheel, so its arrow is near its shaft
    far = max(roller_reaches(assembly)) + 2.0 * sizes.roller
    radius = far + BEYOND * assembly.L if assembly.sign > 0.0 else 0.5 * sizes.arm
    for place in assembly.full.crank_places:
        yield about(place.at, radius, place.turn - sense * 0.5, sense)


def _free_direction(mechanism: Mechanism) -> float:
    """Return the direction of the wheel's arrow: half-way between two cranks, if several."""
    turns = sorted(place.turn for place in mechanism.crank_places)
    if len(turns) == 1:
        return math.radians(140.0)
    before, after = max(pairwise([*turns, math.tau]), key=lambda ends: ends[1] - ends[0])
    return 0.5 * (before + after)


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


def _arm(parts: FlatParts, crank: Member) -> list[Shape]:
    """Return the visible part of a crank's arm: its outline, and its bore unless the disc's."""
    if parts.arm is None:
        return []
    bore = parts.arm.bore
    hidden = bore in outlines_of(crank.part)
    visible: list[Shape] = [parts.arm.outline, *([] if hidden else [bore._replace(layer="ARM")])]
    return [placed(shape, crank.at, crank.turn) for shape in visible]


def _roller_lines(parts: FlatParts) -> list[Shape]:
    """Return the line of centres, and the rollers' paths on their circles and in their slots."""
    assembly = parts.outlines.assembly
    cranks = [place.at for place in assembly.full.crank_places]
    lines: list[Shape] = [
        Contour("PITCH", (Line((0.0, 0.0), axis),), closed=False) for axis in cranks
    ]
    arms = set()
    for number, (engagement, behind) in enumerate(assembly.rollers):
        if not engagement.crank_sense and engagement.groove is None:
            x, y = assembly.pin(number, np.array([behind]))[0]
            arms.add(round(math.hypot(x - assembly.L, y), 9))
    lines += [Circle("PITCH", axis, arm) for axis in cranks for arm in sorted(arms)]
    pitches = {s: pitch_lines(parts, s) for s in assembly.kinds}
    lines += [
        turned(line, direction + parts.wheel.turn)
        for engagement, direction in assembly.slots
        for line in pitches[engagement]
    ]
    return lines
