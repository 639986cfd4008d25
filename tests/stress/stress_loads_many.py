"""Extremes of loads of many designs: is any missed? Part of `make stress`.

    stress_loads_many.py [--designs N] [--machine NAME]... [--seconds S] [--seed N]

Random designs of every machine (those of tests/design_arrays.py), each under a load of its own,
with friction and without: the greatest and least of every quantity that is known of it is
compared with a dense scan, which has other places in each design. All are computed together, and
some one at a time, as a sweep does: a cut of the motion for one quantity may show the extreme of
another. Greatest sizes are computed alone too, which may need no cut. One row a machine; the exit
status is 1 where a place of the scan exceeds an extreme.
"""

import math
import sys
import time

import numpy as np
from loaded_arrays import beyond, loaded
from stress_many import options

from geneva_cli.loads.load_case import known_quantities
from geneva_cli.loads.load_peaks import load_peaks, load_summaries

CHUNK = 4_096  # designs built together
PLACES = 200
ALONE = ("pin_force_N", "input_torque_Nm")
MORE = 1e-12  # of a quantity's size: above what rounding does


def stressed(name, count, seed=12, places=PLACES, seconds=math.inf):
    """Count the designs, and those with a missed extreme; by how much at most; CPU seconds."""
    start = time.process_time()
    done, missed, most = 0, 0, -math.inf
    while done < count and time.process_time() - start < seconds:
        # every second time without friction, where other signs count
        rubs = {"friction": 0.0} if seed % 2 else {}
        batch = loaded(name, min(CHUNK, 2 * (count - done) + 20), seed, **rubs)[2]
        seed += 1
        if batch.machine is None:
            continue
        names = known_quantities(batch.machine)
        over = beyond(batch, places, seed, names=names)
        for one in [name for name in ALONE if name in names]:
            together = load_summaries(batch.machine, (one,), means=False)
            over = np.hstack((over, beyond(batch, places, seed, (one,), together)))
            over = np.hstack((over, off(batch.machine, one, together[one])))
        done += len(over)
        missed += int((over > MORE).any(axis=1).sum())
        most = max(most, float(over.max()))
    return done, missed, most, time.process_time() - start


def off(machine, name, ends):
    """Relative difference of the greatest size, computed alone, from the greater extreme."""
    size = np.maximum(np.abs(ends.max), np.abs(ends.min))
    alone = load_peaks(machine, [name])[name].max
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.where(alone == size, 0.0, np.abs(alone / size - 1.0))[:, None]


def main():
    chosen = options(__doc__)
    print(f"{'machine':26}{'designs':>10}{'missed':>8}{'passed by':>12}{'CPU s':>8}")
    wrong = False
    for name in chosen.machine:
        done, missed, most, seconds = stressed(
            name, chosen.designs, chosen.seed, seconds=chosen.seconds
        )
        print(f"{name:26}{done:>10}{missed:>8}{most:>12.1e}{seconds:>8.0f}", flush=True)
        wrong |= bool(missed)
    sys.exit(wrong)


if __name__ == "__main__":
    main()
