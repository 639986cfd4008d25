"""The machines of each independent group that may meet a requirement, searched in all cores.

If one motion angle is required, a family's free number has a closed form. If a range is required,
``family_search`` chooses the best machine of each family.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.records import families_of_kinds
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Mask
from geneva_cli.progress import tracked
from geneva_cli.study.batches import cells_of, numbers
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.families.curved_slots import with_laws
from geneva_cli.study.synth.families.family import Family, pieces
from geneva_cli.study.synth.families.straight_slots import straight
from geneva_cli.study.synth.family_search import FamilyCosts, best
from geneva_cli.study.synth.fast_parts import has_no_obstacle
from geneva_cli.study.synth.machine_rows import MachineRow, rows, with_peak_limit
from geneva_cli.study.synth.optimiser import (
    Places,
    accepted,
    sampled,
)
from geneva_cli.study.synth.parts_data import compute_parts_data
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import in_batch


class KindRows(NamedTuple):
    """The rows of one kind of machine, and whether one of its machines keeps the bounds."""

    rows: list[MachineRow]
    keeps: bool
    errors: list[str]


def all_kinds(
    target: Target,
    names: Sequence[str],
    how_near: bool = False,
    which: Sequence[bool] = (),
) -> list[KindRows]:
    """The results of all groups of machines, or of ``which``, in order, from all cores."""
    tasks = [task for i, task in enumerate(kinds(target)) if not which or which[i]]
    wheels = len(target.gearings) * len(target.z) * len(target.laws)
    many = which or wheels > 6  # a smaller search ends before a second process has started
    workers = min(len(tasks), cores()) if many else 1
    work = partial(_kind_rows, names=names, how_near=how_near)
    done = mapped(work, tasks, workers, "machines")
    return list(tracked(done, "groups of machines", len(tasks)))


def _kind_rows(task: tuple[Kind, Target], names: Sequence[str], how_near: bool) -> KindRows:
    kind, target = task
    errors: list[str] = []
    thing = [*families(kind, target)]
    if not in_batch(target.quantities):
        # the search cannot see them: they are computed for the best of several pieces of a family
        thing = pieces(thing, 120)
    one_each, near = best(thing, target, how_near)
    of = {one.spec: one.family for one in reversed([*one_each, *near])}
    keeps, kept, broken = _divided(
        target.known_bounds, [*dict.fromkeys(one.spec for one in one_each)]
    )
    shown = [*kept, *broken, *(one.spec for one in near)] if how_near else kept
    built_rows = [
        row._replace(family=of[spec].whole) if of[spec].can_vary else row
        for spec, row in zip(shown, rows(target, shown, errors), strict=True)
        if row
    ]
    return KindRows(with_batch_values(names, built_rows), keeps, errors)


def _divided(
    bounds: Sequence[Constraint], specs: list[Spec]
) -> tuple[bool, list[Spec], list[Spec]]:
    """Divide specs by the bounds that do not depend on the roller.

    Returns whether one of them is known to keep all, the specs that may keep them, and the others.
    """
    whatever = [b for b in bounds if not b.name.startswith("loads.")]
    if not whatever:
        return bool(specs), specs, []
    values = numbers(specs, [b.name for b in whatever])
    broken = [
        own is not None and not all(b.kept(x) for b, x in zip(whatever, own, strict=True))
        for own in values
    ]
    keeps = any(own and not out for own, out in zip(values, broken, strict=True))
    kept = [spec for spec, out in zip(specs, broken, strict=True) if not out]
    return keeps, kept, [spec for spec, out in zip(specs, broken, strict=True) if out]


def with_batch_values(names: Sequence[str], rows: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows with their quantities from batches; without them if a row needs its own machine."""
    if not (names and in_batch(names)):
        return list(rows)
    values = numbers([row.spec for row in rows], names)
    return [
        row._replace(extra=tuple(cells_of(one or ())))
        for row, one in zip(rows, values, strict=True)
    ]


Kind: TypeAlias = Callable[[Target, Sequence[Gearing]], Iterator[Family]]


def kinds(target: Target) -> list[tuple[Kind, Target]]:
    """Independent groups of machines: straight slots, and laws, of each gearing; those of kinds.

    Each has some of the numbers of slots. If the target has wheels on a carrier: the carousels of
    each gearing.
    """
    some = [target._replace(z=z) for z in _groups(target.z)]
    each = [one._replace(gearings=(gearing,)) for gearing in target.gearings for one in some]
    if target.wheels:
        return [(kind, one) for kind in families_of_kinds("carrier") for one in each]
    alone = target.only_acceleration
    return [
        *((kind, one) for kind in families_of_kinds("alone") for one in some),
        *((_straight, one.by_bounds if alone else one) for one in each),
        *((with_laws, one._replace(laws=(law,))) for law in target.laws for one in each),
    ]


# Least numbers of slots in a group: a search of so many four-bars has its fewest samples for each
# (four_bar_search), so that groups find what one search of all does.
GROUP = 24


def _groups(z: tuple[int, ...]) -> list[tuple[int, ...]]:
    """Divide numbers of slots into as many groups of at least ``GROUP`` as there may be.

    >>> [len(group) for group in _groups(tuple(range(3, 80)))]
    [26, 26, 25]
    """
    count = max(len(z) // GROUP, 1)
    ends = [-(-len(z) * i // count) for i in range(count + 1)]
    return [z[i:j] for i, j in pairwise(ends)]


def families(kind: Kind, target: Target) -> Iterator[Family]:
    """The families of one kind that may meet the requirement."""
    wheels = [target.wheel(gearing, z) for gearing in target.gearings for z in target.z]
    yield from kind(target, wheels)


def _straight(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    for wheel in wheels:
        yield from straight(target, wheel)


# A function that turns a machine's parts and returns its row, None if they fail. It uses the sizes
# of another row that passes or, without one, the first sizes that do.
Turn: TypeAlias = Callable[[MachineRow, MachineRow | None], MachineRow | None]


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
        specs = [
            families[i].at(free.place(i, at)) for i, at in zip(places.of, places.at, strict=True)
        ]
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
    at = np.concatenate([np.linspace(0.0, 1.0, count) for count in counts])[:, None]
    every = sampled(free, np.repeat(np.arange(len(families)), counts), at)
    good = accepted(every, accept)
    for number in range(samplings + 1):
        best_rows |= {
            i: known[i, x] for i, (x,) in zip(good.of.tolist(), good.at.tolist(), strict=True)
        }
        if number == samplings:
            break
        step = np.arange(-parts + 1, parts) / (intervals * parts ** (number + 1))
        refined = good.take(~np.isin(good.of, [i for i, f in enumerate(families) if f.several]))
        near = np.clip(refined.at + step, 0.0, 1.0).reshape(-1, 1)
        samples = sampled(free, np.repeat(refined.of, len(step)), near)
        better = samples.take(samples.cost < np.repeat(refined.cost, len(step)))
        good = accepted(better, accept).joined(good).best(1)
    return [best_rows.get(i) for i in range(len(families))]
