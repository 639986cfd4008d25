"""No kerf's path crosses itself: `tests/stress/fuzz_kerf.py --runs 20000`, some 10,000 outlines.

Random outlines of lines and arcs, standing out and standing in, long and thin, with corners as
sharp as they come, and cuts of any width: each has a path that leaves the part, by shapely's
offsets of polygons, or is refused.
"""

import sys

from fuzzing import campaign, in_time
from test_kerf import tried

SECONDS = 30  # of one outline


def case(rng):
    """Distances of the corners from the origin with the bulges after them, a kerf, and its side."""
    spread = rng.choice([0.1, 0.5, 1.0])
    bent = rng.choice([0.0, 0.3, 0.7, 1.5])
    corners = [
        (10.0 * 3.0 ** rng.uniform(-spread, spread), rng.uniform(-bent, bent))
        for _ in range(rng.randint(3, 40))
    ]
    return corners, 10.0 ** rng.uniform(-2.0, 1.0), rng.random() < 0.5


def one(arguments):
    """Return the result of a case in a word."""
    with in_time(SECONDS):
        return tried(*arguments)


if __name__ == "__main__":
    sys.exit(campaign("outlines", case, one, batch=200))
