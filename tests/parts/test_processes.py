"""Clearances by the way in which parts are made."""

import math
import re
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
import pytest
from mpmath import mp
from repo import DESIGNS

from geneva_cli import Design, External, Load, Size, load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Member, Plate
from geneva_cli.geometry.shapes import Circle, Point
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.shafts.fits import limits
from geneva_cli.spec.workshops import PROCESSES, deviation_mm
from geneva_cli.verdict.checks.check import Check


def test_a_mill_keeps_the_nominal_sizes() -> None:
    """There are reamers and bars for them: only the gap along the axis is not 0."""
    assert PROCESSES["mill"][:5] == (0.0, 0.0, 0.0, 0.0, 0.2)


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


def test_a_batch_has_the_clearances_of_its_designs() -> None:
    far = np.array([30.0, 100.0, 400.0])
    spec = Design(External(6), size=Size(process="laser")).spec
    batch = many(spec, {"size.center_distance_mm": far}).machine.spec.size.allowances
    for i, L in enumerate(far):
        one = Size(float(L), process="laser").allowances
        for key in ("slot_clearance_mm", "lock_clearance_mm", "press_fit_mm"):
            assert float(getattr(batch, key)[i, 0]) == getattr(one, key)


# what changes other sizes than those of the bores
SAME_REST = (
    *("size.slot_clearance_mm=0.1", "size.lock_clearance_mm=0.1", "size.press_fit_mm=0"),
    *("size.pin_gap_mm=0.3", "size.wall_min_mm=0.8"),
    *("material.wheel.youngs_modulus_GPa=210", "material.wheel.poisson_ratio=0.3"),
    *("material.wheel.density_kgm3=7850", "material.wheel.stress_max_MPa=165"),
)


PLANE = [one for one in sorted(DESIGNS.glob("*.toml")) if not one.stem.startswith("spherical")]


def turret(*settings: str) -> Design:
    return load(str(DESIGNS / "turret.toml"), settings)


def named(design: Design) -> dict[str, Check]:
    return {check.name: check for check in design.checks}


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


def test_holes_that_a_laser_cuts_badly_are_named() -> None:
    """Plates of 18 mm need 12.6 mm: the mounting holes of 9 mm are the smallest for theirs."""
    texts = {
        text.name: str(text) for text in turret("size.process=laser", "size.lock_bolts=0").warnings
    }
    assert "frame Ø 9, " in texts["small-hole"]
    assert "make the frame at most 12.86 mm thick" in texts["small-hole"]
    thin = turret("size.process=laser", "size.face_width_mm=12", "size.lock_bolts=0").warnings
    assert "small-hole" not in {text.name for text in thin}


def test_a_clearance_for_another_thickness_is_named() -> None:
    """A four-bar's centre distance, and so its plates of 11 mm, are solved for."""
    four_bar = load(str(DESIGNS / "four-bar-z4.toml"), ("size.process=laser",))
    texts = [str(text) for text in four_bar.warnings if text.name == "narrow-for-process"]
    assert len(texts) == 1
    assert "slot_clearance_mm = 0.25" in texts[0]
    assert texts[0].endswith("set slot_clearance_mm to 0.3")
    told = load(
        str(DESIGNS / "four-bar-z4.toml"), ("size.process=laser", "size.slot_clearance_mm=0.3")
    )
    assert "narrow-for-process" not in {text.name for text in told.warnings}


@pytest.mark.parametrize(
    ("process", "given", "needed"),
    [
        ("laser", "0.02", "0.35"),
        ("print", "0.02", "0.2"),
        ("laser", "0.35", ""),
        ("mill", "0", ""),
    ],
)
def test_a_clearance_below_what_the_process_holds_is_named(
    process: str, given: str, needed: str
) -> None:
    """A roller of 14 mm and its slot in a plate of 14 mm are both off by up to 0.35 mm."""
    size = Size(140.0, 7.0, process=process, slot_clearance_mm=float(given))
    texts = [str(text) for text in Design(External(6), size=size).warnings]
    assert [text.split()[-1] for text in texts if "slot_clearance_mm" in text] == [needed] * bool(
        needed
    )


@pytest.mark.usefixtures("no_advice")
def test_printed_walls_are_two_lines_of_a_nozzle() -> None:
    small = Size(20.0, process="print")
    assert {c.limit for c in Design(External(6), size=small).checks if c.name == "horn_mm"} == {0.8}
    own = small.replace(wall_min_mm=0.5)
    assert {c.limit for c in Design(External(6), size=own).checks if c.name == "horn_mm"} == {0.5}


