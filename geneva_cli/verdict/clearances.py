"""What stands between the parts: walls, horns, shafts, and what a whole turn shows."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.measure import turned
from geneva_cli.curves.shapes import Line, backwards, closed
from geneva_cli.numerics.keeps import keeps
from geneva_cli.parts.crank import is_whole
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.turn.full_turn import FullTurn, Most

PUSH_MAX_DEG = 60.0  # pressure angle at which a roller still pushes the wheel into line
# Of a step, either way, in a slot: where the driving wall changes the wheel falls behind by twice
# that, a tenth of its step, and strikes the other wall; a slot so wide does not set the motion.
MOTION_PLAY_MAX = 0.05
LOOKS = 400  # places at which the branches of a curved slot are compared
NO_WALL = {  # what it means that a wall is less than nothing
    "wall_between_slots_mm": "neighbouring slots cut each other",
    "horn_mm": "the recess breaks into the slot",
    "wheel_bore_wall_mm": "the wheel's bore breaks into the slots",
    "crank_bore_wall_mm": "the crank's bore breaks through the relief",
    "outer_wall_mm": "the slots break through the wheel's outside",
}
BESIDE = np.geomspace(0.01, 3.0, 12)  # degrees of the input, beside a place that is looked at


class Clearance(NamedTuple):
    """One clearance; ``at_least`` says which side of the limit passes."""

    name: str
    value: float
    at_deg: float | None
    at_least: bool
    limit: float
    passes: bool

    @property
    def must_be(self) -> str:
        """The limit's side in words."""
        return "at least" if self.at_least else "at most"


def clearance(
    name: str,
    value: float,
    at_deg: float | None,
    at_least: bool,
    limit: float,
    noise: float = 0.0,
) -> Clearance:
    """A clearance held to its limit; ``noise`` is the rounding of the value, mm or degrees."""
    passes = keeps(value, "at least" if at_least else "at most", limit, noise)
    return Clearance(name, value, at_deg, at_least, limit, passes)


def clearances(found: Outlines) -> Iterator[Clearance]:
    """The clearances of a machine's parts as they stand, without turning them."""
    yield from _walls(found)
    yield from _shafts(found)
    yield from _branches(found)


def turning(found: Outlines, turn: FullTurn) -> list[Clearance]:
    """What a whole turn shows: no parts overlap, the wheel is held, pushed into line and led."""
    smallest, touch = turn.smallest, found.contact
    value = 0.0 if abs(smallest.mm) <= touch else smallest.mm
    rows = [clearance("gap_mm", value, smallest.at_deg, True, 0.0, touch)]
    if turn.idle is not None:
        gap = max(turn.idle.mm, 0.0) if turn.idle.mm >= -touch else turn.idle.mm
        rows.append(clearance("idle_roller_mm", gap, turn.idle.at_deg, True, 0.0, touch))
    if found.crank:
        limit = _finds_slot(found)
        rows += [
            _at_most("dwell_play_deg", turn.dwell, limit),
            _at_most("hand_over_play_deg", turn.hand_over, limit),
            _at_most("hand_over_pressure_deg", turn.push, PUSH_MAX_DEG),
        ]
    return [*rows, _at_most("motion_play_deg", turn.motion, motion_play_max(found))]


def motion_play_max(found: Outlines) -> float:
    """The play, degrees either way, up to which a slot sets the wheel's motion."""
    step = min(2.0 * math.degrees(engagement.half_step) for engagement in found.plane.kinds)
    return MOTION_PLAY_MAX * step


def _at_most(name: str, found: Most, limit: float) -> Clearance:
    return clearance(name, found.deg, found.at_deg if found.deg else None, False, limit)


def gap_about(found: Outlines, at_deg: float) -> float:
    """The smallest gap of any two parts, mm, at positions about one input angle.

    A few positions instead of a whole turn: to look for a size that frees a machine there.
    """
    start, turn = found.plane.start_deg, found.plane.turn_deg
    place = found.plane.place_deg(at_deg)
    at = start + (place + np.concatenate((-BESIDE, [0.0], BESIDE)) - start) % turn
    pose = found.clash.pose(at)
    gap = float(found.clash.rollers(pose).min())
    return min(gap, float(found.clash.locking(pose).min())) if found.crank else gap


