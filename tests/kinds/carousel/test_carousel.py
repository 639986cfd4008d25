"""Wheels on a carrier: motion from the ground at 50 digits, loads by Newton's law for points."""

import math
from typing import NamedTuple

import mpmath
import numpy as np
import pytest
from drawing_witness import polygon
from mpmath import mp
from shapely import affinity

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
    Shaft,
    Size,
    Spherical,
    Support,
)
from geneva_cli.geometry.plates import plates
from geneva_cli.loads.highest_speed import kinetic_power_W
from geneva_cli.loads.product import product_motion
from geneva_cli.loads.sizing import sizing
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many
from geneva_cli.motion.mechanism import build
from geneva_cli.output.scene import place_at, value_at
from geneva_cli.study.animation.turning_scene import scene
from geneva_cli.verdict.quantities.groups import GROUPS
from geneva_cli.verdict.strength import strength

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


@every
def test_a_turn_of_the_carrier(wheel):
    """A step forward adds to the carrier's turn, one of an internal wheel takes from it."""
    table = Design(wheel, Carousel(rollers=1)).motion(361).to_dict()
    turned = table["absolute_deg"][-1] - table["absolute_deg"][0]
    assert turned == pytest.approx(360.0 + wheel.SIGN * 360.0 / wheel.z, abs=1e-12)


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


@pytest.mark.sampled(6)
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
    loaded = Load(torque_Nm=3.0, friction=0.1, efficiency=0.8)
    orbit, plain = (
        Design(External(6), drive, load=loaded).loads for drive in (Carousel(), Crank())
    )
    for name in ("input_torque_Nm", "pin_force_N", "power_W"):
        assert orbit[name].max == plain[name].max, name
        assert orbit[name].rms == plain[name].rms, name


def test_losses_count_where_the_input_drives():
    """The sign of the whole torque decides, with the frame's share."""
    loaded = Load(inertia_kgm2=0.05, torque_Nm=0.2, friction=0.05)
    lossless = Design(External(6), Carousel(), load=loaded)
    lossy = Design(External(6), Carousel(), load=loaded.replace(efficiency=0.7))
    x = np.linspace(-59.9, 59.9, 400)
    Q = lossless.cycle.states(x).input_torque_Nm
    expected = np.where(Q > 0.0, Q / 0.7, Q)
    assert lossy.cycle.states(x).input_torque_Nm == pytest.approx(expected, rel=1e-12)


def test_inertia_ratio_counts_from_the_ground():
    """At rest on the carrier the wheel has the carrier's speed."""
    motor = Motor(inertia_kgm2=0.02)
    for wheel, fastest in ((External(6), 2.0), (Internal(6), 1.0)):  # psi' is 1 and 1/3 at most
        loaded = Load(inertia_kgm2=0.01)
        values = sizing(Design(wheel, Carousel(), load=loaded, motor=motor).cycle)[0]
        assert values["inertia_ratio"] == pytest.approx(0.5 * fastest**2, rel=1e-13)


SEVERAL = [(3, 2), (3, 5), (4, 3), (5, 3), (8, 2)]  # slots, wheels


@pytest.mark.long
@pytest.mark.parametrize(("z", "wheels"), SEVERAL)
def test_loads_of_several_wheels_are_the_sum_over_a_turn(z, wheels):
    """The torques of all wheels, each behind the one before it, over a whole turn."""
    loaded, motor = (
        Load(inertia_kgm2=0.02, torque_Nm=0.1, efficiency=0.9),
        Motor(gear_efficiency=0.8),
    )
    one, several = (
        Design(External(z), Carousel(wheels=n), load=loaded, motor=motor) for n in (1, wheels)
    )
    (engagement,) = one.mechanism.engagements
    half = engagement.exit_deg
    # a grid that holds every entry and exit of all wheels would not be even: midpoints err by h²
    x = (np.arange(360_000) + 0.5) * 1e-3 - half
    total = np.zeros(len(x))
    for k in range(wheels):
        own = (x - 360.0 * k / wheels + half) % 360.0 - half
        order = np.argsort(own)
        torque = np.empty(len(x))
        torque[order] = one.cycle.states(own[order]).input_torque_Nm
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
    values = sizing(several.cycle)[0]
    swing = max(0.0, work.max()) - min(0.0, work.min())
    assert values["energy_fluctuation_J"] == pytest.approx(swing, rel=1e-5)
    shaft = np.where(total > 0.0, total / 0.8, total * 0.8)
    assert values["motor_torque_rms_Nm"] == pytest.approx(math.sqrt((shaft**2).mean()), rel=1e-6)


