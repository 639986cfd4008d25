"""Every drawing shows what the solid has: loops of one are loops of the other, by shapely.

Solids are put in their places here by shapely's own rotations, and weighed by its areas.
"""

import cmath
import math

import pytest
import repo
from drawing_witness import polygon
from shapely import affinity
from test_assembles import SAGITTA

from geneva_cli import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group
from geneva_cli.geometry.shapes import Circle

DRAWN = "wheel", "crank", "arm", "links", "first-wheel", "first-crank", "frame", "groove-plate"
TOLERANCE = 0.02  # mm, of curved walls: few pieces
SAME = 1e-7  # of a length: rounding of areas and centroids
WEIGHED = 5e-3  # relative: chords 0.002 mm off arcs, in pins from 4 mm on
FLAT = sorted(
    file.stem
    for file in repo.DESIGNS.glob("*.toml")
    if "spherical" not in file.read_text(encoding="utf-8")
)
HOLED = ("size.wheel_hub_mm=24", "size.crank_hub_mm=24", "size.lock_bolts=2", "size.dial_bolts=3")


def plates(part, at=0j, turn=0.0):
    """Each plate of a part with its place and direction."""
    if isinstance(part, Group):
        for one in part.members:
            there = at + cmath.rect(1.0, turn) * complex(*one.at)
            yield from plates(one.part, there, turn + one.turn)
    else:
        yield part, at, turn


def loops_of(plate, at, turn):
    for shape in (plate.outline, *plate.holes):
        face = affinity.rotate(polygon(shape, SAGITTA), turn, (0.0, 0.0), use_radians=True)
        yield affinity.translate(face, at.real, at.imag)


def drawn_loops(drawing):
    """What is closed and no mark: a pitch circle is one only where a gear has it."""
    for shape in drawing.shapes:
        if isinstance(shape, Circle) or shape.closed:
            yield shape.layer, polygon(shape, SAGITTA)


def missing(loops, among, L):
    """The area and centroid of loops that coincide with none of some others."""

    def size(loop):
        centre = loop.centroid
        return loop.area / L, centre.x, centre.y

    known = [size(loop) for loop in among]
    return [
        one
        for one in map(size, loops)
        if not any(math.dist(one, other) < SAME * L for other in known)
    ]


def assert_drawn_as_built(design, part):
    """A part's drawing has all loops of its solids and no other; returns the drawing."""
    drawing, L = design.drawing(part, TOLERANCE), design.mechanism.center_distance_mm
    drawn = [loop for layer, loop in drawn_loops(drawing) if layer != "PITCH"]
    built = [loop for one in plates(drawing.solid) for loop in loops_of(*one)]
    assert not missing(drawn, built, L), part
    assert not missing(built, drawn, L), part
    return drawing


@pytest.mark.sampled(120)
@pytest.mark.parametrize("given", [(), HOLED], ids=["", "holed"])
@pytest.mark.parametrize("name", FLAT)
def test_drawings_show_what_the_solids_have(name, given):
    design = load(str(repo.DESIGNS / f"{name}.toml"), given)
    assert assert_machine(design) or given  # hubs and bolts do not suit every machine


def assert_machine(design):
    """Compare all drawings of a machine; return False if not all of its parts can be built."""
    try:
        drawings = {"assembly": design.drawing("assembly", TOLERANCE)}
    except GenevaError:
        return False
    rows = {
        row["name"]: row for row in design.part_table("parts").to_rows() if row["row"] == "part"
    }
    for part in DRAWN:
        try:
            drawings[part] = assert_drawn_as_built(design, part)
        except GenevaError:  # the machine has no such part
            continue
        if "first" not in part:  # those are listed with the thickness of links
            assert_weighed(drawings[part].solid, rows)
    assert len(drawings) > 3  # wheel, crank, frame
    assert_assembled(design, drawings["assembly"])
    return True


def assert_weighed(solid, rows):
    for plate, *_ in plates(solid):
        outline, *holes = (polygon(s, SAGITTA) for s in (plate.outline, *plate.holes))
        volume = plate.thickness * (outline.area - sum(hole.area for hole in holes))
        row = rows[plate.name]
        mass = 1e-9 * row["density_kgm3"] * volume
        assert row["mass_kg"] == pytest.approx(mass, rel=WEIGHED), plate.name


def assert_assembled(design, drawing):
    """The assembly draws loops of its solids alone, and the outlines of all that is cut."""
    L = design.mechanism.center_distance_mm
    parts = list(plates(drawing.solid))
    built = [loop for one in parts for loop in loops_of(*one)]
    drawn = [loop for layer, loop in drawn_loops(drawing) if layer != "PITCH"]
    assert not missing(drawn, built, L)
    cut = [
        next(loops_of(*one)) for one in parts if one[0].layer in ("WHEEL", "CRANK", "ARM", "FRAME")
    ]
    assert not missing(cut, drawn, L)
