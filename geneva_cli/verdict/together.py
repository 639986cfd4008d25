"""Single designs that take loads and strength for their checks from a batch of them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cache, partial
from typing import TypeVar

from geneva_cli.analysis.peak_search import PeakArray
from geneva_cli.errors import GenevaError
from geneva_cli.kinematics.engagement import Peak
from geneva_cli.loads import loads
from geneva_cli.loads.strength.part_loads import PartLoads, own_loads, single_loads
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.quantities.designs import BatchMember, Designs, single
from geneva_cli.verdict.quantities.under_load import under_load

T = TypeVar("T")
M = TypeVar("M")


def share(batch: Mechanism, machines: Sequence[Mechanism]) -> None:
    """Let the machines of a batch's designs take from it what their checks need.

    The batch is searched when the first of them needs a value. A value that the batch lacks is
    computed for the design alone. There are at most ``latest.KEPT`` machines.
    """
    designs = Designs(batch, each=machines)
    own = _unless_refused(lambda: under_load(designs).part_loads)
    sizing = _unless_refused(lambda: under_load(designs).sizing_loads)
    pressures = _unless_refused(lambda: loads.greatest_pressures(batch))
    limited = _unless_refused(lambda: loads.limited_load_peaks(batch))
    for i, machine in enumerate(machines):
        single.put(machine, partial(BatchMember, designs, i))
        own_loads.put(machine, partial(_taken, own, partial(_loads_of, i=i)))
        single_loads.put(machine, partial(_taken, sizing, partial(_loads_of, i=i)))
        loads.greatest_pressure.put(machine, partial(_taken, pressures, partial(_peak, i=i)))
        loads.limited_peaks.put(machine, partial(_taken, limited, partial(_limited_peaks, i=i)))


def _unless_refused(compute: Callable[[], T]) -> Callable[[], T | None]:
    """A function that is computed once, and returns None if it raises GenevaError."""

    @cache
    def result() -> T | None:
        try:
            return compute()
        except GenevaError:  # which one of the designs raises it again
            return None

    return result


def _taken(of_batch: Callable[[], M | None], take: Callable[[M], T | None]) -> T | None:
    every = of_batch()
    return None if every is None else take(every)


def _loads_of(every: PartLoads, i: int) -> PartLoads | None:
    one = every.of(i)
    return None if any(map(math.isnan, one)) else one


def _peak(every: PeakArray, i: int) -> Peak[float] | None:
    one = loads.peak_of(every, i)
    return None if math.isnan(one.max) else one


def _limited_peaks(every: dict[str, PeakArray], i: int) -> dict[str, Peak[float]] | None:
    peaks = {name: loads.peak_of(one, i) for name, one in every.items()}
    return None if any(math.isnan(one.max) for one in peaks.values()) else peaks
