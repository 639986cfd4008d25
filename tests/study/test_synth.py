"""From a wish to machines: closed forms, the sources' tables, specs, parts that can be built."""

import json
import math

import mpmath
import pytest
from sampling import some
from searched import searched
from typer.testing import CliRunner
from words import Drive, Spec, Wheel, load
from words import Keys as _keys

from geneva_cli import GearSector
from geneva_cli.cli.app import app
from geneva_cli.drives.crank import Crank
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.errors import GenevaError
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec as MachineSpec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import worst
from geneva_cli.motion.timing import timings
from geneva_cli.motion.wheels.external import External
from geneva_cli.study.synth.families import straight_slots as closed
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.suiting import USUAL, with_roller
from geneva_cli.study.synth.synth_search import MachineRow, rows, search
from geneva_cli.study.synth.synth_table import built, chosen, commented, synthesis_table
from geneva_cli.verdict.checks import checks

pytestmark = pytest.mark.usefixtures("few_four_bars")
GEARINGS = ("external", "internal")
COSTS = ("velocity_max", "acceleration_max", "acceleration_entry", "jerk_max", "power_max")


def candidates(**options):
    """The machines of a wish."""
    return [row.cells for row in searched(**options)[1]]


# joints so near to the crank that there are few four-bars, whose search takes the longest: for what
# is asked of plain cranks
NEAR = "0.1"


def plain(found):
    """The plain cranks between parallel shafts, with radial slots."""
    keys = ("law", "axes_deg", "offset_mm")
    return [w for w in found if w["drive"] == "crank" and not any(w[key] for key in keys)]


def costs(candidate):
    return tuple(candidate[name] for name in COSTS)


def written(target, found, number):
    """A row as a spec, without turning its parts."""
    spec, candidate, *_ = found[number - 1]
    return commented(target, number, MachineRow(spec, candidate))


def run(*words):
    return CliRunner().invoke(app, ["synth", *words], prog_name="geneva")


def natural(z, gearing):
    return 180.0 + (360.0 / z if gearing == "internal" else -360.0 / z)


# Closed forms


@pytest.mark.parametrize("gearing", GEARINGS)
@pytest.mark.parametrize("x", [-0.95, -0.6, -0.1, 0.05, 0.6, 0.95])
def test_a_drive_before_the_crank_is_found_again(gearing, x):
    """Of elliptical gears a negative eccentricity is the quick phase."""
    for z in (3, 5, 6, 12, 24):
        for kind, keys, form in (
            ("side-crank", (x,), closed.side_crank),
            ("elliptical-gears", phased(x), closed.eccentricity),
        ):
            machine = build(Spec(Wheel(z, gearing), Drive(kind), _keys(kind, *keys)))
            found = form(natural(z, gearing), machine.engagements[0].motion_deg)
            assert found == pytest.approx(x, rel=1e-12), (kind, z)


def phased(e):
    """A signed eccentricity as the keys of a spec: its size and its phase."""
    return abs(e), "quick" if e < 0.0 else "slow"


# The sources' tables


@pytest.mark.sampled(8)
@pytest.mark.parametrize(("z", "most"), [(3, 5), (4, 3), (5, 3), (6, 2), (7, 2), (12, 2), (24, 2)])
def test_rollers_up_to_the_strict_bound(z, most):
    found = candidates(z=str(z), cycle="1", external=True, space=NEAR)
    assert sorted(w["rollers"] for w in plain(found)) == list(range(1, most + 1))
    for candidate in plain(found):
        assert candidate["tau"] == pytest.approx(
            candidate["rollers"] * (z - 2) / (2 * z), rel=1e-13
        )
        assert candidate["n_rpm"] == pytest.approx(60.0 / candidate["rollers"])
    with pytest.raises(GenevaError, match=f"at most {most}"):
        candidates(z=str(z), cycle="1", external=True, rollers=most + 1)


# Costs


