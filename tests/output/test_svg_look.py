"""SVG to look at: lines that suit its size, plates filled, notes; and parts to cut without."""

import math
import re
from xml.etree import ElementTree

import pytest
from drawing_witness import apart, drawn_shapes, svg_path, svg_shapes
from shapely.geometry import Polygon
from words import Drive, Spec, Wheel

from geneva_cli.design import Design
from geneva_cli.geometry.plates import face, plates
from geneva_cli.output.svg import chunks
from geneva_cli.spec.tables import Size

NAME = "{http://www.w3.org/2000/svg}"


def design(L=100.0, wheel=None, rollers=1, **size):
    return Design.of(Spec(wheel or Wheel(6), Drive(rollers=rollers), size=Size(L, **size)))


@pytest.fixture(scope="module")
def assembly():
    return design().drawing("assembly", 0.01)


def root(drawing):
    return ElementTree.fromstring("".join(chunks(drawing)))


def groups(svg):
    return {g.get("id"): g for g in svg.findall(f"{NAME}g")}


def test_the_centre_distance_is_written_and_drawn(assembly):
    svg = root(assembly)
    assert "L = 100 mm" in [t.text for t in svg.iter(f"{NAME}text")]
    lines = [svg_path(p.get("d")) for p in groups(svg)["NOTES"] if not p.get("id")]
    level = [(a, b) for ((a, b, _),) in (one for one in lines if len(one) == 1)]
    assert any(
        abs(a[1] - b[1]) < 1e-9 and abs(a[0]) < 1e-8 and abs(b[0] - 100.0) < 1e-8 for a, b in level
    )


@pytest.mark.parametrize(
    ("wheel", "sense"), [(Wheel(6), -1.0), (Wheel(4, "internal"), 1.0)], ids=["out", "in"]
)
def test_arrows_turn_as_the_machine_does(wheel, sense):
    """The wheel turns counterclockwise; outside the crank turns against it, inside with it."""
    own, crank = design(wheel=wheel).drawing("assembly", 0.01).look.turns
    assert own.bulge > 0.0
    assert math.copysign(1.0, crank.bulge) == sense
    assert crank.centre == pytest.approx((100.0, 0.0), abs=1e-9)


def polygon(pieces):
    return Polygon([point(i / 96) for _, _, point in pieces for i in range(96)])


def test_a_fill_is_what_the_plates_are(assembly):
    """Areas of outlines less their holes, by shapely, of what the file fills."""
    svg = root(assembly)
    paths = list(groups(svg)["FILL"])
    assert groups(svg)["FILL"].get("fill-rule") == "evenodd"
    solid = sorted(plates(assembly.solid), key=lambda p: (p.high, p.low))
    assert len(paths) == len(solid)
    for path, plate in zip(paths, solid, strict=True):
        assert path.get("class") == plate.layer
        rings = re.findall(r"M [^M]*", path.get("d"))
        outer, *holes = (polygon(svg_path(ring.strip())) for ring in rings)
        area = outer.area - sum(hole.area for hole in holes)
        assert area == pytest.approx(face(plate).area, rel=1e-3)  # of 96 chords a piece
    # the layers themselves are what they are without it
    assert apart(svg_shapes("".join(chunks(assembly))), drawn_shapes(assembly)) < 1e-8


def test_parts_to_cut_are_not_filled():
    assert "FILL" not in groups(root(design().drawing("wheel", 0.01)))
