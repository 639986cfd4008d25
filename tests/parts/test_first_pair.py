"""The first of two wheels in series: the plain machine that it is, on the second's crank shaft."""

import pytest
import repo

from geneva_cli import Design, External, Size, load
from geneva_cli.curves.mass import mass_properties
from geneva_cli.curves.plates import plates
from geneva_cli.curves.shapes import Circle
from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError


@pytest.fixture(scope="module")
def pair():
    design = load(str(repo.DESIGNS / "geneva-pair.toml"))
    return design, design.drawn(0.001, "first-wheel")


def bore(drawing):
    (found,) = (
        s.radius
        for s in drawing.shapes
        if isinstance(s, Circle) and s.layer == "BORE" and s.centre == (0.0, 0.0)
    )
    return found


def test_it_is_a_plain_wheel_and_turns(pair):
    """Its outline is that of a machine of one wheel, which a whole turn shows to be free."""
    design, model = pair
    first = design.spec.drive
    L = first.first_distance_mm or design.mechanism.center_distance_mm
    plain = Design(
        External(first.first_z),
        size=Size(L, design.mechanism.roller_radius_mm, lock_radius_mm=model.outlines.sizes.lock),
    )
    assert design.drawing("first-wheel", of=model).shapes[0] == plain.drawing("wheel").shapes[0]
    assert design.judge(model) == ("", [])


def test_its_shafts_are_those_of_the_second_crank_and_of_the_first_link(pair):
    design, model = pair
    second = PartsModel(design.mechanism)
    assert bore(design.drawing("first-wheel", of=model)) == bore(design.drawing("crank", of=second))
    links = design.drawing("links", of=second)
    (link,) = (plate for plate in plates(links.solid) if plate.name == "first crank")
    shaft = next(hole for hole in link.holes if hole.centre[0] == 0.0)
    assert bore(design.drawing("first-crank", of=model)) == shaft.radius


def test_it_is_in_the_list_below_the_second_cranks_arm(pair):
    design, model = pair
    rows = {row["name"]: row for row in design.part_table("parts").to_rows()}
    for name, part in (("first wheel", "first-wheel"), ("first locking disc", "first-crank")):
        row, drawing = rows[name], design.drawing(part, of=model)
        plate = next(p for p in plates(drawing.solid) if p.layer in ("WHEEL", "CRANK"))
        assert row["mass_kg"] == mass_properties(plate, 7850.0).mass_kg
        # in the plane of the first crank's roller, between the arm and that crank
        roller = rows["first crank's roller"]
        assert (row["z_low_mm"], row["z_high_mm"]) == (roller["z_low_mm"], roller["z_high_mm"])
        assert row["z_high_mm"] == rows["arm"]["z_low_mm"]
        assert row["z_low_mm"] == rows["first crank"]["z_high_mm"]


def test_one_wheel_has_no_first():
    with pytest.raises(GenevaError, match='kind = "crank" has one wheel; geneva-pair has two'):
        Design(External(6)).drawing("first-wheel")
