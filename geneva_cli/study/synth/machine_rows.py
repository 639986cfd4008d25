"""The rows of a synthesis: each machine's description and costs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.registry import thing
from geneva_cli.motion.timing import Timing, timing
from geneva_cli.numerics.angles import omega
from geneva_cli.study.batches import batch_machines, columns, numbers
from geneva_cli.study.synth.families.family import allows
from geneva_cli.study.synth.suiting import suiting, with_roller
from geneva_cli.study.target import USUAL_RPM, Target

# Entries of the table for parts that pass a full turn, and for parts that were not turned.
YES = "yes"
MAYBE = "maybe"
COSTS = ("velocity.max", "acceleration.max", "acceleration.entry", "jerk.max", "power.max")
TIMES = ("motion_deg", "dwell_deg", "tau", "k", "motion_s", "dwell_s")
# The cells of a row: its number from 1, the machine's keys as far as it has them, its costs
# (invariants), its times in seconds if they are required, and whether its parts can be built; None
# if they are not drawn.
CELLS = (
    *("no", "z", "gearing", "rollers", "drive", "A", "eccentricity", "phase", "axes_deg"),
    "alpha0_deg",
    *("law", "ratio", "motion_deg", "dwell_deg", "tau", "k", "velocity_max", "acceleration_max"),
    *("acceleration_entry", "jerk_max", "power_max", "n_rpm", "acceleration_max_rad_s2", "parts"),
    *("offset_mm", "planet_ratio", "fixed", "motion_s", "dwell_s", "crank_mm", "ground_mm"),
    *("coupler_mm", "rocker_mm", "point_mm", "point_deg", "entry_deg", "sector_deg", "first_z"),
)


class MachineRow(NamedTuple):
    """A machine: its spec, cells by their names, and further requested quantities."""

    spec: Spec
    cells: dict[str, Any]
    extra: tuple[float | int | str | bool | None, ...] = ()

    @property
    def peak(self) -> float:
        """The greatest acceleration, in rad/s² if the speed is required."""
        per_s2: float | None = self.cells["acceleration_max_rad_s2"]
        return self.cells["acceleration_max"] if per_s2 is None else per_s2

    @property
    def trouble(self) -> str:
        """The reason why its parts cannot be built; empty if none is known."""
        return (self.cells["parts"] or "").partition(": ")[2]


def rows(target: Target, specs: Sequence[Spec], errors: list[str]) -> list[MachineRow]:
    """The rows of machines that can be built and have the required motion.

    The reasons against others are added to ``errors``.
    """
    limits = target.soft_bounds
    # at the usual speed with one of its equal rollers a machine has the same peaks
    alone = [s.replace(drive=s.drive.replace(n_rpm=USUAL_RPM, rollers=1)) for s in specs]
    costs, sized = _costs_and_rollers(specs, alone)
    limited = numbers(batch_machines(specs), [b.name for b in limits.values()], len(specs))
    out: list[MachineRow] = []
    each = zip(specs, alone, sized, limited.T.tolist(), strict=True)
    for spec, one, (radius, why), held in each:
        cost, drive = costs.get(one), spec.drive
        *_, motion_deg, period, entry, end = cost or [math.nan] * 4
        dwell_deg = period / drive.rollers + entry - end
        if not dwell_deg > 1e-9:  # there is no machine, or rollers without a dwell may jam
            try:
                build(spec)
            except GenevaError as error:
                errors.append(str(error))
                continue
        if cost is None:
            continue
        motion = target.motion_for(drive.rollers / drive.turns)
        if motion is not None and not allows(motion, motion_deg):
            continue
        dwell_deg = dwell_deg if dwell_deg > 1e-9 else 0.0
        index_deg = spec.wheel.index_deg(0)
        times = timing(motion_deg, dwell_deg, index_deg, drive.n_rpm, None, drive.stop_s)
        bounds = zip(limits.items(), held, strict=True)
        over = [key for (key, bound), x in bounds if not (np.isnan(x) or bound.kept(x))]
        parts = MAYBE if spec.is_turned else None
        if why or (over and parts):
            parts = f"no: {why or ', '.join(over)}"
        cells = _cells(target, spec, cost, times, parts)
        out.append(MachineRow(with_roller(spec, radius), cells))
    return out


def _costs_and_rollers(
    specs: Sequence[Spec], alone: Sequence[Spec]
) -> tuple[dict[Spec, list[float]], list[tuple[float, str]]]:
    """The costs, R/L, motion, period and ends of the machines ``alone``; the rollers that suit.

    ``alone`` are the specs with one roller each. The rollers are those of specs, with obstacles.
    Both come from the same batches. A spec that makes no machine, or one whose acceleration has no
    bound, has no costs.
    """
    # with the same slots and rollers' paths: plain cranks, whatever turns them
    slots = [
        one.replace(drive=Crank(n_rpm=USUAL_RPM)) if s.motion is None and s.drive.crank else one
        for s, one in zip(specs, alone, strict=True)
    ]
    several: dict[Spec, dict[int, None]] = {}  # the numbers of rollers with such slots
    for spec, one in zip(specs, slots, strict=True):
        if spec.is_flat:
            several.setdefault(one, {})[spec.drive.rollers] = None
    costs: dict[Spec, list[float]] = {}
    found: dict[tuple[Spec, int], tuple[float, str]] = {}
    each = [*dict.fromkeys((*alone, *several))]
    for members, machine in batch_machines(each):
        own = [each[i] for i in members.tolist()]
        if values := columns(machine, COSTS, len(own)):
            (moved,) = machine.engagements
            ends = moved.mid_deg + moved.entry_deg, moved.mid_deg + moved.exit_deg
            more = machine.ratio, moved.motion_deg, machine.period_deg, *ends
            table = np.broadcast_arrays(*values, *map(np.ravel, more))
            known = zip(own, np.column_stack(table).tolist(), strict=True)
            costs |= {spec: row for spec, row in known if math.isfinite(row[1])}
        pairs = [(i, one, m) for i, one in enumerate(own) for m in several.get(one, ())]
        if pairs:
            which, suited_specs, counts = zip(*pairs, strict=True)
            radii, why = suiting(machine, np.array(which), np.array(counts))
            suited = zip(radii.tolist(), why, strict=True)
            found.update(zip(zip(suited_specs, counts, strict=True), suited, strict=True))
    out = []
    for spec, one in zip(specs, slots, strict=True):
        roller = found.get((one, spec.drive.rollers), (math.nan, ""))
        if not spec.is_flat and spec.is_turned and (suits := thing(spec.wheel.NAME, "roller")):
            try:
                roller = suits(build(spec))
            except GenevaError as error:
                roller = math.nan, str(error)
        out.append(roller)
    return costs, out


def _cells(
    target: Target, spec: Spec, costs: list[float], times: Timing, parts: str | None
) -> dict[str, Any]:
    keys, motion, n = spec.wheel.as_dict() | spec.drive.as_dict(), spec.motion, spec.drive.n_rpm
    cells: dict[str, Any] = {name: keys.get(name) for name in CELLS}
    cells |= {name.replace(".", "_"): cost for name, cost in zip(COSTS, costs, strict=False)}
    cells |= {name: getattr(times, name) for name in TIMES if target.timed or name[-2:] != "_s"}
    return cells | {
        "gearing": spec.wheel.NAME,
        "rollers": spec.drive.rollers,
        "drive": spec.drive.NAME,
        "alpha0_deg": motion.alpha0_deg if motion else None,
        "law": motion.law.NAME if motion else None,
        "ratio": costs[len(COSTS)],
        "n_rpm": n if target.timed else None,
        "acceleration_max_rad_s2": costs[1] * omega(n) ** 2 if target.timed else None,
        "parts": parts,
        "offset_mm": cells["offset_mm"] or None,
    }
