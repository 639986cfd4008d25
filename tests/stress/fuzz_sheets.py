"""Drawing sheets of random machines: `python tests/stress/fuzz_sheets.py --runs 5000 --jobs 2`.

Each is refused with a place in its spec, or all on it is inside the frame, no text stands on
another or on a line, few dimensions cross, each dimension says what it spans, and the list of items
is the list of parts; and it is written as SVG, DXF and PDF, which other readers take.
"""

import io
import sys
from xml.etree import ElementTree

import ezdxf
from fuzz_machines import machine_text
from fuzz_spec import read
from fuzzing import campaign, strictly
from sheet_witness import assert_as_listed, assert_measured, beyond, crossings, overlaps

from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.sheet import DIMENSION
from geneva_cli.output.sheets import sheet_dxf, sheet_pdf, sheet_svg

SECONDS = 60  # for one sheet and its checks
TOLERANCE = 0.01  # mm at L = 100, of the walls
# Walls that are drawn coarser than the list of parts takes them move a thin wheel's mass so far.
CLOSE = 5e-3


def one(text):
    """Draw and check the sheet of one spec; return how it ended, in a word."""
    with strictly(SECONDS):
        machine = read(text.encode())
        if isinstance(machine, str):
            return "refused"
        design = Design.of(machine.spec)
        try:
            coarse = TOLERANCE * machine.center_distance_mm / 100.0
            sheet = design.sheet(coarse, units=("mm", "inch")[len(text) % 2])
        except GenevaError as error:
            # of a machine that jams, walls may leap: `profile` refuses it before it draws
            known = error.key or "--" in str(error) or "roller and slot overlap" in str(error)
            assert known, f"no place: {error}"
            return "no sheet"
        assert overlaps(sheet) == []
        assert beyond(sheet) == []
        # A tiny wheel may have no place free of crossings. A rack of 24 slots behind elliptical
        # gears is drawn at 1:10. It has 109 dimensions, and up to 8 leaders and balloons of its
        # small parts cross another one there. Each can be followed.
        assert len(crossings(sheet)) <= max(4, len(sheet.measures) // 13)
        assert_measured(sheet)
        if machine.spec.wheel.FLAT and sheet.units == "mm":
            assert_as_listed(sheet, list(design.part_table("parts").to_rows()), CLOSE)
        written(sheet)
        return "sheet"


def written(sheet):
    """Check the files with other readers: texts in SVG, dimensions in DXF, one page in PDF."""
    tree = ElementTree.fromstring("".join(sheet_svg.chunks(sheet)))
    shown = {"".join(node.itertext()) for node in tree.iter() if node.tag.endswith("}text")}
    assert {label.text for label in sheet.texts} <= shown
    drawing = ezdxf.read(io.StringIO("".join(sheet_dxf.chunks(sheet))))
    assert not drawing.audit().errors
    spans = [m for m in sheet.measures if m.kind != "note"]
    assert len(drawing.modelspace().query("DIMENSION")) == len(spans), DIMENSION
    page = "".join(sheet_pdf.chunks(sheet))
    assert page.startswith("%PDF-")
    assert page.rstrip().endswith("%%EOF")
    for at, number in offsets(page):
        assert page.startswith(f"{number} 0 obj", at)


def offsets(page):
    """The places that a PDF's own table gives for its objects, in bytes, and their numbers."""
    assert page.isascii()  # or a byte were no character
    start = int(page.rstrip().splitlines()[-2])
    rows = page[start:].splitlines()
    assert rows[0] == "xref"
    count = int(rows[1].split()[1])
    return [(int(row[:10]), i) for i, row in enumerate(rows[3 : 2 + count], 1)]


if __name__ == "__main__":
    sys.exit(campaign("sheets", machine_text, one, batch=20))
