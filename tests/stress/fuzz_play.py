"""A larger clearance never gives a smaller play: `tests/stress/fuzz_play.py --runs 20000 --jobs 2`.

Random machines, each with five wheels that are cut with ever larger clearances, in slots or in
recesses, for the same crank: 100,000 machines. At random places of a turn no wheel may have less
play, back or on, than the one before it: it is a part of that one.
"""

import random
import sys

import numpy as np
from fuzzing import campaign, in_time
from test_full_turn import random_case
from test_outline import made

from geneva_cli.errors import GenevaError
from geneva_cli.parts.outlines import slot_walls
from geneva_cli.parts.turn.freedom import EXACT, SHARE, free_angles
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.wheel import wheel_contour

SECONDS = 30  # of one machine
WHEELS = 5
PLACES = 2
MORE = (0.001, 0.01, 0.05, 0.2)  # mm, at L = 100: one may leave no horn


def wider(found, more_slot, more_lock):
    """A machine with the same crank, and a wheel with more clearance, mm a side."""
    size, assembly = found.sizes, found.assembly
    size = size._replace(half_width=size.half_width + more_slot, recess=size.recess + more_lock)
    walls = {e: slot_walls(assembly, size, e, found.fine) for e in assembly.kinds}
    wheel = wheel_contour(assembly, size, walls)
    return found._replace(
        sizes=size, slots=walls, wheel=wheel, gaps=Gaps(assembly, size, wheel, found.crank)
    )


def require_no_less_play(found, rng, wheels):
    """Returns how many wheels there were: they end where a clearance leaves no horn."""
    start, turn = found.assembly.start_deg, found.assembly.turn_deg
    at = np.array([start + turn * rng.random() for _ in range(PLACES)])
    # Curved walls are known to ``fine``, on both wheels; straight ones to rounding.
    spare = 2.0 * found.fine * any(e.slot.curved for e in found.assembly.kinds)
    for count in range(wheels):
        more = rng.choice(MORE)
        in_slot = rng.random() < 0.5
        try:
            after = wider(found, *((more, 0.0) if in_slot else (0.0, more)))
        except GenevaError:
            return count
        less = np.stack(free_angles(found, at))
        play = np.stack(free_angles(after._replace(close=found.close + spare), at))
        assert (play >= less * (1.0 - 2.0 * SHARE) - 2.0 * EXACT).all(), (less, play, at)
        found = after
    return wheels


def one(given):
    """How a case, a seed and the machine's keys, ended."""
    seed, case = given
    with in_time(SECONDS):
        try:
            found = made.__wrapped__(**case)
        except GenevaError:
            return "refused"
        return f"{require_no_less_play(found, random.Random(seed), WHEELS)} wheels"


def case(rng):
    """A case."""
    return rng.random(), random_case(rng)


if __name__ == "__main__":
    sys.exit(campaign("machines with five wheels", case, one, batch=50))
