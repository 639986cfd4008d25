"""Places on a curve whose chords keep a tolerance."""

import math

import numpy as np
import pytest

from geneva_cli.geometry import chords


@pytest.mark.parametrize("fewest", [True, False])
@pytest.mark.parametrize("within", [1e-3, 1e-4, 1e-11])
def test_a_stretch_that_is_hidden_between_two_places(within, fewest):
    """A point runs through half a circle of 50 mm at once, and on along it by one radian.

    By their sagittas 50 (1 - cos(turn/2)), at least (pi + 1)/(2 acos(1 - 1e-3/50)) chords are
    needed. Some more are where the survey of the curve does not show the half circle.
    """
    measured = 0

    def turned(t):
        return 2.0 * np.arctan(t / within) + t

    def curves(t):
        nonlocal measured
        measured += 1
        return (50.0 * np.column_stack((np.cos(turned(t)), np.sin(turned(t)))),)

    places = chords.nodes(curves, (0.0, 1.0), 1e-3, fewest)
    turn = np.diff(turned(places))
    # measured places leave three quarters of a chord at most: 0.75 is 4 x 0.75 x 0.25 of a sagitta
    assert 50.0 * (1.0 - np.cos(0.5 * turn)).max() <= 1e-3 / 0.75
    least = (math.pi + 1.0) / (2.0 * math.acos(1.0 - 1e-3 / 50.0))
    assert len(places) - 1 <= (1.05 if fewest and within > 1e-5 else 1.4) * least
    assert measured <= 2 * 60


def off_a_cubic(t):
    """Distance of x³ from each chord, in closed form: at most where the tangent is parallel.

    x³ less the chord from a to b is (x - a)(x - b)(x + a + b).
    """
    a, b = t[:-1], t[1:]
    far = np.zeros_like(a)
    for sign in (-1.0, 1.0):
        x = np.clip(sign * np.sqrt((a * a + a * b + b * b) / 3.0), a, b)
        far = np.maximum(far, np.abs((x - a) * (x - b) * (x + a + b)))
    return far / np.hypot(1.0, a * a + a * b + b * b)


@pytest.mark.parametrize("tolerance", [1e-4, 1e-6, 1e-9])
@pytest.mark.parametrize("fewest", [True, False])
def test_no_chord_exceeds_the_tolerance_at_an_inflection(tolerance, fewest):
    """There the curve is an S, whose peaks lie between the places of the measurement."""
    ends = (-1.0, 0.3, 1.0)
    places = chords.nodes(lambda t: (np.column_stack((t, t**3)),), ends, tolerance, fewest)
    # what doubles leave of points of size 1
    assert off_a_cubic(places).max() <= tolerance + 4e-16