def test_printed_parts_are_as_light_as_plastic() -> None:
    """PLA of 1240 kg/m³ in place of steel; a density of the spec wins; so on a sphere, too."""
    for design in ("turret", "spherical-z6"):
        wheels = {}
        for process, own in (("mill", ""), ("print", ""), ("print", "2700")):
            clear = ["size.slot_clearance_mm=0.1", "size.lock_clearance_mm=0.1"]
            rest = ["size.press_fit_mm=0.01", "size.shaft_fit_mm=0.02", "size.pin_gap_mm=0.2"]
            keys = [f"material.wheel.density_kgm3={own}"] if own else []
            path = str(DESIGNS / f"{design}.toml")
            settings = [f"size.process={process}", *clear, *rest, *keys]
            rows = load(path, settings).part_table("parts").to_rows()
            wheels[process + own] = next(row for row in rows if row["name"] == "wheel")
        assert wheels["print"]["density_kgm3"] == 1240.0
        assert wheels["print"]["mass_kg"] == pytest.approx(
            wheels["mill"]["mass_kg"] * 1240.0 / 7850.0, rel=1e-12
        )
        assert wheels["print2700"]["density_kgm3"] == 2700.0
    printed = turret("size.process=print")
    texts = [label.text for label in printed.sheet(0.05).texts]
    assert {"PLA", "steel", "see list"} <= {*texts}


def sphere(*settings: str) -> Design:
    return load(str(DESIGNS / "spherical-z6.toml"), settings)


@pytest.mark.usefixtures("no_advice")
def test_a_laser_cuts_no_shell_from_a_plate() -> None:
    """Its shells are 8 mm thick, within 32 mm; the slots inside 2 · 76 sin(5.3/80) mm wide."""
    ball = sphere("size.process=laser")
    checks, texts = named(ball), {text.name: str(text) for text in ball.warnings}
    assert "roll them to their cones" in texts["bent-parts"]
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
        assert "bent-parts" not in {text.name for text in made.warnings}


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


def test_default_sizes_of_a_print_hold_as_pla() -> None:
    """PLA allows a twentieth of steel's stress: the arm is thicker, and all parts hold."""
    arms = []
    for torque in (0.1, 1.0, 3.0):
        size, load_ = Size(process="print"), Load(torque_Nm=torque)
        stresses = [
            check
            for name, check in named(Design(External(6), size=size, load=load_)).items()
            if name.endswith("stress_MPa")
        ]
        assert len(stresses) == 6
        assert all(check.passes for check in stresses), (torque, stresses)
        for one in (size, size.replace(process="mill")):
            arms.append(machine_sizes(build(Spec(External(6), size=one, load=load_)))[1])
    assert [arm.arm_thickness for arm in arms[1::2]] == [10.0, 10.0, 10.0]
    assert arms[4].arm_thickness > arms[0].arm_thickness == 10.0


