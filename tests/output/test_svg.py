"""SVG files, read back by an evaluator of paths of the tests' own."""

import math
import re
from xml.etree import ElementTree

import pytest
from drawing_witness import apart, contours, drawn_shapes, dxf_shapes, scaled, svg_shapes
from hypothesis import given, settings
from sampling import some
from test_dxf import MANY, of

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.drawing import Annotations, extent
from geneva_cli.geometry.shapes import Circle, Line, about, closed
from geneva_cli.output import dxf
from geneva_cli.output.inks import INKS, OTHERS
from geneva_cli.output.notes import round_length
from geneva_cli.output.svg.drawing_svg import MARGIN, STROKE, chunks

# mm. The last decimal is 1e-9; a radius that is off by half of that moves an arc's centre by up to
# 4 times as much (at 150 and 210 degrees), and a chord's ends add to it.
SAME = 1e-8
QUICK = settings(max_examples=some(40, 15))
NAME = "{http://www.w3.org/2000/svg}"


def text(drawing, units="mm"):
    return "".join(chunks(drawing, units))


def root(drawing, units="mm"):
    return ElementTree.fromstring(text(drawing, units))


def view(drawing, units="mm"):
    """Left, right, bottom and top of the view, y up."""
    x, y, width, height = map(float, root(drawing, units).get("viewBox").split())
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


@pytest.mark.parametrize(
    "degrees", [0.01, 1, 90, 149, 151, 179.99, 180, 180.01, 209, 211, 270, 299, 301, 359, 359.99]
)
@pytest.mark.parametrize("turn", [1.0, -1.0])
def test_arcs_of_any_sweep(degrees, turn):
    arc = about((3.0, 4.0), 25.0, 0.3, turn * math.radians(degrees))
    drawing = of(closed("WHEEL", [arc, Line(arc.end, arc.start)]))
    assert apart(svg_shapes(text(drawing)), drawn_shapes(drawing)) < SAME
    (path,) = root(drawing).iter(f"{NAME}path")
    parts = 4 if degrees > 300 else 2 if 150 < degrees < 210 else 1
    flags = re.findall(r"A \S+ 0 ([01]) ([01]) ", path.get("d"))
    assert flags == [(str(int(210 < degrees < 300)), str(int(turn < 0)))] * parts


@pytest.mark.parametrize(("units", "suffix", "unit"), [("mm", "mm", 1.0), ("inch", "in", 25.4)])
def test_true_size_and_layers(units, suffix, unit):
    svg = root(MANY, units)
    _, _, width, height = svg.get("viewBox").split()
    assert (svg.get("width"), svg.get("height")) == (width + suffix, height + suffix)
    groups = svg.findall(f"{NAME}g")
    assert tuple(g.get("id") for g in groups) == MANY.layers
    assert [g.get("id") for g in groups if g.get("stroke-dasharray")] == ["PITCH"]
    assert len({g.get("stroke") for g in groups}) == len(groups)
    assert {float(g.get("stroke-width")) for g in groups} == {round(0.25 / unit, 9)}
    assert svg.get("fill") == "none"
    assert svg.find(f"{NAME}title").text == MANY.title
    assert not list(svg.iter(f"{NAME}text"))
    wanted = drawn_shapes(scaled(MANY, 1.0 / unit))
    assert apart(svg_shapes(text(MANY, units)), wanted) < SAME
    read = dxf_shapes("".join(dxf.chunks(MANY, units)))
    assert apart(svg_shapes(text(MANY, units)), read) < SAME


@pytest.mark.parametrize("size", [0.3, 7.0, 100.0, 3456.0])
@pytest.mark.parametrize("units", ["mm", "inch"])
def test_the_scale_bar(size, units):
    suffix, unit = {"mm": ("mm", 1.0), "inch": ("in", 25.4)}[units]
    drawing = of(Circle("WHEEL", (size, 0.0), 0.5 * size), title="A title\x1b of <40>\nletters")
    svg = root(drawing._replace(look=Annotations()), units)
    (path,) = (p for p in svg.iter(f"{NAME}path") if p.get("id") == "SCALE_BAR")
    numbers = [float(n) for n in re.findall(r"-?\d+\.\d+", path.get("d"))]
    xs, ys = numbers[::2], numbers[1::2]
    label, title = svg.iter(f"{NAME}text")
    length, unit_name = label.text.split(" ")
    assert unit_name == suffix
    assert max(xs) - min(xs) == pytest.approx(float(length), abs=2e-9)  # two last decimals
    assert float(length) == round_length(float(length))
    share = float(length) * unit / size
    # a fifth, at most the root of 2.5 off: 1-2-5 has steps of 2 and 2.5
    assert 0.2 / math.sqrt(2.5) <= share + 1e-9
    assert share - 1e-9 <= 0.2 * math.sqrt(2.5)
    assert title.text == "A title  of <40> letters"
    # outside the shapes, inside the view
    left, right, bottom, _ = view(drawing._replace(look=Annotations()), units)
    lowest = -0.5 * size / unit
    assert all(bottom < -y < lowest for y in ys)
    assert all(left < x < right for x in xs)
    for element in (label, title):
        x, y = float(element.get("x")), -float(element.get("y"))
        height = 0.02 * size / unit  # 5 mm where the drawing has 250
        assert left < x < x + 0.6 * height * len(element.text) < right
        assert bottom < y < y + 0.75 * height < lowest


def luminance(rgb):
    parts = [int(rgb[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
    linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
    return sum(w * p for w, p in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def test_inks_read_on_white_and_on_black():
    """By the contrast of WCAG 2, which asks for 3 of lines; numbers and RGB are the same ink."""
    from ezdxf.colors import DXF_DEFAULT_COLORS, int2rgb

    inks = [*INKS.values(), *OTHERS]
    for ink in inks:
        light = luminance(ink.rgb) + 0.05
        assert min(1.05 / light, light / 0.05) > 3.9
        parts = int2rgb(DXF_DEFAULT_COLORS[ink.number] & 0xFFFFFF)
        assert ink.rgb == "#{:02x}{:02x}{:02x}".format(*parts)
    assert len(set(inks)) == len(inks)


def test_refusals():
    with pytest.raises(GenevaError, match="--units cm: it must be one of mm, inch"):
        text(MANY, "cm")
    with pytest.raises(GenevaError, match="coordinates must be finite"):
        text(of(closed("WHEEL", [Line((0.0, math.inf), (1.0, 0.0)), Line((1.0, 0.0), (0.0, 0.0))])))
    with pytest.raises(GenevaError, match="nothing to draw"):
        text(of(Circle("BORE", (0.0, 0.0), 0.0)))
