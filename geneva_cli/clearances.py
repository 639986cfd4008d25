"""What stands between the parts: walls, horns, shafts, and what a whole turn shows.

Each as a value, its limit, and where it fails a size that would pass.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.crank import is_whole
from geneva_cli.drawing import Line, backwards, closed
from geneva_cli.errors import GenevaError
from geneva_cli.full_turn import FullTurn, full_turn
from geneva_cli.keys import Size
from geneva_cli.measure import turned
from geneva_cli.mechanism import Mechanism, build
from geneva_cli.outline import Outlines, outlines
from geneva_cli.polyarc import Polyarc
from geneva_cli.station import LawDriven

PUSH_MAX_DEG = 60.0  # pressure angle at which a roller still pushes the wheel into line
LOOKS = 400  # places at which the branches of a curved slot are compared
FREE = (  # sizes that are put back to their defaults, one by one, to free a machine that jams
    "wheel_radius_mm",
    "lock_radius_mm",
    "relief",
    "relief_clearance_mm",
    "slot_bottom_clearance_mm",
    "wheel_outer_radius_mm",
    "lock_clearance_mm",
    "slot_clearance_mm",
    "roller_radius_mm",
)
SHARES = (0.9, 0.8, 0.7, 0.6, 0.5, 0.4)
NEARLY = 0.02  # of the way from what jams to the default, by which advice may be rounded
TRIES = 8  # halvings between a size that jams and one that does not


class Clearance(NamedTuple):
    """One clearance; ``at_least`` says which side of the limit passes."""

    name: str
    value: float
    at_deg: float | None
    at_least: bool
    limit: float
    passes: bool
    nearest: str = ""


def clearances(found: Outlines, turn: FullTurn) -> list[Clearance]:
    """All clearances of a machine's parts."""
    rows = [*_walls(found), *_shafts(found), *_branches(found)]
    return [*rows, *_advised(found, turning(found, turn))]


def turning(found: Outlines, turn: FullTurn) -> list[Clearance]:
    """What a whole turn shows: no parts overlap, the wheel is held and pushed into line.

    Without advice where only a whole turn of another size can tell what would help.
    """
    smallest = turn.smallest
    fits = smallest.mm >= -found.close
    value = 0.0 if abs(smallest.mm) <= found.close else smallest.mm
    rows = [Clearance("gap_mm", value, smallest.at_deg, True, 0.0, fits)]
    if turn.idle is not None:
        gap = max(turn.idle.mm, 0.0) if turn.idle.mm >= -found.close else turn.idle.mm
        clears = gap >= 0.0
        advice = "" if clears else f"roller_radius_mm = {_floor(found.sizes.roller + gap):.4g}"
        rows.append(Clearance("idle_roller_mm", gap, turn.idle.at_deg, True, 0.0, clears, advice))
    if not found.crank:
        return rows
    limit, play, push = _finds_slot(found), turn.hand_over_deg, turn.push_deg
    held, pushes = play <= limit, push <= PUSH_MAX_DEG
    return [
        *rows,
        Clearance("dwell_play_deg", turn.dwell_play_deg, None, False, limit, True),
        Clearance("hand_over_play_deg", play, turn.hand_over_at_deg, False, limit, held),
        Clearance("hand_over_pressure_deg", push, turn.push_at_deg, False, PUSH_MAX_DEG, pushes),
    ]


def _advised(found: Outlines, rows: list[Clearance]) -> list[Clearance]:
    """Rows of ``turning`` with a size that would free the machine; it takes some seconds."""
    if all(c.passes or c.nearest for c in rows):
        return rows
    advice = freed(found)
    return [c if c.passes or c.nearest else c._replace(nearest=advice) for c in rows]


