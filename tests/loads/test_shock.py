"""Shocks against closed forms and searches of 50 digits that know nothing of jets or anchors."""

import itertools
import math

import mpmath as mp
import numpy as np
import pytest
from impact_witness import contact_of, force_of, impacts_in

from geneva_cli import (
    Design,
    EllipticalGears,
    External,
    Internal,
    Load,
    SideCrank,
    Size,
    Spherical,
    Tolerance,
)
from geneva_cli.loads.impacts.entry import entry_impacts
from geneva_cli.loads.impacts.reversal import changes, impacts_of, lasting_drag_Nm
from geneva_cli.loads.load_case import load_case
from geneva_cli.parts.machine_sizes import built
from geneva_cli.spec.tables import WheelMaterial

# A contact is where a square root of the error says: half of a double's digits would be lost of
# the angle if the path were not written about its entry. Here only the angle's own last digits go.
NEAR = 4e-14


@pytest.fixture(autouse=True)
def digits():
    with mp.workdps(50):
        yield


def of(*kinds):
    return Design(*kinds).mechanism.engagements[0]


def near(found, true, tolerance=NEAR):
    assert abs(found - true) <= tolerance * max(abs(true), mp.mpf(1) / 100), (found, mp.nstr(true))


def deg(x):
    return mp.degrees(x)


def test_the_values_of_the_theory():
    """theory-loads.md, section 6: z = 3."""
    contact = contact_of(of(External(3)), 1e-4)
    near(contact.at_deg, mp.mpf("-30.81025092485702"))
    near(contact.jump, mp.mpf("-0.023909826405751256"))
    [(_, at_deg, speed)] = impacts_in(of(External(3)), 1e-4)
    near(at_deg, mp.mpf("0.55220712276288262"))
    near(speed, mp.mpf("0.031071640094697492"))


@pytest.mark.parametrize("z", [3, 4, 6, 24, 200])
@pytest.mark.parametrize("crank, center", [(1e-4, 0.0), (1e-9, 0.0), (2e-3, 1e-3), (-1e-3, -5e-3)])
@pytest.mark.parametrize("gearing, sign", [(External, 1), (Internal, -1)])
def test_first_contact_by_the_law_of_sines(gearing, sign, z, crank, center):
    b = mp.pi / z
    l = mp.sin(b) * (1 + mp.mpf(crank)) / (1 + mp.mpf(center))
    # the obtuse of the two triangles of the wheel, the crank and the roller on the axis
    a = -(mp.pi - mp.asin(mp.sin(b) / l) - b) if sign > 0 else -(mp.pi - mp.asin(mp.sin(b) / l) + b)
    jump = sign * l * (sign * mp.cos(a) - l) / (1 - 2 * sign * l * mp.cos(a) + l * l)
    found = contact_of(of(gearing(z)), crank, center)
    near(found.at_deg, deg(a))
    near(found.jump, jump, 1e-12 if crank - center > 1e-6 else 1e-7)  # crank - center is rounded


@pytest.mark.parametrize("e", [0.0, 0.2])
def test_of_a_side_crank(e):
    """Alone, and behind elliptical gears of eccentricity e: Kepler's angle turns its shaft."""
    A, z, eps = mp.mpf("0.6"), 6, mp.mpf("1e-3")
    b = mp.pi / z
    l = mp.sin(b) * (1 + eps)

    def crank(phi):
        shaft = phi - 2 * mp.arg(1 + mp.mpf(e) * mp.expj(phi))
        return mp.atan2(mp.sin(shaft), A + mp.cos(shaft))

    def wheel(phi):
        f = crank(phi)
        return mp.atan2(l * mp.sin(f), 1 - l * mp.cos(f))

    gears = EllipticalGears(eccentricity=e, gear_distance_mm=50.0) if e else None
    design = Design(External(6), SideCrank(A=0.6), drive_before=gears)
    found = contact_of(design.mechanism.engagements[0], 1e-3)
    at = mp.findroot(lambda phi: wheel(phi) + b, mp.radians(found.at_deg))
    near(found.at_deg, deg(at))
    near(found.jump, mp.diff(wheel, at), 1e-12)
    assert found.jump < 0.0  # struck backwards: the first of the axis' two crossings


def beside_the_centre(z, offset, crank, center):
    """Angle and jump by the circle with errors, and the axis at rest: the line at -e beside."""
    e = mp.mpf(offset) / 100
    b = mp.pi / z
    d = mp.asin(e / mp.cos(b))
    R, L = mp.sin(b) * mp.cos(d) * (1 + mp.mpf(crank)), 1 + mp.mpf(center)
    ahead = b - d  # of the crank's axis against the slot's direction
    # (L sin(ahead) + e) is the crank's axis' distance from the slot's axis; the chord's far end
    chord = mp.sqrt(R**2 - (L * mp.sin(ahead) + e) ** 2)
    along = L * mp.cos(ahead) + chord
    pin = along * mp.expj(-ahead) + -e * 1j * mp.expj(-ahead)
    a = mp.arg(-(pin - L))  # from the line of centres, clockwise
    velocity = 1j * (pin - L) * -1
    return -deg(a), mp.im(velocity * mp.expj(ahead)) / along


