"""Drawings of wheel and crank: how they turn, against the ideal machine, and what is refused."""

import functools
import json
import math

import ezdxf
import numpy as np
import pytest
import repo
from drawn_wheels import disc, drawn_wheel
from sampling import some
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.design import Design, load
from geneva_cli.errors import GenevaError
from geneva_cli.extras.outline.checks import lag_deg
from geneva_cli.extras.outline.contact import contacts
from geneva_cli.extras.outline.pictures import drawn_scene
from geneva_cli.extras.outline.turning import struck_by, turned
from geneva_cli.geometry.shapes import Arc, Line, closed, placed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.loads.strength.pin_arm_key import stiffness_N_mm
from geneva_cli.output import draw
from geneva_cli.spec.workshops import Stock

PLAIN = """[wheel]
z = 6
{wheel}
[size]
center_distance_mm = 60
roller_radius_mm = 3
lock_radius_mm = 0
"""


LAGS = {"internal-z6": 0.041, "turret": 0.019, "side-crank-z6": 0.036}


def designs(first, *others):
    """Names of designs, of which `make test` takes the first."""
    return [first, *(pytest.param(name, marks=pytest.mark.long) for name in others)]


@pytest.fixture(scope="module")
def exported(tmp_path_factory):
    """A design of ours whose parts are read back from their own drawings, the same each time."""
    folder = tmp_path_factory.mktemp("exported")
    return functools.cache(lambda name, clearance: own_drawings(folder, name, clearance))


def own_drawings(folder, name, clearance):
    clearances = [f"size.{key}={clearance}" for key in ("slot_clearance_mm", "lock_clearance_mm")]
    design = load(str(repo.DESIGNS / f"{name}.toml"), clearances)
    files = {part: str(folder / f"{name}-{clearance}-{part}.dxf") for part in ("wheel", "crank")}
    for part, file in files.items():
        draw(design.drawing(part), file)
    settings = [f"outline.{part}={file}" for part, file in files.items()]
    return load(str(repo.DESIGNS / f"{name}.toml"), settings)


def written(folder, contour, name="wheel.dxf"):
    file = folder / name
    draw(Drawing("", (contour,)), str(file))
    return file


def spec(folder, file, wheel=""):
    path = folder / "spec.toml"
    path.write_text(PLAIN.format(wheel=wheel) + f'[outline]\nwheel = "{file}"\n')
    return load(str(path))


def failing(design):
    return [check.name for check in design.checks if check.passes is False]


@pytest.mark.parametrize("name", designs("side-crank-z6", "turret", "internal-z6"))
def test_our_own_drawings_turn_as_the_ideal_machine(name, exported):
    design = exported(name, 0)
    assert failing(design) == []
    result = turned(design.mechanism)
    turn = result.senses[0].first
    (passage,) = result.machine.assembly.motions
    at = np.degrees(turn.crank)
    moving = (at > passage.entry) & (at < passage.exit)
    ideal = np.degrees(passage.engagement.motion(at[moving] - passage.mid, 0).derivatives()[0])
    assert np.abs(ideal - np.degrees(turn.wheel[moving])).max() < 1e-6
    assert abs(math.degrees(lag_deg(result))) < 1e-4


@pytest.mark.parametrize("name", designs(*LAGS))
def test_a_clearance_makes_the_wheel_lag(name, exported):
    """In its slot the wheel lags by the clearance over the roller's distance, at most at the mouth.

    Its plays are those that the checks of our own parts measure.
    """
    design = exported(name, 0.05)
    result = turned(design.mechanism)
    assert result.turns
    assert lag_deg(result) == pytest.approx(LAGS[name], abs=5e-4)
    plain = load(str(repo.DESIGNS / f"{name}.toml"))
    for key in ("slot_clearance_mm", "lock_clearance_mm"):
        plain = plain.with_(f"size.{key}", 0.05)
    plays = {check.name: check.value for check in plain.checks}
    rest = math.degrees(result.rest.high - result.rest.low)
    assert 0.5 * rest == pytest.approx(plays["dwell_play_deg"], abs=1e-3)


