"""Peaks of many designs: is any missed, and how exact are they? Part of `make stress`.

    stress_many.py [--designs N] [--machine NAME]...

Random designs of every machine (those of tests/design_arrays.py). Each design's greatest velocity
and acceleration is held against all of a dense scan, which knows no Newton and no bracket: a peak
is missed where a place of the scan has more. Of some designs the size is compared with 50 digits,
at the place where it is said to be. One row a machine; the exit status is 1 where one is missed, or
an error is above 1e-14. A million designs of one machine take some ten minutes.
"""

import argparse
import sys
import time
from typing import NamedTuple

import numpy as np
from design_arrays import MACHINES, alone, drawn
from machine_witness import motions
from witness import QUANTITIES as EXACT

from geneva_cli.analysis.peaks_many import peaks_of_many
from geneva_cli.machine.many import many, taken

NAMES = ("velocity", "acceleration")
CHUNK = 10_000  # designs built together
BLOCK = 32  # designs scanned together: their numbers stay in the processor's cache
PLACES = 2_000  # of a whole motion
MORE = 1e-12  # a place of the scan has more by this share: above what rounding does to either
EXACT_TO = 1e-14
WITNESSED = 20  # designs compared with 50 digits
# no witness of 50 digits by keys alone; stress.py has others
WITHOUT = ("gear sector", "gear sector, any ratio", "four-bar", "slider-crank")


class Row(NamedTuple):
    """What was found of a machine."""

    machine: str
    designs: int
    missed: int
    short: float  # greatest share by which a place of the scan has more
    worst: float | None  # greatest relative error against 50 digits
    seconds: float


def stressed(name, count, seed=12, places=PLACES, witnessed=WITNESSED):
    """One machine. Designs that cannot be built are drawn again."""
    start = time.process_time()
    spec, rules = MACHINES[name]
    done = missed = 0
    short, worst, left = 0.0, 0.0, witnessed
    while done < count:
        varied = drawn(rules, min(CHUNK, 2 * (count - done) + 20), seed)
        seed += 1
        found = many(spec, varied)
        if found.machine is None:
            continue
        which = found.which[: count - done]
        some = taken(found.machine, np.arange(len(which))[: len(found.which)])
        for j, engagement in enumerate(some.engagements):
            peaks = peaks_of_many(engagement.motion, NAMES)
            sizes = [np.broadcast_to(peaks[n].max, len(which)) for n in NAMES]
            over = beyond(engagement.motion, sizes, places)
            missed += int((over > MORE).sum())
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


def beyond(motion, sizes, places):
    """By what share the greatest of a dense scan is above the sizes told: (n,)."""
    count = len(sizes[0])
    ends = [np.broadcast_to(np.ravel(x), (count,)) for x in (motion.entry_deg, motion.exit_deg)]
    whole = not motion.symmetric
    share = np.linspace(0.0, 1.0 if whole else 0.5, places if whole else places // 2)
    out = np.full(count, -np.inf)
    for i in range(0, count, BLOCK):
        part = slice(i, i + BLOCK)
        a, b = (end[part, None] for end in ends)
        x = np.asfortranarray(a + (b - a) * share)
        p = taken(motion, part)(x, 2).derivatives()
        for k, size in enumerate(sizes, 1):
            most = np.abs(np.broadcast_to(p[k], x.shape)).max(axis=1)
            out[part] = np.maximum(out[part], most / size[part] - 1.0)
    return out


def errors(true, peaks, row):
    """Relative errors of the sizes at their places."""
    for name in NAMES:
        size, at = (np.ravel(v)[row if np.size(v) > 1 else 0] for v in peaks[name])
        yield abs(float(size / abs(EXACT[name](true.derivatives(float(at)))[0]) - 1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--designs", type=int, default=20_000, help="of each machine")
    parser.add_argument("--machine", action="append", choices=list(MACHINES))
    asked = parser.parse_args()
    print(f"{'machine':26}{'designs':>10}{'missed':>8}{'short':>10}{'error':>10}{'CPU s':>8}")
    wrong = False
    for name in asked.machine or MACHINES:
        row = stressed(name, asked.designs)
        error = "-" if row.worst is None else f"{row.worst:.1e}"
        print(
            f"{name:26}{row.designs:>10}{row.missed:>8}{row.short:>10.1e}{error:>10}"
            f"{row.seconds:>8.0f}",
            flush=True,
        )
        wrong |= bool(row.missed) or (row.worst or 0.0) > EXACT_TO
    sys.exit(wrong)


if __name__ == "__main__":
    main()
