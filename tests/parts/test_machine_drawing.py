"""The machine put together: each part where it works, and no two in one place, by shapely."""

from itertools import combinations

import pytest
import repo
from drawing_witness import polygon
from shapely.affinity import rotate, translate
from shapely.geometry import Polygon

from geneva_cli import load
from geneva_cli.drawings.parts_list import parts_list
from geneva_cli.geometry.plates import Group

CHORDS = 1e-4  # mm, by which what shapely sees lies off arcs
# Of the centre distance, times it: 1e-6 along parts that touch all the way, as a pin in its hole.
# A part 0.1 mm out of place overlaps 100 mm of wall by more.
OVERLAP = 1e-4


def face_of(plate):
    holes = [polygon(hole, CHORDS).exterior for hole in plate.holes]
    return Polygon(polygon(plate.outline, CHORDS).exterior, holes).buffer(0.0)


def faces(part, at=(0.0, 0.0), turn=0.0):
    """Each plate of a part with its face where it is."""
    if not isinstance(part, Group):
        yield part, translate(rotate(face_of(part), turn, (0.0, 0.0), use_radians=True), *at)
        return
    for member in part.members:
        for plate, face in faces(member.part, member.at, member.turn):
            yield plate, translate(rotate(face, turn, (0.0, 0.0), use_radians=True), *at)


HUBS = ("wheel_hub_mm=40", "crank_hub_mm=14", "lock_thickness_mm=6", "pin_gap_mm=1")


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("geneva-pair", ()),
        ("cam-geneva", ()),
        ("slider-crank", ()),
        ("epicyclic-soft-z6", ()),
        ("four-bar-z4", ()),
        ("noncircular-gears", ()),
        ("internal-z6", ()),
        ("side-crank-z6", ()),
        ("two-pins-z4", HUBS),
    ],
)
def test_no_two_parts_are_in_one_place(name, given):
    design = load(str(repo.DESIGNS / f"{name}.toml"), [f"size.{key}" for key in given])
    L = design.mechanism.center_distance_mm
    proof = design.parts
    every = list(faces(design.drawing("assembly", 0.01).solid))
    names = {plate.name for plate, _ in every}
    assert "frame" in names
    for (one, a), (other, b) in combinations(every, 2):
        if min(one.high, other.high) - max(one.low, other.low) > 1e-9:
            assert a.intersection(b).area < OVERLAP * L, (one.name, other.name)
    rows = parts_list(proof).to_rows()
    assert names == {row["name"] for row in rows if row["row"] == "part"}


@pytest.mark.parametrize(
    ("name", "said"), [("four-bar-z4", "counterclockwise"), ("slider-crank", "clockwise")]
)
def test_the_arrow_of_a_link_crank_runs_as_the_list_says(name, said):
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    rows = design.part_table("parts").to_rows()
    assert said in [row["value"] for row in rows if row["name"] == "crank turns"]
    wheel, crank = design.drawing("assembly", 0.01).look.turns
    assert wheel.bulge > 0.0  # the wheel's own sense
    assert (crank.bulge > 0.0) == (said == "counterclockwise")
    assert crank.centre == pytest.approx((design.mechanism.center_distance_mm, 0.0))