def test_an_entry_is_over_the_speed_of_the_input(exported):
    """A side-crank turns the crank at another rate: here by differences of its own formula."""
    design = exported("side-crank-z6", 0.05)
    result = turned(design.mechanism)
    struck = struck_by(design.mechanism, result)
    after = struck.crank + 1e-6
    touching = contacts(result.machine.free, np.array([after]), np.array([struck.wheel]))
    velocity = float(touching.motion(np.array([after]))[1][0])
    at, step = math.degrees(struck.crank), 1e-4
    to_input = turned(design.mechanism).machine.assembly.to_input
    rate = 2.0 * step / (to_input(at + step) - to_input(at - step))
    (row,) = [check for check in design.checks if check.name == "entry_velocity_max"]
    assert abs(rate - 1.0) > 0.2
    assert row.value == pytest.approx(abs(velocity) * rate, rel=1e-4)


@pytest.mark.parametrize("name", designs("side-crank-z6", "turret"))
def test_peaks_of_our_own_drawings_are_those_of_the_formulas(name, exported):
    own, ideal = (
        exported(name, 0).peaks_table,
        load(str(repo.DESIGNS / f"{name}.toml")).peaks,
    )
    for quantity in ("velocity", "acceleration", "jerk"):
        known = getattr(ideal, quantity)
        assert own[f"{quantity}.max"] == pytest.approx(known.max, rel=1e-6)
        assert own[f"{quantity}.at_deg"] == pytest.approx(known.at_deg, abs=1e-3)


def test_motion_is_that_of_the_formulas(exported):
    own = exported("side-crank-z6", 0).motion(13)
    ideal = load(str(repo.DESIGNS / "side-crank-z6.toml")).motion(13)
    inside = slice(1, 7)  # neither end, where the slack decides
    for name in ("wheel_deg", "velocity", "acceleration", "jerk"):
        assert own[name][inside] == pytest.approx(ideal[name][inside], abs=2e-6)


def test_a_wheel_that_jams_says_where(tmp_path):
    """Its rim is too short, which is no matter of slack; and nothing holds it in its dwell."""
    design = spec(tmp_path, written(tmp_path, drawn_wheel(6, 30.0, 3.25, 33.0)))
    first, slack, hold = design.checks[:3]
    assert (hold.name, hold.passes) == ("dwell_hold", False)
    assert (slack.name, slack.value, slack.passes) == ("turning_slack_mm", None, False)
    assert "would not turn with 1.2 mm less" in slack.why
    assert (first.name, first.value, first.passes) == ("turns", 0.0, False)
    assert abs(first.at_deg) == pytest.approx(27.12675, abs=1e-4)
    assert "the corner of the wheel" in first.why
    with pytest.raises(GenevaError, match="does not turn"):
        _ = design.peaks_table


@pytest.mark.parametrize(("half", "needed"), [(2.97, 0.03), (3.0, 1e-6)])
def test_a_slot_that_is_too_narrow_says_by_how_much(half, needed, tmp_path):
    """A roller of 3 mm in a slot of twice 2.97 mm overlaps each wall by 0.03 mm."""
    file = written(tmp_path, drawn_wheel(6, 30.0, half, math.hypot(60.0 * math.sqrt(0.75), 3.0)))
    design = spec(tmp_path, file, 'held_by = "pin"')
    slack = next(check for check in design.checks if check.name == "turning_slack_mm")
    assert needed <= slack.value * (1.0 + 1e-9)
    assert slack.value <= 1.02 * needed
    assert slack.passes == (half == 3.0)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("at_mm", [33.0, 38.21, 47.773])
def test_a_burr_in_a_slot_is_not_missed_between_two_steps(at_mm, tmp_path):
    """One of 0.002 mm touches a roller of 3 mm for 0.22 mm of its way: a step is 0.13 mm at most.

    In a slot without clearance there is no place for it.
    """
    rim = math.hypot(60.0 * math.sqrt(0.75), 3.0)
    pieces = []
    for k, piece in enumerate(drawn_wheel(6, 30.0, 3.0, rim).segments):
        if k != 2:  # the upper side of the slot along x, outwards
            pieces.append(piece)
            continue
        points = [piece.start, (at_mm - 0.002, 3.0), (at_mm, 2.998), (at_mm + 0.002, 3.0)]
        pieces += [Line(p, q) for p, q in zip(points, [*points[1:], piece.end], strict=True)]
    file = written(tmp_path, closed("WHEEL", pieces))
    design = spec(tmp_path, file, 'held_by = "pin"')
    assert turned(design.mechanism).machine.free.slack == 1e-6
    assert not turned(design.mechanism).turns
    assert turned(design.with_("outline.slack_mm", 0.002).mechanism).turns


