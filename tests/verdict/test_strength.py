"""Strength and life of whole designs: each check can fail and be mended, and what lacks is said."""

import math

import numpy as np
import pytest
import repo
from strength_checks import judged
from words import Drive, Motion, Spec, Wheel

import geneva_cli
from geneva_cli import Cam, External, Internal, SideCrank, design
from geneva_cli.loads.cycle import cycle_of
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.machine_sizes import sized
from geneva_cli.spec.tables import Limits, Load, RollerMaterial, Shaft, Size, WheelMaterial
from geneva_cli.verdict.checks import checks
from geneva_cli.verdict.strength import Strength

DESIGNS = repo.DESIGNS

# The first machine that a new user tries: eight stations, 40 a minute, 1.2 kg m², 20 N m.
WHOLE = Spec(
    Wheel(8),
    Drive(n_rpm=40.0),
    size=Size(
        250.0, 12.0, face_width_mm=18.0, lock_clearance_mm=0.02, lock_edge_mm=0.5, pin_mm=12.0
    ),
    load=Load(1.2, 20.0, friction=0.05),
    material_roller=RollerMaterial(stress_max_MPa=60.0, dynamic_capacity_N=8000.0),
    material_wheel=WheelMaterial(stress_max_MPa=30.0),
    shaft=Shaft(
        wheel_overhang_mm=40.0,
        wheel_diameter_mm=20.0,
        wheel_span_mm=80.0,
        crank_overhang_mm=30.0,
        crank_diameter_mm=20.0,
        shear_stress_max_MPa=40.0,
    ),
    limits=Limits(
        pv_max_W_m2=1e8,
        roller_life_min_h=2e4,
        lock_stress_max_MPa=800.0,
        lock_deflection_max_deg=0.01,
    ),
)
ROWS = {
    "pv_max_W_m2": ("limits.pv_max_W_m2", 4e7),
    "roller_life_min_h": ("limits.roller_life_min_h", 1e9),
    "pin_stress_MPa": ("material.roller.stress_max_MPa", 6.0),
    "horn_stress_MPa": ("material.wheel.stress_max_MPa", 3.0),
    "lock_horn_stress_MPa": ("material.wheel.stress_max_MPa", 2.0),
    "lock_stress_max_MPa": ("limits.lock_stress_max_MPa", 400.0),
    "lock_deflection_max_deg": ("limits.lock_deflection_max_deg", 0.002),
    "wheel_shaft_stress_MPa": ("shaft.shear_stress_max_MPa", 15.0),
    "crank_shaft_stress_MPa": ("shaft.shear_stress_max_MPa", 12.0),
}


def rows(spec):
    return {c.name: c for c in checks(build(spec), parts=False)}


@pytest.mark.long
def test_a_row_where_something_is_allowed():
    found = rows(WHOLE)
    assert set(ROWS) <= set(found)
    assert all(found[name].passes for name in ROWS)
    unloaded = rows(Spec(Wheel(8), size=Size(face_width_mm=18.0)))
    assert not set(ROWS) & set(unloaded)
    # loaded parts have the default steel's allowable stresses
    plain = rows(Spec(Wheel(8), size=Size(face_width_mm=18.0), load=WHOLE.load))
    limits = {name: plain[name].limit for name in set(ROWS) & set(plain)}
    assert limits == {
        **dict.fromkeys(("pin_stress_MPa", "horn_stress_MPa", "lock_horn_stress_MPa"), 165.0),
        **dict.fromkeys(("wheel_shaft_stress_MPa", "crank_shaft_stress_MPa"), 82.5),
    }


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", ROWS)
def test_each_can_fail_and_one_key_mends_it(name):
    """The advice is a key's value with which the row passes."""
    key, limit = ROWS[name]
    spec = WHOLE.with_(key, limit)
    failing = {c.name: c for c in judged(build(spec), parts=False)}[name]
    assert failing.passes is False
    # two shafts that are too thin are mended by two keys, or each row has its own
    own = failing.why.rpartition("; ")[2].removesuffix(" passes this one")
    tables = {
        "wheel_diameter_mm": "shaft",
        "crank_diameter_mm": "shaft",
        "dynamic_capacity_N": "material.roller",
        "n_rpm": "drive",
    }
    for told in (failing.nearest or own).split(" and "):
        key, _, value = told.partition(" = ")
        spec = spec.with_(f"{tables.get(key, 'size')}.{key}", float(value))
    assert rows(spec)[name].passes


