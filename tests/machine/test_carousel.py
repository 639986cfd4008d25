"""Wheels on a carrier: motion from the ground at 50 digits, loads by Newton's law for points."""

import math
from typing import NamedTuple

import mpmath
import numpy as np
import pytest
from mpmath import mp

from geneva_cli import (
    Carousel,
    Crank,
    Design,
    External,
    GenevaError,
    Internal,
    Load,
    Mass,
    Motor,
    Product,
    Size,
    Spherical,
    Support,
)
from geneva_cli.loads.loads import kinetic_power_W
from geneva_cli.loads.sizing import sizing
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec

WHEELS = [External(3), External(4), External(6), External(12), Internal(3), Internal(6)]
every = pytest.mark.parametrize("wheel", WHEELS, ids=lambda w: f"{w.NAME}-{w.z}")


class Witness(NamedTuple):
    """A wheel on a carrier, its pivot at e^(i c) and the finger at rest, as complex numbers.

    The finger stands where it is in the middle of a slot with the carrier at 0: on the line from
    the fixed axis to the wheel's, or beyond it for an internal wheel.
    """

    z: int
    inside: bool

    @property
    def finger(self):
        """The finger's place; the slot is tangent to the path at entry, so |finger| is sin b."""
        return mp.sin(mp.pi / self.z) * (-1 if self.inside else 1)

    def slot(self, c):
        """Direction from the ground of the slot that holds the finger, positive with the carrier.

        At c = 0 the slot points at the finger, along -1; that is angle 0.
        """
        pivot = mp.expj(c)
        return mp.arg(-(self.finger - pivot) / pivot) + c

    def half_deg(self):
        """Half the motion: where the way to the finger is tangent to the finger's circle."""
        return 90.0 + (1 if self.inside else -1) * 180.0 / self.z


def witness_of(wheel):
    return Witness(wheel.z, wheel.SIGN < 0)


@every
@pytest.mark.parametrize("turns", [None, 3])
def test_absolute_motion_at_50_digits(wheel, turns):
    """Angle to 1e-12 degrees of a turn, its rates to 1e-12 of their peaks."""
    table = Design(wheel, Carousel()).motion(73, turns).to_dict()
    witness = witness_of(wheel)
    step = wheel.SIGN * 360.0 / wheel.z
    half = witness.half_deg()
    moving = 0
    with mp.workdps(50):
        for c, angle, speed, acceleration in zip(
            table["input_deg"],
            table["absolute_deg"],
            table["absolute_velocity"],
            table["absolute_acceleration"],
            strict=True,
        ):
            turn = round(c / 360.0)
            here = c - 360.0 * turn
            if abs(here) < half * (1.0 - 1e-9):
                moving += 1
                at = mp.radians(mp.mpf(here))
                expected = [mpmath.diff(witness.slot, at, k) for k in range(3)]
                expected[0] = mp.degrees(expected[0]) + turn * (360.0 + step)
            elif abs(here) > half * (1.0 + 1e-9):
                side = math.copysign(0.5, here)
                expected = [c + turn * step + side * step, 1.0, 0.0]
            else:
                continue  # the entry's own row: its acceleration jumps
            assert angle == pytest.approx(float(expected[0]), rel=1e-14, abs=1e-12)
            assert speed == pytest.approx(float(expected[1]), rel=1e-12, abs=1e-12)
            # a steep wheel of three slots peaks at 31
            assert acceleration == pytest.approx(float(expected[2]), rel=1e-12, abs=4e-12)
    assert moving > 10


@every
def test_a_turn_of_the_carrier(wheel):
    """A step forward adds to the carrier's turn, one of an internal wheel takes from it."""
    table = Design(wheel, Carousel(rollers=1)).motion(361).to_dict()
    turned = table["absolute_deg"][-1] - table["absolute_deg"][0]
    assert turned == pytest.approx(360.0 + wheel.SIGN * 360.0 / wheel.z, abs=1e-12)


def test_without_a_carrier_no_absolute_columns():
    assert "absolute_deg" not in Design(External(6)).motion(9).to_dict()


POINTS = 3  # point masses on the wheel: the fewest whose inertia has no direction
HELD = 0.3  # metres, from the wheel's pivot


def by_newton(witness, wheel, c_deg, mass, L, w):
    """Pin force and torque on the carrier of a wheel of point masses, without friction.

    Every point's acceleration from the ground is the second difference of its place. The moments of
    all mass times acceleration about the pivot are those of the pin's force, across the slot;
    about the fixed axis they are those of the carrier's torque and of that force.
    """
    pin = L * witness.finger

    def place(k, c):
        return L * mp.expj(c) + HELD * mp.expj(witness.slot(c) + mp.mpf(2 * k) * mp.pi / POINTS + 1)

    def cross(a, b):
        return (mp.conj(a) * b).imag

    c = mp.radians(mp.mpf(c_deg))
    pivot = L * mp.expj(c)
    across = 1j * (pin - pivot) / abs(pin - pivot)
    about_pivot = about_axis = mp.mpf(0)
    for k in range(POINTS):
        force = mass * w * w * mpmath.diff(lambda x, k=k: place(k, x), c, 2)
        about_pivot += cross(place(k, c) - pivot, force)
        about_axis += cross(place(k, c), force)
    size = about_pivot / cross(pin - pivot, across)
    return size, about_axis - size * cross(pin, across)


