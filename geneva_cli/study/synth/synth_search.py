"""The search for machines that meet a requirement, with their costs, the best first."""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.registry import families_of_kinds, gearing, thing
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
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
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

# Entries of the table for parts that pass a full turn, and for parts that were not turned.
YES = "yes"
MAYBE = "maybe"
COSTS = ("velocity.max", "acceleration.max", "acceleration.entry", "jerk.max", "power.max")
TIMES = ("motion_deg", "dwell_deg", "tau", "k", "motion_s", "dwell_s")
# Cells that are quantities, and those of them that need a required speed.
QUANTITIES = {name.replace(".", "_"): name for name in (*COSTS, "acceleration.max_rad_s2")}
QUANTITIES |= {name: f"timing.{name}" for name in TIMES}
TIMED = ("motion_s", "dwell_s", "acceleration_max_rad_s2")
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
    """A machine: its spec, and cells by their names, with further requested quantities last."""

    spec: Spec
    cells: dict[str, Any]

    @property
    def trouble(self) -> str:
        """The reason why its parts cannot be built; empty if none is known."""
        return (self.cells["parts"] or "").partition(": ")[2]


def rows(target: Target, specs: Sequence[Spec]) -> list[MachineRow]:
    """The rows of machines that can be built and have the required motion."""
    limits, out = target.soft_bounds, dict[int, MachineRow]()
    names = [*QUANTITIES.values(), *(bound.name for bound in limits.values())]
    for members, machine in target.at_speed(batch_machines(specs)):
        own, n, m = [specs[i] for i in members.tolist()], len(members), machine.spec.drive.rollers
        radii, why = np.full(n, math.nan), [""] * n
        if any(spec.is_flat for spec in own):
            radii, why = suiting(machine, np.full(n, m))
        values = columns(machine, names, n)
        each = np.column_stack(np.broadcast_arrays(*values, np.ravel(machine.ratio)))
        suited = zip(radii.tolist(), why, strict=True)
        for i, spec, roller, row in zip(members, own, suited, each.tolist(), strict=True):
            known = dict(zip((*QUANTITIES, *limits, "ratio"), row, strict=True))
            motion_deg, in_turn = known["motion_deg"], m / spec.drive.turns
            allowed = target.motions(in_turn, motion_deg)
            if not (math.isfinite(known["acceleration_max"]) and allowed.allows(motion_deg)):
                continue
            spec = spec.with_("drive.n_rpm", target.n_rpm(in_turn, motion_deg))
            radius, obstacle = roller if spec.is_flat else _roller(spec)
            over = [k for k, b in limits.items() if not (math.isnan(x := known[k]) or b.kept(x))]
            parts = MAYBE if spec.is_turned else None
            if obstacle or (over and parts):
                parts = f"no: {obstacle or ', '.join(over)}"
            out[int(i)] = MachineRow(with_roller(spec, radius), _cells(target, spec, known, parts))
    return [out[i] for i in sorted(out)]


def _roller(spec: Spec) -> tuple[float, str]:
    """The roller that suits a machine without flat outlines, as ``suiting`` returns it."""
    suits = thing(spec.wheel.NAME, "roller") if spec.is_turned else None
    try:
        roller: tuple[float, str] = suits(build(spec)) if suits else (math.nan, "")
    except GenevaError as error:
        return math.nan, str(error)
    return roller


def _cells(
    target: Target, spec: Spec, values: Mapping[str, float], parts: str | None
) -> dict[str, Any]:
    keys, motion = spec.wheel.as_dict() | spec.drive.as_dict(), spec.motion
    cells: dict[str, Any] = {name: keys.get(name) for name in CELLS}
    known = [name for name in (*QUANTITIES, "ratio") if target.timed or name not in TIMED]
    cells |= {name: values[name] for name in known}
    return cells | {
        "gearing": spec.wheel.NAME,
        "rollers": spec.drive.rollers,
        "drive": spec.drive.NAME,
        "alpha0_deg": motion.alpha0_deg if motion else None,
        "law": motion.law.NAME if motion else None,
        "n_rpm": spec.drive.n_rpm if target.timed else None,
        "parts": parts,
        "offset_mm": cells["offset_mm"] or None,
    }


KIND = ("gearing", "z", "drive", "law", "fixed", "rollers")
# Least numbers of slots in a group: a search of so many four-bars has its fewest samples for each
# (four_bar_search), so that groups find what one search of all does.
GROUP = 24
Kind: TypeAlias = Callable[[Target, Sequence[Gearing]], Iterator[Family]]


def _rank(target: Target, row: MachineRow) -> tuple[object, ...]:
    """The sort key of a row: the goal's quantity, then peaks, equal in 12 digits."""
    cells, first = row.cells, tuple[object, ...]()
    if target.sort:
        value, sign = cells[target.sort.name], target.sort.sign
        # texts, and unknown values, come behind the numbers
        first = (0, float(f"{sign * value:.12g}")) if is_number(value) else (1, str(value))
    peak = cells["acceleration_max_rad_s2" if target.timed else "acceleration_max"]
    peaks = (float(f"{x:.12g}") for x in (peak, cells["jerk_max"]))
    return (*first, *peaks, *(cells[name] for name in ("rollers", "z", "gearing", "drive")))


