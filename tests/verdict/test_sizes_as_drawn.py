"""Sizes that a report prints, measured on the outlines that are cut."""

import math

import pytest
import repo
from drawing_witness import vertices
from words import load

from geneva_cli.geometry.shapes import Circle
from geneva_cli.parts.outlines.wheel_circles import wheel_circles
from geneva_cli.parts.parts import parts_of
from geneva_cli.parts.projection import outlines_of
from geneva_cli.verdict.report.parts_report import cut_sizes
from geneva_cli.verdict.report.sizes_report import sizes

pytestmark = pytest.mark.usefixtures("made_once")
CHORD = 1e-4  # mm, of the polylines that stand for outlines
CLOSE = 1e-3  # mm: curved walls are known to 2e-6 of L, here up to 420 mm
FLAT = [file.stem for file in repo.wheels() if "spherical" not in file.read_text()]
GIVEN = {
    "a given rim": "[wheel]\nz = 6\n[size]\nwheel_radius_mm = 82\nslot_clearance_mm = 0.1\n",
    "a given opening": "[wheel]\nz = 6\ngearing = 'internal'\n[size]\nwheel_radius_mm = 93\n",
    "given steps and rim": "[wheel]\nz = 6\nsteps_deg = [50, 70]\n[size]\nwheel_radius_mm = 89\n",
}


def far(contour):
    """The distances of a contour's points from its axis."""
    return [math.hypot(*p) for p in vertices(contour, CHORD)]


def about_axis(shapes, layer):
    """The diameter of a drawing's hole about its axis, 0 without one."""
    holes = [s for s in shapes if isinstance(s, Circle) and s.layer == layer]
    return max((2.0 * s.radius for s in holes if s.centre == (0.0, 0.0)), default=0.0)


@pytest.fixture
def model(name, tmp_path):
    """The parts of a design, or of one of those above."""
    file = repo.DESIGNS / f"{name}.toml"
    if name in GIVEN:
        file = tmp_path / "spec.toml"
        file.write_text(GIVEN[name])
    return parts_of(load(str(file)))


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", [*FLAT, *GIVEN])
def test_printed_sizes_are_those_of_the_outlines(model):
    found, size, part = model.outlines, sizes(model), cut_sizes(model)
    low, high = min(far(found.wheel)), max(far(found.wheel))
    inside = found.assembly.sign < 0.0
    rim, end = (low, high) if inside else (high, low)
    printed = [size[f"{key}_radius_mm"] for key in ("wheel", "rim")]
    assert printed[not inside] is None
    assert printed[inside] == part["rim_radius_mm"] == pytest.approx(rim, abs=CLOSE)
    assert part["slot_end_radius_mm"] == pytest.approx(end, abs=CLOSE)
    # half a slot's width beyond the roller's centre, and the gap behind it
    beyond = abs(size["slot_bottom_radius_mm"] - end) - 0.5 * size["slot_width_mm"]
    assert -CLOSE <= beyond <= found.sizes.slot_bottom + CLOSE
    reach = max((r for contour in found.crank for r in far(contour)), default=0.0)
    assert part["lock_radius_mm"] == pytest.approx(reach, abs=CLOSE)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", [*FLAT, *GIVEN])
def test_printed_bores_and_rollers_are_those_drawn(model):
    found, size, part = model.outlines, sizes(model), cut_sizes(model)
    circles, shapes = (
        wheel_circles(found.assembly, found.sizes),
        outlines_of(model.flat.crank_without_arm.part),
    )
    assert part["wheel_bore_mm"] == about_axis(circles, "BORE")
    assert part["crank_bore_mm"] == about_axis(shapes, "BORE")
    rollers = [s for s in shapes if s.layer == "ROLLER"]
    if rollers:  # and their pins
        assert max(s.radius for s in rollers) == size["roller_radius_mm"]
        radius = math.hypot(*rollers[0].centre)
        assert size["crank_radius_mm"] == pytest.approx(radius, rel=1e-12)