def _finds_slot(found: Outlines) -> float:
    """The play, degrees, at which the roller would still meet the mouth of its slot."""
    return math.degrees(math.asin(min(1.0, found.sizes.half_width / found.sizes.rim)))


def _walls(found: Outlines) -> Iterator[Clearance]:
    """The walls that are left in the wheel and the crank, each held to ``wall_min_mm``."""
    size, least = found.sizes, found.sizes.wall_min
    yield clearance("wall_between_slots_mm", _between_slots(found), None, True, least)
    if found.crank:
        yield clearance("horn_mm", size.horn, None, True, least)
    if size.wheel_bore:
        yield clearance("wheel_bore_wall_mm", size.slot_end - size.wheel_bore, None, True, least)
    if size.outer:
        deepest = max(size.slot_end, found.plane.L + size.recess if size.lock else 0.0)
        yield clearance("outer_wall_mm", size.outer - deepest, None, True, least)
    if size.crank_bore and found.crank and is_whole(found.plane, size):
        wall = _relief_depth(found) - size.crank_bore
        yield clearance("crank_bore_wall_mm", wall, None, True, least)


def _between_slots(found: Outlines) -> float:
    """The thinnest wall between a slot and the next one, negative where they cut each other."""
    around, near = found.plane.slots, math.inf
    for i, (engagement, direction) in enumerate(around):
        following, ahead = around[(i + 1) % len(around)]
        walls = turned(found.slots[engagement], direction)
        ends = walls.segments[-1].end, walls.segments[0].start
        slot = closed(walls.layer, [*walls.segments, Line(*ends)])
        inside = Polyarc([backwards(slot) if found.plane.sign > 0.0 else slot])
        points = Polyarc([turned(found.slots[following], ahead)]).samples(
            1e-6 * found.plane.L, 0.01 * found.plane.L
        )
        near = min(near, float(inside.signed(points).min()))
        if all(s is engagement for s, _ in around):
            break
    return near


def _shafts(found: Outlines) -> Iterator[Clearance]:
    """Shafts and hubs against what passes them by."""
    plane, size = found.plane, found.sizes
    outside = plane.sign > 0.0
    shaft = max(size.crank_bore, size.crank_hub if size.crank_bore else 0.0)
    if shaft:
        # An internal wheel's horns sweep over the crank's axis, and there is no room at all.
        room = plane.L - size.rim - shaft if outside else -shaft
        yield clearance("crank_shaft_mm", room, None, True, 0.0)
        if is_whole(plane, size) and found.crank:
            yield clearance("crank_hub_mm", _relief_depth(found) - shaft, None, True, 0.0)
    hub = max(size.wheel_bore, size.wheel_hub)
    if hub and outside:
        yield clearance("wheel_shaft_mm", size.slot_end - hub, None, True, 0.0)


def _relief_depth(found: Outlines) -> float:
    """The distance of the crank's outline from its axis at the bottom of a relief."""
    return abs(float(Polyarc(found.crank).signed(np.zeros((1, 2)))[0]))


def _branches(found: Outlines) -> Iterator[Clearance]:
    """Of curved slots: how far the way in and the way out are apart, on the right side and not.

    Farther than the slot is wide an island is left between them, which falls out.
    """
    engagement = found.plane.slots[0][0]
    if not engagement.slot.curved:
        return
    t = engagement.entry_deg * (1.0 - np.arange(LOOKS) / LOOKS)
    (x, y), (u, v) = (engagement.slot(s * t, 0) for s in (1.0, -1.0))
    turn = np.remainder(
        np.arctan2(y.c[0], x.c[0]) - np.arctan2(v.c[0], u.c[0]) + np.pi, 2.0 * np.pi
    )
    apart = 2.0 * found.plane.L * np.hypot(x.c[0], y.c[0]) * np.sin(0.5 * (turn - np.pi))
    limit = 2.0 * found.sizes.half_width
    for name, gap in (("branches_apart_mm", apart), ("branches_crossed_mm", -apart)):
        i = int(np.argmax(gap))
        value = max(float(gap[i]), 0.0)
        at_deg = found.plane.given.shown_deg(engagement.mid_deg + float(t[i]))
        yield clearance(name, value, at_deg, False, limit)
