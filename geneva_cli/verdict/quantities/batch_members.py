"""Designs of a sweep that share one batch: each takes from it what its checks and parts need."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache, partial

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.strength.part_loads import PartLoads, single_loads
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.verdict.quantities.batch_designs import Columns, Designs, number_of, single
from geneva_cli.verdict.quantities.under_load import UnderLoad


class BatchMember(Designs):
    """One design of a batch, which takes its values from the batch if they are known there."""

    def __init__(self, batch: Designs, number: int) -> None:
        super().__init__(batch.each[number], batch.names)
        self.batch, self.number = batch, number

    def columns(self, compute: Callable[[Designs], Columns]) -> Columns:
        """The values of this design, from the batch or computed alone."""
        try:
            every = self.batch.requesting(self.names).columns(compute)
        except GenevaError:  # of another design, or of this one, which then raises it again
            return super().columns(compute)
        own = {
            name: None if column is None else number_of(column, self.number)
            for name, column in every.items()
        }
        is_unknown = any(value is not None and np.isnan(value) for value in own.values())
        return super().columns(compute) if is_unknown else own


def share(batch: Mechanism, machines: Sequence[Mechanism]) -> None:
    """Let the machines of a batch's designs take from it what their checks need."""
    designs = Designs(batch, None, machines)

    @cache
    def sizing() -> PartLoads | None:
        try:
            return designs.once(UnderLoad).part_loads
        except GenevaError:  # which one of the designs raises it again
            return None

    def loads_of(i: int) -> PartLoads | None:
        every = sizing()
        one = every and every.of(i)
        return None if one is None or any(map(math.isnan, one)) else one

    for i, machine in enumerate(machines):
        single.put(machine, partial(BatchMember, designs, i))
        single_loads.put(machine, partial(loads_of, i))
