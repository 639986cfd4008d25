"""DXF files of each version, read back by ezdxf: the same shapes, true arcs, the same bytes."""

import io
import math

import dxfgrabber
import pytest
from drawing_witness import apart, contours, drawn_shapes, dxf_document, dxf_shapes
from ezdxf import recover
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import some

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Cubic, Line, about, closed
from geneva_cli.geometry.sheet import Drawing, extent
from geneva_cli.output.dxf import chunks

# mm. A file's last decimal is 1e-12; a polyline's centre of 300 degrees, an ARC's ends at a radius
# of a metre and a spline's joints (JOINT) come to less than 2e-9 together.
SAME = 2e-9
QUICK = settings(max_examples=some(40, 15))


def text(drawing, version="R2000"):
    return "".join(chunks(drawing, version))


def of(*shapes, title="", look=None):
    return Drawing(title, shapes, look)


def bow(turn=1.0, layer="WHEEL"):
    """A half disc; with ``turn`` of -1 the line bends the other way."""
    return closed(layer, [Arc((10.0, 0.0), (-10.0, 0.0), turn), Line((-10.0, 0.0), (10.0, 0.0))])


def smooth(layer="CRANK"):
    """Three smooth cubics of uneven speed, a corner, an arc and a line."""
    return closed(
        layer,
        [
            Cubic((0.0, 0.0), (5.0, 0.0), (8.0, 2.0), (10.0, 4.0)),
            Cubic((10.0, 4.0), (16.0, 10.0), (12.0, 14.0), (10.0, 16.0)),
            Cubic((10.0, 16.0), (9.5, 16.5), (8.0, 20.0), (0.0, 20.0)),
            Arc((0.0, 20.0), (-5.0, 15.0), math.tan(math.pi / 8.0)),
            Line((-5.0, 15.0), (0.0, 0.0)),
        ],
    )


MANY = of(
    bow(),
    Circle("BORE", (0.0, 4.0), 2.0),
    smooth(),
    Circle("ROLLER", (3.0, 15.0), 1.5),
    Circle("PITCH", (0.0, 0.0), 10.0),
    Contour("PITCH", (about((0.0, 0.0), 12.0, 0.5, -2.0),), closed=False),
    bow(-1.0, "GROOVE"),
    title='a <title> & "more" — ünder Ωmega',
)


def entities(drawing):
    return list(dxf_document(text(drawing)).modelspace())


@pytest.mark.long
@QUICK
@given(contours())
def test_any_contour_is_read_back(contour):
    drawing = of(contour)
    read = dxf_shapes(text(drawing))
    assert apart(read, drawn_shapes(drawing)) < SAME


@pytest.mark.parametrize("degrees", [0.01, 180, 299, 301, 359.99])
@pytest.mark.parametrize("turn", [1.0, -1.0])
def test_arcs_of_any_sweep(degrees, turn):
    """The circle that was meant: a bulge near a whole turn knows its centre to fewer digits."""
    arc = about((3.0, 4.0), 25.0, 0.3, turn * math.radians(degrees))
    drawing = of(closed("WHEEL", [arc, Line(arc.end, arc.start)]))
    read = dxf_shapes(text(drawing))
    assert apart(read, drawn_shapes(drawing)) < SAME
    for share in (0.2, 0.5, 0.9):
        assert math.dist(read["WHEEL"][0][0][2](share), (3.0, 4.0)) == pytest.approx(25.0, abs=1e-7)


def test_a_contour_with_cubics_is_end_to_end():
    found = entities(of(smooth()))
    assert [e.dxftype() for e in found] == ["SPLINE", "ARC", "LINE"]
    spline, arc, line = found
    assert spline.dxf.degree == 3
    assert len(spline.control_points) == 8  # 2 a cubic and the ends: joints need none
    ends = [spline.control_points[-1], arc.start_point, arc.end_point, line.dxf.start]
    ends += [line.dxf.end, spline.control_points[0]]
    for a, b in zip(ends[::2], ends[1::2], strict=True):
        # an ARC's ends are computed from its centre and angles by whoever reads it
        assert math.dist(tuple(a)[:2], tuple(b)[:2]) < 1e-11
    assert tuple(line.dxf.end) == tuple(spline.control_points[0])  # these are written
    assert apart(dxf_shapes(text(of(smooth()))), drawn_shapes(of(smooth()))) < 1e-11


