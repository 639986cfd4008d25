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
from words import Motion

from geneva_cli.errors import GenevaError
from geneva_cli.parts.turn.full_turn import full_turn
from geneva_cli.parts.turn.play import search_deg, smallest_clearance, wheel_stops, windows

LAWS = ("modified-sine", "cycloidal", "modified-trapezoid", "3-4-5", "harmonic")
PLACES, DENSE = 80, 1500  # positions of the wheel in each motion and dwell
TURNS = 40  # angles of the wheel that are tried before a stop
ROUNDING = 1e-10  # mm: of gaps of some hundred mm
PAST = 1e-5  # radians: what grazes at 100 mm overlaps by some 1e-7 mm more, as much as counts
SCAN = 1.002  # times the play: a peak lies between two positions of the search
WALLS = 50.0  # times the tolerance of the walls over the rim: smaller plays are the walls' own


def require_first_contacts(parts, at_deg):
    """No overlap before the stops at input angles, and an overlap behind them."""
    gaps, pose = parts.gaps, parts.gaps.pose(at_deg)
    apart = smallest_clearance(gaps, pose, np.zeros(len(at_deg)), gaps.near) + parts.close >= 0.0
    most = math.radians(search_deg(parts))
    many = gaps.pose(np.tile(at_deg, TURNS))
    share = np.linspace(0.0, 1.0, TURNS)[:, None]
    for way, free in zip((-1.0, 1.0), wheel_stops(parts, at_deg)[0], strict=True):
        turned = np.where(apart, share * free, 0.0)
        gap = smallest_clearance(gaps, many, way * turned.ravel(), gaps.near).reshape(turned.shape)
        assert (gap[:, apart] >= -parts.close - ROUNDING).all(), "a stop is missed"
        stopped = apart & (free < most)
        behind = smallest_clearance(gaps, pose, way * (free + PAST), gaps.near)
        assert (behind[stopped] < -parts.close).all(), "nothing is behind a stop"


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
    with mock.patch("geneva_cli.geometry.fit.arcs.WEIGHT", step):
        try:
            parts = made.__wrapped__(**case)
        except GenevaError:
            return "refused"
        share = np.sort(np.random.default_rng(seed).random(PLACES))
        ends = [(w.start, w.end) for w in windows(parts)]
        require_first_contacts(parts, np.concatenate([a + (b - a) * share for a, b in ends]))
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