WISHES = [
    {"motion_deg": "180", "z": "6", "law": "all"},
    {"z": "6", "cycle": "2"},
    {"z": "8", "cycle": "1.5", "motion_s": "0.7", "law": "all"},
    {"subject_to": ["acceleration.max <= 0.5"], "z": "5"},
]


@pytest.mark.long
@pytest.mark.parametrize("options", WISHES, ids=str)
def test_every_row_as_a_spec_is_the_row(options, tmp_path):
    target, found_rows = searched(**options)
    for number, (_, candidate, *_) in enumerate(found_rows, 1):
        file = tmp_path / f"{number}.toml"
        file.write_text(written(target, found_rows, number), encoding="utf-8")
        machine = load(str(file))
        # the machine is chosen by its motion; the sizes of its parts come after that
        failing = [c for c in checks(machine, parts=False) if not c.passes]
        stands = candidate["parts"] is None or not candidate["parts"].startswith("no")
        # a search samples the walls: what lies between is left to the turn
        assert not stands or all(c.value < 1.1 * c.limit for c in failing), (candidate, failing)
        assert {c.name for c in failing} <= {"undercut_mm", "groove_pressure_deg"}, candidate
        found, time, spec = worst(machine), timings(machine)[0], machine.spec
        peaks = found.velocity.max, found.acceleration.max, found.jerk.max, found.power.max
        wanted = (*peaks[:2], found.ends.acceleration_entry, *peaks[2:])
        assert costs(candidate) == pytest.approx(wanted, rel=1e-12, abs=1e-15)
        shown = [candidate[name] for name in ("ratio", "motion_deg", "dwell_deg", "tau", "k")]
        times = [machine.ratio, time.motion_deg, time.dwell_deg, time.tau, time.k]
        assert shown == pytest.approx(times, rel=1e-12)
        named = [candidate[name] for name in ("z", "gearing", "rollers")]
        assert named == [spec.wheel.z, spec.wheel.NAME, spec.drive.rollers]
        if target.timed:
            assert candidate["n_rpm"] == spec.drive.n_rpm
            size = candidate["acceleration_max"] * (candidate["n_rpm"] * math.pi / 30.0) ** 2
            assert candidate["acceleration_max_rad_s2"] == pytest.approx(size, rel=1e-14)
            assert time.cycle_s == pytest.approx(float(options["cycle"]), rel=1e-12)
            moved = float(options.get("motion_s", time.motion_s))
            assert time.motion_s == pytest.approx(moved, rel=1e-12)


# Refusals


@pytest.mark.long
@pytest.mark.parametrize(
    ("options", "wants"),
    [
        ({}, ["no requirement", "--tau", "--subject-to"]),
        (
            {"tau": "0.3", "motion_deg": "240"},
            ["--tau 0.3", "--motion-deg 240", "below 360 deg does so"],
        ),
        ({"tau": "1.2"}, ["--tau 1.2", "below 1"]),
        ({"motion_deg": "200", "rollers": 2}, ["--motion-deg 200", "2 rollers", "below 180 deg"]),
        ({"tau": "0.3", "sort": "-jerk.max"}, ["--sort -jerk.max", "min:FIELD or max:FIELD"]),
        (
            {"z": "6", "cycle": "1", "motion_s": "1"},
            ["--motion-s 1 with --cycle 1", "below 360 deg"],
        ),
        (
            {"dwell_deg": "100..", "motion_deg": "90..", "rollers": 2},
            ["100..", "no motion of 2 rollers"],
        ),
        (
            {"tau": "0.3", "subject_to": ["dwell_s >= 0.8", "timing.dwell_s <= 0.7"]},
            ["nothing is both", "timing.dwell_s <= 0.7"],
        ),
        (
            {"tau": "0.3", "z": "6", "subject_to": ["pin_force_N.max <= 9"]},
            ["pin_force_N.max: nothing resists the wheel", "--from SPEC"],
        ),
        ({"z": "6", "cycle": "1", "rollers": 3}, ["3 rollers", "at most 2"]),
        ({"tau": "0.3", "law": "modified-sin"}, ["--law", '"modified-sine"']),
        (
            {"subject_to": ["acceleration.max <= 0.1"], "z": "3", "internal": True},
            ["nearest 0.321833"],
        ),
    ],
    ids=str,
)
def test_refusals(options, wants):
    with pytest.raises(GenevaError) as said:
        candidates(**options)
    for text in wants:
        assert text in str(said.value)