def test_a_wheel_off_its_axis_says_where_its_centre_is(tmp_path):
    moved = placed(drawn_wheel(6, 30.0, 3.25, 45.0), (12.0, -7.0))
    design = spec(tmp_path, written(tmp_path, moved), 'held_by = "pin"')
    said = r"centre is at \(12, -7\), but its axis is the drawing's origin"
    with pytest.raises(GenevaError, match=said):
        _ = design.checks


@pytest.fixture(scope="module")
def struck(tmp_path_factory):
    """A machine whose rim is too short."""
    folder = tmp_path_factory.mktemp("struck")
    file = written(folder, drawn_wheel(6, 30.0, 3.25, 40.0))
    return spec(folder, file, 'held_by = "detent"')


def test_an_impact_is_told_with_the_rim_that_would_avoid_it(struck):
    entry = next(c for c in struck.checks if c.name == "entry_velocity_max")
    assert entry.value == pytest.approx(1.16207, abs=1e-4)
    assert abs(entry.at_deg) == pytest.approx(41.332, abs=1e-3)
    assert "rim is at 40 mm, and must reach 52.05" in entry.why  # the root of L² cos² b + r²


def test_an_impact_has_a_force_where_an_inertia_is_given(tmp_path):
    """The moment is I dw; pin and wall store I dw² / 2 under the force, by Palmgren's numbers."""
    file = written(tmp_path, drawn_wheel(6, 30.0, 3.25, 40.0))
    plain = spec(tmp_path, file, 'held_by = "detent"')
    assert plain.peaks_table["impact.force_N"] is None
    heavy = plain.with_("load.inertia_kgm2", 0.01).with_("size.face_width_mm", 6.0)
    heavy = heavy.with_("size.pin_mm", 3.0)
    found, w = heavy.peaks_table, math.tau  # 60 rpm
    dw = found["impact.jump"] * w
    assert found["impact.jump"] == pytest.approx(1.16207, abs=1e-5)
    assert found["impact.moment_Nms"] == pytest.approx(0.01 * dw, rel=1e-12)
    force = found["impact.force_N"]
    bend = 1.0 / stiffness_N_mm(heavy.spec.size, 6.0, 3.0, Stock().youngs_modulus_GPa)
    press = 3.84e-5 / 6.0**0.8
    stored = press * force**1.9 * 0.9 / 1.9 + 0.5 * bend * force**2
    assert stored == pytest.approx(0.5 * 0.01 * dw**2 * 1e3, rel=1e-6)
    entry = next(c for c in heavy.checks if c.name == "entry_velocity_max")
    assert f"the roller strikes it with {force:.4g} N" in entry.why


def test_rollers_have_no_corners(tmp_path):
    """Of two rollers the second enters as the first: the greatest power is that of the formulas."""
    rim = math.sqrt(100.0**2 * 0.75 + 5.0**2)
    wheel = written(tmp_path, drawn_wheel(6, 50.0, 5.0, rim))
    crank = tmp_path / "crank.dxf"
    draw(Drawing("", (disc(50.0, 0.0, 5.0), disc(-50.0, 0.0, 5.0))), str(crank))
    design = spec(tmp_path, wheel, 'held_by = "pin"\n[drive]\nrollers = 2')
    design = design.with_("size.center_distance_mm", 100.0).with_("size.roller_radius_mm", 5.0)
    found = design.with_("outline.crank", str(crank))
    at = [120.0 + off for off in (-1e-9, -1e-12, 0.0, 1e-12, 1e-9)]
    assert np.abs(found.motion(at_deg=at)["acceleration"]).max() < 6.0
    power = found.peaks_table["power.max"]
    assert power == pytest.approx(design.peaks.power.max, rel=1e-6)


def test_an_overlap_in_the_dwell_says_where(tmp_path):
    """Our disc of 25 mm reaches to 35 mm of the wheel's axis, 10 mm below the rim."""
    design = spec(tmp_path, written(tmp_path, drawn_wheel(6, 30.0, 3.25, 45.0)))
    design = design.with_("size.lock_radius_mm", 25.0)
    (turns,) = [check for check in design.checks if check.name == "turns"]
    assert "10 mm inside the wheel at (30.3109, 17.5)" in turns.why
    assert "lock_radius_mm = 0" in turns.why


