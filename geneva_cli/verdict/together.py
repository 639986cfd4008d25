"""Single designs that take loads and strength for their checks from a batch of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache, partial

from geneva_cli.errors import GenevaError
from geneva_cli.loads.strength.part_loads import PartLoads, single_loads
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.verdict.quantities.batch_designs import BatchMember, Designs, limited_loads, single
from geneva_cli.verdict.quantities.under_load import under_load


def share(batch: Mechanism, machines: Sequence[Mechanism]) -> None:
    """Let the machines of a batch's designs take from it what their checks need.

    The batch is searched when the first of them needs a value. A value that the batch lacks is
    computed for the design alone. There are at most ``kept.KEPT`` machines.
    """
    designs = Designs(batch, limited_loads(batch.spec), machines)

    @cache
    def sizing() -> PartLoads | None:
        try:
            return under_load(designs).sizing_loads
        except GenevaError:  # which one of the designs raises it again
            return None

    def loads_of(i: int) -> PartLoads | None:
        every = sizing()
        one = every and every.of(i)
        return None if one is None or any(map(math.isnan, one)) else one

    for i, machine in enumerate(machines):
        single.put(machine, partial(BatchMember, designs, i))
        single_loads.put(machine, partial(loads_of, i))
