"""Certificates of random machines against 40 digits: no true peak is outside its bounds.

The bounds are a unit in the last place apart, so a constant that was rounded to a double before a
ball met it is seen in one machine of twenty.
"""

import math
import random

import mpmath
import pytest
from mpmath import mpf
from sampling import some

from geneva_cli import (
    Cam,
    Crank,
    Cycloidal,
    Design,
    EllipticalGears,
    External,
    Harmonic,
    Internal,
    ModifiedConstantVelocity,
    ModifiedSine,
    ModifiedTrapezoid,
    Motion,
    Polynomial345,
    Polynomial4567,
    SideCrank,
    SineConstantCosine,
    SineGroup,
    Size,
    Spherical,
)

QUANTITIES = ("velocity", "acceleration", "jerk")
DIGITS = 40


def decimal(x):
    """The decimal that is written for a double."""
    return mpf(repr(x))


def straight(turned, sign, l):
    """The wheel's angle by the input's, behind a crank that turns by ``turned``."""

    def angle(a):
        f = turned(a)
        return mpmath.atan2(l * mpmath.sin(f), 1 - sign * l * mpmath.cos(f))

    return angle


def crank(rng, sign):
    z = rng.randint(3, 40)
    wheel = External(z) if sign > 0 else Internal(z)
    return Design(wheel), straight(lambda a: a, sign, mpmath.sin(mpmath.pi / z))


def side_crank(rng, sign):
    z, A = rng.randint(3, 12), round(rng.uniform(-0.7, 0.7), 3)
    wheel = External(z) if sign > 0 else Internal(z)
    offset = decimal(A)
    return Design(wheel, SideCrank(A=A)), straight(
        lambda a: mpmath.atan2(mpmath.sin(a), mpmath.cos(a) + offset),
        sign,
        mpmath.sin(mpmath.pi / z),
    )


def elliptical(rng):
    z, e = rng.randint(3, 12), round(rng.uniform(0.01, 0.45), 3)
    phase = rng.choice(("slow", "quick"))
    signed = decimal(e) if phase == "slow" else -decimal(e)
    ratio = (1 - signed) / (1 + signed)
    return Design(External(z), EllipticalGears(eccentricity=e, phase=phase)), straight(
        lambda a: 2 * mpmath.atan2(ratio * mpmath.sin(a / 2), mpmath.cos(a / 2)),
        1,
        mpmath.sin(mpmath.pi / z),
    )


def offset(rng):
    z, L = rng.randint(3, 12), round(rng.uniform(60, 200), 1)
    b = mpmath.pi / z
    e_mm = round(float(rng.uniform(0.05, 0.6) * L * mpmath.cos(b) ** 2), 2)
    e = decimal(e_mm) / decimal(L)
    l = mpmath.sin(b) * mpmath.cos(mpmath.asin(e / mpmath.cos(b)))

    def angle(a):
        x, y = 1 - l * mpmath.cos(a), l * mpmath.sin(a)
        return mpmath.atan2(y, x) + mpmath.asin(e / mpmath.hypot(x, y))

    return Design(External(z, offset_mm=e_mm), size=Size(center_distance_mm=L)), angle


def spherical(rng):
    z, axes_deg = rng.randint(3, 16), round(rng.uniform(40, 140), 1)
    S = mpmath.radians(decimal(axes_deg))
    th = mpmath.asin(mpmath.sin(S) * mpmath.sin(mpmath.pi / z))

    def angle(a):
        x = mpmath.sin(S) * mpmath.cos(th) - mpmath.cos(S) * mpmath.sin(th) * mpmath.cos(a)
        return mpmath.atan2(mpmath.sin(th) * mpmath.sin(a), x)

    return Design(Spherical(z, axes_deg=axes_deg)), angle


ROUNDED = 1e-12  # of a peak: what the rounding of a spec's numbers may change
DECIMALS = {
    "external": lambda rng: crank(rng, 1),
    "internal": lambda rng: crank(rng, -1),
    "side-crank": lambda rng: side_crank(rng, 1),
    "side-crank, internal": lambda rng: side_crank(rng, -1),
    "elliptical gears": elliptical,
    "offset": offset,
    "spherical": spherical,
}


def true_peak(angle, order, at_deg, entry_deg):
    """A derivative at the zero of the next one, or at the end of the motion, of zero speed."""
    with mpmath.workdps(2 * DIGITS):  # differences lose half of the digits
        at, zero_of = mpmath.radians(mpf(at_deg)), order + 1
        if abs(at_deg - entry_deg) < 1e-6:
            zero_of = 1
        if at_deg or zero_of == 1:
            slope = lambda a: mpmath.diff(angle, a, zero_of)  # noqa: E731
            at = mpmath.findroot(slope, at, tol=mpf(10) ** (-DIGITS))
        return abs(mpmath.diff(angle, at, order))


@pytest.mark.sampled(9)
@pytest.mark.parametrize("kind", DECIMALS)
def test_no_true_peak_is_excluded(kind):
    """Machines by their decimals, whose angle has a closed form of its own here."""
    rng = random.Random(f"decimals {kind}")
    for _ in range(some(400, 2)):
        with mpmath.workdps(2 * DIGITS):
            machine, angle = DECIMALS[kind](rng)
        mechanism = machine.mechanism
        entries = [one.mid_deg + one.entry_deg for one in mechanism.engagements]
        mids = [one.mid_deg for one in mechanism.engagements]
        for order, quantity in enumerate(QUANTITIES, 1):
            proof = machine.certificate(quantity)
            mid = min(mids, key=lambda x, at=proof.at_deg: abs(at - x))
            with mpmath.workdps(2 * DIGITS):
                entry = min(entries, key=lambda x, m=mid: abs(x - m)) - mid
                exact = true_peak(angle, order, proof.at_deg - mid, entry)
            # the proof is about doubles, which are rounded
            below, above = proof.low * (1 - ROUNDED), proof.high * (1 + ROUNDED)
            assert below <= exact <= above, f"{machine.spec}: {quantity} {exact}"
            assert proof.high - proof.low <= 1e-10 * proof.high


