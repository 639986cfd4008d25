"""A method, a task and a subject of the bench; and the frontier of methods."""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from bench.timing_pairs import processor_s


class Method(NamedTuple):
    """One way to do a task. ``size`` is its parameter: a number of points, say."""

    name: str
    size: float | None
    run: Callable[[], Any]
    ours: bool = False
    rival: bool = True  # False for our own code in another way, which no user has to write
    times: float = 1.0  # the run is that part of the task: a loop over a sample of the designs


class Task(NamedTuple):
    """A task for competing methods: one answer, one baseline, one measure of error."""

    name: str
    baseline: str
    baseline_run: Callable[[], Any]
    error: Callable[[Any], float]
    methods: Sequence[Method]
    designs: int | None = None  # designs per run, for their rate per second


class Subject(NamedTuple):
    """A subject of the bench: what is compared, the kind of error and its reference, the tasks."""

    title: str
    error: str
    tasks: Sequence[Task]
    slack: float = 0.1  # a method is faster if it takes less than 1 - slack of another's time
    floor: float = 1e-15  # relative errors below this count as equal
    seconds: float = 1.0  # run time of each method, at least one run
    clock: Callable[[], float] = processor_s


class BenchRow(NamedTuple):
    """A line of the table."""

    subject: str
    task: str
    method: str
    size: float | None
    error: float | None
    time_ratio: float  # of short calls the least time, else the median of pairs
    ours: bool
    frontier: bool | None = None
    rival: str | None = None  # "none but ourselves" where no other program does the task
    designs_per_s: float | None = None  # of one core


def with_frontier(rows, slack, floor):
    """Rows of a task, each marked as on the frontier unless another is faster and as accurate.

    Ours are different functions or inputs, and do not compete with each other.
    """

    def beats(one, other):
        faster = one.time_ratio < (1.0 - slack) * other.time_ratio
        return faster and max(one.error, floor) <= max(other.error, floor)

    out = []
    for row in rows:
        rivals = [other for other in rows if not (other.ours and row.ours)]
        out.append(row._replace(frontier=not any(beats(other, row) for other in rivals)))
    return out
