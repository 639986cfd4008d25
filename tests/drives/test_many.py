"""Peaks of batches of side-cranks: against the general search, and against 50 digits."""

import numpy as np
import pytest
from witness import Geneva

from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many
from geneva_cli.motion.peak_search import motion_peaks, search_peaks
from geneva_cli.motion.registry import gearing as wheel_of
from geneva_cli.motion.wheels.side_crank_arrays import (
    acceleration,
    acceleration_at_end,
    acceleration_peaks,
    velocity_peaks,
    wheels,
)
from geneva_cli.numerics.angles import one_minus_sin_pi, sin_cos_pi

# What it promises, relative to the true peak; and twice that between two that promise it.
EXACT = 4e-15


def designs(count, seed):
    """Half of them with z to 24, half to a million; half of A even, half crowding to +-0.999."""
    random = np.random.default_rng(seed)
    large = np.exp(random.uniform(np.log(3.0), np.log(1e6), count)).astype(int)
    z = np.clip(np.where(random.random(count) < 0.5, random.integers(3, 25, count), large), 3, None)
    near = np.sign(random.uniform(-1.0, 1.0, count)) * (1.0 - 10.0 ** random.uniform(-3, 0, count))
    A = np.where(random.random(count) < 0.5, random.uniform(-0.999, 0.999, count), near)
    A[:4] = (-0.999, 0.999, 0.5, -0.5)
    A[A == 0.0] = 0.1
    return z, random.random(count) < 0.5, A


def batch(z, internal, A):
    sign = np.where(internal, -1.0, 1.0)
    return wheels(sign, sin_cos_pi(1, z)[0], one_minus_sin_pi(1, z), A)


PEAKS = {"velocity": velocity_peaks, "acceleration": acceleration_peaks}
# velocities of internal wheels are left to the general search
CASES = [("external", "velocity"), ("external", "acceleration"), ("internal", "acceleration")]


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("gearing", "quantity"), CASES)
def test_none_is_missed(gearing, quantity):
    """20,000 designs against the general search, which shares no formula; 5 % it may leave out.

    `make stress` looks at thousands of every machine (stress_many.py).
    """
    z, _, A = designs(20_000, 1)
    spec = Spec(wheel_of(gearing)(6), SideCrank(A=0.1))
    motion = many(spec, {"wheel.z": z, "drive.A": A}).machine.engagements[0].motion
    size, at_deg = PEAKS[quantity](batch(z, np.full(len(z), gearing == "internal"), A))
    found = search_peaks(motion, [quantity])[quantity]
    known = ~np.isnan(size)
    assert known.mean() > 0.95
    # the other one's own error comes on top: jets run up to 31 units near |A| = 1
    np.testing.assert_allclose(size[known], found.max[known], rtol=2 * EXACT)
    np.testing.assert_allclose(at_deg[known], found.at_deg[known], rtol=0.0, atol=1e-4)
    # what it leaves out the general search finds
    whole = motion_peaks(motion, [quantity])[quantity]
    np.testing.assert_allclose(whole.max, found.max, rtol=2 * EXACT)


@pytest.mark.parametrize("z", [3, 4, 6, 24, 1000])
def test_inside_a_slow_crank_never_passes_its_jump(z):
    """What is not searched for: inside and A >= 0, on a grid of A up to 1 - 1e-6 and of f."""
    A = np.concatenate((np.linspace(0.0, 0.9, 40), 1.0 - np.logspace(-1, -6, 60)))
    w = batch(z, True, A)
    jump = acceleration_at_end(w)[0]
    inner = acceleration(w, np.linspace(0.0, 1.0, 2001)[:-1, None] * np.arccos(w.sign * w.l))[0]
    assert (inner <= jump).all()


@pytest.mark.sampled(12)
@pytest.mark.parametrize(("gearing", "quantity"), CASES)
@pytest.mark.parametrize("z", [3, 11, 1000])
def test_against_50_digits(z, gearing, quantity):
    A = np.array([-0.999, -0.9, -0.3, 0.01, 0.324737, 0.6, 0.9, 0.999])
    size, place = PEAKS[quantity](batch(z, gearing == "internal", A))
    assert np.isnan(size).sum() <= 2
    for i in np.flatnonzero(~np.isnan(size)):
        exact, at_deg = Geneva(z, gearing, float(A[i])).peak(quantity)
        assert abs(float(size[i] / exact - 1)) <= EXACT
        assert place[i] == pytest.approx(float(at_deg), abs=1e-8)
