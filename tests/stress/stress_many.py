"""Peaks of many designs, or of their loads: is any missed, and how exact are they?

Part of `make stress`:

    stress_many.py [--loads] [--designs N] [--machine NAME]... [--seconds S] [--seed N]

Random designs of every machine (those of tests/design_arrays.py). Each design's greatest velocity
and acceleration is compared with a dense scan: a peak is missed where a place of the scan has more.
Of some designs the size is compared with 50 digits, at the place of the peak. One row a machine;
the exit status is 1 where one is missed, or an error is above 1e-14. A million designs of one
machine take one to four minutes; with ``--seconds`` a machine gets so much time and no more.

The scan has few places, which differ from design to design: one anywhere in each of some equal
parts, and some at distances of all orders of magnitude from the motion's ends and from the peaks.
A very narrow peak, which some hundred designs would hide, shows in a million.

With ``--loads`` each design has a load of its own, with friction and without, and the greatest and
least of every known quantity are compared with the scan. All are computed together, and some one at
a time, as a sweep does: a cut of the motion for one quantity may show the extreme of another.
Greatest sizes are computed alone too, which may need no cut.
"""

import argparse
import math
import sys
import time
from typing import NamedTuple

import numpy as np
from design_arrays import MACHINES, alone, drawn
from loaded_arrays import beyond as beyond_loads
from loaded_arrays import loaded
from machine_witness import motions
from witness import QUANTITIES as EXACT

from geneva_cli.loads.load_case import sources
from geneva_cli.loads.load_peaks import load_peaks, load_summaries
from geneva_cli.motion.batch import taken
from geneva_cli.motion.many import many
from geneva_cli.motion.peak_search import motion_peaks

NAMES = ("velocity", "acceleration")
ALONE = ("pin_force_N", "input_torque_Nm")  # loads that are computed alone too
CHUNK, LOADS_CHUNK = 10_000, 4_096  # designs built together
BLOCK = 256  # designs scanned together: their numbers stay in the processor's cache
LOADS_PLACES = 200
PLACES = 256  # of a whole motion; of half of one that is symmetric, half as many
NEAREST = 1e-9  # fraction of a span: the least distance of a place from an end or a peak
MORE = 1e-12  # relative: a place of the scan exceeds the peak by more than rounding
# The same of a wheel that turns v times as fast as its input, because the pin passes so near its
# centre: a rounding of the keys counts there 5 v times in the velocity, 10 v in the acceleration.
# The slider-crank of crank 40 mm, rod 48.96976390030376, height 8.558560903106624, point 80 at 90
# deg and z = 11 has v = 1485, the pin passing at 5e-8 of the centre distance. In 50 digits, a unit
# in the rod's last place moves its peaks by 9.0e-13 and 1.8e-12; a scan had more by 1.1e-12.
MORE_OF_V = 16 * 2.0**-53
EXACT_TO = 1e-14
WITNESSED = 20  # designs compared with 50 digits
# no witness of 50 digits by keys alone; stress.py has others
WITHOUT = ("gear sector", "gear sector, any ratio", "four-bar", "slider-crank")


class Row(NamedTuple):
    """Result for a machine."""

    machine: str
    designs: int
    missed: int
    short: float  # greatest relative excess of a place of the scan
    worst: float | None  # greatest relative error against 50 digits
    seconds: float


def stressed(name, count, seed=12, places=PLACES, witnessed=WITNESSED, seconds=math.inf):
    """Compare one machine. Designs that cannot be built are drawn again."""
    start = time.process_time()
    spec, rules = MACHINES[name]
    random = np.random.default_rng(seed)
    done = missed = 0
    short, worst, left = -math.inf, 0.0, witnessed
    while done < count and time.process_time() - start < seconds:
        varied = drawn(rules, min(CHUNK, 2 * (count - done) + 20), seed)
        seed += 1
        batch = many(spec, varied)
        if batch.machine is None:
            continue
        which = batch.which[: count - done]
        some = taken(batch.machine, np.arange(len(which))[: len(batch.which)])
        for j, engagement in enumerate(some.engagements):
            peaks = motion_peaks(engagement.motion, NAMES)
            over = beyond(engagement.motion, peaks, len(which), places, random)
            bar = np.maximum(MORE, MORE_OF_V * np.broadcast_to(peaks["velocity"].max, over.shape))
            missed += int((over > bar).sum())
            short = max(short, float(over.max()))
            if name not in WITHOUT:
                for row in range(min(left, len(which))):
                    true = motions(alone(spec, varied, int(which[row])).spec)[j]
                    worst = max(worst, *errors(true, peaks, row))
        left -= len(which)
        done += len(which)
    return Row(
        name, done, missed, short, None if name in WITHOUT else worst, time.process_time() - start
    )