@pytest.mark.parametrize("offset", [10.0, -10.0])
@pytest.mark.parametrize("crank, center", [(1e-3, 0.0), (0.0, -1e-3), (3e-4, 1e-4)])
def test_of_slots_beside_the_centre(offset, crank, center):
    at_deg, jump = beside_the_centre(6, offset, crank, center)
    found = contact_of(of(External(6, offset_mm=offset)), crank, center)
    near(found.at_deg, at_deg)
    near(found.jump, jump, 1e-11)


@pytest.mark.parametrize("z, offset", [(12, 20.0), (12, 40.0), (24, 60.0)])
def test_the_hardest_of_slots_far_beside_the_centre(z, offset):
    """Of four combinations of the errors, for a crank's axis on either side of the wheel's centre.

    Beyond an offset of R (25 and 10 mm here) a longer centre distance is as bad as a longer crank.
    """
    clear = Size(slot_clearance_mm=5.0)  # the roller meets no corner of the mouth
    tolerance = Tolerance(center_distance_mm=0.05, crank_radius_mm=0.05)
    m = Design(External(z, offset_mm=offset), size=clear, tolerance=tolerance).mechanism
    jumps = []
    for one, other in itertools.product((1.0, -1.0), repeat=2):
        _, jump = beside_the_centre(z, offset, one * 0.05 / (100.0 * m.ratio), other * 5e-4)
        jumps.append(0 if mp.im(jump) else abs(jump))  # complex where the circle misses the axis
    near(abs(entry_impacts(m).jump.item()), max(jumps), 1e-11)


@pytest.mark.parametrize("axes", [40.0, 90.0, 120.0])
def test_on_a_sphere(axes):
    """The arm longer by eps, in its plane; the pin reaches the meridian plane of the slot."""
    z, eps = 5, mp.mpf("1e-3")
    b, S = mp.pi / z, mp.radians(axes)
    th = mp.asin(mp.sin(S) * mp.sin(b))

    def wheel(a):
        x = mp.sin(S) * mp.cos(th) - (1 + eps) * mp.sin(th) * mp.cos(S) * mp.cos(a)
        return mp.atan2((1 + eps) * mp.sin(th) * mp.sin(a), x)

    found = contact_of(of(Spherical(5, axes_deg=axes)), 1e-3)
    at = mp.findroot(lambda a: wheel(a) + b, mp.radians(found.at_deg))
    near(found.at_deg, deg(at))
    near(found.jump, mp.diff(wheel, at), 1e-12)
    assert found.jump < 0.0


def test_a_crank_that_is_too_short_meets_the_mouth():
    assert contact_of(of(External(5)), -1e-9) is None
    assert contact_of(of(External(5)), 0.0, 1e-9) is None
    assert contact_of(of(External(5)), 0.0) is None


@pytest.mark.parametrize("gearing, sign", [(External, 1), (Internal, -1)])
@pytest.mark.parametrize("z, play, drag", [(3, 1e-6, 0), (5, 1e-3, 0.1), (8, 1e-4, 0.05)])
def test_impact_by_search(gearing, sign, z, play, drag):
    l = mp.sin(mp.pi / z)

    def wheel(a):
        return mp.atan2(l * mp.sin(a), 1 - sign * l * mp.cos(a))

    start = mp.findroot(lambda a: mp.diff(wheel, a, 2) + drag, mp.mpf("0.001")) if drag else 0
    w0, v0 = wheel(start), mp.diff(wheel, start)

    def gap(x):
        return w0 + v0 * x - drag * x * x / 2 - wheel(start + x) - play

    [(from_deg, at_deg, speed)] = impacts_in(of(gearing(z)), play, drag)
    x = mp.findroot(gap, mp.radians(at_deg) - start)
    near(from_deg, deg(start), 1e-11)
    near(at_deg, deg(start + x), 1e-11)
    near(speed, mp.diff(gap, x), 1e-10)


def test_small_plays_keep_their_digits():
    """phi -> (6 q / |psi3|)^(1/3), and the speed |psi3| phi² / 2."""
    l = mp.sin(mp.pi / 3)
    jerk = l * (1 + l) / (1 - l) ** 3  # -psi3(0)
    [(_, at_deg, speed)] = impacts_in(of(External(3)), 1e-15)
    phi = (6 * mp.mpf(1e-15) / jerk) ** (mp.mpf(1) / 3)
    near(at_deg, deg(phi), 1e-7)  # the next term is of order phi²
    near(speed, jerk * phi**2 / 2, 1e-6)


