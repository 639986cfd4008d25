"""The search for machines that meet a requirement, with their costs, the best first.

A row is a machine with its description and its costs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.registry import families_of_kinds, gearing, thing
from geneva_cli.motion.timing import Timing, timing
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import omega
from geneva_cli.progress import tracked
from geneva_cli.study.batches import batch_machines, columns, numbers
from geneva_cli.study.fields import Cell, Pick, rows_of
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import Nearness, is_number
from geneva_cli.study.synth.families.curved_slots import with_laws
from geneva_cli.study.synth.families.family import Family, natural_deg, pieces
from geneva_cli.study.synth.families.straight_slots import straight
from geneva_cli.study.synth.family_search import best
from geneva_cli.study.synth.suiting import suiting, with_roller
from geneva_cli.study.target import USUAL_RPM, Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

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


def rows(target: Target, specs: Sequence[Spec]) -> list[MachineRow]:
    """The rows of machines that can be built and have the required motion."""
    limits = target.soft_bounds
    # at the usual speed with one of its equal rollers a machine has the same peaks
    alone = [s.replace(drive=s.drive.replace(n_rpm=USUAL_RPM, rollers=1)) for s in specs]
    costs, sized = _costs_and_rollers(specs, alone)
    limited = numbers(batch_machines(specs), [b.name for b in limits.values()], len(specs))
    out: list[MachineRow] = []
    each = zip(specs, alone, sized, limited.T.tolist(), strict=True)
    for spec, one, (radius, why), held in each:
        cost, drive = costs.get(one), spec.drive
        if cost is None:
            continue
        *_, motion_deg, period, entry, end = cost
        dwell_deg = period / drive.rollers + entry - end
        if not target.motions(drive.rollers / drive.turns, motion_deg).allows(motion_deg):
            continue
        if not dwell_deg > 1e-9:  # rollers without a dwell may jam
            dwell_deg = 0.0
            try:
                build(spec)
            except GenevaError:
                continue
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


KIND = ("gearing", "z", "drive", "law", "fixed", "rollers")
TURNED = 20  # rows whose parts are turned by default
# Least numbers of slots in a group: a search of so many four-bars has its fewest samples for each
# (four_bar_search), so that groups find what one search of all does.
GROUP = 24
Kind: TypeAlias = Callable[[Target, Sequence[Gearing]], Iterator[Family]]


class Ranking(NamedTuple):
    """The rows that meet a requirement, in order, and the requirement itself."""

    rows: list[MachineRow]
    target: Target  # with its bounds on times as ranges
    requested: Target

    def rank(self, row: MachineRow) -> tuple[object, ...]:
        """The sort key of a row: the goal's quantity, then peaks, equal in 12 digits."""
        target, numbers, cells = self.requested, [row.peak, row.cells["jerk_max"]], row.cells
        first: tuple[object, ...] = ()
        if target.sort:
            value = row.extra[target.names.index(target.sort.name)]
            # texts, and unknown values, come behind the numbers
            first = (1, str(value))
            if is_number(value):
                first = (0, float(f"{target.sort.sign * float(value):.12g}"))
        peaks = (float(f"{x:.12g}") for x in numbers)
        return (*first, *peaks, *(cells[name] for name in ("rollers", "z", "gearing", "drive")))


def search(target: Target) -> Ranking:
    """The machines that meet the requirement, in order; no part has been turned yet."""
    narrowed = target.with_times()
    narrowed.refuse_contradictions()
    # if there are none, the error message says how near they come
    every = _all_groups(narrowed, target.names, False) or _all_groups(target, target.names, True)
    if not every:
        raise GenevaError(_out_of_reach(target))
    ranking = Ranking([], narrowed, target)
    kept = sorted(_bounded(target, every), key=ranking.rank)
    # without a search for the goal or a bound a family has several rows: the first of each kind,
    # and the first that may be built
    has_one, can_be = in_batch(target.names), dict[object, bool]()
    for i, row in enumerate(kept):
        is_single = has_one and row.cells["crank_mm"] is None
        kind: object = i if is_single else tuple(row.cells[name] for name in KIND)
        if kind not in can_be or (not can_be[kind] and not row.trouble):
            ranking.rows.append(row)
            row.cells["no"] = len(ranking.rows)
            can_be[kind] = not row.trouble
    return ranking


