"""Wheels on a carrier with a body off their axis: loads by Lagrange's equations at 50 digits.

The witness: the body's place from the ground as a complex number of two coordinates, the carrier's
angle and the wheel's. Its kinetic energy is differentiated numerically by both, and by time.
"""

import math

import mpmath
import numpy as np
import pytest
from mpmath import mp

from geneva_cli import Carousel, Design, External, GenevaError, Internal, Load, Mass, Motion
from geneva_cli.loads.highest_speed import fastest_rpm
from geneva_cli.loads.sizing import sizing
from geneva_cli.loads.strength.lock import held_torque_Nm
from geneva_cli.motion.laws.standard import Cycloidal
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Size
from geneva_cli.verdict.quantities.groups import GROUPS


def values_of(design):
    (group,) = [one for one in GROUPS if one.table == "carousel" and "held_Nm" in one.own]
    return {
        f"carousel.{name}": value
        for name, value in zip(group.own, group.values(design.parts).values(), strict=True)
    }


WHEELS = [External(3), External(5), External(8), Internal(3), Internal(6)]
every = pytest.mark.parametrize("wheel", WHEELS, ids=lambda w: f"{w.NAME}-{w.z}")
MASS, L, N, OFF, ANGLE = 0.7, 0.25, 90.0, 0.12, 40.0  # kg, m, rpm, m, degrees


def design_of(wheel, load=None, off=OFF, angle=ANGLE, **drive):
    bodies = (Mass("point", mass_kg=MASS, radius_mm=1000.0 * off, angle_deg=angle),)
    size = Size(center_distance_mm=1000.0 * L)
    return Design(wheel, Carousel(n_rpm=N, **drive), mass=bodies, size=size, load=load)


def wheel_angle(wheel, c):
    """The wheel's own angle at the carrier's angle c: that of the line from its axis to the finger.

    The finger is l from the carrier's axis, in units of L, before the wheel's or behind it.
    """
    l = mp.sin(mp.pi / wheel.z)
    if wheel.SIGN > 0:
        return mp.atan2(l * mp.sin(c), 1 - l * mp.cos(c))
    return mp.atan2(l * mp.sin(c), 1 + l * mp.cos(c))


def by_lagrange(wheel, c_deg, step):
    """Torques on the wheel and on the carrier, N m, in the motion after so many steps.

    The slot points at the carrier's axis at mid-motion; an internal wheel turns against the
    carrier. With the generalized torques Qc and Qp the carrier needs Qc + psi' Qp, as the finger,
    which stands still, does no work.
    """
    s, w = wheel.SIGN, mp.mpf(N) * mp.pi / 30
    turned = 2 * mp.pi * step / wheel.z
    phase = mp.radians(ANGLE)

    def place(c, psi):
        return L * mp.expj(c) - OFF * mp.expj(c + s * (psi + phase))

    def energy(c, psi, dc, dpsi):
        # the velocity by the chain rule, whose derivatives are numerical
        by_c = mpmath.diff(lambda x: place(x, psi), c)
        by_psi = mpmath.diff(lambda x: place(c, x), psi)
        return MASS / 2 * abs(by_c * dc + by_psi * dpsi) ** 2

    def state(t):
        c = w * t
        rate = mpmath.diff(lambda x: wheel_angle(wheel, x), c)
        return [c, wheel_angle(wheel, c) + turned, w, w * rate]

    def generalized(k, t):
        def momentum(x):
            own = state(x)
            return mpmath.diff(lambda v: energy(*[*own[: k + 2], v, *own[k + 3 :]]), own[k + 2])

        own = state(t)
        slope = mpmath.diff(lambda q: energy(*[*own[:k], q, *own[k + 1 :]]), own[k])
        return mpmath.diff(momentum, t) - slope

    t = mp.radians(mp.mpf(c_deg)) / w
    of_carrier, of_wheel = generalized(0, t), generalized(1, t)
    return of_wheel, of_carrier + of_wheel * state(t)[3] / w


