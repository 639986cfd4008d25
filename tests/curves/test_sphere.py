"""Regions of a sphere: solid angles and moments against closed forms of other derivations."""

import math

import numpy as np
import pytest

from geneva_cli.curves.plates import Shell
from geneva_cli.curves.sphere import Region, Rotation, SphereArc, cross, place, unit

POLE = (0.0, 0.0, 1.0)
CLOSE = 1e-14  # sums of some numbers up to 2 pi


def cap(angle):
    rim = place(angle, 0.3)
    return Region((SphereArc(POLE, angle, rim, rim),), POLE)


def triangle(a, b, c):
    """Of great circles."""
    arcs = tuple(
        SphereArc(unit(cross(p, q)), math.pi / 2.0, p, q) for p, q in ((a, b), (b, c), (c, a))
    )
    return Region(arcs, unit(tuple(sum(v) for v in zip(a, b, c, strict=True))))


@pytest.mark.parametrize("angle", [1e-3, 0.4, math.pi / 2.0, 2.0])
def test_a_cap(angle):
    """The zone of height 1 - cos: by integrals over the height."""
    c = math.cos(angle)
    region = cap(angle)
    assert region.area == pytest.approx(math.tau * (1.0 - c), abs=CLOSE)
    first, second = region.moments
    assert first == pytest.approx([0.0, 0.0, math.pi * (1.0 - c * c)], abs=CLOSE)
    up = math.tau * (1.0 - c**3) / 3.0
    aside = 0.5 * (math.tau * (1.0 - c) - up)
    assert second == pytest.approx(np.diag((aside, aside, up)), abs=CLOSE)


def test_the_excess_of_a_triangle():
    """L'Huilier's formula, by its sides alone; an octant by symmetry."""
    corners = [place(0.3, 0.1), place(1.0, -0.4), place(1.2, 0.9)]
    sides = [math.acos(np.dot(corners[i], corners[(i + 1) % 3])) for i in range(3)]
    s = 0.5 * sum(sides)
    product = math.tan(0.5 * s)
    for side in sides:
        product *= math.tan(0.5 * (s - side))
    assert triangle(*corners).area == pytest.approx(4.0 * math.atan(math.sqrt(product)), abs=CLOSE)
    octant = triangle((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), POLE)
    assert octant.area == pytest.approx(math.pi / 2.0, abs=CLOSE)
    first, second = octant.moments
    assert first == pytest.approx([math.pi / 4.0] * 3, abs=CLOSE)
    # of x y by polar angles: the integral of sin³ is 2/3, that of sin cos of the azimuth 1/2
    assert second == pytest.approx(np.eye(3) * math.pi / 6.0 + (1.0 - np.eye(3)) / 3.0, abs=CLOSE)


def test_clockwise_is_about_the_opposite():
    """A hemisphere without a cap."""
    rim = place(0.7, 0.0)
    outside = SphereArc((0.0, 0.0, -1.0), math.pi - 0.7, rim, rim)
    assert Region((outside,), (0.0, 0.0, -1.0)).area == pytest.approx(
        math.tau * (1.0 + math.cos(0.7)), abs=CLOSE
    )


def test_turned():
    """Moved anywhere, a region keeps its area; its moments turn with it."""
    z = place(0.9, 2.0)
    x = unit(cross((1.0, 0.0, 0.0), z))
    turn = Rotation(x, cross(z, x), z)
    one = triangle(place(0.3, 0.1), place(1.0, -0.4), place(1.2, 0.9))
    moved = one.turned(turn)
    assert moved.area == pytest.approx(one.area, abs=CLOSE)
    frame = np.column_stack(turn)
    assert moved.moments[0] == pytest.approx(frame @ one.moments[0], abs=CLOSE)
    assert moved.moments[1] == pytest.approx(frame @ one.moments[1] @ frame.T, abs=CLOSE)


def test_a_shell():
    """A whole cap's frustum of a cone between two spheres, and a hollow ball's 2/5."""
    two = [
        cap(math.pi / 2.0),
        cap(math.pi / 2.0).turned(Rotation((1, 0, 0), (0, -1, 0), (0, 0, -1))),
    ]
    ball = Shell("ball", "WHEEL", tuple(two), 3.0, 5.0)
    assert ball.volume == pytest.approx(4.0 / 3.0 * math.pi * (125.0 - 27.0), rel=1e-14)
    wanted = 0.4 * ball.volume * (5.0**5 - 3.0**5) / (5.0**3 - 3.0**3)
    assert ball.inertia(place(1.0, 2.0)) == pytest.approx(wanted, rel=1e-14)
