"""SVG files, read back by an evaluator of paths of the tests' own."""

import math
import re
from xml.etree import ElementTree

import pytest
from drawing_witness import apart, contours, drawn_shapes, dxf_shapes, svg_path, svg_shapes
from hypothesis import given, settings
from sampling import some
from shapely.geometry import Polygon
from test_dxf import MANY, of
from words import Drive, Spec, Wheel

from geneva_cli.design import Design
from geneva_cli.geometry.plates import face, plates
from geneva_cli.geometry.sheet import extent
from geneva_cli.output import dxf
from geneva_cli.output.inks import INKS
from geneva_cli.output.svg import MARGIN, STROKE, chunks
from geneva_cli.spec.tables import Size

# mm. The last decimal is 1e-9; a radius that is off by half of that moves an arc's centre by up to
# 4 times as much (at 150 and 210 degrees), and a chord's ends add to it.
SAME = 1e-8
QUICK = settings(max_examples=some(40, 15))
NAME = "{http://www.w3.org/2000/svg}"


def text(drawing):
    return "".join(chunks(drawing))


def root(drawing):
    return ElementTree.fromstring(text(drawing))


def view(drawing):
    """Left, right, bottom and top of the view, y up."""
    x, y, width, height = map(float, root(drawing).get("viewBox").split())
    return x, x + width, -y - height, -y


@QUICK
@given(contours())
def test_any_contour_is_read_back(contour):
    drawing = of(contour)
    assert apart(svg_shapes(text(drawing)), drawn_shapes(drawing)) < SAME
    left, right, bottom, top = view(drawing)
    box = extent(drawing)
    for inside, outside in ((left, box.x0), (bottom, box.y0), (-right, -box.x1), (-top, -box.y1)):
        assert inside <= outside - MARGIN - 0.5 * STROKE


def test_true_size_and_layers():
    svg = root(MANY)
    _, _, width, height = svg.get("viewBox").split()
    assert (svg.get("width"), svg.get("height")) == (width + "mm", height + "mm")
    groups = svg.findall(f"{NAME}g")
    assert tuple(g.get("id") for g in groups) == MANY.layers
    assert [g.get("id") for g in groups if g.get("stroke-dasharray")] == ["PITCH"]
    assert len({g.get("stroke") for g in groups}) == len(groups)
    assert {float(g.get("stroke-width")) for g in groups} == {0.25}
    assert svg.get("fill") == "none"
    assert svg.find(f"{NAME}title").text == MANY.title
    assert not list(svg.iter(f"{NAME}text"))
    assert apart(svg_shapes(text(MANY)), drawn_shapes(MANY)) < SAME
    assert apart(svg_shapes(text(MANY)), dxf_shapes("".join(dxf.chunks(MANY)))) < SAME


def luminance(rgb):
    parts = [int(rgb[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return sum(w * p for w, p in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def test_inks_read_on_white_and_on_black():
    """By the contrast of WCAG 2, which asks for 3 of lines; numbers and RGB are the same ink."""
    from ezdxf.colors import DXF_DEFAULT_COLORS, int2rgb

    inks = [*INKS.values()]
    for ink in inks:
        light = luminance(ink.rgb) + 0.05
        assert min(1.05 / light, light / 0.05) > 3.9
        parts = int2rgb(DXF_DEFAULT_COLORS[ink.number] & 0xFFFFFF)
        assert ink.rgb == "#{:02x}{:02x}{:02x}".format(*parts)
    assert len(set(inks)) == len(inks)


# To look at: lines that suit its size, plates filled, notes; and parts to cut without


def design(L=100.0, wheel=None, rollers=1, **size):
    return Design.of(Spec(wheel or Wheel(6), Drive(rollers=rollers), size=Size(L, **size)))


@pytest.fixture(scope="module")
def assembly():
    return design().drawing("assembly", 0.01)


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
    assert apart(svg_shapes(text(assembly)), drawn_shapes(assembly)) < 1e-8
    assert "FILL" not in groups(root(design().drawing("wheel", 0.01)))  # which is cut