@pytest.mark.sampled(9)
@every
@pytest.mark.parametrize("fraction", [-0.8, -0.2, 0.4, 0.95])
def test_torques_by_lagrange(wheel, fraction):
    design = design_of(wheel)
    c_deg = fraction * design.mechanism.engagements[0].exit_deg
    for step in range(3):
        with mp.workdps(50):
            of_wheel, of_carrier = by_lagrange(wheel, c_deg, step)
        here = design.cycle.states(np.array([c_deg + 360.0 * step]))
        assert here.wheel_torque_Nm[0] == pytest.approx(float(of_wheel), rel=1e-11), step
        assert here.input_torque_Nm[0] == pytest.approx(float(of_carrier), rel=1e-11), step


def dense(design, count=200_001):
    """The closed forms of both torques over all motions of a wheel, and of the input's angle."""
    wheel, w = design.spec.wheel, N * math.pi / 30.0
    (one,) = design.mechanism.engagements
    half = math.radians(one.exit_deg)
    a = np.linspace(-half, half, count)
    s, l = wheel.SIGN, math.sin(math.pi / wheel.z)
    D = 1.0 - 2.0 * s * l * np.cos(a) + l * l
    psi = np.arctan2(l * np.sin(a), 1.0 - s * l * np.cos(a))
    V = l * (np.cos(a) - s * l) / D
    A = -l * (1.0 - l * l) * np.sin(a) / D**2
    J, U = MASS * OFF**2, MASS * OFF * L
    for k in range(wheel.z):
        x = psi + math.radians(ANGLE) + 2.0 * math.pi * k / wheel.z
        own = w * w * (J * A - U * np.sin(x))
        extra = w * w * (s * J * A - s * U * A * np.cos(x) + U * V * (2.0 + s * V) * np.sin(x))
        yield a, own, V * own + extra


@pytest.mark.long
@every
def test_extremes_and_means_over_a_turn_of_the_wheel(wheel):
    design = design_of(wheel)
    period = 2.0 * math.pi * wheel.z
    own, shaft, square, mean = [], [], 0.0, 0.0
    for a, torque, total in dense(design):
        own.append(torque)
        shaft.append(total)
        square += np.trapezoid(total**2, a)
        mean += np.trapezoid(total, a)
    own, shaft = np.concatenate(own), np.concatenate(shaft)
    loads = design.cycle.extremes  # with signs
    for name, values in (("wheel_torque_Nm", own), ("input_torque_Nm", shaft)):
        assert loads[name].max == pytest.approx(values.max(), rel=1e-8)  # of the scan's spacing
        assert loads[name].min == pytest.approx(values.min(), rel=1e-8)
        # the place names the turn too
        k, i = divmod(int(np.argmax(values)), len(a))
        at = loads[name].max_at_deg
        assert at == pytest.approx(360.0 * k + math.degrees(a[i]), abs=0.01)
    assert loads["input_torque_Nm"].rms == pytest.approx(math.sqrt(square / period), rel=1e-8)
    # all that is put in comes back in a turn
    assert mean == pytest.approx(0.0, abs=1e-8 * abs(shaft).max())
    assert loads["input_torque_Nm"].mean == pytest.approx(0.0, abs=1e-10 * abs(shaft).max())
    work = np.concatenate(
        [
            np.append(0.0, np.cumsum(0.5 * (t[1:] + t[:-1]) * np.diff(a)))
            for a, _, t in dense(design)
        ]
    )
    starts = np.repeat(np.cumsum([0.0, *[w[-1] for w in np.split(work, wheel.z)][:-1]]), len(a))
    swing = np.ptp(work + starts)
    assert sizing(design.cycle)[0]["energy_fluctuation_J"] == pytest.approx(swing, rel=1e-7)


@every
def test_the_lock_and_the_pivot_in_the_dwells(wheel):
    """The body's place at rest after each step, and its acceleration towards the carrier's axis."""
    design, w = design_of(wheel), N * math.pi / 30.0
    moments, forces = [], []
    for k in range(wheel.z):
        x = math.radians(ANGLE) + 2.0 * math.pi * (k + 0.5) / wheel.z
        from_pivot = -OFF * np.exp(1j * wheel.SIGN * x)
        force = MASS * w * w * (L + from_pivot)
        moments.append(abs((np.conj(from_pivot) * force).imag))
        forces.append(abs(force))
    values = values_of(design)
    assert values["carousel.held_Nm"] == pytest.approx(max(moments), rel=1e-13)
    assert values["carousel.centrifugal_N"] == pytest.approx(max(forces), rel=1e-13)
    assert held_torque_Nm(design.mechanism) == pytest.approx(max(moments), rel=1e-13)


