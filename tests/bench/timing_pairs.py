"""Times as ratios: every run follows a run of a baseline.

A change in the computer's speed affects both alike. The ratio is the median over the pairs. For
calls shorter than SHORTEST it is that of the least times of many runs: interruptions only add.
"""

import statistics
from time import perf_counter, process_time
from typing import NamedTuple, TypeVar

T = TypeVar("T")
Pair = tuple[float, float]  # seconds of the baseline, and of the run after it
SHORTEST = 2e-3  # seconds: shorter calls are repeated until they take as long


class Timed(NamedTuple):
    """Time of a call, as a ratio to the baseline, and the least time in seconds."""

    ratio: float
    least_s: float


def processor_s():
    """Processor time of this process and of the processes that it waited for, in seconds.

    Other work of the computer does not add to it. The time of all cores counts. Windows does not
    tell the time of other processes: there it is that of the wall clock.
    """
    try:
        import resource
    except ImportError:
        return wall_s()
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return process_time() + children.ru_utime + children.ru_stime


def wall_s():
    """Seconds on the wall clock, which a user waits for."""
    return perf_counter()


def median_ratio(pairs):
    """Median of the pairs' ratios."""
    return statistics.median(own / base for base, own in pairs)


def ratios(baseline, calls, seconds, clock=processor_s):
    """Answer of each call, and its time as a ratio to the baseline's.

    Each call first runs once for its answer, without measurement. Then the calls run in turn, round
    after round. Each takes part until it has used ``seconds``, but at least once. A call shorter
    than ``SHORTEST`` is repeated in each round.
    """
    _, base_repeats = _first(baseline, clock)
    answers, repeats = zip(*[_first(call, clock) for call in calls], strict=True)
    spent = [0.0] * len(calls)
    pairs = [[] for _ in calls]
    while any(s < seconds for s in spent):
        base = -1.0
        for i, call in enumerate(calls):
            if spent[i] >= seconds:
                continue
            if base < 0.0 or repeats[i] == 1:  # after a long call the machine may have changed
                base = _time(baseline, base_repeats, clock)
            own = _time(call, repeats[i], clock)
            spent[i] += own * repeats[i]
            pairs[i].append((base, own))
    least = min(base for p in pairs for base, _ in p)
    timed = []
    for p, repeat in zip(pairs, repeats, strict=True):
        own_s = min(own for _, own in p)
        timed.append(Timed(own_s / least if repeat > 1 else median_ratio(p), own_s))
    return list(answers), timed


def _first(call, clock):
    """Answer of a call, and the number of its runs per round."""
    start = wall_s()
    answer = call()
    once = wall_s() - start
    if once < SHORTEST:
        once = _time(call, 1, clock)  # warm now
    return answer, max(1, round(SHORTEST / once))


def _time(call, repeats, clock):
    start, start_wall = clock(), wall_s()
    for _ in range(repeats):
        call()
    # some systems' processor clock advances only every few milliseconds
    return (clock() - start or wall_s() - start_wall) / repeats
