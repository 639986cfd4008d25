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

from geneva_cli.curves.sheet import DIMENSION
from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.output.sheets import dxf, pdf, svg

SECONDS = 60  # of one sheet and what is looked at on it
TOLERANCE = 0.01  # mm at L = 100, of the walls
# Walls that are drawn coarser than the list of parts takes them move a thin wheel's mass so far.
CLOSE = 5e-3


def one(text):
    """The sheet of one spec; how it ended, in a word."""
    with strictly(SECONDS):
        found = read(text.encode())
        if isinstance(found, str):
            return "refused"
        design = Design.of(found.spec)
        try:
            coarse = TOLERANCE * found.center_distance_mm / 100.0
            made = design.sheet(coarse, units=("mm", "inch")[len(text) % 2])
        except GenevaError as error:
            # of a machine that jams, walls may leap: `profile` refuses it before it draws
            known = error.key or "--" in str(error) or "roller and slot overlap" in str(error)
            assert known, f"no place: {error}"
            return "no sheet"
        assert overlaps(made) == []
        assert beyond(made) == []
        # A tiny wheel may have no place free of crossings. A rack of 24 slots behind elliptical
        # gears is drawn at 1:10. It has 109 dimensions, and up to 8 leaders and balloons of its
        # small parts cross another one there. Each can be followed.
        assert len(crossings(made)) <= max(4, len(made.measures) // 13)
        assert_measured(made)
        if found.spec.wheel.FLAT and made.units == "mm":
            assert_as_listed(made, list(design.part_table("parts").to_rows()), CLOSE)
        written(made)
        return "sheet"


def written(made):
    """Read by others: each text is in the SVG, each dimension in the DXF, one page in the PDF."""
    tree = ElementTree.fromstring("".join(svg.chunks(made)))
    shown = {"".join(node.itertext()) for node in tree.iter() if node.tag.endswith("}text")}
    assert {label.text for label in made.texts} <= shown
    drawing = ezdxf.read(io.StringIO("".join(dxf.chunks(made))))
    assert not drawing.audit().errors
    spans = [m for m in made.measures if m.kind != "note"]
    assert len(drawing.modelspace().query("DIMENSION")) == len(spans), DIMENSION
    page = "".join(pdf.chunks(made))
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