def values_of(design):
    return {
        f"{group.table}.{name}": value
        for group in GROUPS
        if group.table == "carousel"
        for name, value in zip(group.own, group.values(design.parts).values(), strict=True)
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
        total = sum(
            mass
            * w
            * w
            * mpmath.diff(
                lambda x, k=k: (
                    L * mp.expj(x)
                    + HELD * mp.expj(witness.slot(x) + mp.mpf(2 * k) * mp.pi / POINTS)
                ),
                c,
                2,
            )
            for k in range(POINTS)
        )
    assert values["carousel.centrifugal_N"] == pytest.approx(float(abs(total)), rel=1e-13)
    assert values_of(Design(wheel, Carousel()))["carousel.centrifugal_N"] is None


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "design",
    [
        Design(External(4), Carousel(wheels=3), load=Load(inertia_kgm2=0.1)),
        Design(External(6), Carousel(rollers=2)),
        Design(Internal(5), Carousel()),
    ],
    ids=["several", "two fingers", "inside"],
)
def test_the_page_turns_the_carrier_about_fingers_that_stand(design):
    """Seen from the ground: fingers at rest, pivots on their orbit, wheels as the witness turns."""
    shown, witness = scene(design), witness_of(design.spec.wheel)
    g, L = design.spec.wheel.SIGN, design.mechanism.center_distance_mm
    wheels = [body for body in shown.bodies if body.name.startswith("wheel")]
    (crank,) = (body for body in shown.bodies if body.name == "crank")
    pivot = complex(*shown.frame.centre)
    assert pivot == L
    behind, stands = 360.0 / len(wheels), None
    half = design.mechanism.engagements[0].exit_deg

    def ground(place, t):
        return pivot + (complex(*place) - pivot) * np.exp(1j * value_at(shown.frame.angle, t))

    for t in np.linspace(1.0, 359.0, 73):
        c = shown.start_deg + t
        fingers = [ground(place_at(place, t), t) for place in shown.rollers]
        here = [*fingers, value_at(crank.angle, t) + value_at(shown.frame.angle, t)]
        stands = here if stands is None else stands
        assert here == pytest.approx(stands, abs=1e-3)  # mm; a screen shows 2e-6 of L
        for k, body in enumerate(wheels):
            at = c - behind * k
            expected = pivot - L * np.exp(1j * g * math.radians(at))
            assert ground(body.centre, t) == pytest.approx(expected, abs=1e-9 * L)
            turn = value_at(body.angle, t) + value_at(shown.frame.angle, t)
            nearest = (at + 180.0 / len(fingers)) % (360.0 / len(fingers)) - 180.0 / len(fingers)
            if abs(nearest) < half:  # in motion: from the nearest finger's mid-motion on
                own = float(witness.slot(mp.radians(mp.mpf(nearest)))) - math.radians(nearest)
                slots = turn - g * math.radians(at) - g * own
                assert math.remainder(slots, math.tau / witness.z) == pytest.approx(0.0, abs=1e-6)
    for push in shown.pushes:  # at the finger's roller, whose radius is L/20
        for t, x, y in zip(push.at, push.x, push.y, strict=True):
            off = min(abs(ground((x, y), t) - ground(place_at(p, t), t)) for p in shown.rollers)
            assert off == pytest.approx(L / 20.0, rel=1e-3)
    assert len(shown.pushes) == (len(wheels) if design.spec.is_loaded else 0)
    assert sum(phase.moves for phase in shown.states) == len(wheels) * len(shown.rollers)


@pytest.mark.sampled(6)
@every
def test_what_a_product_feels_at_any_place_on_the_wheel(wheel):
    """Against second differences of places all round the wheel, over a turn of the carrier."""
    L, r, n = 0.1, 0.03, 40.0
    w = n * math.pi / 30.0
    orbit = Design(wheel, Carousel(n_rpm=n), product=Product(radius_mm=1000.0 * r))
    felt = product_motion(orbit.mechanism)
    half = witness_of(wheel).half_deg()
    a = np.radians(np.linspace(-half, half, 20_001))
    g, l = wheel.SIGN, math.sin(math.pi / wheel.z)
    D = 1.0 - 2.0 * g * l * np.cos(a) + l * l
    V, A = l * (np.cos(a) - g * l) / D, -l * (1.0 - l * l) * np.sin(a) / D**2
    speed = acceleration = 0.0
    for phase in np.linspace(0.0, math.tau, 721):
        # the place is L + r e^(i angle) in axes that turn with the carrier
        arm = r * np.exp(1j * phase)
        rate = 1.0 + g * V
        moves = w * abs(1j * L + 1j * rate * arm)
        jerks = w * w * abs(-L + (1j * g * A - rate**2) * arm)
        speed, acceleration = max(speed, moves.max()), max(acceleration, jerks.max())
    rest = w * (L + r), w * w * (L + r)
    # the grid of phases, half a degree apart, misses a cosine by 1e-5
    assert felt.speed_m_s.max[0] == pytest.approx(max(speed, rest[0]), rel=3e-5)
    assert felt.acceleration_m_s2.max[0] == pytest.approx(max(acceleration, rest[1]), rel=3e-5)
    assert felt.friction_needed[0] == pytest.approx(felt.acceleration_m_s2.max[0] / 9.80665)


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
        ({"wheel": Spherical(6)}, "external or internal"),
        ({"product": Product(sprocket_teeth=20, pitch_mm=5.0)}, "on the ground"),
        ({"support": Support(gear_ratio=2.0)}, "on the ground"),
        ({"drive": Carousel(wheels=2, rollers=2)}, "one finger"),
        ({"wheel": External(6, steps_deg=(70, 50)), "drive": Carousel(wheels=2)}, "one finger"),
        ({"wheel": Internal(6), "drive": Carousel(wheels=2)}, "surrounds"),
    ],
)
def test_what_is_refused(tables, text):
    tables = {"wheel": External(6), "drive": Carousel(), **tables}
    with pytest.raises(GenevaError, match=text):
        build(Spec(**tables))


