"""The rows of a sweep: its varied keys, then the requested quantities."""

from __future__ import annotations

import hashlib
import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import NamedTuple

import numpy as np

from geneva_cli import __version__
from geneva_cli.errors import GenevaError, cut
from geneva_cli.kept import KEPT
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.specfile.reader import Text
from geneva_cli.specfile.settings import Setting, setting
from geneva_cli.study.batches import Batch, batch_rows, number_columns
from geneva_cli.study.fields import Pick, pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.rows import Cell, Column, Rows, rows_of
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.sweep.plan import BLOCK, WHOLE, Shard, SweepPlan
from geneva_cli.study.sweep.values import Value, VariedKey
from geneva_cli.verdict.quantities.under_load import share

DEFAULT = ("timing.motion_deg", "timing.dwell_s", "velocity.max", "acceleration.max", "jerk.max")
ERROR = "error"  # the column that says why a design cannot be built
TEXTS = (ERROR, "checks.failed")  # columns without numbers, even if no design fails


class Sweep(NamedTuple):
    """A spec, the plan of its varied keys, and the quantities to compute for each design."""

    text: Text
    plan: SweepPlan
    pick: Pick
    shard: Shard = WHOLE
    bounds: tuple[Constraint, ...] = ()  # no parts are made of designs that break one of them

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns."""
        return (*(a.key for a in self.plan.axes), *self.pick.names, ERROR)

    @property
    def span(self) -> tuple[int, int]:
        """The first design of this shard, and the one after its last."""
        return self.shard.span(len(self.plan))

    @property
    def key(self) -> str:
        """A digest of all that the rows depend on."""
        inputs = repr((__version__, self.text, self.plan, self.pick.names, self.shard))
        return hashlib.sha256(inputs.encode()).hexdigest()

    def rows(self, start: int, stop: int) -> Rows:
        """The rows of the designs ``start`` to ``stop - 1``."""
        return self.rows_of(self.plan.columns(start, stop))

    def block(self, start: int) -> Rows:
        """The rows of one task of this shard, from a design on."""
        return self.rows(start, min(start + self.task_size, self.span[1]))

    def rows_of(self, keys: Sequence[Column]) -> Rows:
        """The rows of designs from the columns of their keys."""
        designs, values = Rows(keys), self.known(keys)
        if not self.is_batched:
            return rows_of(self._rows_alone(designs, values))
        rows = Rows([*keys, *values, [None] * len(designs)])
        left = np.flatnonzero(np.isnan(values).any(axis=0))
        alone = [self.row(designs.row(i)) for i in left.tolist()]
        return rows.replaced(left, alone) if alone else rows

    def _rows_alone(self, designs: Rows, values: Array) -> list[list[Cell]]:
        """The rows of designs with quantities that are computed for each; ``values`` are known."""
        keys = [*designs]
        whole = np.flatnonzero(~np.isnan(values).any(axis=0)).tolist() if len(values) else []
        cells = Rows([*values[:, whole]]) if whole else ()
        known = dict(zip(whole, cells, strict=True))
        out: dict[int, list[Cell]] = {}
        for i, own in known.items():
            if not self._keeps(by_name := dict(zip(self.pick.batched, own, strict=True))):
                out[i] = [*keys[i], *map(by_name.get, self.pick.names), None]
        left = [i for i in range(len(keys)) if i not in out]
        for start in range(0, len(left), KEPT):
            part = left[start : start + KEPT]
            last: Parts | None = None
            for i, machine in zip(part, self._machines(designs.taken(np.array(part))), strict=True):
                if isinstance(machine, GenevaError):
                    out[i] = self._row(keys[i], machine)
                    continue
                last = last.following(machine) if last else parts_of(machine)
                out[i] = self._row(keys[i], last, known.get(i))
        return [out[i] for i in range(len(keys))]

    def _keeps(self, cells: Mapping[str, Cell]) -> bool:
        return all(bound.kept(cells[bound.name]) for bound in self.bounds if bound.name in cells)

    @property
    def _makes_parts(self) -> bool:
        return any(group.makes_parts for group in self.pick.groups)

    def _batches(self, designs: Rows) -> Iterator[Batch]:
        return batch_rows(designs, [a.key for a in self.plan.axes], self._spec)

    def _machines(self, designs: Rows) -> list[Mechanism | GenevaError]:
        """The machine of each row, or why it cannot be built."""
        machines: list[Mechanism | GenevaError] = []
        for values in designs:
            try:
                machines.append(self.machine(values))
            except GenevaError as error:
                machines.append(error)
        if self._makes_parts:  # the loads of their checks are those of batches
            for members, machine in self._batches(designs):
                each = [machines[i] for i in members.tolist()]
                own = [one for one in each if isinstance(one, Mechanism)]
                if len(own) == len(members) > 1:
                    share(machine, own)
        return machines

    def known(self, keys: Sequence[Column]) -> Array:
        """The quantities of ``pick.batched`` (q, n) of designs, NaN where a batch lacks them."""
        names, designs = self.pick.batched, Rows(keys)
        return number_columns(self._batches(designs) if names else (), names, len(designs))

    @property
    def task_size(self) -> int:
        """The number of designs in one task."""
        if self.is_batched:
            return BLOCK
        if not self._makes_parts:
            return 64
        # Parts are slow: eight tasks keep several processes busy. Four designs or more share the
        # searches of their batch, which keeps the results of at most KEPT.
        start, stop = self.span
        return min(KEPT, max(4, math.ceil((stop - start) / 8)))

    @property
    def is_batched(self) -> bool:
        """Return True if all quantities can be computed for a batch of designs."""
        return bool(self.pick.names) and not self.pick.rest.names

    def _spec(self, values: Sequence[Cell]) -> Spec:
        return with_values(self.text, self.plan.axes, values).spec()

    @property
    def own_values(self) -> list[Value] | None:
        """The spec's own values of the varied keys; None if one is not among those varied."""
        with suppress(GenevaError):  # the spec may lack a varied key
            spec, own = self.text.spec(), list[Value]()
            for axis in self.plan.axes:
                table, _, name = axis.key.rpartition(".")
                own.append(spec.table(table).get(name, ""))
            if all(value in axis for value, axis in zip(own, self.plan.axes, strict=True)):
                return own
        return None

    def row(self, values: Sequence[Cell]) -> list[Cell]:
        """The row of the design with these values of the keys, computed alone."""
        try:
            return self._row(values, parts_of(self.machine(values)))
        except GenevaError as error:
            return self._row(values, error)

    def _row(
        self,
        values: Sequence[Cell],
        parts: Parts | GenevaError,
        known: Sequence[Cell] | None = None,
    ) -> list[Cell]:
        """The row of a machine; ``known`` are the quantities of ``pick.batched`` from a batch."""
        try:
            if isinstance(parts, GenevaError):
                raise parts
            return [*values, *self.pick.of_parts(parts, known, self._keeps), None]
        except GenevaError as error:
            return [*values, *[None] * len(self.pick.names), str(error)]

    def machine(self, values: Sequence[Cell]) -> Mechanism:
        """The machine with these values. Raises GenevaError if it cannot be built."""
        text = with_values(self.text, self.plan.axes, values)
        spec = text.spec()
        with text.located():
            return build(spec)


