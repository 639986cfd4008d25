"""A method, a task and a subject of the bench; and when a method is on the frontier."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

SLACK = 0.1  # one method is faster than another if it takes less than 1 - SLACK of its time
FLOOR = 1e-15  # relative errors below this are as good as each other
SECONDS = 1.0  # of a method's own time, at least one run


class Method(NamedTuple):
    """One way to do a task. ``size`` is its own: points, pieces, tolerance."""

    name: str
    size: float | None
    run: Callable[[], Any]
    ours: bool = False
    times: float = 1.0  # the run is that part of the task: a loop over a sample of the designs
    pieces: Callable[[Any], int] | None = None  # how much the answer costs its reader
    memory: Callable[[], float] | None = None  # peak of a run, MB


class Task(NamedTuple):
    """What methods compete in: one answer, one baseline, one measure of error.

    The error of what the baseline's run returns is None where the baseline is no method.
    """

    name: str
    baseline: str
    baseline_run: Callable[[], Any]
    error: Callable[[Any], float]
    methods: Sequence[Method]
    designs: int | None = None  # that a run answers for: their number a second is told


class Subject(NamedTuple):
    """A subject of the bench, and the words of its plot."""

    title: str
    error: str  # what the error is, and of what
    tasks: Sequence[Task]
    processes: bool = False  # runs are whole processes: times come from ``pairs`` of them
    slack: float = SLACK
    floor: float = FLOOR
    seconds: float = SECONDS  # that each method is run for
    absent: Sequence[str] = ()  # libraries with methods of their own that are not installed


def missing(*distributions: str) -> tuple[str, ...]:
    """Those libraries, by the names that pip has, that are not installed."""
    from importlib import metadata

    def is_here(name: str) -> bool:
        try:
            metadata.version(name)
        except metadata.PackageNotFoundError:
            return False
        return True

    return tuple(name for name in distributions if not is_here(name))


class Row(NamedTuple):
    """A line of the table."""

    subject: str
    task: str
    method: str
    size: float | None
    pieces: int | None
    error: float | None
    time_ratio: float
    memory_MB: float | None
    ours: bool
    frontier: bool | None = None
    designs_per_s: float | None = None  # of one core


def beats(one: Row, other: Row, slack: float, floor: float) -> bool:
    """Whether ``one`` is faster and as accurate, with as few pieces where pieces count."""
    if one.error is None or other.error is None:
        return False
    faster = one.time_ratio < (1.0 - slack) * other.time_ratio
    fewer = one.pieces is None or other.pieces is None or one.pieces <= other.pieces
    return faster and fewer and max(one.error, floor) <= max(other.error, floor)


def with_frontier(rows: Sequence[Row], slack: float, floor: float) -> list[Row]:
    """The rows of a task, each marked: on the frontier unless another's method beats it.

    Ours are different functions or inputs, not rivals of each other.
    """
    return [
        row
        if row.error is None
        else row._replace(
            frontier=not any(
                beats(other, row, slack, floor) for other in rows if not (other.ours and row.ours)
            )
        )
        for row in rows
    ]
