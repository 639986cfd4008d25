"""The greatest loads: none is stepped over, all are refined, and what has no bound says so."""

import math
from itertools import pairwise

import numpy as np
import pytest
import repo
from load_states import greatest, state
from sampling import some
from witness import mp
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli.design import Design, load
from geneva_cli.errors import GenevaError
from geneva_cli.loads.cycle import Cycle, cycle_warnings
from geneva_cli.loads.load_peaks import REPORTED_PEAKS, greatest_pressure
from geneva_cli.loads.sizing import kinetic_power_W
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import worst
from geneva_cli.spec.tables import Load, Size

OMEGA = 2.0 * math.pi
BOTH = Load(0.02, 3.0, friction=0.1)
WIDE = Size(100.0, 5.0, face_width_mm=10.0)


def crank(z, gearing="external", load=BOTH, **wheel):
    return Spec(Wheel(z, gearing, **wheel), size=WIDE, load=load)


def side(z, A, gearing="internal", load=BOTH):
    drive = Drive("side-crank")
    return Spec(Wheel(z, gearing), drive, Keys("side-crank", A), size=WIDE, load=load)


def elliptical(z, e, gearing, load=BOTH):
    drive = Drive("elliptical-gears")
    return Spec(Wheel(z, gearing), drive, Keys("elliptical-gears", e), size=WIDE, load=load)


def curved(law, ratio=None, load=BOTH, z=6, alpha0=0.0):
    motion = Motion(law, alpha0_deg=alpha0, ratio=ratio)
    return Spec(Wheel(z), motion=motion, size=WIDE, load=load)


INERTIA = Load(0.05)
NARROW = [
    side(5, 0.97, load=INERTIA),
    side(6, -0.999, "external", load=INERTIA),
    elliptical(4, 0.9999, "internal", load=INERTIA),
]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("spec", NARROW, ids=lambda s: f"{s.drive.NAME} z={s.wheel.z}")
def test_inertia_alone_takes_the_peaks_of_the_motion(spec):
    """T1 = I w² psi' psi'' and T = I w² psi'', whose peaks have a search of their own: 64 ulp."""
    mechanism = build(spec)
    motion, scale = worst(mechanism), 0.05 * OMEGA**2
    shaft = greatest(mechanism, "input_torque_Nm")
    assert shaft.max == pytest.approx(scale * motion.power.max, rel=2e-14)
    power = scale * motion.power.max * OMEGA
    assert kinetic_power_W(mechanism) == pytest.approx([power], rel=2e-14)
    torque = greatest(mechanism, "wheel_torque_Nm")
    assert torque.max == pytest.approx(scale * motion.acceleration.max, rel=2e-14)


MIXED = [
    crank(5),
    crank(4, "internal"),
    crank(6, offset_mm=-30.0),
    crank(6, load=Load(0.0, 3.0, friction=0.3)),
    crank(6, "spherical", axes_deg=70.0),
    side(5, 0.9),
    elliptical(6, 0.9, "external"),
    curved("cycloidal", z=5, alpha0=-17.42),
    curved("3-4-5", "matched"),
    curved("modified-trapezoid", "matched", Load(1.0, 1.0)),
]


@pytest.mark.sampled(10)
@pytest.mark.parametrize("spec", MIXED, ids=range(len(MIXED)))
def test_against_a_dense_grid(spec):
    """A grid never exceeds what is found, but by rounding, and a fine one comes near to it.

    Near where friction turns round the force is steep, and ends in a jump: 2e-3 for the grid.
    """
    mechanism = build(spec)
    engagement = mechanism.engagements[0]
    breaks = engagement.motion.breaks_deg
    near = np.geomspace(1e-6, 1.0, 300)
    grids = [np.linspace(a, b, 3001)[1:-1] for a, b in pairwise(breaks)]
    x = np.concatenate([*grids, near, -near, breaks[:1], breaks[-1:]])
    every = state(mechanism, engagement, x)
    for quantity, values in every._asdict().items():
        if quantity == "pressure_deg":
            found = greatest_pressure(mechanism).max
        else:
            found = greatest(mechanism, REPORTED_PEAKS[quantity]).max
        most = float(np.max(np.abs(values)))
        assert found >= most * (1.0 - 1e-12), quantity
        assert found <= most * 1.002 or math.isinf(found), quantity


