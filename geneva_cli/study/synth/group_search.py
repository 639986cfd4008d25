"""The rows of each independent group of machines that may meet a requirement, from all cores.

If one motion angle is required, a family's free number has a closed form. If a range is required,
``family_search`` chooses the best machine of each family.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.motion.records import families_of_kinds
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Mask
from geneva_cli.progress import tracked
from geneva_cli.study.batches import numbers
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.rows import Cell
from geneva_cli.study.synth.families.curved_slots import with_laws
from geneva_cli.study.synth.families.family import Family, pieces
from geneva_cli.study.synth.families.straight_slots import straight
from geneva_cli.study.synth.family_search import FamilyCosts, best
from geneva_cli.study.synth.fast_parts import has_no_obstacle
from geneva_cli.study.synth.machine_rows import MachineRow, rows, with_peak_limit
from geneva_cli.study.synth.optimiser import Places, accepted, sampled
from geneva_cli.study.synth.parts_data import compute_parts_data
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

Kind: TypeAlias = Callable[[Target, Sequence[Gearing]], Iterator[Family]]
# A function that turns a machine's parts and returns its row, None if they fail. It uses the sizes
# of another row that passes or, without one, the first sizes that do.
Turn: TypeAlias = Callable[[MachineRow, MachineRow | None], MachineRow | None]
# Least numbers of slots in a group: a search of so many four-bars has its fewest samples for each
# (four_bar_search), so that groups find what one search of all does.
GROUP = 24


class KindRows(NamedTuple):
    """The rows of one kind of machine, and whether one of its machines keeps the bounds."""

    rows: list[MachineRow]
    keeps: bool
    errors: list[str]


def all_kinds(
    target: Target, names: Sequence[str], how_near: bool = False, which: Sequence[bool] = ()
) -> list[KindRows]:
    """The results of all groups of machines, or of ``which``, in order, from all cores."""
    tasks = [task for i, task in enumerate(kinds(target)) if not which or which[i]]
    wheels = len(target.gearings) * len(target.z) * len(target.laws)
    many = which or wheels > 6  # a smaller search ends before a second process has started
    workers = min(len(tasks), cores()) if many else 1
    work = partial(_kind_rows, names=names, how_near=how_near)
    done = mapped(work, tasks, workers, "machines")
    return list(tracked(done, "groups of machines", len(tasks)))


def kinds(target: Target) -> list[tuple[Kind, Target]]:
    """Independent groups of machines: straight slots, and laws, of each gearing; those of kinds.

    Each has some of the numbers of slots. If the target has wheels on a carrier: the carousels of
    each gearing.
    """
    count = max(len(target.z) // GROUP, 1)
    ends = [-(-len(target.z) * i // count) for i in range(count + 1)]
    some = [target._replace(z=target.z[i:j]) for i, j in pairwise(ends)]
    each = [one._replace(gearings=(gearing,)) for gearing in target.gearings for one in some]
    if target.wheels:
        return [(kind, one) for kind in families_of_kinds("carrier") for one in each]
    alone = target.only_acceleration
    return [
        *((kind, one) for kind in families_of_kinds("alone") for one in some),
        *((straight, one.by_bounds if alone else one) for one in each),
        *((with_laws, one._replace(laws=(law,))) for law in target.laws for one in each),
    ]


def _kind_rows(task: tuple[Kind, Target], names: Sequence[str], how_near: bool) -> KindRows:
    kind, target = task
    wheels = [target.wheel(gearing, z) for gearing in target.gearings for z in target.z]
    families: Sequence[Family] = [*kind(target, wheels)]
    if not in_batch(target.quantities):
        # the search cannot see them: they are computed for the best of several pieces of a family
        families = pieces(families, 120)
    one_each, near = best(families, target, how_near)
    of = dict(reversed([*one_each, *near]))
    specs = [*dict.fromkeys(spec for spec, _ in one_each)]
    # the bounds that do not depend on the roller; None where a machine is computed alone
    bounds = [b for b in target.known_bounds if not b.name.startswith("loads.")]
    keep: list[bool | None] = [True] * len(specs)
    if bounds:
        values = numbers(specs, [b.name for b in bounds])
        keep = [
            None if x is None else all(b.kept(v) for b, v in zip(bounds, x, strict=True))
            for x in values
        ]
    shown = [spec for spec, keeps in zip(specs, keep, strict=True) if keeps is not False]
    if how_near:
        shown += [spec for spec, keeps in zip(specs, keep, strict=True) if keeps is False]
        shown += [spec for spec, _ in near]
    errors: list[str] = []
    found = [
        row._replace(family=of[spec].whole) if of[spec].can_vary else row
        for spec, row in zip(shown, rows(target, shown, errors), strict=True)
        if row
    ]
    return KindRows(with_batch_values(names, found), any(keep), errors)


def with_batch_values(names: Sequence[str], rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows with their quantities from batches; without them if a row needs its own machine."""
    if not (names and in_batch(names)):
        return list(rows)
    values = numbers([row.spec for row in rows], names)
    return [row._replace(extra=_cells(one or ())) for row, one in zip(rows, values, strict=True)]


