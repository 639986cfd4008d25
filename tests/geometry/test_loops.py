"""Closed outlines from pieces in any order, and what is refused with its place."""

import math
import random

import pytest

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.loops import loops, shown
from geneva_cli.geometry.plates import moments
from geneva_cli.geometry.shapes import Arc, Circle, Line, polygon, two_arcs


def square(half, x=0.0):
    corners = [(x - half, -half), (x + half, -half), (x + half, half), (x - half, half)]
    return list(polygon("", corners).segments)


def circle(x, y, radius):
    return list(two_arcs(Circle("", (x, y), radius)))


def test_nesting_tells_plates_from_holes():
    """Areas by hand: the material lies on the left of each outline."""
    pieces = [*square(10.0), *square(5.0), *circle(0.0, 0.0, 2.0), *circle(30.0, 0.0, 1.0)]
    random.Random(1).shuffle(pieces)
    seen = sorted(round(moments(loop).area, 9) for loop in loops(pieces))
    four_pi, pi = (round(v * math.pi, 9) for v in (4.0, 1.0))
    assert seen == [-100.0, pi, four_pi, 400.0]


def test_ends_are_joined_and_copies_left_out():
    moved = [Line((-10.0, -10.0), (10.0004, -10.0)), *square(10.0)[1:], square(10.0)[2]]
    (loop,) = loops(moved)
    assert len(loop.segments) == 4


BOW = [(0.0, 0.0), (10.0, 10.0), (10.0, 0.0), (0.0, 10.0)]


@pytest.mark.parametrize(
    ("pieces", "words"),
    [
        ([], "nothing is drawn"),
        (
            square(10.0)[:3],
            r"open at \(-10, -10\): the nearest other end is 20 mm away, at \(-?10, -?10\)",
        ),
        ([*square(10.0), Line((10.0, 10.0), (20.0, 20.0))], r"3 ends meet at \(10, 10\)"),
        (polygon("", BOW).segments, r"cross at \(5, 5\)"),
        ([*square(10.0), *circle(10.0, 0.0, 2.0)], r"cross at \(10, [-2]"),
        ([*circle(0.0, 0.0, 2.0), *circle(1.0, 0.0, 2.0)], r"cross at \(0.5\d*, -?1.93"),
    ],
)
def test_the_place_of_what_is_wrong(pieces, words):
    with pytest.raises(GenevaError, match=words):
        loops(pieces)


def test_tangent_pieces_do_not_cross():
    """A slot's end: two lines and half a circle, whose numbers are rounded."""
    end = Arc((10.0, -2.0), (10.0, 2.0), 0.9999)
    back = polygon("", [(10.0, 2.0), (0.0, 2.0), (0.0, -2.0), (10.0, -2.0)]).segments[:3]
    (loop,) = loops([end, *back])
    assert moments(loop).area == pytest.approx(40.0 + 2.0 * math.pi, rel=1e-3)


def test_places_are_shown_without_needless_digits():
    assert shown((12.0, -0.33333)) == "(12, -0.3333)"
    assert shown((-1e-9, 0.5)) == "(0, 0.5)"