def test_place_and_value_of_a_peak_with_friction():
    """N = |T| / (rho - r f s) and T1 = T psi' + f N |v| of an external wheel, in 50 digits.

    The place is a root of the slope: as sure as the motion's own, 1e-13 of the motion.
    """
    mechanism = build(crank(6, load=Load(0.02, 3.0, friction=0.2)))
    l, r, f, w = mp.mpf(1) / 2, mp.mpf(5) / 100, mp.mpf(0.2), 2 * mp.pi

    def psi(a):
        return mp.atan2(l * mp.sin(a), 1 - l * mp.cos(a))

    def rho(a):
        return mp.sqrt(1 - 2 * l * mp.cos(a) + l * l)

    def torque(a):
        return mp.mpf(0.02) * w * w * mp.diff(psi, a, 2) + 3

    def rubs(a):  # on the way in, where the wheel is driven
        return mp.diff(rho, a) + (1 + mp.diff(psi, a)) * r

    def force(a):
        return torque(a) / (rho(a) - r * f * mp.sign(rubs(a))) / mp.mpf("0.1")

    def shaft(a):
        return torque(a) * mp.diff(psi, a) + f * force(a) * abs(rubs(a)) * mp.mpf("0.1")

    for quantity, of in (("pin_force_N", force), ("input_torque_Nm", shaft)):
        found = greatest(mechanism, quantity)
        with mp.workdps(60):
            at = mp.findroot(lambda a, of=of: mp.diff(of, a), math.radians(found.at_deg))
            assert found.at_deg == pytest.approx(float(mp.degrees(at)), abs=1e-11)
            assert found.max == pytest.approx(float(of(at)), rel=4e-15)


def test_a_bearing_wall_as_sharp_as_the_roller_ends_in_an_edge():
    """The press with curved slots: 544 MPa at -1.93 deg was only where the search stopped."""
    size, load = Size(441.89, 20.0, face_width_mm=30.0), Load(6.484556, 497.0)
    mechanism = build(Spec(Wheel(6), motion=Motion("cycloidal", ratio="matched"), size=size))
    mechanism = mechanism._replace(spec=mechanism.spec.replace(load=load))
    engagement = mechanism.engagements[0]
    assert state(mechanism, engagement, -1.0).contact_stress_MPa == pytest.approx(2179.5, abs=0.1)
    found = greatest(mechanism, "contact_stress_MPa")
    assert math.isinf(found.max)
    # The radius of curvature is the roller's there, by differences of the pitch curve in 50 digits.
    l, b = mp.mpf(1) / 2, mp.pi / 6

    def pitch(x):
        u = x / (4 * b) + mp.mpf(1) / 2
        psi = 2 * b * (u - mp.sin(2 * mp.pi * u) / (2 * mp.pi) - mp.mpf(1) / 2)
        return (1 - l * mp.expj(-x)) * mp.expj(-psi)

    at = mp.radians(found.at_deg)
    first, second = mp.diff(pitch, at), mp.diff(pitch, at, 2)
    radius = abs(first) ** 3 / abs((mp.conj(first) * second).imag)
    assert float(radius) == pytest.approx(20.0 / 441.89, rel=1e-11)
    assert any("no bound" in text for text in cycle_warnings(mechanism))


