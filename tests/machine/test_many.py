"""Peak accelerations of many designs: against the program's own search, and against 50 digits."""

import math

import numpy as np
import pytest
from witness import SIGN, Geneva

from geneva_cli.analysis.peaks import acceleration_peak as acceleration_search
from geneva_cli.analysis.peaks import peak
from geneva_cli.errors import GenevaError
from geneva_cli.machine.wheels.side_crank_formulas import (
    acceleration,
    acceleration_at_end,
    wheel_of,
)
from geneva_cli.machine.wheels.side_crank_peaks import (
    acceleration_peak,
    acceleration_peaks,
    velocity_peaks,
)

GEARINGS = ("external", "internal")
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


@pytest.mark.sampled(3)
@pytest.mark.parametrize("part", range(5))
def test_none_is_missed(engagement, part):
    """1,000 designs against the adaptive search of geneva_cli.peaks, which shares no formula.

    `make stress` looks at thousands of every machine (stress_many.py).
    """
    z, internal, A = designs(1000, 1)
    size, at_deg = acceleration_peaks(z, internal, A)
    for i in range(part, len(z), 5):
        passage = engagement(int(z[i]), GEARINGS[int(internal[i])], float(A[i]))
        found = peak(passage.motion, "acceleration")
        where = (int(z[i]), GEARINGS[int(internal[i])], float(A[i]))
        # the other one's own error comes on top: jets run up to 31 units near |A| = 1
        assert size[i] == pytest.approx(found.max, rel=2 * EXACT), where
        assert at_deg[i] == pytest.approx(found.at_deg, abs=1e-4), where


def test_a_finer_scan_finds_no_more(monkeypatch):
    """Twice the scan finds nothing more among 200,000."""
    z, internal, A = designs(200_000, 2)
    size, _ = acceleration_peaks(z, internal, A)
    monkeypatch.setattr("geneva_cli.machine.wheels.side_crank_peaks.SCAN", 33)
    finer, _ = acceleration_peaks(z, internal, A)
    assert np.abs(size / finer - 1.0).max() <= 2 * EXACT


@pytest.mark.parametrize("z", [3, 4, 6, 24, 1000])
def test_inside_a_slow_crank_never_passes_its_jump(z):
    """What is not searched for: inside and A >= 0, on a grid of A up to 1 - 1e-6 and of f."""
    A = np.concatenate((np.linspace(0.0, 0.9, 40), 1.0 - np.logspace(-1, -6, 60)))[:, None]
    b = np.pi / z
    l, cos_b = np.sin(b), np.cos(b)
    w = wheel_of(-1.0 + 0.0 * A, l, 1.0 - l, cos_b, np.pi / 2 + b, A)
    jump = acceleration_at_end(np, w)[0]
    inner = acceleration(np, w, np.linspace(0.0, 1.0, 2001)[None, :-1] * w.half)[0]
    assert (inner <= jump).all()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("part", range(4))
def test_no_velocity_is_missed(engagement, part):
    """Of 400 designs; inside, a crank that runs away puts a second peak near the ends."""
    z, internal, A = designs(400, 4)
    size, at_deg = velocity_peaks(z, internal, A)
    for i in range(part, len(z), 4):
        passage = engagement(int(z[i]), GEARINGS[int(internal[i])], float(A[i]))
        found = peak(passage.motion, "velocity")
        assert size[i] == pytest.approx(found.max, rel=2 * EXACT), i
        assert at_deg[i] == pytest.approx(found.at_deg, abs=1e-4), i


def test_a_finer_scan_finds_no_more_velocity(monkeypatch):
    z, internal, A = designs(200_000, 2)
    size, _ = velocity_peaks(z, internal, A)
    monkeypatch.setattr("geneva_cli.machine.wheels.side_crank_peaks.SCAN", 33)
    finer, _ = velocity_peaks(z, internal, A)
    assert np.abs(size / finer - 1.0).max() <= 2 * EXACT


@pytest.mark.parametrize("z", [120, 221])
def test_beyond_what_the_quick_way_is_sure_of(engagement, z):
    """Near |A| = 1 a peak is a sliver that 16 intervals step over: it is searched for."""
    passage = engagement(z, "external", 0.9999988390361856)
    found = acceleration_search(passage)
    assert found.max == pytest.approx(peak(passage.motion, "acceleration").max, rel=1e-15)
    exact, _ = Geneva(z, "external", 0.9999988390361856).peak("acceleration")
    assert found.max == pytest.approx(float(exact), rel=1e-12)  # A is so near to 1


@pytest.mark.parametrize("gearing", GEARINGS)
@pytest.mark.parametrize("A", [-0.999, -0.9, -0.3, 0.0, 0.324737, 0.6, 0.9, 0.999])
@pytest.mark.parametrize("z", [3, 4, 11, 24, 1000])
def test_against_50_digits(z, gearing, A):
    exact, at_deg = Geneva(z, gearing, A).peak("acceleration")
    size, place = acceleration_peak(z, SIGN[gearing], A)
    assert abs(float(size / exact - 1)) <= EXACT
    assert place == pytest.approx(float(at_deg), abs=1e-8)
    many, places = acceleration_peaks(z, gearing == "internal", A)
    assert abs(float(many[0] / exact - 1)) <= EXACT
    assert places[0] == pytest.approx(float(at_deg), abs=1e-8)


def test_shapes_broadcast():
    size, at_deg = acceleration_peaks([4, 6, 8], False, 0.6)
    assert size.shape == at_deg.shape == (3,)
    assert size[1] == pytest.approx(0.5225298230346583, rel=EXACT)
    assert at_deg[1] == pytest.approx(-38.20547183086933, abs=1e-9)


def test_plain_internal_wheels_peak_at_entry():
    z = np.arange(3, 1000)
    size, at_deg = acceleration_peaks(z, True, 0.0)
    assert size == pytest.approx([math.tan(math.pi / k) for k in z], rel=EXACT)
    assert at_deg == pytest.approx(-90.0 - 180.0 / z, abs=1e-12)


def test_no_numpy_state_changes_and_no_warning():
    before = np.geterr()
    acceleration_peaks(*designs(1000, 3))
    assert np.geterr() == before


@pytest.mark.parametrize(
    ("z", "internal", "A", "word"),
    [
        (2, False, 0.0, "z must"),
        (6.5, False, 0.0, "z must"),
        (2_000_000, False, 0.0, "z must"),
        (math.nan, False, 0.0, "z must"),
        (6, 1, 0.0, "gearing"),
        (6, False, 1.0, "A must"),
        (6, False, math.nan, "A must"),
    ],
)
def test_out_of_range(z, internal, A, word):
    with pytest.raises(GenevaError, match=word):
        acceleration_peaks(z, internal, A)


def test_one_out_of_range():
    for z, sign, A, word in (
        (2, 1.0, 0.0, "z must"),
        (6, 0.0, 0.0, "gearing"),
        (6, 1.0, -1.0, "A must"),
    ):
        with pytest.raises(GenevaError, match=word):
            acceleration_peak(z, sign, A)
