"""Regions of a sphere: solid angles and moments against closed forms of other derivations."""

import math

import numpy as np
import pytest

from geneva_cli.geometry.plates import Shell
from geneva_cli.geometry.sphere import (
    Cap,
    Region,
    SphereArc,
    convex_hull,
    cross,
    place,
    unit,
)
from geneva_cli.geometry.sphere_arcs import RoundHole, SphereArcs

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
    up = math.tau * (1.0 - c**3) / 3.0
    assert region.polar_moment == pytest.approx(math.tau * (1.0 - c) - up, abs=CLOSE)


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
    assert octant.polar_moment == pytest.approx(math.pi / 3.0, abs=CLOSE)


def test_a_shell():
    """A whole cap's frustum of a cone between two spheres, and a hollow ball's 2/5."""
    two = [Cap((0.0, 0.0, sense), 0.5 * math.pi).region for sense in (1.0, -1.0)]
    ball = Shell("ball", "WHEEL", tuple(two), 3.0, 5.0)
    assert ball.volume == pytest.approx(4.0 / 3.0 * math.pi * (125.0 - 27.0), rel=1e-14)
    wanted = 0.4 * ball.volume * (5.0**5 - 3.0**5) / (5.0**3 - 3.0**3)
    assert ball.inertia == pytest.approx(wanted, rel=1e-14)


def test_round_holes_take_what_integrals_say():
    """Of a cylinder between two spheres, about an axis askew to it: by Gauss's points over the
    distance from its axis and the height, enough for rounding alone to be left."""
    axis, q, low, high = place(0.7, 0.4), 3.0, 20.0, 26.0
    hole = RoundHole(axis, q)
    nodes, weights = np.polynomial.legendre.leggauss(40)

    def over(f):
        s = 0.5 * q * (1.0 + nodes[:, None])
        ends = [np.sqrt(R * R - s * s) for R in (low, high)]
        half = 0.5 * (ends[1] - ends[0])
        h = 0.5 * (ends[0] + ends[1]) + half * nodes
        return float((0.5 * q * weights) @ (math.tau * s * half * f(s, h)) @ weights)

    cosine = axis[2]
    assert hole.volume(low, high) == pytest.approx(over(lambda s, h: h**0), rel=1e-13)
    # r² less the square along the axis asked for, whose mean about the cylinder's own is this
    askew = over(lambda s, h: s**2 + h**2 - (h * cosine) ** 2 - s**2 * (1.0 - cosine**2) / 2.0)
    assert hole.inertia(low, high) == pytest.approx(askew, rel=1e-13)


def test_a_bored_shell_has_its_mass_where_sampling_finds_it():
    """A cap with two holes: volume, inertia and size, by a grid's points."""
    low, high = 8.0, 10.0
    holes = RoundHole(place(0.0, 0.0), 1.5), RoundHole(place(0.5, 1.0), 1.0)
    one = Shell("", "ARM", (cap(0.8),), low, high, holes)
    step = 0.1
    side = np.arange(-8.0, 8.0, step) + 0.5 * step
    x, y, z = (v.ravel() for v in np.meshgrid(side, side, np.arange(5.0, 10.0, step) + 0.5 * step))
    r = np.sqrt(x * x + y * y + z * z)
    inside = (r > low) & (r < high) & (z > r * math.cos(0.8))
    for (a, b, c), q in holes:
        inside &= r * r - (a * x + b * y + c * z) ** 2 > q * q
    x, y, z = x[inside], y[inside], z[inside]
    # the surface's cells are in or out: some step² of each of its mm²
    assert one.volume == pytest.approx(len(x) * step**3, rel=3e-3)
    wanted = (x * x + y * y).sum() * step**3
    assert one.inertia == pytest.approx(wanted, rel=3e-3)
    assert one.reach((0.0, 0.0, 1.0)) == high
    assert one.reach((0.0, 1.0, 0.0)) == pytest.approx(high * math.sin(0.8), rel=1e-14)
    assert one.reach((0.0, 0.0, -1.0)) == pytest.approx(-low * math.cos(0.8), rel=1e-14)


BELTS = {
    "an arm": [Cap((0.0, 0.0, 1.0), 0.2), Cap(place(0.5, 0.3), 0.06)],
    "a plate": [Cap((0.0, 0.0, 1.0), 0.1), *(Cap(place(0.6, 2.1 * k), 0.05) for k in range(3))],
    "a disc with noses": [Cap((0.0, 0.0, 1.0), 0.5), *(Cap(place(0.6, k), 0.05) for k in (0, 3))],
    "in a row": [Cap(place(0.5, a), 0.05) for a in (0.0, math.pi)] + [Cap((0.0, 0.0, 1.0), 0.05)],
    "one in another": [Cap((0.0, 0.0, 1.0), 0.5), Cap(place(0.3, 1.0), 0.1)],
}


@pytest.mark.parametrize("name", BELTS)
def test_a_belt_holds_its_caps_and_no_more(name):
    """All rims are within; it never turns to the right, nor at a corner; its arcs are of rims, and
    its great circles touch two. There is one such boundary: the hull."""
    caps, found = BELTS[name], convex_hull(BELTS[name])
    edge = SphereArcs(found.boundary)
    for one in caps:
        rim = one.region.boundary[0].at(np.linspace(0.0, math.tau, 100))[0]
        assert edge.signed(rim).max() < 1e-9  # of a square root at a tangent's touch
    assert np.abs(edge.turn_start).max() < 1e-9
    for arc, after in zip(found.boundary, (*found.boundary[1:], found.boundary[0]), strict=True):
        assert arc.end == after.start
        if arc.angle < 1.5:
            assert any(arc.axis == one.middle and arc.angle == one.angle for one in caps)
            continue
        off = [float(np.dot(arc.axis, one.middle)) - math.sin(one.angle) for one in caps]
        assert sum(abs(d) < 1e-12 for d in off) >= 2