def test_frames_are_turned_and_mirrored(tmp_path):
    contour = drawn_wheel(6, 30.0, 3.25, 45.0)
    flat = spec(tmp_path, written(tmp_path, contour), 'held_by = "pin"')
    index = turned(flat.mechanism).senses[0].first.gained
    off = flat.with_("outline.wheel_turn_deg", 30.0)
    assert failing(off)[0] == "turns"
    for key, value in some([("wheel_turn_deg", 60.0), ("mirror", "wheel")], [("mirror", "wheel")]):
        design = flat.with_(f"outline.{key}", value)
        again = turned(design.mechanism)
        assert again.senses[0].first.gained == pytest.approx(index, abs=1e-9)


def test_the_motion_of_a_drawn_wheel_on_a_carrier_has_that_from_the_ground(exported):
    """The columns of our own outlines are those of the formulas."""
    drawn = exported("wandering-hours", 0).motion(samples=9).to_dict()
    ideal = load(str(repo.DESIGNS / "wandering-hours.toml")).motion(samples=9).to_dict()
    assert [*drawn] == [*ideal]
    for name in ("absolute_deg", "absolute_velocity"):
        assert drawn[name] == pytest.approx(ideal[name], abs=1e-3)


def test_a_missing_part_and_a_far_one_are_refused(tmp_path):
    with pytest.raises(GenevaError, match=r"none\.dxf: cannot read: No such file"):
        _ = spec(tmp_path, "none.dxf").checks
    small = written(tmp_path, drawn_wheel(6, 3.0, 0.325, 4.5))
    (turns,) = [check for check in spec(tmp_path, small).checks if check.name == "turns"]
    assert "goes on by 0° only: no roller finds a slot; check [size]" in turns.why
    around = spec(tmp_path, written(tmp_path, disc(0.0, 0.0, 100.0)), 'held_by = "pin"')
    (turns,) = [check for check in around.checks if check.name == "turns"]
    assert "parts overlap" in turns.why  # the crank lies wholly in the plate


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("four-bar-z4", "do not go round the crank's axis"),
        ("spherical-z6", '"spherical": an outline is turned in one plane'),
    ],
)
def test_other_machines_have_no_outlines(name, why, tmp_path):
    with pytest.raises(GenevaError, match=why):
        _ = load(str(repo.DESIGNS / f"{name}.toml"), [f"outline.wheel={tmp_path}/w.dxf"]).checks


def test_rounded_arcs_get_the_slack_that_their_gaps_tell(tmp_path):
    """Numbers with four decimals: walls overlap by half of the last, and ends of arcs miss."""
    document, z, r = ezdxf.new("R2000", units=4), 6, 3.0
    rim = math.hypot(60.0 * math.sqrt(0.75), r)
    for piece in drawn_wheel(z, 30.0, r, rim).segments:
        if isinstance(piece, Arc):
            (x, y), radius = piece.centre, piece.radius
            ends = [
                round(math.degrees(math.atan2(p[1] - y, p[0] - x)), 4)
                for p in (piece.start, piece.end)
            ]
            ends = ends if piece.bulge > 0.0 else ends[::-1]
            document.modelspace().add_arc((round(x, 4), round(y, 4)), round(radius, 4), *ends)
        else:
            p, q = ([round(v, 4) for v in point] for point in (piece.start, piece.end))
            document.modelspace().add_line(p, q)
    document.saveas(tmp_path / "rounded.dxf")
    design = spec(tmp_path, "rounded.dxf", 'held_by = "pin"')
    assert 1e-5 < turned(design.mechanism).machine.free.slack < 5e-4
    assert "turns" not in failing(design)
    assert "turns" in failing(design.with_("outline.slack_mm", 1e-6))


def test_a_page_turns_the_drawings_and_marks_their_contact(struck):
    shown = drawn_scene(struck)
    wheel, crank = shown.bodies
    assert wheel.angle.gain == pytest.approx(turned(struck.mechanism).senses[0].first.gained)
    assert len(wheel.shapes) == len(crank.shapes) == 1
    (push,) = shown.pushes
    for t, x, y in zip(push.at, push.x, push.y, strict=True):
        pin = complex(60.0, 0.0) - 30.0 * complex(*cos_sin(shown.start_deg + t, -1.0))
        assert abs(complex(x, y) - pin) == pytest.approx(3.0, abs=2e-4)  # on the roller
    assert [phase.moves for phase in shown.states] == [False, True, False]