def scca(b, d, v=0):
    """Velocity, acceleration and jerk of the sine-constant-cosine family, after Norton."""
    pi, c = mpmath.pi, 1 - b - d
    Ca = 4 * pi**2 / ((pi**2 - 8) * (b**2 - d**2) - 2 * pi * (pi - 2) * b + pi**2)
    Cv = Ca * ((b + d) / pi + c / 2)
    Cj = Ca * pi / min(x for x in (b, d) if x) if b or d else mpf(0)
    top = Cv / (1 - v + v * Cv)  # of a middle at constant velocity, which takes v of the time
    share = top / Cv
    return top, Ca * share / (1 - v), Cj * share / (1 - v) ** 2


def tilted(shape):
    """Krasniqi's sine group: the greatest sizes of its velocity's derivatives, on a grid first."""

    def velocity(u):
        s, c = mpmath.sin(mpmath.pi * u), mpmath.cos(mpmath.pi * u)
        return mpf(8) / 3 * s**4 * (1 - 8 * shape * c)

    for order in range(3):
        size = lambda u, n=order: abs(mpmath.diff(velocity, u, n))  # noqa: E731
        with mpmath.workdps(15):
            best = max((mpf(k) / 200 for k in range(1, 200)), key=size)
        slope = lambda u, n=order: mpmath.diff(velocity, u, n + 1)  # noqa: E731
        at = mpmath.findroot(slope, (best, best + mpf(1) / 1000), tol=mpf(10) ** -DIGITS)
        yield size(at)


def closed(*sizes):
    """The sizes of a law without parameters."""
    return lambda rng, law: (law(), [size() for size in sizes])


LAWS = {
    Harmonic: closed(lambda: mpmath.pi / 2, lambda: mpmath.pi**2 / 2, lambda: mpmath.pi**3 / 2),
    Cycloidal: closed(lambda: mpf(2), lambda: 2 * mpmath.pi, lambda: 4 * mpmath.pi**2),
    Polynomial345: closed(lambda: mpf(15) / 8, lambda: 10 / mpmath.sqrt(3), lambda: mpf(60)),
    Polynomial4567: closed(
        lambda: mpf(35) / 16, lambda: 84 * mpmath.sqrt(5) / 25, lambda: mpf(105) / 2
    ),
    ModifiedSine: lambda rng, law: (law(), scca(mpf(1) / 4, mpf(3) / 4)),
    ModifiedTrapezoid: lambda rng, law: (law(), scca(mpf(1) / 4, mpf(1) / 4)),
    ModifiedConstantVelocity: lambda rng, law: (law(), scca(mpf(1) / 4, mpf(3) / 4, mpf(1) / 2)),
    SineGroup: lambda rng, law: _sine_group(law, rng.uniform(-0.12, 0.12)),
    SineConstantCosine: lambda rng, law: _scca(law, rng.uniform(0.1, 0.4), rng.uniform(0.1, 0.4)),
}


def _sine_group(law, shape):
    return law(shape), [*tilted(mpf(shape))]


def _scca(law, b, d):
    return law(b=b, c=1.0 - b - d, d=d), None


def confirm(machine, sizes):
    """A law's greatest sizes are within the bounds, with the motion's ends and step as doubles."""
    (one,) = machine.mechanism.engagements
    with mpmath.workdps(DIGITS):
        whole = mpmath.radians(mpf(one.exit_deg) - mpf(one.entry_deg))
        for order, quantity in enumerate(QUANTITIES, 1):
            proof = machine.certificate(quantity)
            exact = 2 * mpf(one.half_step) * sizes[order - 1] / whole**order
            assert proof.low <= exact <= proof.high, f"{machine.spec}: {quantity} {exact}"
            assert math.isclose(proof.low, proof.high, rel_tol=1e-13)


@pytest.mark.sampled(16)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("drive", some((Crank, Cam), (Crank,)))
def test_no_true_peak_of_a_law_is_excluded(law, drive):
    """The law's greatest sizes in closed form."""
    rng = random.Random(f"{law.NAME} {drive.NAME}")
    for _ in range(some(400, 2)):
        with mpmath.workdps(DIGITS):
            shape, sizes = LAWS[law](rng, law)
            if sizes is None:  # its fractions are numbers of the program, of exactly the whole
                sizes = scca(*map(mpf, shape.FRACTIONS[:2]))
        alpha0_deg = round(rng.uniform(-40.0, 20.0), 2)
        motion = Motion(shape, alpha0_deg=alpha0_deg)
        confirm(Design(External(rng.randint(5, 16)), drive(), motion), sizes)


def test_a_motion_whose_length_rounds():
    """Its ends are 130.41 degrees apart as a double, and 7e-15 more in fact."""
    with mpmath.workdps(DIGITS):
        law, sizes = _sine_group(SineGroup, -0.02590759796338575)
    confirm(Design(External(6), Cam(), Motion(law, alpha0_deg=-10.41)), sizes)
