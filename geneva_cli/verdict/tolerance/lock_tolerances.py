"""Parts as they are cut within the tolerances: their locks, and the extremes of their machines."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeAlias

from geneva_cli.loads.tolerance.locking import CutLock, Lock
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.records import thing
from geneva_cli.parts.outlines.cut_outlines import cut_arcs
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.parts import Parts

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
