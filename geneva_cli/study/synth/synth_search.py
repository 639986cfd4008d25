"""The search for machines that meet a requirement, with their costs, the best first."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.registry import families_of_kinds, gearing
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.progress import tracked
from geneva_cli.study.batches import batch_machines, numbers
from geneva_cli.study.fields import Pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.rows import Cell, rows_of
from geneva_cli.study.sweep.constraints import Nearness, is_number
from geneva_cli.study.synth.families.curved_slots import with_laws
from geneva_cli.study.synth.families.family import Family, natural_deg, pieces
from geneva_cli.study.synth.families.straight_slots import straight
from geneva_cli.study.synth.family_search import best
from geneva_cli.study.synth.machine_rows import MachineRow, rows
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

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
    narrowed, errors = target.with_times(), list[str]()
    narrowed.refuse_contradictions()
    every = _all_groups(narrowed, target.names, False, errors)
    if not every:  # the error message says how near they come
        errors.clear()
        every = _all_groups(target, target.names, True, errors)
    if not every:
        raise GenevaError(_out_of_reach(target, errors))
    ranking = Ranking([], narrowed, target)
    kept = sorted(_bounded(target, every), key=ranking.rank)
    # without a search for the goal or a bound a family has several rows: the first of each kind,
    # and the first that may be built
    every_kind, can_be = in_batch(target.names), dict[object, bool]()
    for i, row in enumerate(kept):
        kind: object = tuple(row.cells[name] for name in KIND)
        if every_kind and row.cells["crank_mm"] is None:
            kind = i
        if kind not in can_be or (not can_be[kind] and not row.trouble):
            ranking.rows.append(row)
            row.cells["no"] = len(ranking.rows)
            can_be[kind] = not row.trouble
    return ranking


def _all_groups(
    target: Target, names: Sequence[str], how_near: bool, errors: list[str]
) -> list[MachineRow]:
    """The rows of all independent groups of machines, in order, from all cores.

    They are straight slots, and laws, of each gearing; those of kinds. Each has some of the numbers
    of slots. With ``how_near`` those that break the bounds are among them. The reasons against
    machines are added to ``errors``.
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
    done = mapped(partial(_group, names=names, how_near=how_near), tasks, workers, "machines")
    out = list[MachineRow]()
    for found, reasons in tracked(done, "groups of machines", len(tasks)):
        out += found
        errors += reasons
    return out


def _group(
    task: tuple[Kind, Target], names: Sequence[str], how_near: bool
) -> tuple[list[MachineRow], list[str]]:
    """The rows of a group, and the reasons against the other machines."""
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
    errors: list[str] = []
    found = rows(target, [*dict.fromkeys(shown)], errors)
    if not (names and in_batch(names)):
        return found, errors
    out, values = [], numbers(batch_machines([row.spec for row in found]), names, len(found))
    for row, own in zip(found, values.T.tolist(), strict=True):
        cells = tuple(None if math.isinf(x) else x for x in own)
        # a row without one of them needs its own machine
        out.append(row if any(map(math.isnan, own)) else row._replace(extra=cells))
    return out, errors


def _bounded(target: Target, found: list[MachineRow]) -> list[MachineRow]:
    """The rows, with the requested quantities, that keep the bounds."""
    names = target.names
    if not names:
        return found
    alone = [row.spec for row in found if not row.extra]
    rest = mapped(partial(_values, Pick(names)), alone, min(cores(), len(alone)), "machines")
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


def _out_of_reach(target: Target, errors: list[str]) -> str:
    """The error message if no machine was found."""
    m = target.rollers or next((int(m) for m in target.counts if m >= 1.0), 1)
    wheels = [gearing(name)(z) for name in target.gearings for z in target.z]
    most = max(rollers_max(natural_deg(wheel)) for wheel in wheels)
    first = f"; the first says: {errors[0]}" if errors else ""
    rollers = "one roller" if m == 1 else f"{m} rollers"
    return (
        f"{target.words}: out of reach with {rollers}; straight slots carry at most {most} here: "
        f"use more slots or a longer motion{first}"
    )