def replacement_rows(
    target: Target, first: Sequence[MachineRow], ranked: Sequence[MachineRow]
) -> list[MachineRow]:
    """Replacements for the ``first`` rows that cannot be built: the best of their families.

    Rows that break a limit of the frame are left out; another search replaces them.
    """
    able = {row.family for row in ranked if not row.is_impossible}
    stuck = [row.family for row in first if row.is_impossible and not row.breaks_limit]
    families = [*dict.fromkeys(family for family in stuck if family and family not in able)]
    known = {row.spec for row in ranked}
    others = buildable_rows(target, families) if families else []
    return [row._replace(is_replacement=True) for row in others if row and row.spec not in known]


def buildable_rows(
    target: Target, families: Sequence[Family], turn: Turn | None = None
) -> list[MachineRow | None]:
    """For each family the row of its best machine that may be built; None for a family without.

    The place is precise to some thousandths of the span. With ``turn`` the machine passes a full
    turn, which takes a hundred times as long as a test: only a few are turned.
    """
    free = FamilyCosts(families, target)
    known: dict[tuple[int, float], MachineRow] = {}
    best_rows: dict[int, MachineRow] = {}

    def accept(places: Places) -> Mask:
        each = [*zip(places.of.tolist(), places.at[:, 0].tolist(), strict=True)]
        specs = [families[i].at(free.place(i, np.array([x]))) for i, x in each]
        limited = [spec and with_peak_limit(target, spec) for spec in specs]
        compute_parts_data(spec for spec in limited if spec)
        drawn = [k for k, spec in enumerate(limited) if spec and has_no_obstacle(spec)]
        for k, row in zip(drawn, rows(target, [limited[k] for k in drawn], []), strict=True):
            i, _ = each[k]
            if row and not row.is_impossible:
                own = row._replace(family=families[i])
                passing = turn(own, best_rows.get(i)) if turn else own
                if passing:
                    known[each[k]] = passing
        return np.array([one in known for one in each], dtype=bool)

    intervals, parts, samplings = (8, 2, 4) if turn else (16, 4, 4)
    counts = [f.several or intervals + 1 for f in families]
    lists = [i for i, f in enumerate(families) if f.several]
    at = np.concatenate([np.linspace(0.0, 1.0, count) for count in counts])[:, None]
    every = sampled(free, np.repeat(np.arange(len(families)), counts), at)
    good = accepted(every, accept)
    for number in range(samplings + 1):
        for one in zip(good.of.tolist(), good.at[:, 0].tolist(), strict=True):
            best_rows[one[0]] = known[one]
        if number < samplings:
            step = np.arange(-parts + 1, parts) / (intervals * parts ** (number + 1))
            refined = good.take(~np.isin(good.of, lists))
            near = np.clip(refined.at + step, 0.0, 1.0).reshape(-1, 1)
            samples = sampled(free, np.repeat(refined.of, len(step)), near)
            better = samples.take(samples.cost < np.repeat(refined.cost, len(step)))
            good = accepted(better, accept).joined(good).best(1)
    return [best_rows.get(i) for i in range(len(families))]


def _cells(values: Sequence[float]) -> tuple[Cell, ...]:
    """The cells of a row, None for undefined values; no cells if one must be computed alone."""
    if any(map(math.isnan, values)):
        return ()
    return tuple(None if math.isinf(value) else value for value in values)
