"""The product on the dial, against closed forms at 50 digits and dense scans."""

import math

import mpmath
import numpy as np
import pytest
import repo

from geneva_cli import Design, External, GenevaError, Limits, Product, Support, load
from geneva_cli.loads.product import product_motion
from geneva_cli.motion.motion_table import derivatives

G = 9.80665


def motion_of(wheel, drive=None, product=None, **tables):
    product = product or Product(radius_mm=300.0)
    return product_motion(Design(wheel, drive, product=product, **tables).mechanism)


def plain_peak(z, ratio):
    """The peak of sqrt((i A)² + (i V)^4) of a plain external wheel, by mpmath at 50 digits.

    psi = atan2(l sin a, 1 - l cos a): V = l (cos a - l)/D, A = -l (1 - l²) sin a/D² with
    D = 1 - 2 l cos a + l².
    """
    with mpmath.workdps(50):
        l = mpmath.sin(mpmath.pi / z)

        def square(a):
            d = 1 - 2 * l * mpmath.cos(a) + l * l
            v = l * (mpmath.cos(a) - l) / d
            second = -l * (1 - l * l) * mpmath.sin(a) / d**2
            return (ratio * second) ** 2 + (ratio * v) ** 4

        half = mpmath.pi / 2 - mpmath.pi / z
        grid = [half * k / 400 for k in range(401)]
        best = max(range(401), key=lambda k: square(grid[k]))
        at = grid[best]
        if 0 < best < 400:
            slope = lambda a: mpmath.diff(square, a)  # noqa: E731
            at = mpmath.findroot(slope, (grid[best - 1], grid[best + 1]), solver="anderson")
        return float(mpmath.sqrt(square(at))), float(mpmath.degrees(at))


@pytest.mark.sampled(24)
@pytest.mark.parametrize("z", [3, 4, 5, 6, 8, 12])
@pytest.mark.parametrize("ratio", [0.5, 1.0, 3.0])
def test_plain_wheel(z, ratio):
    """Every value of a plain wheel's dial, against closed forms."""
    n_rpm, r = 60.0, 0.3
    w = 2.0 * math.pi * n_rpm / 60.0
    got = motion_of(External(z), support=Support(gear_ratio=ratio))
    l = math.sin(math.pi / z)
    most, at_deg = plain_peak(z, ratio)
    # The search refines to the last bits; the square root and the products add a few.
    assert got["acceleration_m_s2.max"].item() == pytest.approx(r * w * w * most, rel=1e-13)
    # The peak is flat: its place is known to the root of a rounding, and mirrored: the earlier.
    assert got["acceleration_m_s2.at_deg"].item() == pytest.approx(-at_deg, abs=1e-6)
    assert got["speed_m_s.max"].item() == pytest.approx(r * w * ratio * l / (1.0 - l), rel=1e-14)
    assert got["travel_mm"].item() == pytest.approx(300.0 * ratio * 2.0 * math.pi / z, rel=1e-14)
    assert got["friction_needed"].item() == pytest.approx(got["acceleration_m_s2.max"].item() / G)


@pytest.mark.parametrize("file", repo.wheels(), ids=lambda file: file.stem)
@pytest.mark.sampled(8)
def test_dense_scan(file):
    """No place of 20,000 has more acceleration than the peak, and one nearly as much."""
    design = load(str(file), ["product.radius_mm=250"])
    machine = design.mechanism
    start = machine.engagements[0].mid_deg + machine.engagements[0].entry_deg
    at_deg = start + np.linspace(0.0, machine.period_deg, 20_001)
    v, a = derivatives(machine, at_deg, (1, 2))
    w = 2.0 * math.pi * design.spec.drive.n_rpm / 60.0
    i = design.spec.support.gear_ratio
    orbit = 0.0
    if design.spec.drive.NAME == "carousel":
        # from the ground the wheel turns with its carrier, and its axis goes round in a circle
        v, orbit = 1.0 + v, 1e-3 * design.spec.size.center_distance_mm * w * w
    scanned = (0.25 * w * w * np.hypot(i * a, (i * v) ** 2)).max() + orbit
    most = product_motion(machine)["acceleration_m_s2.max"].item()
    assert scanned <= most * (1.0 + 1e-12)
    # 20,000 places are 1/5,000 of a motion apart: a steep peak loses some of a per cent.
    assert scanned >= 0.99 * most


def test_chain():
    """A chain moves by whole pitches, and has no acceleration towards an axis."""
    chain = motion_of(External(8), product=Product(sprocket_teeth=16, pitch_mm=8.0))
    assert chain["travel_mm"].item() == pytest.approx(2 * 8.0, rel=1e-14)
    # r w² psi2, with r = N p / (2 pi) and w = 2 pi
    along = 16 * 8e-3 * 2.0 * math.pi * Design(External(8)).peaks.acceleration.max
    assert chain["acceleration_m_s2.max"].item() == pytest.approx(along, rel=1e-14)


def test_jerk():
    """At mid-motion of a plain wheel |psi'''| = l (1 + l)/(1 - l)^3, its peak; theory.md 1.2."""
    l, w = 0.5, 2.0 * math.pi
    jerk = motion_of(External(6))
    assert jerk["jerk_m_s3.max"].item() == pytest.approx(
        0.3 * w**3 * l * (1.0 + l) / (1.0 - l) ** 3, rel=1e-14
    )
    assert jerk["jerk_m_s3.at_deg"].item() == 0.0


def test_a_product_that_says_too_little_or_too_much():
    both = {"radius_mm": 9.0, "sprocket_teeth": 16, "pitch_mm": 5.0}
    for wrong in ({"sprocket_teeth": 16}, {"friction": 0.2}, both):
        with pytest.raises(GenevaError, match="radius_mm, or sprocket_teeth and pitch_mm: set one"):
            Product(**wrong)
    with pytest.raises(GenevaError, match="needs the product's place"):
        Design(External(6), limits=Limits(product_acceleration_max_m_s2=3.0))


@pytest.mark.long
def test_checks():
    """The limit and the friction are compared with the peak."""
    product = Product(radius_mm=300.0, friction=0.2)
    design = Design(External(6), product=product, limits=Limits(product_acceleration_max_m_s2=99.0))
    checks = {check.name: check for check in design.checks}
    most = product_motion(design.mechanism)["acceleration_m_s2.max"].item()
    assert checks["product_acceleration_max_m_s2"].value == most
    assert checks["product_slip"].value == pytest.approx(most / G)
    assert checks["product_slip"].passes is False
    upright = Design(External(6), product=product, support=Support(axis="horizontal"))
    assert "product_slip" not in {check.name for check in upright.checks}