def sweep(text: Text, plan: SweepPlan, picks: Sequence[str] = DEFAULT) -> Sweep:
    """Return the sweep of a spec.

    Raises GenevaError for an unknown quantity, and if no design of a sample can be built.
    """
    varied = [a.key for a in plan.axes]  # these have their columns already: no name may occur twice
    names = tuple(name for name in pick(picks).names if name not in varied)
    run, most = Sweep(text, plan, Pick(names)), 1000  # designs of the sample
    reasons = []
    # the middle design comes first: most ranges have one that can be built
    for values in itertools.chain([plan.middle()], plan.sample(most)):
        try:
            run.machine(values)
            return run
        except GenevaError as error:
            reasons.append(str(error))
    del reasons[0]  # the middle design, which may be one of the others
    those = (
        f"{len(reasons)} designs from all over the range"
        if len(plan) > most
        else f"the {len(reasons)} designs"
    )
    count = f"none of {those}" if len(plan) > 1 else "no design"
    raise GenevaError(f"{count} can be built: {reasons[0]}")


def with_values(text: Text, axes: Sequence[VariedKey], values: Sequence[Cell]) -> Text:
    """The spec with the values of the varied keys set over its own."""
    changes = []
    for (key, *_), value in zip(axes, values, strict=True):
        shown = f"{value:.12g}" if isinstance(value, float) else str(value)
        path = setting(f"{key}=0", "--vary").path
        changes.append(Setting(cut(f"{key}={shown}"), path, value))
    return text._replace(set_keys=(*text.set_keys, *changes))


def blocks(run: Sweep, done: int = 0, workers: int | None = None) -> Iterator[Rows]:
    """The rows of a sweep's shard, in blocks and in order; the first ``done`` rows are skipped."""
    start, stop = run.span
    starts = range(start + done, stop, run.task_size)
    count = min(len(starts), cores() if workers is None else workers)
    yield from mapped(run.block, starts, count)
