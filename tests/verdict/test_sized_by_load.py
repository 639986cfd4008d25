"""Default sizes under a load: stresses by other formulas, and no default beyond its steel.

The witnesses compute a stress in another way than the program: from the stress tensor and its
principal stresses, by numerical integration over a section, from the series of a twisted rectangle.
"""

import math
import random

import mpmath
import numpy as np
import pytest
from sampling import some
from strength_checks import HORNS, PARTS, rows

from geneva_cli import Crank, Design, External, Internal, NoncircularGears, SideCrank
from geneva_cli.errors import GenevaError
from geneva_cli.loads.strength.part_loads import part_loads
from geneva_cli.loads.strength.pin_arm_key import (
    ArmDimensions,
    KeyDimensions,
    arm_stress_MPa,
    key_stress,
    least_size_mm,
    shear_allowed_MPa,
    thick,
    torsion_MPa,
)
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.machine_sizes import sized
from geneva_cli.parts.outlines.cut_outlines import cut_arcs, cut_lock, drawn
from geneva_cli.parts.sized_by_load import stressed
from geneva_cli.spec.defaults import DIN_6885_1, wheel_material
from geneva_cli.spec.tables import Load, Shaft, Size, WheelMaterial

STRENGTH = PARTS + HORNS


def test_the_default_steel():
    """C45+N, 275 MPa up to 250 mm (EN 10083-2); 0.6 and 0.3 of it, 3/4 of that at a keyway."""
    steel = wheel_material(Spec(External(6)))
    assert steel.allowed_MPa == pytest.approx(0.6 * 275.0, rel=1e-15)
    assert shear_allowed_MPa(Shaft()) == pytest.approx(0.3 * 275.0, rel=1e-15)
    assert shear_allowed_MPa(Shaft(), True) == pytest.approx(0.75 * 0.3 * 275.0, rel=1e-15)
    # the code's other bound: 0.36 and 0.18 of at least 560 MPa of tensile strength
    assert steel.allowed_MPa < 0.36 * 560.0
    assert shear_allowed_MPa(Shaft()) < 0.18 * 560.0
    # acrylic has no default; a value of the spec is always taken
    acrylic = WheelMaterial(youngs_modulus_GPa=3.2)
    assert math.isinf(wheel_material(Spec(External(6), material_wheel=acrylic)).allowed_MPa)
    own = acrylic.replace(stress_max_MPa=9.0)
    assert wheel_material(Spec(External(6), material_wheel=own)).allowed_MPa == 9.0


@pytest.mark.parametrize(("wide", "high"), [(10.0, 10.0), (30.0, 10.0), (8.0, 40.0), (200.0, 5.0)])
def test_a_twisted_rectangle_by_its_series(wide, high):
    """Saint-Venant's series, in the middle of the longer side; the program's is within 0.3 %."""
    a, b = max(wide, high), min(wide, high)
    with mpmath.workdps(30):
        odd = [2 * n + 1 for n in range(200)]
        k1 = 1 - 8 / mpmath.pi**2 * sum(
            1 / (n * n * mpmath.cosh(n * mpmath.pi * a / (2 * b))) for n in odd
        )
        k = (
            1
            - 192
            * b
            / (mpmath.pi**5 * a)
            * sum(mpmath.tanh(n * mpmath.pi * a / (2 * b)) / mpmath.mpf(n) ** 5 for n in odd)
        ) / 3
        shear = 1000 * k1 / (k * a * b * b)
    found = torsion_MPa(np.array(1000.0), np.array(wide), np.array(high))
    assert float(found) == pytest.approx(float(shear), rel=3e-3)


def test_an_arm_under_a_force_from_all_directions():
    """The force in 181 directions at 101 sections: bending by Navier, twist by Timoshenko.

    The arm narrows from hub to eye; its holes are as small as if there were none.
    """
    R, hub, eye, bored, hole, h, c = 60.0, 16.0, 8.0, 0.02, 0.01, 10.0, 12.0
    dims = ArmDimensions(R, hub, eye, bored, hole, h, c)
    F = 700.0
    bound = float(arm_stress_MPa(dims, F))
    worst = 0.0
    for x in np.linspace(hole, R - bored, 101):
        w = 2.0 * (eye + (hub - eye) * x / R)
        area, across, along = w * h, h * w**3 / 12.0, w * h**3 / 12.0
        for beta in np.linspace(0.0, math.pi / 2.0, 181):
            push, pull = F * math.cos(beta), F * math.sin(beta)
            normal = push * x * (w / 2.0) / across + pull * c * (h / 2.0) / along + pull / area
            # Timoshenko's 3 + 1.8 t/w is within 4 % of the series
            long, short = max(w, h), min(w, h)
            shear = push * c * (3.0 + 1.8 * short / long) / (long * short**2)
            worst = max(worst, math.sqrt(normal**2 + 3.0 * shear**2))
    assert worst <= bound == pytest.approx(worst, rel=0.04)


