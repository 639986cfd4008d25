"""The rows of a sweep: its varied keys, then the requested quantities."""

from __future__ import annotations

import hashlib
import math
import os
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import chain
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli import __version__
from geneva_cli.errors import GenevaError, below, cut
from geneva_cli.kept import KEPT
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.numerics.arrays import Mask, keep_memory
from geneva_cli.numerics.sobol import DIMENSIONS, sobol
from geneva_cli.specfile.columns import digest
from geneva_cli.specfile.reader import Setting, Text, setting
from geneva_cli.study.batches import Batch, batch_rows, numbers
from geneva_cli.study.fields import Cell, Pick, Rows, joined, pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import Constraint, Objective, front
from geneva_cli.study.sweep.values import POINTS_MAX, VariedKey

if TYPE_CHECKING:
    from geneva_cli.parts.parts import Parts

DEFAULT = ("timing.motion_deg", "timing.dwell_s", "velocity.max", "acceleration.max", "jerk.max")
ERROR = "error"  # the column that says why a design cannot be built
TEXTS = (ERROR, "checks.failed")  # columns without numbers, even if no design fails
BLOCK = 16384  # designs of a batch; a power of two, which keeps a Sobol sequence balanced


class SweepPlan(NamedTuple):
    """The designs of a sweep, numbered from 0; the last key varies fastest in a grid.

    ``random`` is the size of the random sample, 0 for the whole grid; ``seed`` is its seed.
    """

    axes: tuple[VariedKey, ...]
    random: int = 0
    seed: int = 0

    def __len__(self) -> int:
        return self.random or math.prod(len(a.values) for a in self.axes)

    def designs(self, start: int, stop: int) -> Rows:
        """The designs ``start`` to ``stop - 1``: a column for each key."""
        if self.random:
            # Points that fill the cube more evenly than random ones, drawn in whole blocks: equal
            # wherever a run begins.
            first = start - start % BLOCK
            dimensions, blocks = len(self.axes), range(first, stop, BLOCK)
            points = np.hstack([sobol(dimensions, self.seed, k, BLOCK) for k in blocks])
            own = points[:, start - first : stop - first]
            return Rows({a.key: a.between(x) for a, x in zip(self.axes, own, strict=True)})
        counts = [len(a.values) for a in self.axes]
        each = np.unravel_index(np.arange(start, stop), counts)
        return Rows({a.key: a.column(at) for a, at in zip(self.axes, each, strict=True)})


def plan(axes: Sequence[VariedKey], random: int | None, seed: int) -> SweepPlan:
    """Return the plan of a sweep. Raises GenevaError, naming the option, for an invalid one."""
    if not axes:
        raise GenevaError("--vary is missing; say what varies, as --vary drive.A=0..0.9:0.1")
    if random is not None and not 1 <= random <= POINTS_MAX:
        raise GenevaError(f"--random {cut(random)}: it must be at least 1, at most {POINTS_MAX:,}")
    if random and len(axes) > DIMENSIONS:
        raise GenevaError(f"--random: {len(axes)} keys vary; at most {DIMENSIONS} can")
    if not 0 <= seed < 2**32:
        raise GenevaError(f"--seed {cut(seed)}: it must be at least 0 and below 2**32")
    size = math.prod(len(a.values) for a in axes)
    if not random and size > POINTS_MAX:
        raise GenevaError(
            f"--vary: {size:,} designs in all; at most {POINTS_MAX:,}: fewer values, or "
            "--random N of them"
        )
    return SweepPlan(tuple(axes), random or 0, seed)


