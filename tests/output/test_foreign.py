"""Drawings of others: DXF and SVG as lines and arcs, against lengths, areas and points by hand."""

import cmath
import math

import ezdxf
import numpy as np
import pytest

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.loops import loops
from geneva_cli.geometry.plates import moments
from geneva_cli.geometry.shapes import Arc, Line, at
from geneva_cli.output.foreign import read_drawing
from geneva_cli.output.foreign.drawn import CURVE_MM, Ellipse, traced


def dxf(folder, draw, units=4):
    document = ezdxf.new("R2010", units=units)
    draw(document, document.modelspace())
    document.saveas(folder / "drawing.dxf")
    return read_drawing(str(folder / "drawing.dxf"))


def svg(folder, body, head='width="100mm" height="100mm" viewBox="0 0 100 100"'):
    text = f'<svg xmlns="http://www.w3.org/2000/svg" {head}>{body}</svg>'
    (folder / "drawing.svg").write_text(text, encoding="utf-8")
    return read_drawing(str(folder / "drawing.svg"))


def areas(drawn):
    return sorted(abs(moments(loop).area) for loop in loops(drawn.pieces))


ENTITIES = {
    "lines": (lambda d, m: [m.add_line(p, q) for p, q in SQUARE], 4.0),
    "circle": (lambda d, m: m.add_circle((3, 4), 2), 4.0 * math.pi),
    "circle from below": (
        lambda d, m: m.add_circle((3, 4), 2, dxfattribs={"extrusion": (0, 0, -1)}),
        4.0 * math.pi,
    ),
    "arc and chord": (
        lambda d, m: (m.add_arc((0, 0), 2, 90, 270), m.add_line((0, 2), (0, -2))),
        2.0 * math.pi,
    ),
    "bulges": (lambda d, m: m.add_lwpolyline(LENS, format="xyb", close=True), math.pi),
    "old bulges": (lambda d, m: m.add_polyline2d(LENS, format="xyb", close=True), math.pi),
    "ellipse": (lambda d, m: m.add_ellipse((1, 1), (3, 1), 0.5), 0.5 * 10.0 * math.pi),
    "block": (lambda d, m: block(d, m, {}), math.pi),
    "mirrored block": (lambda d, m: block(d, m, {"xscale": -1, "rotation": 20}), math.pi),
    "stretched block": (lambda d, m: block(d, m, {"xscale": 3}), 3.0 * math.pi),
}
SQUARE = [((0, 0), (2, 0)), ((2, 2), (2, 0)), ((2, 2), (0, 2)), ((0, 0), (0, 2))]
LENS = [(-1, 0, 1), (1, 0, 1)]


def block(document, space, attributes):
    own = document.blocks.new("LENS")
    own.add_lwpolyline(LENS, format="xyb", close=True)
    space.add_blockref("LENS", (5, 6), dxfattribs=attributes)


@pytest.mark.parametrize("name", ENTITIES)
def test_each_entity_has_its_area(name, tmp_path):
    draw, size = ENTITIES[name]
    assert areas(dxf(tmp_path, draw)) == [pytest.approx(size, rel=2e-5)]


@pytest.mark.parametrize(("code", "mm"), [(1, 25.4), (2, 304.8), (5, 10.0), (6, 1000.0)])
def test_units_become_millimetres(code, mm, tmp_path):
    drawn = dxf(tmp_path, lambda d, m: m.add_circle((0, 0), 1), code)
    assert areas(drawn) == [pytest.approx(math.pi * mm**2, rel=1e-12)]
    assert drawn.notes == ()


def test_no_unit_is_noted(tmp_path):
    assert "millimetres" in dxf(tmp_path, lambda d, m: m.add_circle((0, 0), 1), 0).notes[0]


