"""Holes for screws: those of the standards, and which of two parts has the thread."""

import pytest

from geneva_cli.parts.shafts.bores import SCREWS

# Coarse threads of ISO 262, their clearance holes of the medium series of ISO 273, and the drills
# before the threads are cut by ISO 2306.
STANDARD = """
1.6 1.8 1.25, 2 2.4 1.6, 2.5 2.9 2.05, 3 3.4 2.5, 4 4.5 3.3, 5 5.5 4.2, 6 6.6 5.0, 8 9 6.8,
10 11 8.5, 12 13.5 10.2, 16 17.5 14, 20 22 17.5, 24 26 21, 30 33 26.5, 36 39 32, 42 45 37.5,
48 52 43, 56 62 50.5, 64 70 58
"""


def test_clearance_holes_and_drills_are_the_standards() -> None:
    rows = [[float(x) for x in row.split()] for row in STANDARD.split(",")]
    assert [(row.thread, row.through) for row in SCREWS] == [(a, b) for a, b, _ in rows]
    # a drill is thread less pitch, rounded to what drills there are
    cores = [row.thread - row.pitch for row in SCREWS]
    assert cores == [pytest.approx(drill, abs=0.051) for *_, drill in rows]