class Sweep(NamedTuple):
    """A spec, the plan of its varied keys, the quantities of each design, and the rows to keep."""

    text: Text
    plan: SweepPlan
    pick: Pick
    bounds: tuple[Constraint, ...] = ()
    objectives: tuple[Objective, ...] = ()  # those of a Pareto front
    jobs: int | None = None  # processes; all cores for None
    files: tuple[str, ...] = ()  # that the spec is read from
    goal: Objective | None = None  # of --best, in place of a front
    of_best: Pick = Pick()  # quantities that are computed for the best design only

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns."""
        return (*self.keys, *self.pick.names, ERROR)

    @property
    def keys(self) -> list[str]:
        """The names of the varied keys."""
        return [a.key for a in self.plan.axes]

    @property
    def chooses(self) -> bool:
        """Return True if only some of the rows are kept."""
        return bool(self.bounds or self.objectives)

    @property
    def key(self) -> str:
        """A digest of all that the rows depend on: the sweep, and the files of points."""
        own = repr((__version__, self.text, self.plan, self.pick.names))
        return f"{hashlib.sha256(own.encode()).hexdigest()} {digest(self.inputs[1:])}"

    @property
    def inputs(self) -> tuple[str, ...]:
        """The input files: the spec, the points that it names, and files named by a varied word.

        A word that names no file is listed too, which is harmless.
        """
        folder = os.path.dirname(self.files[0])
        return (*self.files, *(below(folder, x) for a in self.plan.axes for x in a.words))

    @property
    def is_batched(self) -> bool:
        """Return True if all quantities can be computed for a batch of designs."""
        return bool(self.pick.names) and self.pick.batched == self.pick.names

    @property
    def _needed(self) -> tuple[Constraint, ...]:
        """The bounds that a row must keep; a search needs others too, to come nearer."""
        return () if self.goal else self.bounds

    def blocks(self, done: int = 0) -> Iterator[Rows]:
        """The rows in blocks and in order; the first ``done`` rows are skipped."""
        if self.is_batched:  # larger ones take less time, and keep two processes busy if many
            size = BLOCK if len(self.plan) < 32 * BLOCK else 2 * BLOCK
        elif not any(group.makes_parts for group in self.pick.groups):
            size = 64
        else:
            # Parts are slow: eight tasks keep several processes busy. Four designs or more share
            # the searches of their batch, which keeps the results of at most KEPT.
            size = min(KEPT, max(4, math.ceil(len(self.plan) / 8)))
        keep_memory()  # that the rows of other processes arrive in
        starts = range(done, len(self.plan), size)
        count = min(len(starts), cores() if self.jobs is None else self.jobs)
        yield from mapped(partial(self._block, size), starts, count)

    def _block(self, size: int, start: int) -> Rows:
        return self.rows_of(self.plan.designs(start, min(start + size, len(self.plan))))

    def rows_of(self, designs: Rows) -> Rows:
        """The rows of designs from the values of their keys."""
        # NaN where a batch lacks them
        known = numbers(self._batches(designs), self.pick.batched, len(designs))
        none = np.full(len(designs), None)
        columns = designs.columns | dict.fromkeys((*self.pick.names, ERROR), none)
        rows = Rows(columns | dict(zip(self.pick.batched, known, strict=True)))
        whole: Mask = np.logical_not(np.isnan(known).any(axis=0))
        left: Mask = ~whole if self.is_batched else np.full(len(designs), True)
        for bound in self._needed:
            if bound.name in self.pick.batched:  # nobody needs the others if a design breaks it
                left &= bound.kept_by(rows.numbers(bound.name)) | ~whole
        alone = self._rows_alone(designs.taken(left))
        return rows.replaced(np.flatnonzero(left), alone) if left.any() else rows

    def _batches(self, designs: Rows) -> Iterator[Batch]:
        def spec(values: Sequence[Cell]) -> Spec:
            return with_values(self.text, self.keys, values).spec()

        return batch_rows(designs, spec)

    def _rows_alone(self, designs: Rows) -> Iterator[list[Cell]]:
        """The rows of designs, each computed alone."""
        from geneva_cli.parts.parts import parts_of  # most sweeps of a batch need no parts

        for start in range(0, len(designs), KEPT):
            last: Parts | None = None
            some = designs.taken(np.arange(start, min(start + KEPT, len(designs))))
            for values, machine in zip(some, self._machines(some), strict=True):
                if machine:
                    last = last.following(machine) if last else parts_of(machine)
                yield self.row(values, last if machine else None)

    def _machines(self, designs: Rows) -> list[Mechanism | None]:
        """The machine of each row, None if it cannot be built."""
        machines: list[Mechanism | None] = [None] * len(designs)
        for i, values in enumerate(designs):
            with suppress(GenevaError):  # its row says why
                machines[i] = self.machine(values)
        # their quantities, and the loads of their checks, are those of batches
        for members, batch in self._batches(designs):
            own = [one for i in members.tolist() if (one := machines[i])]
            if len(own) == len(members) > 1:
                from geneva_cli.verdict.quantities.under_load import share

                share(batch, own)
        return machines

    def row(self, values: Sequence[Cell], parts: Parts | None = None) -> list[Cell]:
        """The row of the design with these values of the keys, computed alone.

        ``parts`` are those of its machine, if they are made.
        """
        from geneva_cli.parts.parts import parts_of

        try:
            parts = parts or parts_of(self.machine(values))
            return [*values, *self.pick.of_parts(parts, self._needed), None]
        except GenevaError as error:
            return [*values, *[None] * len(self.pick.names), str(error)]

    def machine(self, values: Sequence[Cell]) -> Mechanism:
        """The machine with these values. Raises GenevaError if it cannot be built."""
        text = with_values(self.text, self.keys, values)
        spec = text.spec()
        with text.located():
            return build(spec)

    def chosen(self, row_blocks: Iterable[Rows]) -> Iterator[Rows]:
        """The rows that keep all bounds and, of these, the Pareto front."""
        best, size = list[Rows](), 0  # the front so far, its size, and rows since then

        def foremost() -> Rows:
            rows = joined(best)
            each = [o.sign * rows.numbers(o.name) for o in self.objectives]
            return rows.taken(front(np.column_stack(each)))

        for rows in row_blocks:
            for bound in self.bounds:
                rows = rows.taken(bound.kept_by(rows.numbers(bound.name)))
            if self.objectives:
                best.append(rows)  # a row that the front dominates never returns
                if sum(map(len, best)) >= 2 * size:  # not for a few rows more than a long front
                    best = [foremost()]
                    size = len(best[0])
            elif len(rows):
                yield rows
        if best and len(rows := foremost()):
            yield rows


def sweep(text: Text, plan: SweepPlan, picks: Sequence[str] = DEFAULT) -> Sweep:
    """Return the sweep of a spec. Raises GenevaError if no design of a sample can be built."""
    varied = [a.key for a in plan.axes]  # these have their columns already: no name may occur twice
    names = tuple(name for name in pick(picks).names if name not in varied)
    run, size = Sweep(text, plan, Pick(names)), len(plan)
    count, reasons = min(size, 1000), list[str]()  # designs of the sample
    # the middle design comes first: most ranges have one that can be built
    middle = [*Rows({a.key: a.between(np.array([0.5])) for a in plan.axes})]
    starts = (i * size // count for i in range(count))
    sample = chain.from_iterable(plan.designs(at, at + 1) for at in starts)
    for values in chain(middle, sample):
        try:
            run.machine(values)
            return run
        except GenevaError as error:
            reasons.append(str(error))
    # the first may be one of the others
    raise GenevaError(f"no design can be built, of {count} tried: {reasons[1]}")


def with_values(text: Text, keys: Sequence[str], values: Sequence[Cell]) -> Text:
    """The spec with the values of the varied keys set over its own."""
    changes = []
    for key, value in zip(keys, values, strict=True):
        shown = f"{value:.12g}" if isinstance(value, float) else str(value)
        path = setting(f"{key}=0", "--vary").path
        changes.append(Setting(cut(f"{key}={shown}"), path, value))
    return text._replace(set_keys=(*text.set_keys, *changes))
