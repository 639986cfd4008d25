"""Drawings of wheel and crank: how they turn, against the ideal machine, and what is refused."""

import math

import ezdxf
import numpy as np
import pytest
import repo
from drawn_wheels import drawn_wheel

from geneva_cli.design import Design, load
from geneva_cli.errors import GenevaError
from geneva_cli.extras.outline.checks import lag_deg
from geneva_cli.extras.outline.turning import turned
from geneva_cli.geometry.shapes import Arc
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output import draw

PLAIN = """[wheel]
z = 6
{wheel}
[size]
center_distance_mm = 60
roller_radius_mm = 3
lock_radius_mm = 0
"""


def exported(folder, name, clearance):
    """A design of ours whose parts are read back from their own drawings."""
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


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["turret", "internal-z6", "side-crank-z6"])
def test_our_own_drawings_turn_as_the_ideal_machine(name, tmp_path):
    design = exported(tmp_path, name, 0)
    assert failing(design) == []
    result = turned(design.mechanism)
    turn = result.senses[0].first
    (passage,) = result.machine.assembly.motions
    at = np.degrees(turn.crank)
    moving = (at > passage.entry) & (at < passage.exit)
    ideal = np.degrees(passage.engagement.motion(at[moving] - passage.mid, 0).arrays()[0])
    assert np.abs(ideal - np.degrees(turn.wheel[moving])).max() < 1e-6
    assert abs(math.degrees(lag_deg(result))) < 1e-4


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("name", "lag"), [("turret", 0.019), ("internal-z6", 0.041), ("side-crank-z6", 0.036)]
)
def test_a_clearance_makes_the_wheel_lag(name, lag, tmp_path):
    """In its slot the wheel lags by the clearance over the roller's distance, at most at the mouth.

    Its plays are those that the checks of our own parts measure.
    """
    design = exported(tmp_path, name, 0.05)
    result = turned(design.mechanism)
    assert result.turns
    assert lag_deg(result) == pytest.approx(lag, abs=5e-4)
    plain = load(str(repo.DESIGNS / f"{name}.toml"))
    for key in ("slot_clearance_mm", "lock_clearance_mm"):
        plain = plain.with_(f"size.{key}", 0.05)
    plays = {check.name: check.value for check in plain.checks}
    rest = math.degrees(result.rest.high - result.rest.low)
    assert 0.5 * rest == pytest.approx(plays["dwell_play_deg"], abs=1e-3)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["turret", "side-crank-z6"])
def test_peaks_of_our_own_drawings_are_those_of_the_formulas(name, tmp_path):
    own, ideal = (
        exported(tmp_path, name, 0).peaks_table,
        load(str(repo.DESIGNS / f"{name}.toml")).peaks,
    )
    for quantity in ("velocity", "acceleration", "jerk"):
        known = getattr(ideal, quantity)
        assert own[f"{quantity}.max"] == pytest.approx(known.max, rel=1e-6)
        assert own[f"{quantity}.at_deg"] == pytest.approx(known.at_deg, abs=1e-3)


def test_motion_is_that_of_the_formulas(tmp_path):
    own = exported(tmp_path, "side-crank-z6", 0).motion(13)
    ideal = load(str(repo.DESIGNS / "side-crank-z6.toml")).motion(13)
    inside = slice(1, 7)  # neither end, where the slack decides
    for name in ("wheel_deg", "velocity", "acceleration", "jerk"):
        assert own[name][inside] == pytest.approx(ideal[name][inside], abs=2e-6)


def test_a_wheel_that_jams_says_where(tmp_path):
    design = spec(tmp_path, written(tmp_path, drawn_wheel(6, 30.0, 3.25, 33.0)), 'held_by = "pin"')
    first = design.checks[0]
    assert (first.name, first.value, first.passes) == ("turns", 0.0, False)
    assert abs(first.at_deg) == pytest.approx(27.12675, abs=1e-4)
    assert "the corner of the wheel" in first.why
    with pytest.raises(GenevaError, match="does not turn"):
        _ = design.peaks_table


