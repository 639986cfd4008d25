"""Requirements on every drawing sheet: free texts, lines inside the frame, right sizes."""

import math
import re

import numpy as np
import pytest
import shapely
from drawing_witness import vertices
from shapely.geometry import LineString, Polygon, box
from shapely.ops import substring, unary_union

from geneva_cli.drawings.sheet.paper import SCALES
from geneva_cli.geometry.shapes import Contour
from geneva_cli.geometry.sheet import FRAME

CHORD = 0.02  # mm: how far the witness's polylines are from the arcs
LEFT, MARGIN = 20.0, 10.0  # mm, of the frame (ISO 5457)


def lines_of(sheet):
    """The lines on a sheet as polylines, and its arrows as triangles."""
    shapes = [*sheet.shapes]
    shapes += [Contour("", (piece,), closed=False) for m in sheet.measures for piece in m.lines]
    lines = [LineString(vertices(shape, CHORD)) for shape in shapes]
    return lines + [Polygon(a.corners) for m in sheet.measures for a in m.arrows]


def overlaps(sheet):
    """The texts that stand on a line, on another text, or outside the frame."""
    boxes = [Polygon(label.corners) for label in sheet.texts]
    tree = shapely.STRtree([*lines_of(sheet), *boxes])
    inside = framed(sheet)
    bad = []
    for i, one in enumerate(boxes):
        own = len(tree.geometries) - len(boxes) + i
        hit = [k for k in tree.query(one, predicate="intersects") if k != own]
        if hit or not inside.contains(one):
            bad.append((sheet.texts[i].text, hit))
    return bad


def crossings(sheet):
    """Pairs of dimensions whose lines or arrows cross.

    Extension lines may cross other lines. Half a millimetre at the end of a line does not count,
    nor do the tips of arrows: dimensions in a row meet there.
    """
    mains = [[shortened(line) for line in polylines(m.main_lines)] for m in sheet.measures]
    arrows = [[blunt(a) for a in m.arrows] for m in sheet.measures]
    whole = [unary_union(polylines(m.lines)) for m in sheet.measures]
    bad = []
    for i, m in enumerate(sheet.measures):
        main, heads = unary_union(mains[i]), unary_union(arrows[i])
        for j, other in enumerate(sheet.measures):
            across = j < i and main.intersects(unary_union(mains[j]))
            if across or (j != i and heads.intersects(whole[j])):
                bad.append((m.label.text, other.label.text))
    return bad


def polylines(pieces):
    """Lines and arcs as polylines."""
    return [LineString(vertices(Contour("", (p,), closed=False), CHORD)) for p in pieces]


def shortened(line):
    """A line without its ends."""
    return substring(line, 0.5, line.length - 0.5) if line.length > 1.0 else line


def blunt(arrow):
    """An arrow without the first quarter."""
    tip, left, right = (np.array(p) for p in arrow.corners)
    return Polygon([tip + 0.25 * (left - tip), tip + 0.25 * (right - tip), right, left])


def beyond(sheet):
    """The bounds of lines that leave the frame; the frame itself does not count."""
    inside = framed(sheet).buffer(1e-6)
    own = [shape for shape in sheet.shapes if shape.layer != FRAME]
    lines = lines_of(sheet._replace(shapes=tuple(own)))
    return [line.bounds for line in lines if not inside.contains(line)]


def framed(sheet):
    """The area inside the frame."""
    return box(LEFT, MARGIN, sheet.width - MARGIN, sheet.height - MARGIN)


def assert_measured(sheet):
    """Assert that each dimension shows its points' distance, at its scale."""
    for m in sheet.measures:
        if m.kind == "angular":
            apex, a, b, _ = m.points
            turn = math.atan2(b[1] - apex[1], b[0] - apex[0])
            turn -= math.atan2(a[1] - apex[1], a[0] - apex[0])
            assert math.degrees(turn % math.tau) == pytest.approx(m.value, abs=1e-6)
            shown = float(re.search(r"([\d.]+)°", m.label.text)[1])
        elif m.kind == "note":
            continue
        else:
            a, b = m.points[:2]
            c, s = math.cos(m.turn), math.sin(m.turn)
            along = (b[0] - a[0]) * c + (b[1] - a[1]) * s
            paper = abs(along) if m.kind == "length" else math.dist(a, b)
            # to rounding of the sheet's coordinates, or of the size
            off = min(abs(paper - known * m.value) / max(known, paper) for known in SCALES)
            assert off < 1e-9
            text = re.sub(r"^\d+× ", "", m.label.text)
            shown = float(re.search(r"[\d.]+", text)[0])
        assert shown == pytest.approx(m.value, abs=5.1e-4)  # three decimals


def number(value):
    """The text of a size on a drawing, with at most three decimals."""
    text = f"{round(value, 3) + 0.0:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def assert_as_listed(sheet, rows, close=5.1e-4):
    """Assert that the sheet lists the parts with their names, counts, thicknesses and masses.

    ``rows`` are those of the list of parts, as dictionaries. Masses have four digits; ``close`` is
    the relative tolerance, which is larger for a sheet with coarser walls.
    """
    texts = [label.text for label in sheet.texts]
    whole = " ".join(texts)
    masses = 0.0
    parts = [row for row in rows if row["row"] == "part"]
    items = texts[texts.index("kg each") + 2 :]
    for i, row in enumerate(parts, 1):
        name, thick = row["name"], number(row["thickness_mm"])
        item, items = items[:6], items[6:]
        assert item[0] == str(i)
        assert item[1] == name or (item[1].endswith("...") and name.startswith(item[1][:-3]))
        assert item[2:4] == [str(row["count"]), thick]
        shown = float(item[4])
        assert shown == pytest.approx(row["mass_kg"], rel=close, abs=1e-9)
        masses += row["mass_kg"] * row["count"]
        titled = f"{i} {name}, t = {thick}"
        assert titled in whole or f"{i} {name}" in whole or name in whole, name
    total, unit = texts[texts.index("mass") + 1].split()
    assert float(total) * {"kg": 1.0, "mg": 1e-6}[unit] == pytest.approx(masses, rel=close)
    sizes = {row["name"]: row["value"] for row in rows if row["row"] == "dimension"}
    length = next(
        f"{letter} = {number(sizes[name])}"
        for letter, name in (("L", "centre distance"), ("R", "crank radius"))
        if name in sizes
    )
    assert length in whole
    rolls = f"Ø {number(2.0 * sizes['roller radius'])}"
    assert rolls in whole, rolls