def _all_groups(target: Target, names: Sequence[str], how_near: bool) -> list[MachineRow]:
    """The rows of all independent groups of machines, in order, from all cores.

    They are straight slots, and laws, of each gearing; those of kinds. Each has some of the numbers
    of slots. With ``how_near`` those that break the bounds are among them.
    """
    count = max(len(target.z) // GROUP, 1)
    ends = [-(-len(target.z) * i // count) for i in range(count + 1)]
    some = [target._replace(z=target.z[i:j]) for i, j in pairwise(ends)]
    each = [one._replace(gearings=(gearing,)) for gearing in target.gearings for one in some]
    tasks: list[tuple[Kind, Target]] = [
        *((kind, one) for kind in families_of_kinds("alone") for one in some),
        *((straight, one) for one in each),
        *((with_laws, one._replace(laws=(law,))) for law in target.laws for one in each),
    ]
    # a small search ends before a second process has started
    is_small = len(target.gearings) * len(target.z) * len(target.laws) <= 6
    workers = 1 if is_small else min(len(tasks), cores())
    done = mapped(partial(_group, names=names, how_near=how_near), tasks, workers)
    return [row for found in tracked(done, "groups of machines", len(tasks)) for row in found]


def _group(task: tuple[Kind, Target], names: Sequence[str], how_near: bool) -> list[MachineRow]:
    """The rows of a group."""
    kind, target = task
    wheels = [gearing(name)(z) for name in target.gearings for z in target.z]
    families: Sequence[Family] = [*kind(target, wheels)]
    if not in_batch(target.names):
        # the search cannot see them: they are computed for the best of several pieces of a family
        families = pieces(families, 120)
    specs, near = best(families, target, how_near)
    # the bounds that do not depend on the roller; what no batch computes may keep them
    bounds = [b for b in target.bounds if in_batch([b.name]) and not b.name.startswith("loads.")]
    values = numbers(batch_machines(specs), [b.name for b in bounds], len(specs))
    keeps = np.full(len(specs), True)
    for bound, own in zip(bounds, values, strict=True):
        keeps &= bound.kept_by(own) | np.isnan(own)
    shown = [specs[i] for i in np.flatnonzero(keeps).tolist()]
    if how_near:
        shown += [*(specs[i] for i in np.flatnonzero(~keeps).tolist()), *near]
    found = rows(target, [*dict.fromkeys(shown)])
    if not (names and in_batch(names)):
        return found
    out, values = [], numbers(batch_machines([row.spec for row in found]), names, len(found))
    for row, own in zip(found, values.T.tolist(), strict=True):
        cells = tuple(None if math.isinf(x) else x for x in own)
        # a row without one of them needs its own machine
        out.append(row if any(map(math.isnan, own)) else row._replace(extra=cells))
    return out


def _bounded(target: Target, found: list[MachineRow]) -> list[MachineRow]:
    """The rows, with the requested quantities, that keep the bounds."""
    names = target.names
    if not names:
        return found
    alone = [row.spec for row in found if not row.extra]
    rest = mapped(partial(_values, Pick(names)), alone, min(cores(), len(alone)))
    rest = tracked(rest, "machines computed", len(alone))
    values = [row.extra or next(rest) for row in found]
    pairs = zip(found, values, strict=True)
    known = [row._replace(extra=cells) for row, cells in pairs if cells is not None]
    bounds = [(names.index(b.name), b) for b in target.bounds]
    kept = [row for row in known if all(b.kept(row.extra[i]) for i, b in bounds)]
    if not kept:
        nearness = Nearness(bounds)
        if known:
            nearness.add(rows_of([row.extra for row in known]).numbers)
        why = "; ".join(nearness.phrases())
        raise GenevaError(f"--subject-to: none of {len(found)} machines keeps all bounds: {why}")
    return kept


def _values(of: Pick, spec: Spec) -> tuple[Cell, ...] | None:
    try:
        return tuple(of.of(build(spec)))
    except GenevaError:  # parts that cannot be drawn have no quantities
        return None


def _out_of_reach(target: Target) -> str:
    """The error message if no machine was found."""
    m = target.rollers or next((int(m) for m in target.counts if m >= 1.0), 1)
    wheels = [gearing(name)(z) for name in target.gearings for z in target.z]
    most = max(rollers_max(natural_deg(wheel)) for wheel in wheels)
    text = f"{target.words}: out of reach with {'one roller' if m == 1 else f'{m} rollers'}; "
    return f"{text}straight slots carry at most {most} here: use more slots or a longer motion"