def test_an_impact_is_told_with_the_rim_that_would_avoid_it(tmp_path):
    file = written(tmp_path, drawn_wheel(6, 30.0, 3.25, 40.0))
    design = spec(tmp_path, file, 'held_by = "detent"')
    entry = next(c for c in design.checks if c.name == "entry_velocity_max")
    assert entry.value == pytest.approx(1.16207, abs=1e-4)
    assert abs(entry.at_deg) == pytest.approx(41.332, abs=1e-3)
    assert "rim is at 40 mm, and must reach 52.05" in entry.why  # the root of L² cos² b + r²


def test_without_a_lock_or_detent_nothing_holds(tmp_path):
    design = spec(tmp_path, written(tmp_path, drawn_wheel(6, 30.0, 3.25, 45.0)))
    assert "dwell_hold" in failing(design)


def test_frames_are_turned_and_mirrored(tmp_path):
    contour = drawn_wheel(6, 30.0, 3.25, 45.0)
    flat = spec(tmp_path, written(tmp_path, contour), 'held_by = "pin"')
    index = turned(flat.mechanism).senses[0].first.gained
    off = flat.with_("outline.wheel_turn_deg", 30.0)
    assert failing(off)[0] == "turns"
    for key, value in (("wheel_turn_deg", 60.0), ("mirror", "wheel")):
        design = flat.with_(f"outline.{key}", value)
        again = turned(design.mechanism)
        assert again.senses[0].first.gained == pytest.approx(index, abs=1e-9)


def test_a_missing_part_and_a_far_one_are_refused(tmp_path):
    with pytest.raises(GenevaError, match=r"none\.dxf: cannot read: No such file"):
        _ = spec(tmp_path, "none.dxf").checks
    small = written(tmp_path, drawn_wheel(6, 3.0, 0.325, 4.5))
    with pytest.raises(GenevaError, match="no part reaches the other"):
        _ = spec(tmp_path, small).checks


def test_four_bars_carry_their_rollers_round_no_crank(tmp_path):
    design = load(str(repo.DESIGNS / "four-bar-z4.toml"), [f"outline.wheel={tmp_path}/w.dxf"])
    with pytest.raises(GenevaError, match="do not go round the crank's axis"):
        _ = design.checks


@pytest.mark.long
def test_a_thousand_lines_turn_like_arcs(tmp_path):
    """Facets of a wheel and its crank: the answer is that of the arcs, within the sagittas."""
    document = ezdxf.new("R2000", units=4)
    contour = drawn_wheel(6, 30.0, 3.25, 45.0)
    points = []
    for piece in contour.segments:
        count = 60 if isinstance(piece, Arc) else 1
        from geneva_cli.geometry.measure import at

        points += [at(piece, k / count) for k in range(count)]
    for p, q in zip(points, [*points[1:], points[0]], strict=True):
        document.modelspace().add_line(p, q)
    document.saveas(tmp_path / "lines.dxf")
    arcs = spec(tmp_path, written(tmp_path, contour), 'held_by = "pin"')
    lines = spec(tmp_path, "lines.dxf", 'held_by = "pin"')
    one, two = (turned(design.mechanism) for design in (arcs, lines))
    assert two.machine.free.slack == 1e-3
    assert two.turns
    assert two.senses[0].first.gained == pytest.approx(one.senses[0].first.gained, abs=1e-4)


def test_a_design_in_python_takes_drawings_too(tmp_path):
    from geneva_cli import External, Outline, Size

    file = written(tmp_path, drawn_wheel(6, 30.0, 3.25, 45.0))
    design = Design(
        External(6, held_by="pin"),
        size=Size(60.0, 3.0, lock_radius_mm=0.0),
        outline=Outline(wheel=str(file)),
    )
    assert design.checks[0].passes