def cos_sin(deg, way):
    return math.cos(math.radians(deg)), way * math.sin(math.radians(deg))


def test_a_drawing_lies_over_our_own(struck, tmp_path):
    both = struck.drawing_over(struck.drawing("wheel"))
    for ending in ("dxf", "svg"):
        draw(both, str(tmp_path / f"both.{ending}"))
        assert (tmp_path / f"both.{ending}").stat().st_size > 1000
    assert [shape.layer for shape in both.shapes].count("OUTLINE") == 1
    assert struck.drawing("wheel").shapes == both.shapes[:-1]


@pytest.fixture
def built(tmp_path):
    path = tmp_path / "built.toml"
    path.write_text(
        "[wheel]\nz = 6\n[size]\ncenter_distance_mm = 50\ncrank_radius_mm = 25.217025694\n"
        "roller_radius_mm = 2.5\nslot_clearance_mm = 0.1\nlock_clearance_mm = 0.1\n"
        "lock_radius_mm = 20\nwheel_radius_mm = 40\n"
    )
    return str(path)


def test_a_machine_as_built_is_struck_where_its_parts_meet(built):
    """The values that the same parts gave by hand: roller in clearance, disc in its recess."""
    first = turned(load(built).mechanism)
    struck = struck_by(load(built).mechanism, first)
    assert struck.impact.jump == pytest.approx(0.101386, abs=1e-6)
    assert math.degrees(struck.crank) == pytest.approx(-50.905, abs=1e-3)
    assert math.degrees(first.senses[0].first.gained) == pytest.approx(59.871, abs=1e-3)
    (row,) = [check for check in load(built).checks if check.name == "strike_velocity"]
    assert row.value == pytest.approx(0.101386, abs=1e-6)
    assert (row.limit, row.passes) == (0.01, False)


@pytest.mark.long
def test_a_machine_as_built_without_clearance_jams_or_is_struck_at_its_mouth(built):
    tight = ["size.slot_clearance_mm=0", "size.lock_clearance_mm=0"]
    assert not turned(load(built, tight).mechanism).turns
    free = turned(load(built, [*tight, "size.lock_radius_mm=0"]).mechanism)
    turn = free.senses[0].first
    assert math.degrees(turn.pushes[0].begin) == pytest.approx(-53.482, abs=1e-3)


def test_what_takes_the_ideal_machine_says_so(tmp_path):
    file = written(tmp_path, drawn_wheel(6, 30.0, 3.25, 45.0))
    design = spec(tmp_path, file, 'held_by = "pin"').with_("load.inertia_kgm2", 0.01)
    told = (
        design.warnings,
        design.loads_table.to_dict()["warnings"],
        design.vibration(5.0).to_dict()["warnings"],
        design.report.table.to_dict()["warnings"],
    )
    (note,) = design.ideal_notes
    assert all(note in [str(text) for text in notes] for notes in told)
    assert note not in design.check_warnings
    plain = Design.of(design.spec.replace(outline=type(design.spec.outline)()))
    assert design.loads_table.to_dict()["pin_force_N.max"] == plain.loads["pin_force_N"].max
    assert not plain.ideal_notes
    with pytest.raises(GenevaError, match="our own parts, which drawings"):
        design.tolerance()
    pytest.importorskip("flint")
    said = CliRunner().invoke(app, ["peaks", str(tmp_path / "spec.toml"), "--certify"])
    assert "parts and certificates are those of the ideal machine" in said.stderr


def test_a_drawing_is_named_by_options_too(tmp_path):
    file = written(tmp_path, drawn_wheel(6, 30.0, 3.25, 33.0))
    (tmp_path / "spec.toml").write_text(PLAIN.format(wheel='held_by = "pin"'))
    words = ["check", str(tmp_path / "spec.toml"), "--wheel", str(file), "--format", "json"]
    result = CliRunner().invoke(app, [*words, "--slack", "0.00001"])
    assert result.exit_code == 1
    rows = json.loads(result.stdout)["rows"]
    assert rows[0]["check"] == "turns"
    assert rows[0]["passes"] is False