def test_a_file_without_a_header_is_in_millimetres(tmp_path):
    rows = ["0", "SECTION", "2", "ENTITIES", "0", "CIRCLE", "8", "0", "10", "0.0", "20", "0.0"]
    text = "\n".join([*rows, "40", "2.0", "0", "ENDSEC", "0", "EOF", ""])
    (tmp_path / "drawing.dxf").write_text(text, encoding="ascii")
    drawn = read_drawing(str(tmp_path / "drawing.dxf"))
    assert areas(drawn) == [pytest.approx(4.0 * math.pi, rel=1e-12)]
    assert "millimetres" in drawn.notes[0]


def test_a_spline_stays_within_the_tolerance(tmp_path):
    """Points of the spline by de Boor's own library against the arcs that replace it."""
    points = [(0, 0), (10, 5), (20, -5), (30, 10)]
    splines = []
    drawn = dxf(tmp_path, lambda d, m: splines.append(m.add_spline(points)))
    tool = splines[0].construction_tool()
    for point in tool.points(np.linspace(0.0, tool.max_t, 40)):
        assert min(off(piece, (point.x, point.y)) for piece in drawn.pieces) < 1.1 * CURVE_MM
    assert not drawn.is_exact


def off(piece, point):
    """Distance of a point from a piece, by its circle; from an end where that is beyond."""
    ends = min(math.dist(point, piece.start), math.dist(point, piece.end))
    if isinstance(piece, Line):
        return ends
    middle, half = at(piece, 0.5), 0.5 * math.dist(piece.start, piece.end)
    near = math.dist(point, middle) <= 1.1 * half
    return abs(math.dist(point, piece.centre) - piece.radius) if near else ends


def test_centre_lines_texts_and_layers_that_are_off_are_left_out(tmp_path):
    def draw(document, space):
        space.add_circle((0, 0), 1)
        space.add_text("hello")
        space.add_line((0, 0), (9, 9), dxfattribs={"layer": "CENTER"})
        document.layers.add("OFF").off()
        space.add_line((0, 0), (9, 9), dxfattribs={"layer": "OFF"})

    assert len(dxf(tmp_path, draw).pieces) == 2


def test_what_is_no_outline_is_refused(tmp_path):
    with pytest.raises(
        GenevaError, match="3DFACE on layer 0 is no outline; draw it as one of LINE"
    ):
        dxf(tmp_path, lambda d, m: m.add_3dface([(0, 0), (1, 0), (1, 1), (0, 1)]))


def test_a_missing_block_is_named(tmp_path):
    with pytest.raises(GenevaError, match="a block that the file lacks: GEAR"):
        dxf(tmp_path, lambda d, m: m.add_blockref("GEAR", (0, 0)))


@pytest.mark.parametrize(
    ("name", "data", "words"),
    [
        ("a.dxf", b"", "not a DXF file"),
        ("a.dxf", bytes(range(256)) * 9, "not a DXF file"),
        ("a.dxf", b"0\nSECTION\n2\nHEADER\n", "not a DXF file that can be read"),
        ("a.stl", b"", "from a .dxf or .svg file"),
        ("a.svg", b"", "not an SVG file"),
        ("a.svg", b"<html/>", "no SVG file: its first element is <html>"),
        ("a.svg", b'<svg><path d="M0 0 L 1"/></svg>', 'path "M0 0 L 1" cannot be read: Not enough'),
        ("a.svg", b'<svg><path d="M0 0 K 1 3"/></svg>', "letters of paths and numbers"),
        ("a.svg", b'<svg><circle r="1e400"/></svg>', "is no number"),
        ("a.svg", b'<svg width="1.2.3"><circle r="0"/></svg>', "no width"),
        ("a.svg", b'<svg><use href="#gone"/></svg>', "<use> is no outline"),
        ("a.svg", b'<svg><rect width="2" height="1"/></svg>', "<rect> is no outline"),
        ("a.svg", b'<svg><g transform="matrix(1,2)"/></svg>', "not known"),
        ("a.svg", b'<!DOCTYPE x [<!ENTITY a "b">]><svg/>', "entities"),
        ("a.svg", b'<svg><line x2="9e9"/></svg>', "at most 1e\\+06 mm"),
    ],
)
def test_broken_files_are_refused_with_their_name(name, data, words, tmp_path):
    (tmp_path / name).write_bytes(data)
    with pytest.raises(GenevaError, match=rf"{name}: .*{words}"):
        read_drawing(str(tmp_path / name))


