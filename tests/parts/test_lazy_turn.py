"""A wheel that moves only when it is pushed, against closed forms and polygons that are pushed."""

import math

import numpy as np
import pytest
import shapely
from drawn_wheels import corners, disc, drawn_wheel, outline
from scipy.optimize import brentq

from geneva_cli.parts.turn.free_ranges import FreeRanges
from geneva_cli.parts.turn.lazy_turn import Turner

Z, L, R, ROLLER, CLEARANCE = 6, 60.0, 30.0, 3.0, 0.25
HALF = ROLLER + CLEARANCE
DEG = math.degrees


def turner(rim, slack=1e-6):
    wheel = drawn_wheel(Z, L - R, HALF, rim)
    free = FreeRanges(outline(wheel), outline(disc(R, 0.0, ROLLER)), L, 1.0, math.tau / Z, slack)
    return Turner(free, -math.pi)


def pin(angle):
    """The roller's centre, the crank's angle being 0 where it points to the wheel's axis."""
    return complex(L - R * math.cos(angle), R * math.sin(angle))


def meets(rim, side):
    """Crank angle and velocity at which the roller meets a corner of the slot's mouth at rest."""
    corner = complex(math.sqrt(rim**2 - HALF**2), side * HALF) * complex(
        math.cos(math.pi / 6), -math.sin(math.pi / 6)
    )
    gap = lambda a: abs(pin(a) - corner) - ROLLER  # noqa: E731
    steps = [math.radians(0.1 * k) for k in range(-800, 0)]
    b = next(a for a in steps if gap(a) < 0.0)
    first = brentq(gap, b - math.radians(0.1), b, xtol=1e-15)
    normal = corner - pin(first)
    rate = complex(R * math.sin(first), R * math.cos(first))  # of the pin, a radian
    own = corner * 1j  # of the corner
    dot = lambda p, q: (p.conjugate() * q).real  # noqa: E731
    return first, dot(normal, rate) / dot(normal, own)


@pytest.mark.parametrize(
    ("rim", "index", "at_deg", "velocity"),
    [
        (36.0, 53.027, -34.072, 4.657),
        (40.0, 56.418, -41.332, 1.16207),
        (45.0, 58.718, -48.938, 0.435),
    ],
)
def test_a_rim_that_is_too_small_is_hit(rim, index, at_deg, velocity):
    """The roller meets the rear corner of the mouth, by the triangle of both and the axes."""
    own = turner(rim)
    forwards, backwards = own.turn(-math.pi / 6), own.turn(math.pi / 6, -1)
    assert forwards.jam is None
    assert backwards.jam is None
    assert DEG(forwards.gained) == pytest.approx(index, abs=1e-3)
    assert backwards.gained == pytest.approx(-forwards.gained, abs=1e-9)
    (push,) = forwards.pushes
    first, rate = meets(rim, 1.0)
    assert DEG(push.begin) == pytest.approx(at_deg, abs=1e-3)
    assert push.begin == pytest.approx(first, abs=1e-6)  # the roller is smaller by the slack
    assert rate == pytest.approx(velocity, abs=1e-3)


def test_a_rim_that_ends_short_of_the_roller_jams():
    own = turner(33.0)
    for way, at_deg in ((1, -27.12675), (-1, -360.0 + 27.12675)):
        jam = own.turn(-way * math.pi / 6, way).jam
        assert DEG(jam.crank) == pytest.approx(at_deg, abs=1e-4)
        assert DEG(jam.wheel) == pytest.approx(-30.0 * way)


def test_the_places_of_rest_from_which_a_wheel_turns():
    """From some places the roller pushes a corner; from others it meets it head on."""
    own = turner(33.0)
    rests = (-33.5, -30.0, -28.0, -24.0)
    goes = [own.turn(math.radians(rest), exact=False).jam is None for rest in rests]
    assert goes == [pushed_index(33.0, rest) is not None for rest in rests]


def pushed_index(rim, rest_deg, step=0.25):
    """Index of a polygon, degrees: the wheel is turned just free after each step; None if stuck."""
    wheel = shapely.Polygon(corners(drawn_wheel(Z, L - R, HALF, rim), 96))
    shapely.prepare(wheel)
    at = rest_deg
    for k in range(int(-70 / step), int(70 / step)):
        centre = pin(math.radians(k * step))
        if overlaps(wheel, at, centre):
            move = least_move(wheel, at, centre, 6.0 * step)
            if move is None:
                return None
            at += move
    return at - rest_deg


def least_move(wheel, at, centre, most):
    """The smallest turn that frees the wheel, to 1e-4 degrees; None if it is more than ``most``."""
    for k in range(1, int(most / 0.1) + 1):
        for way in (1.0, -1.0):
            if not overlaps(wheel, at + 0.1 * k * way, centre):
                low, high = 0.1 * (k - 1), 0.1 * k
                for _ in range(10):
                    half = 0.5 * (low + high)
                    there = overlaps(wheel, at + half * way, centre)
                    low, high = (half, high) if there else (low, half)
                return high * way
    return None


def overlaps(wheel, at, centre):
    """Whether the roller, turned back with the wheel, overlaps it."""
    own = centre * complex(math.cos(math.radians(at)), -math.sin(math.radians(at)))
    return shapely.dwithin(wheel, shapely.Point(own.real, own.imag), ROLLER - 1e-4)


@pytest.mark.parametrize("rim", [36.0, 45.0])
def test_polygons_that_are_pushed_go_as_far(rim):
    index = DEG(turner(rim).turn(-math.pi / 6).gained)
    assert pushed_index(rim, -30.0) == pytest.approx(index, abs=0.02)


def test_a_loose_lock_leaves_the_play_of_its_triangle():
    """Disc 0.55 R in a recess of 0.62 R: the recess's corner at the rim meets the disc."""
    R, rim = 50.0, 54.0
    L = R / math.sin(math.pi / 4)
    wheel = drawn_wheel(4, L - R, 5.0, rim, recess=(L, 0.62 * R))
    crank = outline(disc(0.0, 0.0, 0.55 * R))
    free = FreeRanges(outline(wheel), crank, L, 1.0, math.tau / 4, 1e-9)
    at = free.at(np.array([math.pi])).around(0, -math.pi / 4)
    opening = [
        math.acos((L * L + rim * rim - r * r) / (2.0 * L * rim)) for r in (0.62 * R, 0.55 * R)
    ]
    play = opening[0] - opening[1]
    assert DEG(play) == pytest.approx(4.03614, abs=1e-5)
    assert at.is_free
    assert at.high + math.pi / 4 == pytest.approx(play, abs=1e-9)
    assert at.low + math.pi / 4 == pytest.approx(-play, abs=1e-9)
