"""The frame: a hole for every shaft that stands, and for nothing else."""

from functools import cache

import pytest
import repo

from geneva_cli import Design, External, Spherical, load
from geneva_cli.curves.plates import plates
from geneva_cli.curves.shapes import Circle
from geneva_cli.errors import GenevaError
from geneva_cli.parts.hole_walls import least_wall
from geneva_cli.parts.sizes import wall_min

# the pivots of the parts list that stand, of each kind of drive
STANDING = {
    "turret": ["wheel axis", "crank axis"],
    "side-crank-z6": ["wheel axis", "crank axis", "input crank axis"],
    "four-bar-z4": ["wheel axis", "crank axis", "rocker axis"],
    "slider-crank": ["wheel axis", "crank axis"],
    "epicyclic-z4": ["wheel axis", "crank axis"],
    "geneva-pair": ["wheel axis", "crank axis", "first crank axis"],
    "noncircular-gears": ["wheel axis", "crank axis", "driver gear axis"],
}
MOUNTS = 4


@cache
def made(name):
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    proof = design.drawn(0.001)
    return design, proof, design.drawing("frame", of=proof)


def rows(design, row):
    table = design.part_table("parts").to_rows()
    return {one["name"]: one for one in table if one["row"] == row}


@pytest.mark.parametrize("name", STANDING)
def test_a_hole_for_every_shaft_that_stands(name):
    design, _, drawing = made(name)
    holes = [shape for shape in drawing.shapes if isinstance(shape, Circle)]
    pivots = rows(design, "pivot")
    # two screws hold a guide besides, and four a gear
    guide = {"slider-crank": 2, "epicyclic-z4": 4}.get(name, 0)
    assert len(holes) == len(STANDING[name]) + guide + MOUNTS
    for pivot, hole in zip(STANDING[name], holes, strict=False):
        at = pivots[pivot]["x_mm"], pivots[pivot]["y_mm"]
        assert hole.centre == pytest.approx(at, abs=1e-9)
    marks = [shape.segments[0] for shape in drawing.shapes if shape.layer == "CENTER"]
    middles = [(0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])) for a, b in marks[::2]]
    assert middles == [pytest.approx(hole.centre) for hole in holes]


@pytest.mark.parametrize("name", ["side-crank-z6", "slider-crank", "turret"])
def test_it_is_below_all_that_moves_and_has_walls(name):
    design, _, drawing = made(name)
    (plate,) = plates(drawing.solid)
    parts = rows(design, "part")
    own = parts.pop("frame")
    lows = [part["z_low_mm"] for name, part in parts.items() if not name.endswith("shaft")]
    assert own["z_high_mm"] == plate.high == min(lows)
    L = design.mechanism.center_distance_mm
    assert least_wall(plate.holes, plate.outline) > wall_min(design.spec.size, L)


def test_a_guide_is_screwed_on_where_its_own_holes_are():
    design, proof, drawing = made("slider-crank")
    holes = [s for s in drawing.shapes if isinstance(s, Circle)][2:4]
    bars = design.drawing("assembly", of=proof).shapes
    for hole in holes:
        assert any(
            s.centre == pytest.approx(hole.centre) and s.radius == pytest.approx(hole.radius)
            for s in bars
            if isinstance(s, Circle) and s.layer == "LINK"
        )


def test_shafts_have_the_size_of_what_they_carry():
    _, proof, drawing = made("turret")
    wheel, crank = [s.radius for s in drawing.shapes if isinstance(s, Circle)][:2]
    assert wheel == proof.found.sizes.wheel_bore
    assert crank == proof.found.sizes.crank_bore
    thick = Design(External(6)).with_("shaft.crank_diameter_mm", 30.0).drawing("frame")
    assert [s.radius for s in thick.shapes if isinstance(s, Circle)][1] == 15.0


def test_the_shafts_of_a_sphere_stand_in_no_plate():
    with pytest.raises(GenevaError, match=r"--part frame: the shafts of gearing = .* cross"):
        Design(Spherical(6)).drawing("frame")


def test_marks_stand_in_every_hole_of_any_part():
    """Also in a bore with a keyway, which is no circle, and in holes of links as they lie."""
    keyed = made("turret")[0].with_("size.wheel_keyway", "DIN 6885-1")
    wheel = keyed.drawing("wheel", centre_marks=True)
    middles = [shape.segments[0] for shape in wheel.shapes if shape.layer == "CENTER"]
    assert [line.start[1] for line in middles] == [0.0, -1.25 * keyed.parts.sizes.wheel_bore]
    design, proof, _ = made("side-crank-z6")
    links = design.drawing("links", of=proof, centre_marks=True)
    circles = {shape.centre for shape in links.shapes if isinstance(shape, Circle)}
    level = [shape.segments[0] for shape in links.shapes if shape.layer == "CENTER"][::2]
    found = sorted((0.5 * (line.start[0] + line.end[0]), line.start[1]) for line in level)
    assert found == [pytest.approx(centre) for centre in sorted(circles)]
    plain = design.drawing("links", of=proof)
    assert links.shapes[: len(plain.shapes)] == plain.shapes
    assert links.solid == plain.solid