def test_svg_shapes_have_their_areas(tmp_path):
    body = (
        '<circle cx="9" cy="9" r="2"/><path d="M20 1h3v4h-3z"/>'
        '<polygon points="40,0 44,0 44,6"/><ellipse cx="60" cy="9" rx="4" ry="2"/>'
    )
    assert areas(svg(tmp_path, body)) == pytest.approx(
        sorted([4.0 * math.pi, 12.0, 12.0, 8.0 * math.pi]), rel=2e-5
    )


@pytest.mark.parametrize("ry", [2, 3])
def test_an_ellipse_that_is_no_circle_is_not_exact(ry, tmp_path):
    assert svg(tmp_path, f'<ellipse rx="3" ry="{ry}"/>').is_exact == (ry == 3)
    drawn = dxf(tmp_path, lambda d, m: m.add_ellipse((1, 1), (3, 0), ry / 3))
    assert drawn.is_exact == (ry == 3)


def test_svg_is_scaled_to_millimetres_with_y_upwards(tmp_path):
    drawn = svg(tmp_path, '<line x2="1" y2="2"/>', 'width="4in" height="4in" viewBox="0 0 8 8"')
    (line,) = drawn.pieces
    assert line.end == pytest.approx((12.7, -25.4))
    note = svg(tmp_path, '<line x2="1" y2="2"/>', "").notes[0]
    assert "millimetres" in note


def test_svg_transforms_apply_from_the_right(tmp_path):
    """A point by complex arithmetic: doubled, turned by 30 degrees, then moved."""
    group = (
        '<g transform="translate(5 7) rotate(30) scale(2)"><line x1="1" y1="0" x2="1" y2="1"/></g>'
    )
    (line,) = svg(tmp_path, group).pieces
    end = complex(5, 7) + 2 * (1 + 1j) * cmath.exp(1j * math.radians(30.0))
    assert line.end == pytest.approx((end.real, -end.imag))


@pytest.mark.parametrize(("large", "sweep"), [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_svg_arcs_go_the_way_of_their_flags(large, sweep, tmp_path):
    """Of four arcs of radius 2 over a chord of 2, flags choose size and sense; y points down."""
    drawn = svg(tmp_path, f'<path d="M0 0 A2 2 0 {large} {sweep} 2 0"/>')
    total = sum(piece.sweep for piece in drawn.pieces if isinstance(piece, Arc))
    angle = math.radians(300.0 if large else 60.0)
    assert total == pytest.approx(-angle if sweep else angle)


def test_svg_curves_and_their_smooth_continuations(tmp_path):
    """A quadratic curve has two thirds of its control triangle's area; S and T reflect the pole."""
    drawn = svg(tmp_path, '<path d="M0 0 Q 2 3 4 0 z"/>')
    assert areas(drawn) == [pytest.approx(4.0, rel=1e-4)]
    wave = svg(tmp_path, '<path d="M0 00Q02 3. 4 0 T 8.e0-0"/>').pieces  # numbers of all forms
    middle = min(wave, key=lambda piece: abs(piece.start[0] - 6.0))
    assert middle.start[1] == pytest.approx(1.5, abs=0.05)  # below, after above: y points down


def test_a_skewed_circle_is_the_ellipse_of_its_points():
    p, q = 8 + 0j, 4 * math.tan(math.radians(20.0)) - 4j
    for piece in traced(Ellipse(0j, p, q), lambda z: z)[0][::5]:
        z = complex(*piece.start)
        t = np.linalg.solve(np.array([[p.real, q.real], [p.imag, q.imag]]), (z.real, z.imag))
        assert np.hypot(*t) == pytest.approx(1.0, abs=1e-4)