def beyond(motion, peaks, count, places, random):
    """Relative excess of the greatest of a scan over the peaks: (count,)."""
    whole = not motion.symmetric
    ends = [motion.entry_deg, motion.exit_deg if whole else 0.0]
    a, b = (np.broadcast_to(np.reshape(x, (-1, 1)), (count, 1)) for x in ends)
    sizes = [[np.broadcast_to(v, (count,)) for v in peaks[name]] for name in NAMES]
    near = [np.clip(at[:, None], a, b) for _, at in sizes]
    out = np.full(count, -np.inf)
    for i in range(0, count, BLOCK):
        part = slice(i, i + BLOCK)
        x = scanned(a[part], b[part], [x[part] for x in near], places >> (not whole), random)
        p = taken(motion, part)(np.asfortranarray(x), 2).derivatives()
        for k, (size, _) in enumerate(sizes, 1):
            most = np.abs(np.broadcast_to(p[k], x.shape)).max(axis=1)
            out[part] = np.maximum(out[part], most / size[part] - 1.0)
    return out


def scanned(a, b, near, places, random):
    """Random places between a and b: half of them evenly, the others by a, by b and by ``near``."""
    even = places // 2
    x = [(np.arange(even) + random.random((len(a), even))) / even * (b - a) + a]
    ways = [(a, 1.0), (b, -1.0), *[(place, way) for place in near for way in (1.0, -1.0)]]
    each = (places - even) // len(ways)
    for place, way in ways:
        share = NEAREST ** ((np.arange(each) + random.random((len(a), each))) / each)
        x.append(np.clip(place + way * share * (b - a), a, b))
    return np.hstack(x)


def errors(true, peaks, row):
    """Relative errors of the sizes at their places, less the effect of rounding the places.

    That effect counts where the greatest is a jump at an end: of an inside wheel of 3 slots and A =
    0.9079 a unit in the last place of the entry's angle moves it by 3.4e-14.
    """
    for name in NAMES:
        size, at = (float(np.ravel(v)[row if np.size(v) > 1 else 0]) for v in peaks[name])
        true_size, slope, *_ = (abs(v) for v in EXACT[name](true.derivatives(at)))
        moves = slope / true_size * math.radians(math.ulp(at))
        yield max(float(abs(size / true_size - 1) - moves), 0.0)


def stressed_loads(name, count, seed=12, places=LOADS_PLACES, seconds=math.inf):
    """Count the designs, and those with a missed extreme; by how much at most; CPU seconds."""
    start = time.process_time()
    done, missed, most = 0, 0, -math.inf
    while done < count and time.process_time() - start < seconds:
        # every second time without friction, where other signs count
        rubs = {"friction": 0.0} if seed % 2 else {}
        batch = loaded(name, min(LOADS_CHUNK, 2 * (count - done) + 20), seed, **rubs)[2]
        seed += 1
        if batch.machine is None:
            continue
        known = sources(batch.machine)
        names = [name for name, (source, _) in known.items() if name == source]
        over = beyond_loads(batch, places, seed, names=names)
        for one in [name for name in ALONE if name in names]:
            together = load_summaries(batch.machine, (one,), means=False)
            over = np.hstack((over, beyond_loads(batch, places, seed, (one,), together)))
            over = np.hstack((over, off(batch.machine, one, together[one])))
        done += len(over)
        missed += int((over > MORE).any(axis=1).sum())
        most = max(most, float(over.max()))
    return Row(name, done, missed, most, None, time.process_time() - start)


def off(machine, name, ends):
    """Relative difference of the greatest size, computed alone, from the greater extreme."""
    size = np.maximum(np.abs(ends.max), np.abs(ends.min))
    alone = load_peaks(machine, [name])[name].max
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(alone == size, 0.0, np.abs(alone / size - 1.0))[:, None]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--loads", action="store_true", help="extremes of loads")
    parser.add_argument("--designs", type=int, default=20_000, help="of each machine")
    parser.add_argument("--machine", action="append", choices=list(MACHINES))
    parser.add_argument("--seconds", type=float, default=math.inf, help="for each machine, of CPU")
    parser.add_argument("--seed", type=int, default=12, help="of the designs drawn")
    given = parser.parse_args()
    work = stressed_loads if given.loads else stressed
    print(f"{'machine':26}{'designs':>10}{'missed':>8}{'short':>10}{'error':>10}{'CPU s':>8}")
    wrong = False
    for name in given.machine or MACHINES:
        row = work(name, given.designs, given.seed, seconds=given.seconds)
        error = "-" if row.worst is None else f"{row.worst:.1e}"
        counts = f"{row.machine:26}{row.designs:>10}{row.missed:>8}"
        print(f"{counts}{row.short:>10.1e}{error:>10}{row.seconds:>8.0f}", flush=True)
        wrong |= bool(row.missed) or (row.worst or 0.0) > EXACT_TO
    sys.exit(wrong)


if __name__ == "__main__":
    main()