@every
@pytest.mark.parametrize("fraction", [-0.95, -0.5, -0.1, 0.3, 0.9])
def test_loads_by_newton_s_law(wheel, fraction):
    """Without losses: pin force, and torque on the carrier with the frame's share."""
    witness, mass, L_mm, n = witness_of(wheel), 0.4, 250.0, 90.0
    bodies = Mass("point", mass_kg=mass, count=POINTS, radius_mm=1000.0 * HELD)
    size = Size(center_distance_mm=L_mm)
    design = Design(wheel, Carousel(n_rpm=n), mass=(bodies,), size=size)
    c_deg = fraction * witness.half_deg()
    with mp.workdps(50):
        force, torque = by_newton(witness, wheel, c_deg, mass, L_mm / 1000, mp.mpf(n) * mp.pi / 30)
    here = design.cycle.states(np.array([c_deg]))
    assert abs(here.pin_force_N[0]) == pytest.approx(abs(float(force)), rel=1e-11)
    assert here.input_torque_Nm[0] == pytest.approx(float(torque), rel=1e-11)


@every
def test_the_greatest_torque_and_the_mean_square(wheel):
    """Summaries of the whole cycle against a dense scan of closed forms."""
    I, n = 0.02, 60.0
    design = Design(wheel, Carousel(n_rpm=n), load=Load(inertia_kgm2=I))
    w = n * math.pi / 30.0
    half = math.radians(witness_of(wheel).half_deg())
    a = np.linspace(-half, half, 400_001)
    g, l = wheel.SIGN, math.sin(math.pi / wheel.z)
    D = 1.0 - 2.0 * g * l * np.cos(a) + l * l
    V = l * (np.cos(a) - g * l) / D
    A = -l * (1.0 - l * l) * np.sin(a) / D**2
    Q = I * w * w * A * (V + g)
    torque = design.loads["input_torque_Nm"]
    assert torque.max == pytest.approx(Q.max(), rel=1e-8)  # of the scan's spacing
    assert torque.min == pytest.approx(Q.min(), rel=1e-8)
    mean_square = np.trapezoid(Q * Q, a) / (2.0 * math.pi)
    assert torque.rms == pytest.approx(math.sqrt(mean_square), rel=1e-8)
    # the energy of the wheel from the ground, J/2 (1 +- psi')², must come and go
    energy = I * w * w / 2.0 * (1.0 + g * V) ** 2
    swing = sizing(design.cycle)[0]["energy_fluctuation_J"]
    assert swing == pytest.approx(energy.max() - energy.min(), rel=1e-8)
    assert kinetic_power_W(design.mechanism, 0.0) == pytest.approx(w * abs(Q).max(), rel=1e-8)


def test_resistance_acts_between_wheel_and_carrier():
    """A torque alone loads the input as on a plain crank."""
    load = Load(torque_Nm=3.0, friction=0.1, efficiency=0.8)
    orbit, plain = (Design(External(6), drive, load=load).loads for drive in (Carousel(), Crank()))
    for name in ("input_torque_Nm", "pin_force_N", "power_W"):
        assert orbit[name].max == plain[name].max, name
        assert orbit[name].rms == plain[name].rms, name


def test_losses_count_where_the_input_drives():
    """The sign of the whole torque decides, with the frame's share."""
    load = Load(inertia_kgm2=0.05, torque_Nm=0.2, friction=0.05)
    lossless = Design(External(6), Carousel(), load=load)
    lossy = Design(External(6), Carousel(), load=load.replace(efficiency=0.7))
    x = np.linspace(-59.9, 59.9, 400)
    Q = lossless.cycle.states(x).input_torque_Nm
    expected = np.where(Q > 0.0, Q / 0.7, Q)
    assert lossy.cycle.states(x).input_torque_Nm == pytest.approx(expected, rel=1e-12)


def test_the_makers_form_covers_the_exact_torque():
    for wheel in WHEELS:
        design = Design(wheel, Carousel(), load=Load(inertia_kgm2=0.05, torque_Nm=0.2))
        assert sizing(design.cycle)[0]["input_torque_ratio"] >= 1.0


def test_inertia_ratio_counts_from_the_ground():
    """At rest on the carrier the wheel has the carrier's speed."""
    motor = Motor(inertia_kgm2=0.02)
    for wheel, fastest in ((External(6), 2.0), (Internal(6), 1.0)):  # psi' is 1 and 1/3 at most
        load = Load(inertia_kgm2=0.01)
        values = sizing(Design(wheel, Carousel(), load=load, motor=motor).cycle)[0]
        assert values["inertia_ratio"] == pytest.approx(0.5 * fastest**2, rel=1e-13)


@pytest.mark.parametrize(
    ("tables", "text"),
    [
        ({"wheel": Spherical(6)}, "external or internal"),
        ({"mass": (Mass("point", mass_kg=1.0, radius_mm=50.0),)}, "balanced"),
        ({"product": Product(radius_mm=50.0)}, "on the ground"),
        ({"support": Support(gear_ratio=2.0)}, "on the ground"),
    ],
)
def test_what_is_refused(tables, text):
    tables = {"wheel": External(6), **tables}
    with pytest.raises(GenevaError, match=text):
        build(Spec(drive=Carousel(), **tables))
