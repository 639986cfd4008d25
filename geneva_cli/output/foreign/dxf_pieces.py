"""The lines and arcs of a DXF file, of any version, in millimetres."""

from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.measure import mapped
from geneva_cli.geometry.shapes import Arc, Contour, Line
from geneva_cli.output.ezdxf_alone import Document, readfile
from geneva_cli.output.foreign.drawn import Drawn, arc_pieces, bulged, ellipse_pieces, fitted

# $INSUNITS: millimetres in one unit
UNITS = {
    1: 25.4, 2: 304.8, 4: 1.0, 5: 10.0, 6: 1e3, 8: 2.54e-5, 9: 0.0254, 10: 914.4, 13: 1e-3, 14: 1e2,
}  # fmt: skip
# layers and line types of what bounds no part
LAYERS = {
    "CENTER", "CENTERLINE", "CENTRE", "CONSTRUCTION", "DEFPOINTS", "DIM", "DIMENSION",
    "DIMENSIONS", "ENGRAVE", "HIDDEN", "PITCH", "TEXT",
}  # fmt: skip
DASHED = ("CENTER", "HIDDEN", "DASH", "PHANTOM", "DIVIDE", "DOT")
# entities that bound no part
PASSED = {
    "TEXT", "MTEXT", "DIMENSION", "ARC_DIMENSION", "LEADER", "MULTILEADER", "MLEADER", "HATCH",
    "POINT", "ATTDEF", "ATTRIB", "VIEWPORT", "TOLERANCE", "IMAGE", "WIPEOUT", "XLINE", "RAY",
}  # fmt: skip
DEEPEST = 16  # blocks in blocks

Pieces = list[Line | Arc]


def read_dxf(data: bytes) -> Drawn:
    """Return the lines and arcs of a DXF file's model space.

    Layers that are off, and those of centre lines and texts, are left out. Raises GenevaError for
    data that is no DXF file, and for an entity that is no outline.
    """
    document = _document(data)
    # a file without a header gets the library's own, whose unit is the metre
    code = int(document.header.get("$INSUNITS", 0) or 0) if b"$INSUNITS" in data else 0
    if code and code not in UNITS:
        raise GenevaError(
            f"$INSUNITS is {code}: it must be one of {', '.join(map(str, UNITS))}; 4 is millimetres"
        )
    pieces: Pieces = []
    exact, unit = True, UNITS.get(code, 1.0)
    for entity in _entities(document, document.modelspace(), 0):
        pieces += _pieces(entity, unit)
        exact &= entity.dxftype() not in CURVED
    if unit != 1.0 and pieces:
        scaled = mapped(Contour("", tuple(pieces)), lambda p: (p[0] * unit, p[1] * unit), abs)
        pieces = list(scaled.segments)  # type: ignore[arg-type]  # no cubics
    notes = () if code else ("has no unit ($INSUNITS): its numbers are taken as millimetres",)
    return Drawn(tuple(pieces), notes, exact)


def _document(data: bytes) -> Document:
    # ezdxf finds the encoding, and text or binary, only of a file with a name
    handle, path = tempfile.mkstemp(suffix=".dxf")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(data)
        return readfile(path)
    except Exception as error:  # the library raises errors of all kinds for damaged data
        if "is not a DXF file" in str(error):
            raise GenevaError("this is no DXF file") from None
        reason = cut(str(error).replace(path, "the file").strip() or type(error).__name__, 200)
        raise GenevaError(f"not a DXF file that can be read: {reason}") from None
    finally:
        os.unlink(path)


def _entities(document: Document, entities: Iterable[Any], depth: int) -> Iterator[Any]:
    """Yield the entities that bound parts, those of blocks too."""
    if depth > DEEPEST:
        raise GenevaError(f"blocks are nested more than {DEEPEST} deep")
    for entity in entities:
        kind, layer = entity.dxftype(), entity.dxf.get("layer", "0")
        if kind in PASSED or not _is_shown(document, entity, layer):
            continue
        if kind != "INSERT":
            yield entity
            continue
        if entity.dxf.name not in document.blocks:
            raise GenevaError(f"INSERT of a block that the file lacks: {cut(entity.dxf.name, 100)}")
        several = entity.multi_insert() if entity.mcount > 1 else [entity]
        for one in several:
            yield from _entities(document, one.virtual_entities(), depth + 1)


def _is_shown(document: Document, entity: Any, layer: str) -> bool:
    known = document.layers.get(layer) if document.layers.has_entry(layer) else None
    if layer.upper() in LAYERS or (known and (known.is_off() or known.is_frozen())):
        return False
    line = str(entity.dxf.get("linetype", "BYLAYER")).upper()
    if line == "BYLAYER" and known:
        line = str(known.dxf.get("linetype", "")).upper()
    return not line.startswith(DASHED) and not entity.dxf.get("invisible", 0)