def test_an_arm_bears_the_wheel_alone_behind_gears_and_coulisses():
    """What turns the crank pushes on its shaft, or on a part beside the arm, and not on the arm.

    The same motion by a side-crank of any length and by gears gives the same arm the same stress:
    that of the force on the roller, N sqrt(1 + f²), at the greatest N of 7,201 positions.
    """
    size = Size(face_width_mm=8.0, arm_bore_mm=15.0, arm_hub_mm=22.0, arm_eye_mm=11.0)
    size = size.replace(roller_radius_mm=5.0, pin_mm=5.0, arm_thickness_mm=9.0)
    load = Load(inertia_kgm2=0.05, torque_Nm=3.0, friction=0.1)
    for drive in (
        SideCrank(A=0.3, n_rpm=160.0, input_crank_mm=20.0),
        SideCrank(A=0.3, n_rpm=160.0, input_crank_mm=200.0),
        NoncircularGears(A=0.3, n_rpm=160.0),
    ):
        design = Design(External(5), drive, size=size, load=load)
        rows = design.load_cycle(7201).to_dict()
        force = np.abs(rows["pin_force_N"]).max() * math.sqrt(1.0 + 0.1**2)
        # crank radius, hub, eye, bore, pin's hole, thickness; from mid-roller to mid-arm
        R = 100.0 * math.sin(math.pi / 5.0)
        dims = (R, 11.0, 5.5, 7.5, 2.5, 9.0, 0.5 * (8.0 + 9.0))
        stress = float(arm_stress_MPa(ArmDimensions(*dims), force))
        # a peak between two of the positions, 0.05 degrees apart, is flat to 1e-5
        assert design.strength["strength.arm.stress_MPa"] == pytest.approx(stress, rel=1e-5)


def test_the_least_thickness_of_an_arm_has_the_allowed_stress():
    dims = ArmDimensions(60.0, 16.0, 8.0, 10.0, 4.0, 10.0, 12.0)
    force, allowed = np.array([300.0, 3000.0, 3e7]), np.array([165.0] * 3)
    least = least_size_mm(lambda h: arm_stress_MPa(thick(dims, h), force) <= allowed, 10.0)
    for F, h in zip(force[:2], least[:2], strict=True):
        other = dims._replace(thickness=np.asarray(h), offset=np.asarray(7.0 + h / 2.0))
        # 50 halvings from 320 mm leave 3e-13
        assert float(arm_stress_MPa(other, F)) == pytest.approx(165.0, rel=1e-10)
    assert math.isinf(least[2])  # 32 times as thick is not enough


def test_a_key_by_hand():
    """50 N m on a shaft of 20 mm, key 6 x 6 x 25: 5 kN on 2.5 x 25 mm² and 6 x 25 mm²."""
    key = KeyDimensions(20.0, 6.0, 6.0 - 3.5, 25.0)
    pressed, sheared, least = key_stress(key, np.asarray(50.0), np.asarray(165.0), np.asarray(82.5))
    assert float(pressed) == pytest.approx(80.0, rel=1e-15)
    assert float(sheared) == pytest.approx(100.0 / 3.0, rel=1e-15)
    assert float(least) == pytest.approx(80.0 / 165.0 * 25.0, rel=1e-15)
    # of all keys of the standard the pressure is at least twice the shear, so it governs
    assert all(row.width >= 2.0 * (row.height - row.in_shaft) for row in DIN_6885_1)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("seed", range(8))
def test_no_default_passes_beyond_its_steel(seed):
    """Machines over decades of size and load: what passes has stresses below the steel's.

    The pin, the shafts by the greatest force and torque apart, and the key are computed again
    here. Loads add no other failure: walls and gaps of loaded defaults stay those of a machine.
    """
    draw = random.Random(seed)
    for _ in range(some(40, 8)):
        wheel = draw.choice((External, External, Internal))(draw.randint(3, 16))
        drive = draw.choice((Crank(), Crank(rollers=2), SideCrank(A=draw.uniform(-0.4, 0.7))))
        keyway = draw.choice((None, "DIN 6885-1"))
        L = 10.0 ** draw.uniform(1.3, 3.2)
        size = Size(center_distance_mm=L, crank_keyway=keyway)
        load = Load(
            torque_Nm=10.0 ** draw.uniform(-3.0, 4.0),
            inertia_kgm2=draw.choice((0.0, 10.0 ** draw.uniform(-6.0, 1.0))),
        )
        spec = Spec(wheel, drive, size=size)
        try:
            before = rows(spec)
        except GenevaError:  # rollers that jam
            continue
        after = rows(spec.replace(load=load))
        machine = build(spec.replace(load=load))
        flat = sized(machine)
        if flat is None or "parts" in after:
            continue
        parts, loads = stressed(*flat), part_loads(machine).of(0)
        pin_N, crank_Nm = loads.pin_N, loads.crank_Nm
        checked = {name: after[name] for name in STRENGTH if name in after}
        assert "pin_stress_MPa" in checked
        pin_MPa = 16.0 * pin_N * parts.contact / (math.pi * parts.pin**3)
        assert (pin_MPa <= 165.0 * (1.0 + 1e-9)) >= bool(checked["pin_stress_MPa"].passes)
        d = parts.crank_shaft.diameter
        twisted = 16e3 * crank_Nm / (math.pi * d**3)  # less than with bending
        if checked["crank_shaft_stress_MPa"].passes:
            assert twisted <= (61.875 if keyway else 82.5) * (1.0 + 1e-9)
        if "crank_key_pressure_MPa" in checked and checked["crank_key_pressure_MPa"].passes:
            row = next(row for row in DIN_6885_1 if row.above < d <= row.up_to)
            side = (row.height - row.in_shaft) * flat[1].arm_thickness
            assert 2e3 * crank_Nm / d / side <= 165.0 * (1.0 + 1e-9)
        strong = all(check.passes for check in checked.values())
        fails = {name for name, check in after.items() if check.passes is False}
        others = fails - set(STRENGTH) - {n for n, c in before.items() if c.passes is False}
        assert not (strong and others), others


