"""The clearances with which every machine within the tolerances still turns.

The tightest machine has the largest roller in the narrowest slot, and the largest disc in the
smallest recess. At entry the wheel rests in its lock. The deviations of crank radius, centre
distance and slot angle then offset the roller from the slot. The wheel yields by the least play of
its lock; the slot's clearance must take the rest. The deviation of the centre distance reduces the
lock's clearance. These sums are exact if the roller enters along the slot. If the clearances
suffice, the parts of the tightest and the loosest machine are turned through a whole turn.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.impacts.entry import arm_mm
from geneva_cli.loads.tolerance.dimensions import corners
from geneva_cli.loads.tolerance.locking import CutLock, Lock
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.records import thing
from geneva_cli.parts.outlines.cut_outlines import cut_arcs
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.spec.tables import Limits, Tolerance
from geneva_cli.verdict.checks.all_checks import turn_checks

SAME = 1e-6  # fraction of the centre distance, or radians: nearer radii and angles are equal
# The lock's need, None for none, and the spec of the tightest machine (-1) or the loosest (+1)
Corners: TypeAlias = tuple[float | None, Callable[[float], Spec]]


class CutParts:
    """Flat parts as they are cut."""

    def __init__(self, parts: Parts) -> None:
        self.outlines = parts.outlines

    def locks(self) -> Sequence[CutLock]:
        """The locks, one for each shape; none without a locking disc."""
        return flat_locks(self.outlines)

    def corners(self, spec: Spec, sizes: dict[str, float], slot: float) -> Corners:
        """The clearance that the lock needs, and the specs of tightest and loosest machine."""
        ring = sizes["lock_radius_mm"] + sizes["recess_radius_mm"]
        lock = ring + sizes["center_distance_mm"] if self.outlines.crank else None
        return lock, lambda sign: corner(spec, self.outlines, sizes, sign, slot, lock or 0.0)


def cut_parts(parts: Parts) -> CutParts:
    """The parts as they are cut, which a kind of wheel may have in its own way."""
    wheel = parts.mechanism.spec.wheel.NAME
    cut: CutParts = (thing(wheel, "cut_parts") or CutParts)(parts)
    return cut


def flat_locks(outlines: Outlines) -> list[Lock]:
    """Each corner of a recess with each locking arc of the crank; none without a locking disc."""
    size, assembly = outlines.sizes, outlines.assembly
    if not outlines.crank:
        return []
    near = SAME * assembly.L
    radii = {
        round(math.hypot(*end) / near): math.hypot(*end)
        for arc in cut_arcs([outlines.wheel], size.recess, assembly.L, near)
        for end in (arc.start, arc.end)
    }
    halves = {
        round(arc.sweep / SAME): 0.5 * abs(arc.sweep)
        for arc in cut_arcs(outlines.crank, size.lock, 0.0, near)
    }
    return [
        Lock(assembly.L, assembly.sign, size.lock, size.recess, radius, half)
        for radius in radii.values()
        for half in halves.values()
        if half > SAME
    ]


def corner(
    spec: Spec, outlines: Outlines, sizes: dict[str, float], sign: float, slot: float, lock: float
) -> Spec:
    """The spec of the tightest machine (``sign`` -1) or the loosest (+1); other sizes fixed."""
    cut, size = outlines.sizes, spec.size
    roller = cut.roller - sign * 0.5 * sizes["roller_diameter_mm"]
    clearance = max(size.allowances.slot_clearance_mm + sign * slot, 0.0)
    end = cut.slot_bottom + cut.half_width - roller - clearance
    changed = size.replace(
        roller_radius_mm=roller,
        slot_clearance_mm=clearance,
        slot_bottom_clearance_mm=max(end, 0.0),
        lock_radius_mm=cut.lock - sign * sizes["lock_radius_mm"],
        lock_clearance_mm=max(size.allowances.lock_clearance_mm + sign * lock, 0.0),
        wheel_radius_mm=cut.rim,
        relief_clearance_mm=cut.relief,
        relief=outlines.relief if outlines.crank else size.relief,
        wheel_bore_mm=2.0 * cut.wheel_bore,
        wheel_hub_mm=2.0 * cut.wheel_hub,
        crank_bore_mm=2.0 * cut.crank_bore,
        crank_hub_mm=2.0 * cut.crank_hub,
        pin_mm=2.0 * cut.pin,
    )
    if cut.outer:
        changed = changed.replace(wheel_outer_radius_mm=cut.outer)
    return spec.replace(size=changed)


class RequiredClearances(NamedTuple):
    """The clearances needed, mm per side, and whether the parts turn within all tolerances.

    ``lock_mm`` is None without a locking disc. ``turns`` is None if parts cannot be turned. ``why``
    names what fails, or the reason why it is unknown.
    """

    slot_mm: float
    lock_mm: float | None
    turns: bool | None
    why: str


class LeastClearances(NamedTuple):
    """The clearances that tolerances need, mm per side, and the machines at their ends."""

    slot_mm: float
    lock_mm: float | None
    corner: Callable[[float], Spec]

    def short(self, spec: Spec) -> str:
        """The clearances of a spec that are too small, in words; empty if there are none."""
        size, short = spec.size.allowances, []
        if size.slot_clearance_mm < self.slot_mm * (1.0 - 1e-12):
            short.append(f"slot_clearance_mm must be at least {self.slot_mm:.6g}")
        if self.lock_mm is not None and size.lock_clearance_mm < self.lock_mm * (1.0 - 1e-12):
            short.append(f"lock_clearance_mm must be at least {self.lock_mm:.6g}")
        return " and ".join(short)

    def turns(self) -> tuple[bool | None, str]:
        """Whether the tightest and the loosest machine turn, None if unknown; and why not."""
        for sign, words in (
            (-1.0, "largest roller and locking disc, narrowest slot and recess"),
            (1.0, "smallest roller and locking disc, widest slot and recess"),
        ):
            failed = _failing_check(self.corner(sign))
            if failed:
                return failed[0], f"with the {words}: {failed[1]}"
        return True, ""


def required_clearances(
    mechanism: Mechanism, parts: Parts, sizes: dict[str, float]
) -> RequiredClearances:
    """The clearances that the tolerances need, and a whole turn of the tightest and the loosest.

    ``sizes`` are the tolerances that apply, in millimetres and radians.
    """
    spec, why = mechanism.spec, mechanism.no_turn or "there are no drawn parts to turn"
    drawn = spec.is_turned and not mechanism.no_turn
    try:
        least = least_clearances(mechanism, parts.turned, sizes) if drawn else None
    except GenevaError as error:
        least, why = None, str(error)
    if least is None:
        return RequiredClearances(_slot_mm(mechanism, sizes, 0.0), None, None, why)
    short = least.short(spec)
    turns, why = (False, short) if short else least.turns()
    return RequiredClearances(least.slot_mm, least.lock_mm, turns, why)


def least_clearances(
    mechanism: Mechanism, parts: Parts, sizes: dict[str, float]
) -> LeastClearances:
    """The clearances with which machines within the tolerances enter their slots and locks."""
    ends = corners(list(sizes.values()))
    cut = cut_parts(parts)
    plays = [float(np.min(lock(ends).angle.c[0])) for lock in cut.locks()]
    slot = _slot_mm(mechanism, sizes, min(plays, default=0.0))
    return LeastClearances(slot, *cut.corners(mechanism.spec, sizes, slot))


def _slot_mm(mechanism: Mechanism, sizes: dict[str, float], least_play: float) -> float:
    """The clearance that the slot needs; ``least_play`` is that of the lock, radians."""
    fit = 0.5 * (sizes["roller_diameter_mm"] + sizes["slot_width_mm"])
    return fit + max(
        _slot_offset_mm(mechanism, e, sizes, least_play) for e in mechanism.engagements
    )


def _slot_offset_mm(
    mechanism: Mechanism, engagement: Engagement, sizes: dict[str, float], least_play: float
) -> float:
    """The roller's greatest offset from its slot at entry and exit, mm; at least 0."""
    L, arm = mechanism.center_distance_mm, arm_mm(mechanism, engagement)
    fraction = sizes["crank_radius_mm"] / arm
    most = 0.0
    for at in (engagement.entry_deg, engagement.exit_deg):
        x, y = engagement.path(at, 1)
        (px, vx), (py, vy) = x.scalars(), y.scalars()
        # the roller runs along the slot there, which gives its normal; on a sphere the meridian's
        tx, ty = (vx, vy) if engagement.slot.height is None else (px, py)
        far = math.hypot(tx, ty)
        nx, ny = -ty / far, tx / far
        of_arm = abs(nx * (px - engagement.hub) + ny * py) * L * fraction
        of_distance = abs(nx) * sizes["center_distance_mm"]
        lever = abs(ny * px - nx * py) * L
        of_angle = lever * (math.sin(sizes["slot_angle_deg"]) - math.sin(least_play))
        most = max(most, of_arm + of_distance + of_angle)
    return most


def _failing_check(spec: Spec) -> tuple[bool | None, str] | None:
    """The check of a whole turn that fails; None if all pass."""
    try:
        parts = parts_of(build(spec.replace(tolerance=Tolerance(), limits=Limits())))
        rows = list(turn_checks(parts, parts.turned.turn))
    except GenevaError as error:
        return None, str(error)
    for row in rows:
        if row.passes is False:
            return False, f"{row.name} is {row.value:.4g}, must be {row.must_be} {row.limit:.4g}"
    return None