@pytest.mark.long
def test_wheels_pass_each_other_and_the_disc():
    """Their polygons over a turn of the carrier, each turned as the witness says."""
    design = Design(External(4), Carousel(wheels=3))
    (wheel,) = plates(design.drawing("wheel").solid)
    (disc,) = (one for one in plates(design.drawing("crank").solid) if one.layer == "CRANK")
    own, lock = polygon(wheel.outline, 1e-3), polygon(disc.outline, 1e-3)
    L, witness = design.mechanism.center_distance_mm, witness_of(design.spec.wheel)
    half = witness.half_deg()
    nearest = math.inf
    for c in np.linspace(-60.0, 60.0, 61):  # then the next wheel is where the first one was
        placed = []
        for k in range(3):
            at = (c - 120.0 * k + 180.0) % 360.0 - 180.0
            moving = max(-half, min(half, at))
            turn = math.degrees(float(witness.slot(mp.radians(moving)))) - moving
            # the finger is at angle 0 from the fixed axis, which is the origin
            there = affinity.rotate(own, turn + 180.0, (0.0, 0.0))
            there = affinity.translate(there, L, 0.0)
            placed.append(affinity.rotate(there, at, (0.0, 0.0)))
        for i, one in enumerate(placed):
            nearest = min([nearest, *(one.distance(other) for other in placed[:i])])
            # a disc without clearance touches its recess
            assert one.intersection(lock).area < 1e-3 * lock.area
    (check,) = (c for c in design.checks if c.name == "wheels_apart_mm")
    assert nearest >= check.value > 0.0


@pytest.mark.long
def test_a_batch_of_carriers_with_several_fingers():
    """Seen from the carrier, each finger moves the wheel as a roller of a plain crank does."""
    distances = {"size.center_distance_mm": np.array([100.0, 110.0])}
    wheel, angles = External(8), (0.0, 170.0)
    for of in ({"wheel.z": np.array([8, 9, 10])}, distances):
        fingers = many(Spec(wheel, Carousel(roller_angles_deg=angles)), of)
        rollers = many(Spec(wheel, Crank(roller_angles_deg=angles)), of)
        assert fingers.refused.tolist() == rollers.refused.tolist()
        pairs = zip(fingers.machine.engagements, rollers.machine.engagements, strict=True)
        for one, other in pairs:
            x = 0.3 * one.entry_deg
            assert np.array_equal(one.motion(x).c[1], other.motion(x).c[1])


@pytest.mark.sampled(2)
@pytest.mark.parametrize("count", [POINTS, 1])
def test_the_wheel_s_shaft_bears_its_bodies(count):
    """Newton's law for the points: the force of pin and bodies on the pivot is within the bound.

    The bound adds sizes, so that it is above the vector sum, by half of it at most.
    """
    wheel, mass, n, L, a = External(5), 0.7, 120.0, 0.25, 0.04
    bodies = Mass("point", mass_kg=mass, count=count, radius_mm=1000.0 * HELD)
    design = Design(
        wheel,
        Carousel(n_rpm=n),
        mass=(bodies,),
        size=Size(center_distance_mm=1000.0 * L),
        shaft=Shaft(wheel_overhang_mm=1000.0 * a, bending_factor=1.0),
    )
    witness, w = witness_of(wheel), mp.mpf(n) * mp.pi / 30
    places = design.cycle.mechanism.engagements
    greatest = 0.0
    for one in places:
        for fraction in np.linspace(-0.98, 0.98, 25):
            c = mp.radians(mp.mpf(float(fraction * one.exit_deg)))
            total = mp.mpc(0)
            for k in range(count):
                angle = mp.mpf(2 * k) * mp.pi / POINTS
                total += mass * mpmath.diff(
                    lambda x, angle=angle: L * mp.expj(x) - HELD * mp.expj(witness.slot(x) + angle),
                    c,
                    2,
                )
            pin = design.cycle.states(np.array([one.mid_deg + float(mp.degrees(c))])).pin_force_N[0]
            slot = 1j * mp.expj(witness.slot(c))
            # on the pivot: the pin's force, on either wall, less what speeds the bodies up
            inert = w**2 * total
            sums = (abs(pin * slot - inert), abs(pin * slot + inert))
            greatest = max(greatest, *map(float, sums))
    moment = strength(design.mechanism)["strength.wheel_shaft.moment_Nm"]
    torque = design.loads["wheel_torque_Nm"]
    assert greatest * a * 0.9999 <= moment
    assert moment <= 1.5 * math.hypot(greatest * a, max(torque.max, -torque.min))


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