def jam(found: Outlines, turn: FullTurn) -> str:
    """Why a machine does not turn, where, and what would free it; nothing if it turns."""
    failing = [c for c in _advised(found, turning(found, turn)) if not c.passes]
    wall = next(iter(_walls(found)))
    failing += [wall] if wall.value < 0.0 else []
    if not failing:
        return ""
    said = []
    for c in failing:
        where = "" if c.at_deg is None else f" at input angle {c.at_deg:.6g} deg"
        if c.name == "gap_mm":
            said.append(f"{turn.smallest.parts} overlap by {-c.value:.4g} mm{where}")
        elif c.name == "idle_roller_mm":
            said.append(f"an idle roller overlaps the wheel by {-c.value:.4g} mm{where}")
        elif c.name == "wall_between_slots_mm":
            said.append(f"neighbouring slots cut each other by {-c.value:.4g} mm")
        elif c.name == "hand_over_play_deg":
            said.append(
                f"at rest the wheel can turn by {c.value:.4g} deg{where}, more than the "
                f"{c.limit:.4g} at which the roller still finds its slot"
            )
        else:
            said.append(
                f"the roller meets the wheel{where} at a pressure angle of {c.value:.4g} deg, "
                f"above {c.limit:g}"
            )
    advice = next((c.nearest for c in failing if c.nearest), "")
    return "; ".join(said) + (f"; {advice} would free it" if advice else "")


def freed(found: Outlines) -> str:
    """A size that frees a machine that jams: a given one nearer to its default, or a roller."""
    mechanism = found.plane.mechanism
    size = mechanism.spec.size
    defaults = Size(center_distance_mm=size.center_distance_mm)
    for key in FREE:
        now = getattr(size, key)
        if now is None:
            continue
        if now != getattr(defaults, key) and _passes(_with(mechanism, key, getattr(defaults, key))):
            return _nearest(mechanism, key, now)
    now = found.sizes.roller
    for share in SHARES:
        if _passes(_with(mechanism, "roller_radius_mm", share * now)):
            return f"roller_radius_mm = {share * now:.4g}"
    wheel = mechanism.spec.wheel
    for share in SHARES if wheel.offset_mm else ():
        less = float(f"{share * wheel.offset_mm:.4g}")
        spec = mechanism.spec._replace(wheel=wheel._replace(offset_mm=less))
        if _passes(build(spec)):
            return f"offset_mm = {less:.4g}"
    return ""


def _nearest(mechanism: Mechanism, key: str, now: float | str) -> str:
    """The value between one that jams and the default that is nearest to the one that jams."""
    default = _default(mechanism, key)
    if not isinstance(now, float) or not isinstance(default, float):
        return f"leaving out {key}" if default is None else f"{key} = {default}"
    good, bad = default, now
    for _ in range(TRIES):
        middle = 0.5 * (good + bad)
        good, bad = (middle, bad) if _passes(_with(mechanism, key, middle)) else (good, middle)
    # Rounded to where it passes, to as many digits as the distance needs.
    for digits in range(4, 12):
        step = 10.0 ** (math.floor(math.log10(abs(good) or 1.0)) + 1 - digits)
        shown = step * (math.floor(good / step) if good < bad else math.ceil(good / step))
        if abs(shown - good) <= NEARLY * abs(now - default):
            break
    return (
        f"{key} = {shown:.{digits}g}"
        if _passes(_with(mechanism, key, shown))
        else f"{key} = {good!r}"
    )


def _default(mechanism: Mechanism, key: str) -> float | None:
    """What a size is when the spec does not say."""
    without = _with(mechanism, key, getattr(Size(), key))
    assert without is not None  # it was built before
    plain = outlines(without).sizes
    of: dict[str, float] = {
        "wheel_radius_mm": plain.rim,
        "lock_radius_mm": plain.lock,
        "relief_clearance_mm": plain.relief,
        "slot_bottom_clearance_mm": plain.slot_bottom,
        "wheel_outer_radius_mm": plain.outer,
        "lock_clearance_mm": 0.0,
        "slot_clearance_mm": 0.0,
        "roller_radius_mm": plain.roller,
    }
    return of.get(key)


def _with(mechanism: Mechanism, key: str, value: float | str | None) -> Mechanism | None:
    spec = mechanism.spec
    try:
        changed: dict[str, Any] = {key: value}
        return build(spec._replace(size=spec.size._replace(**changed)))
    except GenevaError:
        return None


def _passes(mechanism: Mechanism | None) -> bool:
    if mechanism is None:
        return False
    try:
        found = outlines(mechanism)
    except GenevaError:
        return False
    turns = all(c.passes for c in turning(found, full_turn(found)))
    return turns and _between_slots(found) >= 0.0


def _finds_slot(found: Outlines) -> float:
    """The play, degrees, at which the roller would still meet the mouth of its slot."""
    return math.degrees(math.asin(min(1.0, found.sizes.half_width / found.sizes.rim)))