@pytest.mark.long
@QUICK
@given(
    st.lists(st.tuples(st.floats(-1.5, 1.5), st.floats(0.5, 9.0), st.floats(0.5, 9.0)), min_size=3)
)
def test_smooth_cubics_are_one_spline(joints):
    """Each joint has a direction and two handles; what is uneven past a hundred is cut."""
    segments = []
    for i, ((a, _, out), (b, back, _)) in enumerate(zip(joints, joints[1:], strict=False)):
        p, q = (20.0 * i, 0.0), (20.0 * (i + 1), 0.0)
        first = p[0] + out * math.cos(a), p[1] + out * math.sin(a)
        second = q[0] - back * math.cos(b), q[1] - back * math.sin(b)
        segments.append(Cubic(p, first, second, q))
    drawing = of(Contour("WHEEL", tuple(segments), closed=False))
    found = entities(drawing)
    scale, breaks = 1.0, 1
    for _, back, out in joints[1:-1]:
        scale *= out / back
        if not 0.01 < scale < 100.0:
            scale, breaks = 1.0, breaks + 1
    assert [e.dxftype() for e in found] == ["SPLINE"] * breaks
    assert apart(dxf_shapes(text(drawing)), drawn_shapes(drawing)) < SAME


def test_the_header():
    document = dxf_document(text(MANY))
    box = extent(MANY)
    found = [*document.header["$EXTMIN"], *document.header["$EXTMAX"]]
    assert found == pytest.approx([box.x0, box.y0, 0.0, box.x1, box.y1, 0.0], abs=1e-11)
    assert apart(dxf_shapes(text(MANY)), drawn_shapes(MANY)) < SAME
    center = document.linetypes.get("CENTER").simplified_line_pattern()
    assert sum(center) == pytest.approx(12.5, abs=1e-9)


def test_audit_finds_nothing():
    for drawing in (MANY, of(bow()), of(smooth())):
        written = text(drawing)
        _, recovered = recover.read(io.BytesIO(written.encode()))
        for audit in (dxf_document(written).audit(), recovered):
            assert not audit.errors
            assert not audit.fixes


def test_the_title_is_a_comment_in_plain_letters():
    written = text(MANY)
    assert written.isascii()
    first = written.split("\n")[:2]
    assert first == ["999", r'a <title> & "more" \U+2014 \U+00FCnder \U+03A9mega']
    assert text(of(bow(), title="a\n0\nEOF")).startswith("999\na 0 EOF\n  0\nSECTION\n")
    assert text(of(bow())).startswith("  0\nSECTION\n")


# Every version, read back by two readers: ezdxf, and dxfgrabber's parser of its own

NUMBERS = {"R12": "AC1009", "R2000": "AC1015", "R2018": "AC1032"}
ROUND = of(bow(), Circle("BORE", (0.0, 4.0), 2.0), bow(-0.3, "GROOVE"), title="Ünder")


@pytest.mark.parametrize("version", NUMBERS)
def test_each_version_holds_closed_contours_with_bulges(version):
    document = dxf_document(text(ROUND if version == "R12" else MANY, version))
    assert document.dxfversion == NUMBERS[version] and not document.audit().errors
    assert version == "R12" or document.header["$INSUNITS"] == 4
    kind = "POLYLINE" if version == "R12" else "LWPOLYLINE"
    found = dxfgrabber.read(io.StringIO(text(ROUND, version)))
    first, circle, second = found.entities
    assert (first.dxftype, circle.dxftype, second.dxftype) == (kind, "CIRCLE", kind)
    assert circle.radius == 2.0
    for read, shape in ((first, ROUND.shapes[0]), (second, ROUND.shapes[2])):
        assert read.is_closed
        assert read.layer == shape.layer
        points = [tuple(p)[:2] for p in read.points]
        assert points == [s.start for s in shape.segments]
        wanted = [s.bulge if isinstance(s, Arc) else 0.0 for s in shape.segments]
        assert list(read.bulge) == pytest.approx(wanted, abs=1e-15)


def test_refusals():
    with pytest.raises(GenevaError, match="nothing to draw"):
        text(of())
    with pytest.raises(GenevaError, match="--dxf-version R12 has no splines: leave out --curves"):
        text(of(smooth()), "R12")
    with pytest.raises(GenevaError, match="--dxf-version R9: it must be one of R12, R2000, R2004"):
        text(ROUND, "R9")


@pytest.mark.parametrize(
    "shape",
    [
        Circle("BORE", (0.0, math.nan), 3.0),
        closed("WHEEL", [Line((0.0, 0.0), (math.inf, 0.0)), Line((math.inf, 0.0), (0.0, 0.0))]),
    ],
)
def test_a_coordinate_that_is_not_finite_is_not_written(shape):
    with pytest.raises(GenevaError, match=f"layer {shape.layer}: .* must be finite"):
        text(of(bow(), shape))