def test_without_parts_their_keys_are_needed():
    """A wheel of 400 slots is not drawn, so its parts' sizes are not known."""
    spec = WHOLE.replace(wheel=Wheel(400), size=Size(250.0, 1.0), limits=Limits(), shaft=Shaft())
    assert not {"wheel_shaft_stress_MPa", "arm_stress_MPa"} & set(rows(spec))
    limited = rows(spec.with_("shaft.shear_stress_max_MPa", 40.0))
    needs = {
        "pin_stress_MPa": "face_width_mm in [size]",
        "horn_stress_MPa": "a wheel that is drawn as a flat outline",
        "wheel_shaft_stress_MPa": "wheel_overhang_mm in [shaft] and wheel_diameter_mm in [shaft]",
    }
    for name, keys in needs.items():
        assert limited[name].why == f"not known: it needs {keys}"
        assert limited[name].passes is None


def test_pv_and_the_wheel_shaft_over_the_cycle():
    """Against 20,001 places, as near to the peak as these lie: p v, and the shaft by the code.

    Its stress is 16/(pi d³) sqrt((1.5 M)² + T²).
    """
    mechanism = build(WHOLE)
    of = Strength(mechanism)
    names = ["pv_W_m2", "wheel_bearing_N", "wheel_torque_Nm"]
    pv, bearing, torque = cycle_of(mechanism).states(np.linspace(-67.5, 67.5, 20001), names)
    most = pv.max()
    assert of["life.pv_max_W_m2"] == pytest.approx(most, rel=1e-6)
    assert of["life.pv_max_W_m2"] >= most * (1.0 - 1e-14)
    both = np.hypot(1.5 * 0.040 * bearing, torque).max()
    assert of["strength.wheel_shaft.moment_Nm"] == pytest.approx(both, rel=1e-6)
    stress = 16e3 * both / (math.pi * 20.0**3)
    assert of["strength.wheel_shaft.stress_MPa"] == pytest.approx(stress, rel=1e-6)
    least = of["strength.wheel_shaft.least_diameter_mm"]
    thin = Strength(build(WHOLE.with_("shaft.wheel_diameter_mm", least)))
    assert thin["strength.wheel_shaft.stress_MPa"] == pytest.approx(40.0, rel=1e-14)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("A", [0.0, 0.5, -0.3])
def test_the_crank_shaft_takes_the_crank_s_torque(A):
    """Moments about the crank's axis, of the force on the roller: bodies cut free.

    The normal force at the contact by its place and direction on the fixed axes, at 2001 angles of
    a frictionless machine: as near to the peak as these lie.
    """
    shaft = Shaft(crank_overhang_mm=30.0, crank_diameter_mm=20.0, torsion_factor=2.0)
    drive = Drive("side-crank", n_rpm=40.0)
    spec = Spec(Wheel(8), drive, {"A": A}, size=Size(250.0, 12.0), load=Load(1.2, 20.0))
    mechanism = build(spec.replace(shaft=shaft))
    engagement = mechanism.engagements[0]
    x = np.linspace(engagement.entry_deg, engagement.exit_deg, 20001)
    px, py = (0.250 * jet.c[0] for jet in engagement.path(x, 0))
    rho = np.hypot(px, py)
    psi = engagement.motion(x, 2)
    w = 40.0 * math.pi / 30.0
    force = (1.2 * w * w * psi.c[2] * 2.0 + 20.0) / rho  # a jet's third coefficient is half psi''
    # on the wheel it is square to the radial slot; its moment about the crank's axis (L, 0)
    torque = force * ((px - 0.250) * px + py * py) / rho
    both = np.hypot(1.5 * 0.030 * force, 2.0 * torque).max()
    found = Strength(mechanism)
    assert found["strength.crank_shaft.moment_Nm"] == pytest.approx(both, rel=1e-6)
    stress = 16e3 * both / (math.pi * 20.0**3)
    assert found["strength.crank_shaft.stress_MPa"] == pytest.approx(stress, rel=1e-6)


def cycloid(turned):
    """A wheel's angle that follows a cycloid, 60 degrees in 120 of the crank."""
    u = turned / math.radians(120.0) + 0.5
    return math.pi / 3.0 * u - math.sin(2.0 * math.pi * u) / 6.0


@pytest.mark.long
def test_the_crank_shaft_behind_another_drive_turns_at_its_own_rate():
    """The wheel's power over the rate of the shaft that a side-crank turns, at 2001 angles.

    Derivatives are differences over 2e-4 radians, whose errors are some 1e-7 of them.
    """
    shaft = Shaft(crank_overhang_mm=0.0, crank_diameter_mm=30.0)
    before = SideCrank(A=0.3, input_crank_mm=80.0)
    cam = Spec(External(6), Cam(), None, Motion("cycloidal"), load=Load(0.3, 5.0))
    found = Strength(build(cam.replace(shaft=shaft, drive_before=before)))
    w, h, most = 2.0 * math.pi, 1e-4, 0.0
    for i in range(2001):
        x = 1.2 * (i / 1000.0 - 1.0)
        crank = [math.atan2(math.sin(y), 0.3 + math.cos(y)) for y in (x - h, x, x + h)]
        if abs(crank[1]) < math.radians(60.0):
            first, here, last = map(cycloid, crank)
            torque = 0.3 * w * w * (last - 2.0 * here + first) / (h * h) + 5.0
            most = max(most, abs(torque * (last - first) / (crank[2] - crank[0])))
    assert found["strength.crank_shaft.moment_Nm"] == pytest.approx(most, rel=1e-4)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("wheel", "sense"), [(External(4), 1.0), (Internal(6), -1.0)])