def _walls(found: Outlines) -> Iterator[Clearance]:
    """The wall between neighbouring slots, and the horn between slot and recess."""
    size = found.sizes
    value, least = _between_slots(found), size.wall_min
    passes = value >= least
    roller = size.roller - 0.5 * (least - value)
    advice = "" if passes or roller <= 0.0 else f"roller_radius_mm = {_floor(roller):.4g}"
    yield Clearance("wall_between_slots_mm", value, None, True, least, passes, advice)
    if not found.crank:
        return
    passes = size.horn >= least
    lock = size.lock - (least - size.horn)
    advice = "" if passes else f"lock_radius_mm = {_floor(lock):.4g}"
    yield Clearance("horn_mm", size.horn, None, True, least, passes, advice)


def _floor(value: float) -> float:
    """Rounded down to four digits, so that what is shown passes."""
    step = 10.0 ** (math.floor(math.log10(abs(value))) - 3)
    return math.floor(value / step) * step


def _between_slots(found: Outlines) -> float:
    """The thinnest wall between a slot and the next one, negative where they cut each other."""
    around, near = found.plane.slots, math.inf
    for i, (station, direction) in enumerate(around):
        following, ahead = around[(i + 1) % len(around)]
        walls = turned(found.slots[station], direction)
        ends = walls.segments[-1].end, walls.segments[0].start
        slot = closed(walls.layer, [*walls.segments, Line(*ends)])
        inside = Polyarc([backwards(slot) if found.plane.sign > 0.0 else slot])
        points = Polyarc([turned(found.slots[following], ahead)]).samples(
            1e-6 * found.plane.L, 0.01 * found.plane.L
        )
        near = min(near, float(inside.signed(points).min()))
        if all(s is station for s, _ in around):
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
        advice = "crank_bore_mm = 0"
        if plane.L - size.rim > 0.0 and outside:
            advice = f"crank_hub_mm = {2.0 * _floor(plane.L - size.rim):.4g}"
        yield _at_least("crank_shaft_mm", room, advice)
        if is_whole(plane, size) and found.crank:
            depth = _relief_depth(found)
            advice = f"crank_hub_mm = {2.0 * _floor(depth):.4g}"
            yield _at_least("crank_hub_mm", depth - shaft, advice)
    hub = max(size.wheel_bore, size.wheel_hub)
    if hub and outside:
        room = size.slot_end
        advice = f"wheel_hub_mm = {2.0 * _floor(room):.4g}"
        yield _at_least("wheel_shaft_mm", room - hub, advice)


def _at_least(name: str, value: float, advice: str) -> Clearance:
    passes = value >= 0.0
    return Clearance(name, value, None, True, 0.0, passes, "" if passes else advice)


def _relief_depth(found: Outlines) -> float:
    """The distance of the crank's outline from its axis at the bottom of a relief."""
    points = Polyarc(found.crank).samples(1e-6 * found.plane.L, 0.01 * found.plane.L)
    return float(np.hypot(*points.T).min())


def _branches(found: Outlines) -> Iterator[Clearance]:
    """Of curved slots: how far the way in and the way out are apart, on the right side and not.

    Farther than the slot is wide an island is left between them, which falls out.
    """
    station = found.plane.slots[0][0]
    if not isinstance(station, LawDriven):
        return
    t = station.entry_deg * (1.0 - np.arange(LOOKS) / LOOKS)
    (x, y), (u, v) = (station.pitch(s * t, 0) for s in (1.0, -1.0))
    turn = np.remainder(
        np.arctan2(y.c[0], x.c[0]) - np.arctan2(v.c[0], u.c[0]) + np.pi, 2.0 * np.pi
    )
    apart = 2.0 * found.plane.L * np.hypot(x.c[0], y.c[0]) * np.sin(0.5 * (turn - np.pi))
    limit = 2.0 * found.sizes.half_width
    for name, gap in (("branches_apart_mm", apart), ("branches_crossed_mm", -apart)):
        i = int(np.argmax(gap))
        value = max(float(gap[i]), 0.0)
        roller = found.sizes.roller + 0.5 * (value - limit)
        advice = "" if value <= limit else f"roller_radius_mm = {-_floor(-roller):.4g}"
        yield Clearance(name, value, float(t[i]), False, limit, value <= limit, advice)