@pytest.mark.usefixtures("no_advice")
def test_the_spec_s_sizes_stay():
    """A size of the spec is never changed; its check fails instead."""
    size = Size(wheel_bore_mm=8.0, crank_bore_mm=8.0, pin_mm=3.0, arm_thickness_mm=5.0)
    size = size.replace(wheel_thickness_mm=6.0)
    spec = Spec(External(6), size=size, load=Load(torque_Nm=40.0))
    _, s = sized(build(spec))
    assert (s.wheel_bore, s.crank_bore, s.pin) == (4.0, 4.0, 1.5)
    assert (s.wheel_thickness, s.arm_thickness) == (6.0, 5.0)
    found = rows(spec)
    assert not any(found[name].passes for name in ("pin_stress_MPa", "arm_stress_MPa"))
    assert Design.of(spec).checks


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    "wheel",
    [
        External(6, offset_mm=5.0),
        External(6, steps_deg=(66.0, 54.0)),
        External(4, steps_deg=(48.3, 131.7)),  # whose relief is cut 8 degrees wider
    ],
)
@pytest.mark.parametrize("clearance", [0.0, 0.1])
def test_sizes_are_for_the_lock_as_it_is_cut(wheel, clearance):
    """The corners that leave the most play, from the mouths' formulas, are those of the drawing.

    They are the lower ones: the recess, of one radius about the crank's axis, ends sooner there.
    """
    size = Size(lock_clearance_mm=clearance, slot_clearance_mm=0.02)
    load = Load(inertia_kgm2=1e-3, dwell_torque_Nm=10.0)
    flat = sized(build(Spec(wheel, size=size, load=load)))
    parts, lock = drawn(*flat), cut_lock(*flat)
    recesses = cut_arcs([parts.wheel], lock.recess, lock.L, 1e-6)
    corners = [math.hypot(*end) for one in recesses for end in (one.start, one.end)]
    # 1e-9 mm: a tenth of a digit of a drawing
    assert lock.corner == pytest.approx(min(corners), abs=1e-9)
    assert lock.corner < flat[1].rim - 1.0
    cut = [abs(arc.sweep) for arc in cut_arcs(parts.crank, lock.lock, 0.0, 1e-6)]
    assert lock.half == pytest.approx(0.5 * min(cut), abs=1e-12)


@pytest.mark.long
@pytest.mark.parametrize(("roller_mm", "z"), [(12.0, 3), (16.0, 4), (16.0, 5)])
def test_shafts_are_for_the_locking_sector_that_the_wheel_leaves(roller_mm, z):
    """An internal wheel narrows its locking sector, so that the same torque needs more force.

    The end of the sector bears on the recess, in the direction of its radius. So the force passes
    the wheel's axis at L sin(half the sector), which the drawn arcs give.
    """
    size = Size(center_distance_mm=100.0, roller_radius_mm=roller_mm)
    spec = Spec(Internal(z), size=size, load=Load(torque_Nm=1.0, dwell_torque_Nm=100.0))
    machine = build(spec)
    flat = sized(machine)
    arcs = list(cut_arcs(drawn(*flat).crank, flat[1].lock, 0.0, 1e-6))
    sweep = min(abs(arc.sweep) for arc in arcs)
    dwell = math.radians(machine.dwell_deg(0))
    assert sweep < 0.95 * dwell  # else the case would show nothing
    force = 100.0 / (0.1 * math.sin(0.5 * sweep))
    parts = stressed(*flat)
    bending = 1.5 * force * 1e-3 * parts.crank_shaft.overhang
    stress = 16e3 * bending / (math.pi * parts.crank_shaft.diameter**3)
    assert stress <= 82.5
    assert rows(spec)["crank_shaft_stress_MPa"].passes