def _pieces(entity: Any, unit: float) -> Pieces:
    kind = entity.dxftype()
    if kind not in READERS and kind not in CURVED:
        known = ", ".join((*READERS, *CURVED))
        raise GenevaError(
            f"{kind} on layer {cut(entity.dxf.get('layer', '0'))} is no outline; draw it as one of "
            f"{known}"
        )
    try:
        return CURVED[kind](entity, unit) if kind in CURVED else READERS[kind](entity)
    except (ArithmeticError, ValueError, LookupError, AttributeError) as error:
        handle = entity.dxf.get("handle", "?")
        raise GenevaError(f"{kind} with the handle {handle} cannot be read: {error}") from None


def _line(entity: Any) -> Pieces:
    (x0, y0, _), (x1, y1, _) = entity.dxf.start, entity.dxf.end
    return [Line((x0, y0), (x1, y1))]


def _arc(entity: Any) -> Pieces:
    dxf = entity.dxf
    start = math.radians(dxf.start_angle)
    sweep = math.radians((dxf.end_angle - dxf.start_angle) % 360.0) or math.tau
    return _seen(entity, arc_pieces(tuple(dxf.center)[:2], dxf.radius, start, sweep))


def _circle(entity: Any) -> Pieces:
    return _seen(entity, arc_pieces(tuple(entity.dxf.center)[:2], entity.dxf.radius, 0.0, math.tau))


def _lwpolyline(entity: Any) -> Pieces:
    points = [tuple(map(float, point)) for point in entity.get_points("xyb")]
    return _seen(entity, bulged(points, entity.closed))  # type: ignore[arg-type]


def _polyline(entity: Any) -> Pieces:
    if entity.is_poly_face_mesh or entity.is_polygon_mesh:
        raise GenevaError("POLYLINE is a mesh, not an outline")
    # 16: points of the frame of a fitted curve
    corners = [v for v in entity.vertices if not v.dxf.flags & 16]
    points = [(v.dxf.location.x, v.dxf.location.y, float(v.dxf.bulge)) for v in corners]
    pieces = bulged(points, entity.is_closed)
    return _seen(entity, pieces) if entity.is_2d_polyline else pieces


def _ellipse(entity: Any, unit: float) -> Pieces:
    tool = entity.construction_tool()
    axes = tool.center, tool.major_axis, tool.minor_axis
    centre, major, minor = (complex(v.x, v.y) for v in axes)
    sweep = (tool.end_param - tool.start_param) % math.tau or math.tau
    return ellipse_pieces(centre, (major, minor), (tool.start_param, sweep), unit)


def _spline(entity: Any, unit: float) -> Pieces:
    tool = entity.construction_tool()
    knots, degree = list(tool.knots()), tool.degree
    if degree == 1:
        points = [(v.x, v.y) for v in tool.control_points]
        return [Line(p, q) for p, q in pairwise(points)]

    def curve(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        low, high = knots[degree], knots[-degree - 1]
        rows = list(tool.derivatives([min(max(float(x), low), high) for x in t], 1))
        points = np.array([(p.x, p.y) for p, _ in rows])
        rates = np.array([(d.x, d.y) for _, d in rows])
        return points, rates / np.hypot(*rates.T)[:, None]

    # at a knot of the degree's multiplicity the curve may have a corner
    inner = sorted(set(knots[degree : len(knots) - degree]))
    corners = [k for k in inner[1:-1] if knots.count(k) >= degree]
    places = [inner[0], *corners, inner[-1]]
    edge = 1e-12 * (inner[-1] - inner[0])
    out: Pieces = []
    for a, b in pairwise(places):
        low, high = a + (edge if a in corners else 0.0), b - (edge if b in corners else 0.0)
        out += fitted(curve, low, high, unit)
    return out


READERS: dict[str, Callable[[Any], Pieces]] = {
    "LINE": _line,
    "ARC": _arc,
    "CIRCLE": _circle,
    "LWPOLYLINE": _lwpolyline,
    "POLYLINE": _polyline,
}
# curves that become arcs
CURVED: dict[str, Callable[[Any, float], Pieces]] = {"ELLIPSE": _ellipse, "SPLINE": _spline}


def _seen(entity: Any, pieces: Pieces) -> Pieces:
    """Return pieces as seen from above, which an entity may have in a plane seen from below."""
    across = entity.dxf.get("extrusion", (0.0, 0.0, 1.0))
    if abs(abs(across[2]) - 1.0) > 1e-9:
        raise GenevaError(f"{entity.dxftype()} does not lie in the drawing's plane")
    if across[2] > 0.0:
        return pieces
    return [_flipped(piece) for piece in pieces]


def _flipped(piece: Line | Arc) -> Line | Arc:
    (x0, y0), (x1, y1) = piece.start, piece.end
    if isinstance(piece, Arc):
        return Arc((-x0, y0), (-x1, y1), -piece.bulge)
    return Line((-x0, y0), (-x1, y1))
