"""Wheels on a carrier: motion from the ground at 50 digits, loads by Newton's law for points."""

import math
from typing import NamedTuple

import mpmath
import numpy as np
import pytest
from mpmath import mp

from geneva_cli import (
    Carousel,
    Design,
    External,
    GenevaError,
    Internal,
    Load,
    Mass,
    Product,
    Size,
    Support,
)
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.verdict.quantities.groups import GROUPS

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


@pytest.mark.sampled(8)
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


POINTS = 3  # point masses on the wheel: the fewest whose inertia has no direction
HELD = 0.3  # metres, from the wheel's pivot


def force_on(k, witness, c, L):
    """The acceleration of the k-th point from the ground, over w², and its place."""

    def place(c):
        return L * mp.expj(c) + HELD * mp.expj(witness.slot(c) + mp.mpf(2 * k) * mp.pi / POINTS + 1)

    return mpmath.diff(place, c, 2), place(c)


def by_newton(witness, c_deg, mass, L, w):
    """Pin force and torque on the carrier of a wheel of point masses, without friction.

    Every point's acceleration from the ground is the second difference of its place. The moments of
    all mass times acceleration about the pivot are those of the pin's force, across the slot;
    about the fixed axis they are those of the carrier's torque and of that force.
    """

    def cross(a, b):
        return (mp.conj(a) * b).imag

    c, pin = mp.radians(mp.mpf(c_deg)), L * witness.finger
    pivot = L * mp.expj(c)
    across = 1j * (pin - pivot) / abs(pin - pivot)
    about_pivot = about_axis = mp.mpf(0)
    for k in range(POINTS):
        acceleration, at = force_on(k, witness, c, L)
        force = mass * w * w * acceleration
        about_pivot += cross(at - pivot, force)
        about_axis += cross(at, force)
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
        force, torque = by_newton(witness, c_deg, mass, L_mm / 1000, mp.mpf(n) * mp.pi / 30)
    force_N, torque_Nm = design.cycle.states(np.array([c_deg]), ["pin_force_N", "input_torque_Nm"])
    assert abs(force_N[0]) == pytest.approx(abs(float(force)), rel=1e-11)
    assert torque_Nm[0] == pytest.approx(float(torque), rel=1e-11)


SEVERAL = [(3, 2), (3, 5), (4, 3), (5, 3), (8, 2)]  # slots, wheels


@pytest.mark.long
@pytest.mark.parametrize(("z", "wheels"), SEVERAL)
def test_loads_of_several_wheels_are_the_sum_over_a_turn(z, wheels):
    """The torques of all wheels, each behind the one before it, over a whole turn."""
    loaded = Load(inertia_kgm2=0.02, torque_Nm=0.1, efficiency=0.9)
    one, several = (Design(External(z), Carousel(wheels=n), load=loaded) for n in (1, wheels))
    (engagement,) = one.mechanism.engagements
    half = engagement.exit_deg
    # a grid that holds every entry and exit of all wheels would not be even: midpoints err by h²
    x = (np.arange(360_000) + 0.5) * 1e-3 - half
    total = np.zeros(len(x))
    for k in range(wheels):
        own = (x - 360.0 * k / wheels + half) % 360.0 - half
        order = np.argsort(own)
        torque = np.empty(len(x))
        torque[order] = one.cycle.states(own[order], ["input_torque_Nm"])[0]
        total += torque
    # a wheel's own bearings see one motion in a turn, the finger's see those of all wheels
    for key, times in (("wheel_bearing_N", 1), ("crank_bearing_N", wheels)):
        assert several.loads[key].mean == pytest.approx(times * one.loads[key].mean, rel=1e-12)
        rms = math.sqrt(times) * one.loads[key].rms
        assert several.loads[key].rms == pytest.approx(rms, rel=1e-12)
    summary = several.loads["input_torque_Nm"]
    peak = abs(total).max()
    assert summary.max == pytest.approx(total.max(), rel=1e-6)
    assert summary.mean == pytest.approx(total.mean(), abs=1e-6 * peak)
    assert summary.rms == pytest.approx(math.sqrt((total**2).mean()), rel=1e-6)
    work = np.cumsum(total - total.mean()) * math.radians(1e-3)
    swing = max(0.0, work.max()) - min(0.0, work.min())
    values = several.loads_table.to_dict()
    assert values["sizing.energy_fluctuation_J"] == pytest.approx(swing, rel=1e-5)


def values_of(design):
    return {
        name: value
        for group in GROUPS
        if group.table == "carousel."
        for name, value in group.values(design.parts).items()
    }


