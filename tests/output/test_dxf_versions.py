"""Every version of DXF, read back by two readers: ezdxf, and dxfgrabber's parser of its own."""

import io

import dxfgrabber
import pytest
from drawing_witness import apart, drawn_shapes, dxf_document, dxf_shapes
from test_dxf import MANY, SAME, bow, of, smooth

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc, Circle
from geneva_cli.output.dxf import chunks

NUMBERS = {"R12": "AC1009", "R2000": "AC1015", "R2018": "AC1032"}
ROUND = of(bow(), Circle("BORE", (0.0, 4.0), 2.0), bow(-0.3, "GROOVE"), title="Ünder")


def text(drawing, version):
    return "".join(chunks(drawing, version))


@pytest.mark.parametrize("version", NUMBERS)
def test_each_version_holds_the_same_shapes(version):
    drawing = ROUND if version == "R12" else MANY
    document = dxf_document(text(drawing, version))
    assert document.dxfversion == NUMBERS[version]
    assert not document.audit().errors
    if version != "R12":
        assert document.header["$INSUNITS"] == 4
        assert apart(dxf_shapes(text(drawing, version)), drawn_shapes(drawing)) < SAME


@pytest.mark.parametrize("version", NUMBERS)
def test_another_reader_finds_closed_contours_with_bulges(version):
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
    with pytest.raises(GenevaError, match="--dxf-version R12 has no splines: leave out --curves"):
        text(of(smooth()), "R12")
    with pytest.raises(GenevaError, match="--dxf-version R9: it must be one of R12, R2000, R2004"):
        text(ROUND, "R9")
