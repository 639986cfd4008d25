"""SVG files, read back by an evaluator of paths of the tests' own."""

from xml.etree import ElementTree

from drawing_witness import apart, contours, drawn_shapes, dxf_shapes, svg_shapes
from hypothesis import given, settings
from sampling import some
from test_dxf import MANY, of

from geneva_cli.geometry.sheet import extent
from geneva_cli.output import dxf
from geneva_cli.output.inks import INKS, OTHERS
from geneva_cli.output.svg import MARGIN, STROKE, chunks

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

    inks = [*INKS.values(), *OTHERS]
    for ink in inks:
        light = luminance(ink.rgb) + 0.05
        assert min(1.05 / light, light / 0.05) > 3.9
        parts = int2rgb(DXF_DEFAULT_COLORS[ink.number] & 0xFFFFFF)
        assert ink.rgb == "#{:02x}{:02x}{:02x}".format(*parts)
    assert len(set(inks)) == len(inks)