# The command


@pytest.mark.long
def test_write(tmp_path):
    file = tmp_path / "spec.toml"
    words = ["--motion-deg", "180", "--z", "6", "--external"]
    rows = json.loads(run(*words, "--check", "0", "--format", "json").stdout)["rows"]
    (row,) = [r for r in rows if r["A"]]
    assert run(*words, "--write", str(row["no"]), "-o", str(file)).exit_code == 0
    assert load(str(file)).spec.drive == SideCrank(A=row["A"])
    assert run(*words, "--write", str(row["no"])).stdout == file.read_text(encoding="utf-8")
    text = file.read_text(encoding="utf-8")
    assert "# number of slots" in text
    assert "tau = 0.5" in text


# What is listed


def test_the_angle_of_the_shafts_in_50_digits():
    with mpmath.workdps(50):
        for z, motion in ((3, 60.01), (6, 150.0), (9, 219.9), (4, 269.9)):
            a, b = mpmath.radians(motion) / 2, mpmath.pi / z
            # the motion's own condition: tan(th) = tan(S) cos(a) with sin(th) = sin(S) sin(b)
            S = mpmath.acos(mpmath.cot(b) * mpmath.cot(a))
            th = mpmath.asin(mpmath.sin(S) * mpmath.sin(b))
            assert abs(mpmath.tan(th) - mpmath.tan(S) * mpmath.cos(a)) < 1e-40 * abs(mpmath.tan(S))
            angle = closed.axes(z, motion)
            # near parallel shafts the angle is the root of a difference, which doubles its error
            assert angle == pytest.approx(float(mpmath.degrees(S)), rel=1e-11)


# Turned, written, checked and exported, as `fuzz.py synth` does with random requirements


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("options", "number"),
    [
        ({"z": "8", "cycle": "1.5", "motion_s": "0.7", "external": True}, 7),
        ({"dwell_s": "0.8..", "cycle": "1.5", "z": "8", "motion_deg": "..100"}, 1),
    ],
    ids=str,
)
def test_a_row_that_says_yes_passes_check_and_is_cut(options, number, tmp_path):
    target = read_target(**options)
    found = search(target)
    assert found[number - 1].cells["parts"] == "maybe"  # nobody has turned it yet
    made, text = chosen(target, found, number)
    assert made.trouble == ""
    file, wheel = tmp_path / "spec.toml", tmp_path / "wheel.dxf"
    file.write_text(text, encoding="utf-8")
    assert not [c for c in checks(load(str(file))) if c.passes is False]
    words = ["profile", str(file), "--part", "wheel", "-o", str(wheel)]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    assert wheel.stat().st_size > 1000


@pytest.mark.long
def test_where_a_cycle_is_asked_for_rows_are_ranked_by_time():
    """Issue: 2.7121 at 1440 rpm is 61,672 rad/s2, and came before 5,103 of several rollers.

    A law's peak is C_a step/t², so the longest motion in the cycle is the gentlest, whatever the
    rollers: all of it but a hundredth, with the modified sine's C_a = 4 pi²/(4 + pi).
    """
    table = synthesis_table(read_target(z="4", cycle="1/24", motion_deg="..90"), 0)
    rows = table.to_rows()
    rates = [row["acceleration_max_rad_s2"] for row in rows]
    assert all(a <= b * (1.0 + 1e-11) for a, b in zip(rates, rates[1:], strict=False))
    C_a, motion_s = 4.0 * math.pi**2 / (4.0 + math.pi), 0.99 / 24.0
    assert rates[0] == pytest.approx(C_a * 0.5 * math.pi / motion_s**2, rel=1e-9)
    assert any(row["acceleration_max"] < rows[0]["acceleration_max"] for row in rows)


