"""A sweep: one row a design, its varied keys, then the quantities that are asked for."""

from __future__ import annotations

import hashlib
import itertools
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import NamedTuple

from geneva_cli import __version__
from geneva_cli.errors import GenevaError, cut
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.specfile.reader import Text
from geneva_cli.specfile.settings import Setting, setting
from geneva_cli.study.fields import Cell, Pick, pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.quantities import in_batch
from geneva_cli.study.sweep import batch
from geneva_cli.study.sweep.plan import BLOCK, WHOLE, Shard, SweepPlan
from geneva_cli.study.sweep.values import Value, VariedKey

DEFAULT = ("timing.motion_deg", "timing.dwell_s", "velocity.max", "acceleration.max", "jerk.max")
CHECKED = ("checks.passes", "checks.failed")
ERROR = "error"  # the column that says why a design cannot be built
TEXTS = (ERROR, CHECKED[1])  # columns that hold no numbers, even where all is well
TASK = 64  # designs that a process is given at a time
FEW = 4  # and where their parts are drawn, which takes longer: what is stopped, loses little
TRIED = 1000  # designs among which one must be built


class Sweep(NamedTuple):
    """The designs of one spec with some keys varied, and the quantities to work out for each."""

    text: Text
    plan: SweepPlan
    pick: Pick
    shard: Shard = WHOLE
    of_best: Pick | None = None  # quantities that are worked out of the best design alone

    @property
    def names(self) -> tuple[str, ...]:
        """The columns."""
        return (*(a.key for a in self.plan.axes), *self.pick.names, ERROR)

    @property
    def asked(self) -> tuple[str, ...]:
        """The quantities in the order in which they were asked for, by their whole names."""
        return self.pick.asked

    @property
    def span(self) -> tuple[int, int]:
        """The numbers of the designs of this share."""
        return self.shard.span(len(self.plan))

    @property
    def key(self) -> str:
        """What its rows depend on, as one word."""
        said = repr((__version__, self.text, self.plan, self.pick.names, self.shard))
        return hashlib.sha256(said.encode()).hexdigest()

    def rows(self, start: int, stop: int) -> list[list[Cell]]:
        """The rows of the designs from ``start`` up to ``stop``, left out."""
        return self.rows_of(self.plan.rows(start, stop))

    def rows_of(self, every: Sequence[Sequence[Value]]) -> list[list[Cell]]:
        """The rows of designs by the values of their keys."""
        known = self.known(every)
        return [
            [*some, *known[i], None] if i in known else self.row(some)
            for i, some in enumerate(every)
        ]

    def known(self, every: Sequence[Sequence[Value]]) -> Mapping[int, list[Cell]]:
        """The quantities, by their numbers, of those designs of which they are known together."""
        keys = [a.key for a in self.plan.axes]
        return batch.table(every, keys, self.pick.names, self._spec) if self.together else {}

    @property
    def at_once(self) -> int:
        """How many designs are worked on before their rows are there."""
        if self.together:
            return BLOCK
        return FEW if any(s.makes_parts for s in self.pick.groups) else TASK

    @property
    def together(self) -> bool:
        """Whether the quantities are known for arrays of designs."""
        return bool(self.pick.names) and in_batch(self.pick.names)

    def _spec(self, some: Sequence[Value]) -> Spec:
        return with_values(self.text, self.plan.axes, some).spec()

    @property
    def given(self) -> list[Value] | None:
        """The spec's own values of the varied keys; None where one is not among those varied."""
        with suppress(GenevaError):  # a spec may lack what is varied
            spec, own = self.text.spec(), list[Value]()
            for axis in self.plan.axes:
                table, _, name = axis.key.rpartition(".")
                own.append(spec.table(table).get(name, ""))
            if all(value in axis for value, axis in zip(own, self.plan.axes, strict=True)):
                return own
        return None

    def row(self, some: Sequence[Value]) -> list[Cell]:
        """The row of the design with these values of the keys."""
        try:
            return [*some, *self.pick.of(self.machine(some)), None]
        except GenevaError as error:
            return [*some, *[None] * len(self.pick.names), str(error)]

    def machine(self, some: Sequence[Value]) -> Mechanism:
        """The machine with these values. Raises GenevaError where there is none."""
        return _machine(self.text, self.plan, some)


def sweep(
    text: Text,
    plan: SweepPlan,
    picks: Sequence[str] = DEFAULT,
    check: bool = False,
    options: Mapping[str, str] | None = None,
    of_best: Sequence[str] | None = None,
) -> Sweep:
    """The sweep of a spec. ``check`` adds whether each design passes every check; ``options`` says
    which option asked for a quantity, where it was not --pick. Where one is to be chosen, only it
    is checked, and asked for the quantities ``of_best``.

    Raises GenevaError for a quantity that does not exist, and where none of some designs can be
    built.
    """
    checked = CHECKED if check else ()
    later = None if of_best is None else pick([*of_best, *checked])
    found = pick([*picks, *([] if later else checked)], options=options)
    _refuse_hopeless(text, plan)
    varied = [a.key for a in plan.axes]  # these have their columns: no name may stand twice
    names = tuple(name for name in found.names if name not in varied)
    return Sweep(text, plan, found._replace(names=names), of_best=later)


def _refuse_hopeless(text: Text, plan: SweepPlan) -> None:
    """Raise GenevaError where neither the middle design nor any of some others can be built.

    The middle one needs no drawing, for which SciPy would be loaded.
    """
    said = []
    for some in itertools.chain([plan.middle()], plan.some(TRIED)):
        try:
            _machine(text, plan, some)
            return
        except GenevaError as error:
            said.append(str(error))
    del said[0]  # that of the middle design, which may be one of the others
    those = (
        f"{len(said)} designs from all over the range"
        if len(plan) > TRIED
        else f"the {len(said)} designs"
    )
    count = f"none of {those}" if len(plan) > 1 else "no design"
    raise GenevaError(f"{count} can be built: {said[0]}")


def with_values(text: Text, axes: Sequence[VariedKey], some: Sequence[Value]) -> Text:
    """The spec with the values of the keys set over its own."""
    changes = tuple(_changed(a.key, v) for a, v in zip(axes, some, strict=True))
    return text._replace(set_keys=(*text.set_keys, *changes))


def _machine(text: Text, plan: SweepPlan, some: Sequence[Value]) -> Mechanism:
    text = with_values(text, plan.axes, some)
    spec = text.spec()
    with text.located():
        return build(spec)


def _changed(key: str, value: Value) -> Setting:
    path = setting(f"{key}=0", "--vary").path
    said = f"{value:.12g}" if isinstance(value, float) else str(value)
    return Setting(cut(f"{key}={said}"), path, value)


def blocks(found: Sweep, done: int = 0, workers: int | None = None) -> Iterator[list[list[Cell]]]:
    """The rows of a sweep's share, some at a time, in order; ``done`` are there already."""
    start, stop = found.span
    starts = range(start + done, stop, found.at_once)
    count = min(len(starts), cores() if workers is None else workers)
    yield from mapped(partial(_block, found, stop), starts, count)


def _block(found: Sweep, stop: int, start: int) -> list[list[Cell]]:
    return found.rows(start, min(start + found.at_once, stop))