TEXTS = {
    None: ("8× 24 H7 (+0.021/0)", "Ø 24 g6 (-0.007/-0.02)", "Ø 40 h6 (0/-0.016)", "ISO 2768-m"),
    "mill": (
        *("8× 24 H7 (+0.021/0)", "Ø 24 g6 (-0.007/-0.02)", "Ø 40 h6 (0/-0.016)", "Ra 3.2"),
        *("Ø 40 H7 (+0.025/0)", "Ø 12 P7 (-0.011/-0.029)", "Ø 12 F7 (+0.034/+0.016)"),
    ),
    "laser": (
        *("8× 24.8 ±0.4", "Ø 24 ±0.4", "Ø 40 h6 (0/-0.016)", "Ø 40.45 ±0.45", "ISO 9013 class 1"),
        "Ø 11.6 ±0.4, drill and ream to Ø 12 P7 (-0.011/-0.029)",
    ),
    "print": ("8× 24.5", "Ø 24", "Ø 40", "Ø 40.4", "±0.2 mm"),
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("process", TEXTS)
def test_a_sheet_writes_what_the_process_holds(process: str | None) -> None:
    """Slot, roller, shaft and bore, pin, and a field of the title block; a print has no fit at all.

    The rods stay: wheel 40 mm, pin 12 mm. A cut hole of a pin is ever below it, and is reamed.
    """
    sheet = turret(*([f"size.process={process}"] if process else [])).sheet(0.05)
    texts = {label.text for label in sheet.texts}
    assert set(TEXTS[process]) <= texts
    fits = {text for text in texts if re.search(r"[A-Za-z]\d \(", text)}
    cuts = {text for text in texts if re.search(r"Ø .* ±", text)}
    assert bool(fits) == (process != "print")
    assert bool(cuts) == (process == "laser")
    said = any(text.startswith("clearance a side: ") for text in texts)
    assert said == (process in ("laser", "print"))


def test_teeth_have_the_clearance_of_the_process_on_both_sides() -> None:
    """Twice 0.25 mm, and 0.4 of a laser at 18 mm; the middle of H7/g6; a given key wins."""
    keys = {"wheel_thickness_mm": 18.0, "roller_radius_mm": 12.0}
    backlashes = [Size(process=p, **keys).allowances.gear_backlash_mm for p in PROCESSES]
    assert backlashes == [0.8, 0.02, 0.5]
    gaps = [hole - shaft for hole in limits(14.0, "H7") for shaft in limits(14.0, "g6")]
    assert 0.0005 * (min(gaps) + max(gaps)) == pytest.approx(0.02, abs=0.001)  # given to 1 um
    assert Size(process="print", gear_backlash_mm=0.1).allowances.gear_backlash_mm == 0.1
    printed = PROCESSES["print"]._asdict() | {"lock_thickness_mm": 12, "wall_min_mm": 0.8}
    left_out = "source", "gear_backlash_mm"
    spelled = [f"size.{key}={value}" for key, value in printed.items() if key not in left_out]
    drawn = [
        load(str(DESIGNS / "gear-sector.toml"), ("size.gear_module_mm=3", *more)).drawing("gears")
        for more in (["size.process=print"], [*spelled, "size.gear_backlash_mm=0.5"], spelled)
    ]
    assert drawn[0].shapes == drawn[1].shapes != drawn[2].shapes


def test_a_clearance_that_leaves_no_machine_says_whose_it_is() -> None:
    tiny = Size(process="laser", center_distance_mm=0.3)
    with pytest.raises(GenevaError, match=r"press_fit_mm = 0.075: .*; the value comes from"):
        build(Design(External(6), size=tiny).spec)


@pytest.mark.sampled(6)
@pytest.mark.parametrize("path", PLANE, ids=lambda path: path.stem)
def test_rods_stay_and_bores_widen(path: Path) -> None:
    """Printed holes about the axes of rods are 0.4 mm wider than these, or hold them tight.

    The shafts are those of the design without a process.
    """
    plain, printed = (
        load(str(path), [*keys, *SAME_REST]).parts for keys in ((), ("size.process=print",))
    )
    shafts = [sorted(one[0] for one in _rods(model, "SHAFT")) for model in (plain, printed)]
    assert shafts[1] == pytest.approx(shafts[0], abs=1e-9)  # mm, of sums of lengths
    loose = {
        round(2.0 * (hole.radius - radius), 6)
        for radius, at in _rods(printed, "SHAFT", "ROLLER")
        for hole, there in _holes(printed)
        if math.dist(at, there) < 1e-6 and abs(hole.radius - radius) < 0.5
    }
    assert loose in ({0.4}, {0.0, 0.4})


def _rods(model: Parts, *layers: str) -> Iterator[tuple[float, Point]]:
    """Yield radius and place of all plain shafts and pins of a flat machine."""
    for one in placed(model.built.members):
        plate = one.part
        if not isinstance(plate, Plate) or plate.layer not in layers or plate.holes:
            continue
        if isinstance(plate.outline, Circle):
            yield plate.outline.radius, one.at


def _holes(model: Parts) -> Iterator[tuple[Circle, Point]]:
    """Yield the round holes of all plates of a flat machine, with their places."""
    for one in placed(model.built.members):
        for hole in one.part.holes if isinstance(one.part, Plate) else ():
            if isinstance(hole, Circle):
                (x, y), c, s = hole.centre, math.cos(one.turn), math.sin(one.turn)
                yield hole, (one.at[0] + c * x - s * y, one.at[1] + s * x + c * y)


def placed(
    members: Iterable[Member], at: Point = (0.0, 0.0), turn: float = 0.0
) -> Iterator[Member]:
    """Yield the plates of members and of groups among them, in the machine's frame."""
    for one in members:
        (x, y), c, s = one.at, math.cos(turn), math.sin(turn)
        here = one._replace(at=(at[0] + c * x - s * y, at[1] + s * x + c * y), turn=turn + one.turn)
        if isinstance(one.part, Group):
            yield from placed(one.part.members, here.at, here.turn)
        else:
            yield here