def test_a_drag_ends_the_change_of_sides():
    heavy = Design(External(6), load=Load(inertia_kgm2=0.4, torque_Nm=1.0))
    drag = lasting_drag_Nm(heavy.mechanism)
    # I w² times the peak acceleration, which brakes as it drives
    w = 2 * mp.pi
    near(drag, mp.mpf("0.4") * w**2 * mp.mpf(heavy.peaks.acceleration.max) - 1, 1e-13)
    for more, count in ((-1e-6, 2), (1e-6, 0)):
        load = Load(inertia_kgm2=0.4, torque_Nm=1.0 + drag + more)
        case = load_case(Design(External(6), load=load).mechanism)
        over = np.array([[case.resists_Nm / case.inertia_Nm]])
        assert len(changes(of(External(6)), over)[1]) == count


# bending moments over the force, from the plate, a away from the roller's middle: by statics, and
# for a fixed pin with level ends
MOMENTS = {
    "cantilever": lambda x, a: a - x,
    "supported": lambda x, a: x / 2,
    "fixed": lambda x, a: x / 2 - a / 4,
}


@pytest.mark.parametrize("held", MOMENTS)
@pytest.mark.parametrize(("pin_mm", "d"), [(6.0, 6.0), (0.0, 16.4), (None, None)])
def test_force_counts_how_the_pin_is_held(held, pin_mm, d):
    """The pin's energy in bending is the impact's; without a pin it is the roller that bends.

    The default pin is as thick as it is drawn, half of the roller or what the load needs.
    """
    size = Size(
        face_width_mm=18.0, roller_radius_mm=8.2, pin_mm=pin_mm, pin_gap_mm=1.5, pin_held=held
    )
    plastic = WheelMaterial(3.0, 0.35)
    design = Design(External(6), size=size, load=Load(inertia_kgm2=1.2), material_wheel=plastic)
    d = d or built(design.mechanism).pin_mm
    a, inertia = mp.mpf("10.5"), mp.pi * mp.mpf(d) ** 4 / 64
    half = mp.quad(lambda x: MOMENTS[held](x, a) ** 2, [0, a]) / (210e3 * inertia)
    give = half if held == "cantilever" else 2 * half  # mm/N: the other half bends alike
    steel = (1 - mp.mpf("0.09")) / 210
    soft = (steel + (1 - mp.mpf("0.1225")) / 3) / (2 * steel)
    press = mp.mpf("3.84e-5") * soft ** mp.mpf("0.9") / mp.mpf(18) ** mp.mpf("0.8")
    energy = mp.mpf("1.2") * (mp.mpf("0.02") * 2 * mp.pi) ** 2 / 2 * 1000  # N mm

    def left(Q):
        pressed = press * mp.mpf("0.9") / mp.mpf("1.9") * Q ** mp.mpf("1.9")
        return pressed + give * Q * Q / 2 - energy

    near(force_of(design.mechanism, 0.02), mp.findroot(left, 500), 1e-12)


def test_a_wheel_that_does_not_cross_its_play_is_struck_by_the_wall_it_left():
    """A coast over a grid: the torque returns at 21.5 degrees, before the play is used up.

    1e-4: the speed changes by 2e-5 of itself in a step of the grid.
    """
    b, drag, play = math.pi / 5.0, 2.22474143, 0.0042
    ratio = math.sin(b)
    x, step = np.linspace(-0.3 * math.pi, 0.3 * math.pi, 2_000_001, retstep=True)
    D = 1.0 - 2.0 * ratio * np.cos(x) + ratio**2
    torque = drag - ratio * (1.0 - ratio**2) * np.sin(x) / D**2
    start = np.flatnonzero((torque[:-1] > 0.0) & (torque[1:] <= 0.0))[0]
    rate = -np.cumsum(torque[start:]) * step
    ahead = np.cumsum(rate) * step
    assert ahead.max() < play  # the other wall is not reached
    back = np.flatnonzero(ahead > 0.0)[-1]
    (engagement,) = Design(External(5)).mechanism.engagements
    at = changes(engagement, np.array([[drag]]))
    at_deg, speed = impacts_of(engagement, at, np.full(2, play), np.array([[drag]]))
    assert at_deg[0] == pytest.approx(math.degrees(x[start + back]), rel=1e-4)
    assert speed[0] == pytest.approx(-rate[back], rel=1e-4)
    assert np.isnan(speed[1])  # no wall is left at the second change
