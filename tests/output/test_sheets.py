"""Drawing sheets as files: each format read back by something that is not its writer."""

import io
import math
import os
import re
from xml.etree import ElementTree

import dxfgrabber
import matplotlib
import pytest
from ezdxf import recover
from words import Motion, Spec, Wheel

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sheet import CAPITALS, WIDTHS, width
from geneva_cli.output import DXF_VERSIONS, draw_sheet, dxf, pdf, svg
from geneva_cli.spec.tables import Size

NAME = "{http://www.w3.org/2000/svg}"
TITLE = 'a <title> & (more) \\ "%%c" — ünder Ωmega'


@pytest.fixture(scope="module")
def sheet():
    """A curved wheel with a hard title."""
    spec = Spec(Wheel(6), motion=Motion("cycloidal", ratio="matched"), size=Size(60.0), title=TITLE)
    return Design.of(spec).sheet(0.05)


@pytest.mark.parametrize("bold", [False, True], ids=["plain", "bold"])
def test_widths_are_those_of_the_font(bold):
    """Against the metrics that Matplotlib ships, Adobe's own file."""
    folder = os.path.join(matplotlib.get_data_path(), "fonts", "pdfcorefonts")
    name = "Helvetica-Bold.afm" if bold else "Helvetica.afm"
    with open(os.path.join(folder, name), encoding="latin-1") as file:
        metrics = file.read()
    assert float(re.search(r"CapHeight (\d+)", metrics)[1]) == 1000.0 * CAPITALS
    known = {m[2]: int(m[1]) for m in re.finditer(r"WX (\d+) ; N (\w+)", metrics)}
    codes = {int(m[1]): int(m[2]) for m in re.finditer(r"C (\d+) ; WX (\d+)", metrics)}
    letters = {chr(c): codes[c] for c in range(32, 127) if chr(c) not in "'`"}
    letters |= {"'": known["quotesingle"], "`": known["grave"], "°": known["degree"]}
    letters |= {"±": known["plusminus"], "×": known["multiply"], "Ø": known["Oslash"]}
    letters |= {"²": known["twosuperior"], "³": known["threesuperior"], "–": known["endash"]}
    letters |= {"·": known["periodcentered"]}
    spare = 56.0 if bold else 0.0
    for letter, units in letters.items():
        if bold and not letter.isalnum():
            continue
        assert abs(1000.0 * CAPITALS * width(letter, bold) - units) <= spare + 1e-9, letter
    assert max(known.values()) - 15 <= 1000  # one letter of all, @, is wider than what we take


def objects(text):
    """The objects of a PDF by its own table of where they are, and the trailer."""
    start = int(re.search(r"startxref\n(\d+)\n%%EOF\n$", text)[1])
    table = re.match(r"xref\n0 (\d+)\n0000000000 65535 f \n((?:\d{10} 00000 n \n)+)", text[start:])
    places = [int(line[:10]) for line in table[2].splitlines()]
    assert len(places) + 1 == int(table[1])
    found = {}
    for number, place in enumerate(places, 1):
        body = re.match(rf"{number} 0 obj\n(.*?)\nendobj\n", text[place:], re.DOTALL)
        found[number] = body[1]
    return found, text[start:]


