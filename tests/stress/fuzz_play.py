"""A larger clearance never gives a smaller play: `tests/stress/fuzz_play.py --runs 4000 --jobs 2`.

Random machines, each with wheels for the same crank that are cut with ever larger clearances, in
slots and in recesses: some 30 a machine, 100,000 in all. At random places of a turn, half of them
where lock and roller change over, no wheel may have less play, back or on, than one with less
clearance: it is a part of that one.
"""

import random
import sys

import numpy as np
from fuzzing import campaign, in_time
from other_shape import with_shape
from test_full_turn import random_case
from test_outline import made

from geneva_cli.errors import GenevaError
from geneva_cli.parts.outlines.wheel_outline import slot_walls, wheel_contour
from geneva_cli.parts.turn.free_angles import EXACT, free_angles
from geneva_cli.parts.turn.gaps import Gaps

SECONDS = 30  # of one machine
WIDTHS, RECESSES = 3, 10  # of slots, and of recesses for each: walls of curved slots cost the most
PLACES = 4
ROUNDING = 1e-9  # of a play: a grazing contact is known to the root of what its sides are
BESIDE = 5.0  # degrees of the input, about entry and exit, for half of them
MORE = (0.001, 0.01, 0.05, 0.2)  # mm, at L = 100: one may leave no horn


def wider(found, more_slot):
    """A machine with the same crank, and slots with more clearance, mm a side."""
    size = found.sizes._replace(half_width=found.sizes.half_width + more_slot)
    fine = 1e-6 * found.assembly.L  # as ``outlines`` draws them
    walls = {e: slot_walls(found.assembly, size, e, fine) for e in found.assembly.kinds}
    return with_shape(found, sizes=size, slots=walls)


def deeper(found, more_lock):
    """A machine with the same crank and slots, and recesses with more clearance, mm.

    Raises GenevaError where that leaves no horn.
    """
    size = found.sizes._replace(recess=found.sizes.recess + more_lock)
    if size.horn <= 0.0:
        raise GenevaError("the recess breaks into the slot")  # as the check of the horn says
    wheel = wheel_contour(found.assembly, size, found.outlines.slots)
    gaps = Gaps(found.assembly, size, wheel, found.outlines.crank)
    return with_shape(found, sizes=size, wheel=wheel, gaps=gaps)


def places(found, rng):
    """Input angles, half of them beside the ends of a motion."""
    assembly = found.assembly
    start, turn = assembly.start_deg, assembly.turn_deg
    engagement, behind = rng.choice(assembly.motions)
    ends = [behind + rng.choice((engagement.entry_deg, engagement.exit_deg)) for _ in range(2)]
    beside = [start + (end + rng.uniform(-BESIDE, BESIDE) - start) % turn for end in ends]
    return np.array([*beside, *(start + turn * rng.random() for _ in range(PLACES - 2))])


def require_no_less_play(found, rng, widths, recesses):
    """Return the number of wheels; those without a horn are left out."""
    at = places(found, rng)
    # Walls of curved slots are known to 1e-6 L; those of the same slots are the same.
    curved = any(e.slot.curved for e in found.assembly.kinds)
    spare = 2e-6 * found.assembly.L if curved else 0.0
    depths = [0.0, *np.cumsum([rng.choice(MORE) for _ in range(recesses - 1)]).tolist()]
    eased = {depths[0], depths[-1]} if curved else set(depths)  # a play with spare takes its time
    narrower, count = {}, 0
    for width in range(widths):
        found = wider(found, rng.choice(MORE)) if width else found
        before = None
        for depth in depths if found.locked else depths[:1]:
            try:
                one = deeper(found, depth)
            except GenevaError:
                break
            play = np.stack(free_angles(one, at))
            count += 1
            require_no_less(play, before, one, at)
            if depth in narrower and depth in eased:
                more = free_angles(with_shape(one, close=one.close + spare), at) if curved else play
                require_no_less(np.stack(more), narrower[depth], one, at)
            before = narrower[depth] = play
    return count


def require_no_less(play, less, one, at):
    """The play of a wheel, and that of one with less clearance if there is one."""
    if less is not None:
        enough = less * (1.0 - ROUNDING) - EXACT
        assert (play >= enough).all(), (less, play, at, one.sizes)


def one(arguments):
    """Return the result of a case, a seed and the machine's keys."""
    seed, case = arguments
    with in_time(SECONDS):
        try:
            found = made.__wrapped__(**case)
        except GenevaError:
            return "refused"
        return f"{require_no_less_play(found, random.Random(seed), WIDTHS, RECESSES)} wheels"


def case(rng):
    """A case."""
    return rng.random(), random_case(rng)


if __name__ == "__main__":
    sys.exit(campaign("machines with many wheels", case, one, batch=20))