CURVED = {"external": True, "rollers": 1}


def curved(found):
    """The rows with curved slots, the gentlest first."""
    return [row for row in found if row.cells["law"] and row.cells["drive"] == "crank"]


@pytest.mark.long
@pytest.mark.parametrize("z", [6, 8, 11])
def test_the_longest_motion_is_the_longest_that_may_be_built(z):
    """No longer motion of a dense sweep has parts that may be built."""
    target = read_target(motion_deg="100..200", z=str(z), **CURVED)
    other = curved(search(target))[0]
    assert other.cells["parts"] == "maybe"
    assert other.cells["motion_deg"] < 199.0
    # a 1024th of the range is how near the search goes
    found = other.cells["motion_deg"] + 100.0 / 1024.0
    natural, steps = 180.0 - 360.0 / z, some(300, 60)
    for k in range(steps + 1):
        alpha0 = natural - (found + (200.0 - found) * k / steps)
        spec = other.spec.replace(motion=Motion(ModifiedSine(), alpha0_deg=alpha0, ratio="matched"))
        spec = spec.with_("size.roller_radius_mm", None)
        (row,) = rows(target, [spec])
        assert row.trouble, alpha0


MENDED = [  # what is found to fail with the usual roller, and the roller that mends it, mm
    (lambda: GearSector(sector_deg=33.0), External(21), "rollers_apart_mm", 3.0),
    (lambda: Crank(rollers=2), External(21, offset_mm=10.0), "gap_mm", 3.0),
]


@pytest.mark.long
@pytest.mark.parametrize("drive, wheel, name, radius", MENDED, ids=["gear-sector", "two rollers"])
def test_the_first_roller_that_passes_every_check_is_taken(drive, wheel, name, radius):
    """As trying one after the other has it, with all their checks."""
    spec = MachineSpec(wheel, drive())
    assert name in [c.name for c in checks(build(spec)) if c.passes is False]
    L = build(spec).center_distance_mm
    sized = (with_roller(spec, 0.01 * percent * L) for percent in USUAL)
    first = next(s for s in sized if all(c.passes is not False for c in checks(build(s))))
    assert built(spec) == (first, "")
    assert first.size.roller_radius_mm == radius


DIAL = """[wheel]
z = 8
[drive]
n_rpm = 40
[load]
inertia_kgm2 = 0.8
torque_Nm = 12
"""


def listed(tmp_path, *options):
    spec = tmp_path / "dial.toml"
    spec.write_text(DIAL)
    wanted = ["--from", str(spec), "--dwell-s", "1.2..", "--rollers", "1", "--external"]
    said = CliRunner().invoke(app, ["synth", *wanted, *options, "--format", "csv"])
    assert said.exit_code == 0
    head, *lines = [line.split(",") for line in said.stdout.splitlines()]
    places = [head.index(name) for name in ("drive", "law", "parts")]
    return [tuple(line[i] for i in places) for line in lines]


@pytest.mark.long
def test_a_search_marks_a_machine_that_is_not_driven(tmp_path):
    """The curved slots of a modified sine over 72 degrees drive during 15.7 % of the motion."""
    found = listed(tmp_path, "--check", "5")
    assert ("crank", "modified-sine", "no: driven_fraction") in found
    assert ("cam", "modified-sine", "yes") in found  # straight slots drive any law


@pytest.mark.long
def test_buildable_rows_are_driven(tmp_path):
    found = listed(tmp_path, "--buildable", "--check", "1")
    assert found == [("cam", "modified-sine", "yes")]
