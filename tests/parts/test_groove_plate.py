"""The plate with a cam's groove: against the roller that runs in it, by shapely."""

import pytest
import repo
from drawing_witness import polygon, vertices
from shapely.geometry import LineString, Point

from geneva_cli import load
from geneva_cli.drawings.parts_list import parts_list
from geneva_cli.geometry.plates import mass_properties, plates
from geneva_cli.geometry.shapes import Circle
from geneva_cli.parts.slots.groove import groove_table

SAGITTA = 1e-3  # mm, of the chords that shapely is given
OFF = 5e-3  # mm: those, the walls' own tolerance of 0.001, and shapely's arcs


@pytest.fixture(scope="module")
def cam():
    design = load(str(repo.DESIGNS / "cam-geneva.toml"))
    proof = design.parts
    return design, proof, design.drawing("groove-plate")


def test_the_roller_fills_the_groove_all_round(cam):
    _, proof, drawing = cam
    pitch = next(shape for shape in drawing.shapes if shape.layer == "PITCH")
    base, ring, island = plates(drawing.solid)
    (outer,) = (hole for hole in ring.holes if not isinstance(hole, Circle))
    groove = polygon(outer, SAGITTA).difference(polygon(island.outline, SAGITTA))
    swept = LineString(vertices(pitch, SAGITTA)).buffer(proof.outlines.sizes.half_width, 64)
    assert groove.buffer(OFF).contains(swept)
    assert swept.buffer(OFF).contains(groove)
    assert base.outline == ring.outline
    # the roller's path through the motion is that of the table
    path = LineString(vertices(pitch, SAGITTA))
    table = groove_table(cam[0].mechanism, 0.001, 181)
    for row in table.to_rows():
        assert path.distance(Point(row["x_mm"], row["y_mm"])) < OFF


def test_it_lies_about_its_roller_and_below_the_crank(cam):
    design, proof, drawing = cam
    rows = {row["name"]: row for row in parts_list(proof).to_rows()}
    roller, frame = rows["roller in the groove"], rows["frame"]
    base, ring, island = plates(drawing.solid)
    for plate in (ring, island):
        assert (plate.low, plate.high) == (roller["z_low_mm"], roller["z_high_mm"])
        assert plate.high <= rows["crank"]["z_low_mm"]
    assert frame["z_high_mm"] <= base.low < base.high == ring.low
    for plate in (base, ring, island):
        row = rows[plate.name]
        assert row["mass_kg"] == mass_properties([plate], 7850.0).mass_kg
    # the frame has its four holes, where they are in the machine
    L = design.mechanism.center_distance_mm
    held = design.drawing("frame").shapes
    for hole in ring.holes[1:]:
        at = hole.centre[0] + L, hole.centre[1]
        assert any(isinstance(s, Circle) and s.centre == pytest.approx(at) for s in held)
