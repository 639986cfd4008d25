"""Where two walls of a curved slot meet: straight ones, whose crossing is known."""

import numpy as np
import pytest

from geneva_cli.parts.outlines.curved_walls import WallPlace, _joint
from geneva_cli.parts.outlines.path_walls import Wall


def straight(start, direction):
    """A wall of length 10 from a point; its parameter is the length along it."""
    x, y = np.array(start), np.array(direction) / np.hypot(*direction)

    def curve(t):
        return x + np.multiply.outer(t, y), np.broadcast_to(y, (len(t), 2))

    t = np.linspace(0.0, 10.0, 101)
    return Wall(curve, t, *curve(t), np.ones(len(t), bool))


def joint(one, other):
    """From the end of the one to the start of the other."""
    return _joint(WallPlace(one, 100, 1), WallPlace(other, 0, 1))


def test_walls_that_overlap_at_their_ends_meet_where_they_cross():
    """The one ends at (10, 0); the other, from (9.7, -0.12) at 3 in 4, crosses it at y = 0."""
    found = joint(straight((0.0, 0.0), (1.0, 0.0)), straight((9.7, -0.12), (4.0, 3.0)))
    assert found == pytest.approx((9.86, 0.2), abs=1e-9)


def test_walls_that_end_in_one_point_meet_there():
    """With an end 1e-7 beside it, too: of a wall 10 away from the axis that is rounding."""
    one = straight((0.0, 0.0), (1.0, 0.0))
    for beside in (0.0, 1e-7):
        assert joint(one, straight((10.0, beside), (0.0, 1.0))) == (10.0, 0.0)
