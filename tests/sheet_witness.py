"""What must hold of every drawing sheet: texts stand free, all is on the paper, sizes are right."""

import math
import re

import numpy as np
import pytest
import shapely
from drawing_witness import vertices
from shapely.geometry import LineString, Polygon, box
from shapely.ops import substring, unary_union

from geneva_cli.curves.shapes import Contour
from geneva_cli.curves.sheet import FRAME
from geneva_cli.drawings.sheet.paper import SCALES

CHORD = 0.02  # mm: how far the witness's polylines are from the arcs
LEFT, MARGIN = 20.0, 10.0  # mm, of the frame (ISO 5457)


def lines_of(found):
    """Every line on a sheet as a polyline; arrows are triangles."""
    shapes = [*found.shapes]
    shapes += [Contour("", (piece,), closed=False) for m in found.measures for piece in m.lines]
    lines = [LineString(vertices(shape, CHORD)) for shape in shapes]
    return lines + [Polygon(a.corners) for m in found.measures for a in m.arrows]


def overlaps(found):
    """Texts that stand on a line, on another text, or beyond the frame."""
    boxes = [Polygon(label.corners) for label in found.texts]
    tree = shapely.STRtree([*lines_of(found), *boxes])
    inside = framed(found)
    bad = []
    for i, one in enumerate(boxes):
        own = len(tree.geometries) - len(boxes) + i
        hit = [k for k in tree.query(one, predicate="intersects") if k != own]
        if hit or not inside.contains(one):
            bad.append((found.texts[i].text, hit))
    return bad


def crossings(found):
    """Pairs of dimensions of which a line or an arrow of one runs into the other's.

    Extension lines may cross other lines. Half a millimetre at the end of a line does not count,
    nor do the tips of arrows: dimensions in a row meet there.
    """
    mains = [[shortened(line) for line in polylines(m.main_lines)] for m in found.measures]
    arrows = [[blunt(a) for a in m.arrows] for m in found.measures]
    whole = [unary_union(polylines(m.lines)) for m in found.measures]
    bad = []
    for i, m in enumerate(found.measures):
        main, heads = unary_union(mains[i]), unary_union(arrows[i])
        for j, other in enumerate(found.measures):
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


def beyond(found):
    """Lines that are not the frame's and leave it."""
    inside = framed(found).buffer(1e-6)
    own = [shape for shape in found.shapes if shape.layer != FRAME]
    lines = lines_of(found._replace(shapes=tuple(own)))
    return [line.bounds for line in lines if not inside.contains(line)]


def framed(found):
    """What is inside the frame."""
    return box(LEFT, MARGIN, found.width - MARGIN, found.height - MARGIN)


def assert_measured(found):
    """Each dimension says what its points are apart, at the scale of its view, in its units."""
    for m in found.measures:
        unit = 25.4 if found.units == "inch" and m.kind != "angular" else 1.0
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
        assert shown == pytest.approx(m.value / unit, abs=5.1e-4)  # three decimals


def number(value):
    """A size as a drawing writes it: three decimals at most."""
    text = f"{round(value, 3) + 0.0:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def assert_as_listed(found, rows, close=5.1e-4):
    """The sheet shows what the list of parts prints: each part by name, count, thickness, mass.

    ``rows`` are the list's, as dictionaries; masses are written with four digits, and walls that
    are drawn coarser than the list's move them by more, ``close``.
    """
    texts = [label.text for label in found.texts]
    said = " ".join(texts)
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
        assert titled in said or f"{i} {name}" in said or name in said, name
    total, unit = texts[texts.index("mass") + 1].split()
    assert float(total) * {"kg": 1.0, "mg": 1e-6}[unit] == pytest.approx(masses, rel=close)
    sizes = {row["name"]: row["value"] for row in rows if row["row"] == "dimension"}
    length = next(
        f"{letter} = {number(sizes[name])}"
        for letter, name in (("L", "centre distance"), ("R", "crank radius"))
        if name in sizes
    )
    assert length in said
    if "roller radius" in sizes:  # a counter has teeth
        rolls = f"Ø {number(2.0 * sizes['roller radius'])}"
        assert rolls in said, rolls