@pytest.mark.long
def test_a_pdf_is_whole(sheet):
    text = "".join(pdf.sheet_chunks(sheet))
    assert text.isascii()
    found, trailer = objects(text)
    assert "/Root 1 0 R" in trailer
    assert found[1] == "<< /Type /Catalog /Pages 2 0 R >>"
    length, content = re.match(
        r"<< /Length (\d+) >>\nstream\n(.*)endstream", found[4], re.DOTALL
    ).groups()
    assert len(content) == int(length)
    box = re.search(r"/MediaBox \[0 0 ([\d.]+) ([\d.]+)\]", found[3])
    mm = [float(v) / 72.0 * 25.4 for v in box.groups()]
    assert mm == pytest.approx([sheet.width, sheet.height], abs=1e-4)
    title = bytes.fromhex(re.search(r"<feff(\w+)>", found[7])[1]).decode("utf-16-be")
    assert title == TITLE
    shown = re.findall(r"BT /F1 (\S+) Tf (.*?) Tm \((.*?)\) Tj ET", content)
    assert len(shown) == len(sheet.texts)
    for (size, matrix, escaped), label in zip(shown, sheet.texts, strict=True):
        read = re.sub(r"\\(\d{3})", lambda m: chr(int(m[1], 8)), escaped)
        assert read.encode("latin-1") == label.text.encode("cp1252", "replace")
        assert float(size) * CAPITALS == pytest.approx(label.height, abs=1e-4)
        c, s, _, _, x, y = map(float, matrix.split())
        assert (x, y) == pytest.approx(label.at, abs=1e-4)
        assert math.remainder(math.atan2(s, c) - label.turn, math.tau) == pytest.approx(0, abs=1e-4)


def test_an_svg_has_all_texts_where_they_are(sheet):
    root = ElementTree.fromstring("".join(svg.sheet_chunks(sheet)))
    x, y, w, h = map(float, root.get("viewBox").split())
    assert (x, y, w, h) == (0.0, -sheet.height, sheet.width, sheet.height)
    assert root.get("width") == f"{sheet.width:.9f}mm"
    texts = list(root.iter(f"{NAME}text"))
    assert [t.text for t in texts] == [label.text for label in sheet.texts]
    for element, label in zip(texts, sheet.texts, strict=True):
        assert (float(element.get("x")), -float(element.get("y"))) == pytest.approx(label.at)
        assert float(element.get("textLength")) == pytest.approx(label.width)
    style = root.find(f"{NAME}style").text
    assert "prefers-color-scheme: dark" in style
    groups = {g.get("id"): g for g in root.iter(f"{NAME}g")}
    for layer in {shape.layer for shape in sheet.shapes}:
        assert float(groups[layer].get("stroke-width")) == WIDTHS[layer]


@pytest.mark.sampled(8)
@pytest.mark.parametrize("version", DXF_VERSIONS)
def test_a_dxf_has_dimensions_that_measure_themselves(sheet, version):
    """ezdxf measures each between its own points; times its style's factor it is the part's."""
    written = "".join(dxf.sheet_chunks(sheet, version))
    document, audit = recover.read(io.BytesIO(written.encode()))
    assert not audit.errors
    assert not audit.fixes
    found = list(document.modelspace().query("DIMENSION"))
    wanted = [m for m in sheet.measures if m.kind in dxf.KINDS]
    assert len(found) == len(wanted) > 15
    for dimension, m in zip(found, wanted, strict=True):
        measured = dimension.get_measurement()
        if m.kind != "angular":
            style = document.dimstyles.get(dimension.dxf.dimstyle)
            measured *= style.dxf.dimlfac
        assert measured == pytest.approx(m.value, rel=1e-8)
        block = dimension.get_geometry_block()
        assert len(block.query("TEXT")) == 1
        assert len(block.query("SOLID")) == len(m.arrows)
    assert len(document.modelspace().query("TEXT")) == len(sheet.labels) + len(
        sheet.measures
    ) - len(wanted)
    kinds = {e.dxftype() for e in document.modelspace()}
    assert ("POLYLINE" in kinds) == (version == "R12")
    assert dxfgrabber.read(io.StringIO(written)).entities


def test_refusals(sheet, tmp_path):
    with pytest.raises(GenevaError, match="one of: dxf, svg, pdf"):
        draw_sheet(sheet, "a.step")
    with pytest.raises(GenevaError, match=r"--dxf-version is for .dxf, and this is pdf"):
        draw_sheet(sheet, str(tmp_path / "a.pdf"), version="R12")