def test_quantities_by_hand():
    """An external wheel of four makes a quarter turn: its speed is 1/(sqrt(2) - 1) at most."""
    values = values_of(Design(External(4), Carousel(wheels=3)))
    assert values["carousel.turn_deg"] == pytest.approx(450.0, rel=1e-15)
    assert values["carousel.velocity"] == pytest.approx(2.0 + math.sqrt(2.0), rel=1e-15)
    assert values["carousel.moving_fraction"] == pytest.approx(0.75, rel=1e-15)
    assert values["carousel.behind_deg"] == 120.0
    inside = values_of(Design(Internal(6), Carousel()))
    assert inside["carousel.turn_deg"] == pytest.approx(300.0, rel=1e-15)
    assert inside["carousel.velocity"] == pytest.approx(2.0 / 3.0, rel=1e-15)
    assert inside["carousel.behind_deg"] is None
    two = values_of(Design(External(6), Carousel(rollers=2)))
    assert two["carousel.turn_deg"] == pytest.approx(480.0, rel=1e-15)
    assert two["carousel.moving_fraction"] == pytest.approx(2.0 / 3.0, rel=1e-15)
    assert set(values_of(Design(External(6))).values()) == {None}


def test_centrifugal_force_by_newton_s_law():
    """The sum of mass times acceleration of balanced points, with the wheel at rest or moving."""
    wheel, mass, n, L = External(5), 0.7, 120.0, 0.25
    bodies = Mass("point", mass_kg=mass, count=POINTS, radius_mm=1000.0 * HELD)
    size = Size(center_distance_mm=1000.0 * L)
    values = values_of(Design(wheel, Carousel(n_rpm=n), mass=(bodies,), size=size))
    witness = witness_of(wheel)
    with mp.workdps(50):
        w, c = mp.mpf(n) * mp.pi / 30, mp.radians(20)
        total = mass * w * w * sum(force_on(k, witness, c, L)[0] for k in range(POINTS))
    assert values["carousel.centrifugal_N"] == pytest.approx(float(abs(total)), rel=1e-13)
    assert values_of(Design(wheel, Carousel()))["carousel.centrifugal_N"] is None


@pytest.mark.parametrize(("z", "most"), [(3, 5), (4, 3), (5, 3), (6, 2), (8, 2), (24, 2)])
def test_only_one_wheel_moves_at_a_time(z, most):
    """Wheels that would move together would also meet: 2 L sin(180°/n) against 2 L cos b."""
    build(Spec(External(z), Carousel(wheels=most)))
    with pytest.raises(GenevaError, match=f"at most {most}$"):
        build(Spec(External(z), Carousel(wheels=most + 1)))
    assert math.sin(math.pi / most) > math.cos(math.pi / z)
    # equal for the wheel of four and that of six, whose rims would touch
    assert math.sin(math.pi / (most + 1)) <= math.cos(math.pi / z) * (1.0 + 1e-15)


@pytest.mark.parametrize(
    ("tables", "text"),
    [
        ({"product": Product(sprocket_teeth=20, pitch_mm=5.0)}, "at a fixed place"),
        ({"support": Support(gear_ratio=2.0)}, "at a fixed place"),
        ({"drive": Carousel(wheels=2, rollers=2)}, "one finger"),
        ({"wheel": Internal(6), "drive": Carousel(wheels=2)}, "surrounds"),
    ],
)
def test_what_is_refused(tables, text):
    tables = {"wheel": External(6), "drive": Carousel(), **tables}
    with pytest.raises(GenevaError, match=text):
        build(Spec(**tables))


@pytest.mark.long
def test_neighbours_by_their_places():
    """Gap and envelope from the places of pivots, and of a block's corners at all angles."""
    L, wheels, z = 100.0, 3, 4
    for mass, reach in (
        ((), math.hypot(L * math.cos(math.pi / z), 5.0)),  # a rim that the roller just enters
        ((Mass("block", mass_kg=1.0, length_mm=60.0, width_mm=80.0),), None),
        ((Mass("disc", mass_kg=1.0, diameter_mm=40.0, radius_mm=70.0, count=2),), 90.0),
    ):
        design = Design(External(z), Carousel(wheels=wheels), mass=mass)
        reach = reach or max(abs(complex(30.0, 40.0)), math.hypot(L * math.cos(math.pi / z), 5.0))
        pivots = [L * np.exp(2j * math.pi * k / wheels) for k in range(wheels)]
        gap = min(abs(a - b) for i, a in enumerate(pivots) for b in pivots[:i]) - 2.0 * reach
        (check,) = (c for c in design.checks if c.name == "wheels_apart_mm")
        assert check.value == pytest.approx(gap, rel=1e-13)
        assert check.passes == (gap >= 0.0)
        assert values_of(design)["carousel.envelope_mm"] == pytest.approx(L + reach, rel=1e-14)


@pytest.mark.long
def test_a_report_lists_when_each_wheel_moves():
    design = Design(External(4), Carousel(wheels=3, n_rpm=1.0))
    table = design.report.table.to_dict()["wheels"]
    assert table == [
        {"wheel": 1, "behind_deg": 0.0, "entry_deg": -45.0, "exit_deg": 45.0, "entry_s": 0.0},
        {"wheel": 2, "behind_deg": 120.0, "entry_deg": 75.0, "exit_deg": 165.0, "entry_s": 20.0},
        {"wheel": 3, "behind_deg": 240.0, "entry_deg": 195.0, "exit_deg": 285.0, "entry_s": 40.0},
    ]