def search(target: Target) -> list[MachineRow]:
    """The machines that meet the requirement, in order; no part has been turned yet."""
    narrowed = target.with_times()
    narrowed.refuse_contradictions()
    # without bounds on times there may be some, whose error message says how near they come
    every = _all_groups(narrowed, target.names) or _all_groups(target, target.names)
    if not every:
        raise GenevaError(_out_of_reach(target))
    # without a search for the goal or a bound a family has several rows: the first of each kind,
    # and the first that may be built
    has_one, can_be, out = in_batch(target.names), dict[object, bool](), list[MachineRow]()
    for i, row in enumerate(sorted(_bounded(target, every), key=partial(_rank, target))):
        kind: object = i if has_one else tuple(row.cells[name] for name in KIND)
        if kind not in can_be or (not can_be[kind] and not row.trouble):
            out.append(row)
            row.cells["no"] = len(out)
            can_be[kind] = not row.trouble
    return out


def _all_groups(target: Target, names: Sequence[str]) -> list[MachineRow]:
    """The rows of all independent groups of machines, in order, from all cores.

    They are straight slots, and laws, of each gearing; those of kinds. Each has some of the numbers
    of slots.
    """
    groups = np.array_split(target.z, max(len(target.z) // GROUP, 1))
    some = [target._replace(z=tuple(group.tolist())) for group in groups]
    each = [one._replace(gearings=(gearing,)) for gearing in target.gearings for one in some]
    tasks: list[tuple[Kind, Target]] = [
        *((kind, one) for kind in families_of_kinds("alone") for one in some),
        *((straight, one) for one in each),
        *((with_laws, one._replace(laws=(law,))) for law in target.laws for one in each),
    ]
    # a small search ends before a second process has started
    is_small = len(target.gearings) * len(target.z) * len(target.laws) <= 6
    workers = 1 if is_small else min(len(tasks), cores())
    done = mapped(partial(_group, names=names), tasks, workers)
    return [row for found in tracked(done, "groups of machines", len(tasks)) for row in found]


def _group(task: tuple[Kind, Target], names: Sequence[str]) -> list[MachineRow]:
    """The rows of a group."""
    kind, target = task
    wheels = [gearing(name)(z) for name in target.gearings for z in target.z]
    families: Sequence[Family] = [*kind(target, wheels)]
    if not in_batch(target.names):
        # the search cannot see them: they are computed for the best of several pieces of a family
        families = pieces(families, 120)
    found = rows(target, [*dict.fromkeys(best(families, target))])
    known = [name for name in names if in_batch([name])]
    values = numbers(batch_machines([row.spec for row in found]), known, len(found))
    for row, own in zip(found, values.T.tolist(), strict=True):
        if not any(map(math.isnan, own)):  # else it needs its own machine
            row.cells.update(zip(known, (None if math.isinf(x) else x for x in own), strict=True))
    return found


def _bounded(target: Target, found: list[MachineRow]) -> list[MachineRow]:
    """The rows, with the requested quantities, that keep the bounds."""
    names, bounds = target.names, target.bounds

    def keeps(row: MachineRow) -> bool:
        """True if a row keeps all bounds, as far as their values are known."""
        return all(b.kept(row.cells[b.name]) for b in bounds if b.name in row.cells)

    alone = [row for row in found if keeps(row) and not row.cells.keys() >= {*names}]
    specs = [row.spec for row in alone]
    rest = mapped(partial(_values, Pick(names)), specs, min(cores(), len(alone)))
    for row, cells in zip(alone, tracked(rest, "machines computed", len(alone)), strict=True):
        row.cells.update(zip(names, cells or (), strict=False))
    known = [row for row in found if row.cells.keys() >= {*names}]
    kept = [*filter(keeps, known)]
    if not kept:
        nearness = Nearness(bounds)
        if known:
            each = [[row.cells[name] for name in names] for row in known]
            nearness.add(rows_of(names, each).numbers)
        why = "; ".join(nearness.phrases())
        raise GenevaError(f"--subject-to: none of {len(found)} machines keeps all bounds: {why}")
    return kept


def _values(of: Pick, spec: Spec) -> list[Cell] | None:
    try:
        return of.of(build(spec))
    except GenevaError:  # parts that cannot be drawn have no quantities
        return None


def _out_of_reach(target: Target) -> str:
    """The error message if no machine was found."""
    m = target.rollers or next((int(m) for m in target.counts if m >= 1.0), 1)
    wheels = [gearing(name)(z) for name in target.gearings for z in target.z]
    most = max(rollers_max(natural_deg(wheel)) for wheel in wheels)
    text = f"{target.words}: out of reach with {'one roller' if m == 1 else f'{m} rollers'}; "
    return f"{text}straight slots carry at most {most} here: use more slots or a longer motion"
