"""Stops and plays of wheels with curved slots, for ``fuzz.py``.

Each wheel has a random law, extra dwell and clearance, and walls fitted with other places of the
joints, so that arcs at an inflection get any radius. No parts overlap before a stop, and some do
behind it, by gaps that are distances of points and not contacts. The largest play of a full turn
is that of a dense scan.
"""

import math
from unittest import mock

import numpy as np
from test_outline import made
from turn_witness import check_first_contacts
from words import Motion

from geneva_cli.errors import GenevaError
from geneva_cli.parts.turn.full_turn import full_turn
from geneva_cli.parts.turn.turned_parts import wheel_stops, windows

LAWS = ("modified-sine", "cycloidal", "modified-trapezoid", "3-4-5", "harmonic")
PLACES, DENSE = 80, 1500  # positions of the wheel in each motion and dwell
TURNS = 40  # angles of the wheel that are tried before a stop
SCAN = 1.002  # times the play: a peak lies between two positions of the search
WALLS = 50.0  # times the tolerance of the walls over the rim: smaller plays are the walls' own


def require_largest_plays(parts):
    """The plays of a full turn are those of a dense scan of the first motion."""
    turn = full_turn(parts)
    window = next(w for w in windows(parts) if not w.rests)
    at_deg = np.linspace(window.start, window.end, DENSE)
    at_deg = at_deg[parts.past_mouth(window.motion, at_deg) > 0.0]
    play = np.degrees(wheel_stops(parts, at_deg)[0])
    noise = math.degrees(WALLS * parts.close / parts.sizes.rim)
    assert play.min(axis=0).max() <= max(SCAN * turn.motion.deg, noise), turn.motion
    either = max(turn.ahead.deg, turn.behind.deg)
    assert play.max() <= max(SCAN * either, noise), (turn.ahead, turn.behind)


def stops(arguments):
    """Return the result of a case: a seed, the step of the joints' weights, the machine's keys."""
    seed, step, case = arguments
    with mock.patch("geneva_cli.geometry.fit.WEIGHT", step):
        try:
            parts = made.__wrapped__(**case)
        except GenevaError:
            return "refused"
        share = np.sort(np.random.default_rng(seed).random(PLACES))
        ends = [(w.start, w.end) for w in windows(parts)]
        at_deg = np.concatenate([a + (b - a) * share for a, b in ends])
        assert len(list(check_first_contacts(parts, at_deg, TURNS))) == 2  # ways
        require_largest_plays(parts)
        return "machine"


def case(rng):
    """A case."""
    alpha0 = rng.choice((0.0, -16.303125, rng.uniform(-25.0, 25.0)))
    clearance = rng.choice((0.0, 0.02, 0.1))
    size = {
        "roller_radius_mm": rng.choice((3.0, 5.0, 7.0)),
        "slot_clearance_mm": clearance,
        "lock_clearance_mm": clearance,
    }
    keys = {
        "z": rng.choice((3, 4, 5, 6, 8, 10, 12)),
        "gearing": rng.choice(("external", "external", "internal")),
        "motion": Motion(rng.choice(LAWS), alpha0_deg=alpha0, ratio="matched"),
    }
    return rng.getrandbits(32), 2.0 ** -rng.randint(5, 12), keys | size
