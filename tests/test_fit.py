"""Curves as pieces: counts, tangents, ends and errors, measured by other means than the fit's."""

import numpy as np
import pytest

from geneva_cli.drawing import Arc, Line
from geneva_cli.errors import GenevaError
from geneva_cli.fit import arcs


def circle(radius):
    def curve(t):
        c, s = np.cos(t), np.sin(t)
        return radius * np.column_stack((c, s)), np.column_stack((-s, c))

    return curve


def line(t):
    way = np.array([0.6, 0.8])
    return 100.0 + t[:, None] * way, np.broadcast_to(way, (len(t), 2))


@pytest.mark.parametrize("turn", [0.3, 1.0, 3.0, 4.5, 6.28, 2.0 * np.pi])
def test_a_circle_is_an_arc_or_two(turn):
    found = arcs(circle(25.0), 0.5, 0.5 + turn, 1e-6)
    assert len(found) == (1 if turn < np.pi else 2)
    # The fit's arcs are joined where they agree to 16 ulp of 25 mm.
    assert sum(arc.sweep for arc in found) == pytest.approx(turn, abs=1e-13)
    for arc in found:
        assert arc.radius == pytest.approx(25.0, abs=1e-12)


def test_a_straight_stretch_is_a_line():
    assert [type(piece) for piece in arcs(line, 0.0, 70.0, 1e-3)] == [Line]


def test_a_tolerance_beyond_double_precision_is_refused():
    with pytest.raises(GenevaError, match="finer than double precision can show"):
        arcs(circle(25.0), 0.0, 1.0, 1e-14)


def test_neighbours_meet_and_share_their_tangent():
    def parabola(t):
        slope = np.column_stack((np.ones(len(t)), 0.1 * t))
        return np.column_stack((t, 0.05 * t * t)), slope / np.linalg.norm(slope, axis=1)[:, None]

    found = arcs(parabola, -30.0, 50.0, 1e-3)
    assert all(isinstance(piece, Arc) for piece in found)
    for a, b in zip(found, found[1:], strict=False):
        assert a.end == b.start
