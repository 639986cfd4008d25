"""Clearances by the way in which parts are made."""

import math

import numpy as np
import pytest
from mpmath import mp
from repo import DESIGNS

from geneva_cli import Design, Size, load
from geneva_cli.spec.workshops import WORKSHOPS, deviation_mm
from geneva_cli.verdict.checks import Check


def test_a_mill_keeps_the_nominal_sizes() -> None:
    """There are reamers and bars for them: only the gap along the axis is not 0."""
    assert WORKSHOPS["mill"].allowances[:5] == (0.0, 0.0, 0.0, 0.0, 0.2)


# Class 1 of ISO 9013:2017, by the greatest thickness: nominal sizes of 3, 10, 35 and 125 mm and
# more, as modulusmetal.com/iso-9013-thermal-cutting-dimensional-tolerances prints them.
CLASS_1 = """
1    0.10 0.10 0.20 0.20
3.15 0.15 0.20 0.25 0.25
6.3  0.20 0.25 0.25 0.30
10   0.25 0.30 0.30 0.35
15   0.30 0.35 0.40 0.45
20   0.40 0.40 0.45 0.55
25   0.45 0.50 0.60 0.70
32   -    0.70 0.70 0.80
50   -    0.7  0.70 0.8
100  -    1.3  1.3  1.4
"""


def test_deviations_of_a_cut_are_the_standards() -> None:
    """At the ends of each range, one by one and all at once."""
    rows = [line.split() for line in CLASS_1.split("\n") if line]
    cases = [
        (float(most) - inside, size, float(value))
        for most, *values in rows
        for value, low, high in zip(
            values, (3, 10, 35, 125), (9.9, 34.9, 124.9, 314.9), strict=True
        )
        for inside in (0.0, 0.01)
        for size in (low, high)
        if value != "-"
    ]
    assert [deviation_mm(thick, size) for thick, size, _ in cases] == [v for *_, v in cases]
    thick, size, value = np.array(cases).T
    assert (deviation_mm(thick, size) == value).all()
    assert deviation_mm(10.001, 20.0) == 0.35


def test_a_lasers_clearances_follow_its_plates() -> None:
    """Each mate is off by its deviation, half of it a side: wheel 18 mm, disc 6, arm 3."""
    size = Size(
        250.0,
        12.0,
        process="laser",
        wheel_thickness_mm=18.0,
        lock_thickness_mm=6.0,
        arm_thickness_mm=3.0,
        lock_radius_mm=70.0,
        pin_mm=8.0,
    )
    assert size.allowances[:3] == (0.4, 0.5 * (0.55 + 0.3), 0.15)
    assert Size(250.0, 12.0, process="laser").allowances[:3] == (0.5, 0.7, 0.5)  # 25 mm
    thin = Size(250.0, 12.0, process="laser", face_width_mm=3.0)
    assert thin.allowances[:3] == (0.2, 0.25, 0.2)


def turret(*settings: str) -> Design:
    return load(str(DESIGNS / "turret.toml"), settings)


def named(design: Design) -> dict[str, Check]:
    return {check.name: check for check in design.checks}


@pytest.mark.long
def test_limits_of_a_laser() -> None:
    """40 mm is no plate for it, and a slot of 25.4 mm narrow for that; both have a remedy."""
    thick = named(turret("size.process=laser", "size.wheel_thickness_mm=40"))
    assert (thick["cut_plate_mm"].value, thick["cut_plate_mm"].limit) == (40.0, 32.0)
    assert thick["cut_plate_mm"].passes is False
    slot = thick["cut_slot_mm"]
    assert (slot.value, slot.limit) == (pytest.approx(24.0 + 1.4), pytest.approx(28.0))
    assert slot.passes is False
    assert "wheel_thickness_mm = 32" in slot.nearest
    usual = named(turret("size.process=laser"))
    assert usual["cut_plate_mm"].passes
    assert usual["cut_slot_mm"].passes
    assert not {"cut_plate_mm", "cut_slot_mm"} & {
        *named(turret()),
        *named(turret("size.process=mill")),
    }


@pytest.mark.long
def test_holes_that_a_laser_cuts_badly_are_named() -> None:
    """Plates of 18 mm need 12.6 mm: the mounting holes of 9 mm are the smallest for theirs."""
    texts = {
        text.name: str(text) for text in turret("size.process=laser", "size.lock_bolts=0").warnings
    }
    assert "frame Ø 9, " in texts["small-hole"]
    assert "make the frame at most 12.86 mm thick" in texts["small-hole"]
    thin = turret("size.process=laser", "size.face_width_mm=12", "size.lock_bolts=0").warnings
    assert "small-hole" not in {text.name for text in thin}


def sphere(*settings: str) -> Design:
    return load(str(DESIGNS / "spherical-z6.toml"), settings)


@pytest.mark.long
@pytest.mark.usefixtures("no_advice")
def test_a_laser_cuts_no_shell_from_a_plate() -> None:
    """Its shells are 8 mm thick, within 32 mm; the slots inside 2 · 76 sin(5.3/80) mm wide."""
    ball = sphere("size.process=laser")
    checks = named(ball)
    assert (checks["cut_plate_mm"].value, checks["cut_plate_mm"].limit) == (8.0, 32.0)
    # ISO 9013 gives 10 mm of slot in 8 mm ±0.25, so half of it twice is the clearance of a side
    half = (5.0 + ball.spec.size.allowances.slot_clearance_mm) / 80.0
    slot = checks["cut_slot_mm"]
    assert slot.value == pytest.approx(2.0 * 76.0 * math.sin(half), rel=1e-12)
    assert slot.limit == pytest.approx(0.7 * 8.0)
    thick = named(sphere("size.process=laser", "size.wheel_thickness_mm=40"))
    assert [thick[name].passes for name in ("cut_plate_mm", "cut_slot_mm")] == [False, False]
    for other in ("mill", "print"):
        made = sphere(f"size.process={other}")
        assert not {"cut_plate_mm", "cut_slot_mm"} & {*named(made)}


@pytest.mark.long
def test_printed_parts_are_of_pla() -> None:
    """0.36 of 22.8 MPa are 8.2. A steel roller in a PLA slot: Hertz with both, p0² = F E*/(pi b r).

    The disc is of PLA, too; what the spec sets wins; the steel of pins and shafts stays.
    """
    printed = turret("size.process=print")
    allowed = {name: check.limit for name, check in named(printed).items()}
    for name in ("horn_stress_MPa", "lock_horn_stress_MPa", "arm_stress_MPa"):
        assert allowed[name] == pytest.approx(0.36 * 22.8, abs=0.05)
    assert allowed["pin_stress_MPa"] == 165.0
    assert {allowed["wheel_shaft_stress_MPa"], allowed["crank_shaft_stress_MPa"]} == {82.5}
    steel, pla = (1 - mp.mpf("0.3") ** 2) / 210, (1 - mp.mpf("0.36") ** 2) / mp.mpf("2.4")
    size = printed.spec.size
    loads = printed.loads
    line = mp.mpf(loads["pin_force_N"].max) / size.face_width_mm
    hertz = mp.sqrt(line * 1000 / (steel + pla) / (mp.pi * printed.mechanism.roller_radius_mm))
    assert loads["contact_stress_MPa"].max == pytest.approx(float(hertz), rel=1e-12)
    own = turret("size.process=print", "material.wheel.stress_max_MPa=30")
    assert named(own)["horn_stress_MPa"].limit == 30.0
    other = turret("size.process=print", "material.wheel.youngs_modulus_GPa=3")
    assert "horn_stress_MPa" not in named(other)  # of no known strength