def test_the_finger_of_a_carousel_bears_the_slot_s_torque_alone(wheel, sense):
    """The carrier, not the finger, turns the wheels round: psi' and psi'' of a plain crank."""
    b, w, shaft = math.pi / wheel.z, 2.0 * math.pi, Shaft(crank_overhang_mm=0.0)
    found = Strength(build(Spec(wheel, geneva_cli.Carousel(), load=Load(0.3, 5.0), shaft=shaft)))
    half, l = 0.5 * math.pi - sense * b, math.sin(b)
    x = np.linspace(-half, half, 200001)
    square = 1.0 - 2.0 * sense * l * np.cos(x) + l * l
    bend = -l * (1.0 - l * l) * np.sin(x) / square**2
    torque = (0.3 * w * w * bend + 5.0) * l * (np.cos(x) - sense * l) / square
    assert found["strength.crank_shaft.moment_Nm"] == pytest.approx(abs(torque).max(), rel=1e-8)


def test_the_wheel_s_shaft_and_key_bear_the_torque_of_the_dwell():
    """At rest 300 N m go from the load through shaft and key to the lock, whose force bends both.

    The disc presses through the crank's axis at the recess's corner. So it has the lever L sin phi,
    and the corner is at the rim: p² = L² + k² - 2 L k cos phi.
    """
    size = WHOLE.size.replace(lock_clearance_mm=0.0, lock_edge_mm=None, wheel_bore_mm=30.0)
    spec = WHOLE.replace(size=size.replace(wheel_keyway="DIN 6885-1"))
    calm, held = (Strength(build(spec.with_("load.dwell_torque_Nm", T))) for T in (None, 300.0))
    _, parts = sized(build(spec))
    k, p, L = parts.lock, parts.rim, 250.0
    force = 300e3 / (L * math.sin(math.acos((L * L + k * k - p * p) / (2.0 * L * k))))
    most = math.hypot(1.5 * 0.040 * force, 300.0)
    assert held["strength.wheel_shaft.moment_Nm"] == pytest.approx(most, rel=1e-9)
    assert held["strength.wheel_shaft.at_deg"] == pytest.approx(67.5)
    # DIN 6885-1 for 30 mm: 8 x 7, of which 4 mm in the shaft; 18 mm long, as the wheel is thick
    pressure = 2.0 * 300e3 / (30.0 * 3.0 * 18.0)
    assert held["strength.wheel_key.pressure_MPa"] == pytest.approx(pressure, rel=1e-12)
    assert calm["strength.wheel_shaft.moment_Nm"] < 0.2 * most
    bent = 1.5 * 0.030 * force  # the crank's shaft, which the force does not turn
    assert held["strength.crank_shaft.moment_Nm"] == pytest.approx(bent, rel=1e-9)


def test_horns_that_are_no_slender_beams_are_said():
    """A locking disc of 40 mm leaves horns of 1.09 times that at the mouth; of 60 mm, less."""
    turret = str(DESIGNS / "turret.toml")
    (said,) = design.load(turret, ["size.lock_radius_mm=40"]).strength.warnings()
    assert said.name == "stout-horns"
    assert "1.09 times their recess's radius" in said
    assert not [*design.load(turret, ["size.lock_radius_mm=60"]).strength.warnings()]


@pytest.mark.parametrize("friction", [0.0, 0.1, 0.3])
def test_the_pin_bears_the_friction_along_the_wall(friction):
    """N and f N are at right angles: the cantilever of 20 mm bends under N sqrt(1 + f²)."""
    size = Size(face_width_mm=20.0, pin_mm=8.0)
    machine = build(Spec(Wheel(6), size=size, load=Load(0.1, 5.0, friction=friction)))
    force = cycle_of(machine).extremes["pin_force_N"]
    moment = max(force.max, -force.min) * math.hypot(1.0, friction) * 10.0
    gap = size.allowances.pin_gap_mm
    expected = 32.0 * moment * (1.0 + gap / 10.0) / (math.pi * 8.0**3)
    assert Strength(machine)["strength.pin.stress_MPa"] == pytest.approx(expected, rel=1e-12)