def test_friction_that_holds_the_wheel():
    """r f > rho at mid-motion: no pin force turns the wheel, and a warning says so."""
    mechanism = build(crank(3, load=Load(0.0, 3.0, friction=3.0)))
    found = greatest(mechanism, "pin_force_N")
    assert math.isinf(found.max)
    engagement = mechanism.engagements[0]
    # it is told where that begins: all the way to it the force has a bound
    places = np.linspace(engagement.entry_deg, found.at_deg - 1e-6, 50)
    assert np.isfinite(state(mechanism, engagement, places).pin_force_N).all()
    assert state(mechanism, engagement, found.at_deg + 1e-6).pin_force_N == math.inf
    assert any("friction of 3 holds the wheel" in text for text in cycle_warnings(mechanism))


@pytest.mark.parametrize("near", some((1.0 - 1e-6, 1.0 - 1e-7), (1.0 - 1e-7,)))
def test_a_motion_near_both_ends_has_its_travel(near):
    """It is 2 L (cos b - (1 - l)). Places spread about the middle have too few digits for it."""
    b, design = math.pi / 6.0, Design.of(elliptical(6, near, "external"))
    known = 0.2 * (math.cos(b) - (1.0 - math.sin(b)))
    travel = design.loads_table.to_dict()["life.slot_travel_m"]
    assert travel == pytest.approx(known, rel=1e-10)
    assert design.loads["omega_rad_s"].mean == pytest.approx(math.pi / 3.0, rel=1e-11)


@pytest.mark.long
def test_a_motion_between_two_angles_has_no_loads():
    """At 1 - 1e-8 it has some still; nearer to 1 the reason is told."""
    for near in some((1.0 - 1e-9, 1.0 - 1e-10, 1.0 - 1e-12), (1.0 - 1e-10,)):
        with pytest.raises(GenevaError, match="so that their means would be rounding"):
            Design.of(elliptical(6, near, "external")).loads  # noqa: B018


def test_beside_a_cusp_the_stress_goes_to_nought():
    """At a pitch curve's cusp one wall turns away from the roller: 1/r + k/(1 - k r) goes to 0.

    1/k goes with the angle, and so does the square of the stress; 1e-3 for what is of higher order.
    """
    design = load("designs/press-345.toml")
    [engagement] = design.mechanism.engagements
    more, less = (state(design.mechanism, engagement, at).contact_stress_MPa for at in (1e-3, 1e-4))
    assert less / more == pytest.approx(math.sqrt(0.1), rel=1e-3)
    found = design.loads["contact_stress_MPa"]
    assert (found.min, found.min_at_deg) == (0.0, 0.0)


@pytest.mark.parametrize(("law", "alpha0"), [("cycloidal", 10.0), ("harmonic", 5.0)])
def test_an_inertia_alone_slides_as_far_on_either_side_of_mid_motion(law, alpha0):
    """The pin crosses the radius where the torque is a rounding, whose sign chose a wall.

    Dense states beside mid-motion have the extremes; 1e-3: what the grid leaves of them.
    """
    cycle = Cycle(build(curved(law, load=Load(0.05), alpha0=alpha0)))
    (engagement,) = cycle.mechanism.engagements
    x = np.linspace(engagement.entry_deg, engagement.exit_deg, 40_001)
    names = ["sliding_m_s", "contact_stress_MPa"]
    slid, pressed = cycle.states(x[np.abs(x) > 1e-9], names)
    slides, stress = (cycle.extremes[name] for name in names)
    assert slides.max == pytest.approx(-slides.min, rel=1e-12)
    assert slides.max == pytest.approx(slid.max(), rel=1e-3)
    assert stress.min == pytest.approx(pressed.min(), rel=1e-3, abs=1e-6)


def test_a_stress_has_no_bound_from_where_the_wall_is_undercut():
    """Torque changes its sign earlier: the stress is bounded there."""
    found = load(str(repo.DESIGNS / "sine-group.toml"), ["size.roller_radius_mm=2"]).loads
    for name in ("contact_stress_MPa", "pv_W_m2"):
        assert found[name].max is None
        assert found[name].max_at_deg == pytest.approx(-0.0460118909, abs=1e-9), name