def test_the_fastest_speed_reaches_the_limit():
    """At it the pin force is the limit: inertia and unbalance grow with the square of the speed."""
    spec = design_of(External(5)).spec.with_("limits.pin_force_max_N", 40.0)
    n = fastest_rpm(build(spec))
    at = Design.of(spec.with_("drive.n_rpm", n)).loads["pin_force_N"]
    assert max(at.max, -at.min) == pytest.approx(40.0, rel=1e-9)


def test_a_balanced_pair_has_the_loads_of_its_inertia():
    """Two bodies on opposite sides, set one by one, are as two evenly spaced ones."""
    apart = [
        Mass("point", mass_kg=MASS, radius_mm=120.0, angle_deg=angle) for angle in (30.0, 210.0)
    ]
    even = Mass("point", mass_kg=MASS, radius_mm=120.0, count=2)
    one, other = (
        Design(External(5), Carousel(), mass=mass).loads for mass in (tuple(apart), (even,))
    )
    for name in ("input_torque_Nm", "wheel_torque_Nm", "pin_force_N"):
        assert one[name].max == pytest.approx(other[name].max, rel=1e-12)
        assert one[name].rms == pytest.approx(other[name].rms, rel=1e-10)


@pytest.mark.long
@pytest.mark.parametrize("z", [4, 5, 6])
@pytest.mark.parametrize("apart", [None, (0.0, 150.0)])
def test_two_fingers_meet_the_body_in_all_its_directions(z, apart):
    """Each step has the torques of one finger, however the two stand; a turn has twice as many."""
    one = design_of(External(z)).loads["input_torque_Nm"]
    both = design_of(External(z), rollers=2, roller_angles_deg=apart)
    loads = both.loads["input_torque_Nm"]
    assert (loads.max, loads.min) == pytest.approx((one.max, one.min), rel=1e-12)
    assert loads.rms == pytest.approx(math.sqrt(2.0) * one.rms, rel=1e-10)
    # finger and direction come together again after lcm(z, 2) motions, two in a turn
    assert both.mechanism.under_load.period_deg == pytest.approx(180.0 * math.lcm(z, 2))


@pytest.mark.long
@every
def test_friction_by_the_forces_on_the_slot(wheel):
    """A finger presses with F on the wall that drives, and drags it with mu F where it slides.

    The finger is p from the wheel's axis, and the wall r from the middle of the slot. So F turns
    the wheel by d F (p - mu s r). The finger stands still on the ground, and its side slides by
    p' + (psi' + 1) d r, or psi' - 1 inside. The input adds the power of friction.
    """
    mu, r, l, s = 0.2, 0.05, math.sin(math.pi / wheel.z), wheel.SIGN  # lengths over L
    design = design_of(wheel, Load(friction=mu))
    force, shaft = [], []
    for a, torque, total in dense(design):
        D = 1.0 - 2.0 * s * l * np.cos(a) + l * l
        out, spin = s * l * np.sin(a) / np.sqrt(D), s + l * (np.cos(a) - s * l) / D
        d = np.sign(torque)
        slide = out + spin * d * r
        F = abs(torque) / (np.sqrt(D) - mu * np.sign(slide) * r)  # times L
        force.append(d * F / L)  # signed as the torque
        shaft.append(total + mu * F * abs(slide))
    for name, values in (("pin_force_N", force), ("input_torque_Nm", shaft)):
        values = np.concatenate(values)
        # a load jumps where friction changes its sign: there the scan's spacing, 5e-6 to 1e-5 rad,
        # counts in full, and a load changes by up to ten times itself a radian
        assert design.loads[name].max == pytest.approx(abs(values).max(), rel=1e-4)
        least = abs(values).min() if name == "pin_force_N" else values.min()
        assert design.loads[name].min == pytest.approx(least, abs=1e-4 * abs(values).max())


def test_what_needs_a_balanced_wheel_is_refused():
    single = (Mass("point", mass_kg=1.0, radius_mm=50.0, angle_deg=20.0),)
    with pytest.raises(GenevaError, match="with a law needs balanced wheels"):
        build(Spec(External(6), Carousel(), Motion(Cycloidal()), mass=single))
    on_ground = [one.name for one in Design(External(6), mass=single).warnings]
    assert "nothing-to-act-on" in on_ground
