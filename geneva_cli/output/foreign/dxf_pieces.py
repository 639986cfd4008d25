"""The lines and arcs of a DXF file, of any version, in millimetres."""

import math
from collections.abc import Iterable, Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.fit import arcs
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.output.ezdxf_alone import ConstructionEllipse, Document, readfile
from geneva_cli.output.foreign.drawn import CURVE_MM, Drawn, Ellipse, Traced, drawing, traced

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
KNOWN = ("LINE", "ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE", "ELLIPSE", "SPLINE")
DEEPEST = 16  # blocks in blocks


def read_dxf(data: bytes, path: str) -> Drawn:
    """Return the lines and arcs of a DXF file's model space; ``data`` are the bytes at ``path``.

    Layers that are off, and those of centre lines and texts, are left out. Raises GenevaError for
    data that is no DXF file, and for an entity that is no outline.
    """
    try:
        document = readfile(path)
    except Exception as error:  # the library raises errors of all kinds for damaged data
        reason = cut(str(error).strip() or type(error).__name__, 200)
        raise GenevaError(f"not a DXF file that can be read: {reason}") from None
    # a file without a header gets the library's own, whose unit is the metre
    code = int(document.header.get("$INSUNITS", 0) or 0) if b"$INSUNITS" in data else 0
    if code and code not in UNITS:
        raise GenevaError(
            f"$INSUNITS is {code}: it must be one of {', '.join(map(str, UNITS))}; 4 is millimetres"
        )
    rows, unit = list[Traced](), UNITS.get(code, 1.0)
    for entity in _entities(document, document.modelspace(), 0):
        kind = entity.dxftype()
        if kind not in KNOWN:
            raise GenevaError(
                f"{kind} on layer {cut(entity.dxf.get('layer', '0'))} is no outline; draw it as "
                f"one of {', '.join(KNOWN)}"
            )
        try:
            rows.append(_pieces(kind, entity, unit))
        except (ArithmeticError, ValueError, LookupError, AttributeError) as error:
            handle = entity.dxf.get("handle", "?")
            raise GenevaError(f"{kind} with the handle {handle} cannot be read: {error}") from None
    notes = () if code else ("has no unit ($INSUNITS): its numbers are taken as millimetres",)
    return drawing(rows, notes)


def _entities(document: Document, entities: Iterable[Any], depth: int) -> Iterator[Any]:
    """Yield the entities that are shown and bound parts, those of blocks too."""
    if depth > DEEPEST:
        raise GenevaError(f"blocks are nested more than {DEEPEST} deep")
    for entity in entities:
        kind, layer = entity.dxftype(), entity.dxf.get("layer", "0")
        known = document.layers.get(layer) if document.layers.has_entry(layer) else None
        line = str(entity.dxf.get("linetype", "BYLAYER")).upper()
        if line == "BYLAYER" and known:
            line = str(known.dxf.get("linetype", "")).upper()
        off = layer.upper() in LAYERS or (known and (known.is_off() or known.is_frozen()))
        if kind in PASSED or off or line.startswith(DASHED) or entity.dxf.get("invisible", 0):
            continue
        if kind != "INSERT":
            yield entity
            continue
        if entity.dxf.name not in document.blocks:
            raise GenevaError(f"INSERT of a block that the file lacks: {cut(entity.dxf.name, 100)}")
        several = entity.multi_insert() if entity.mcount > 1 else [entity]
        for one in several:
            yield from _entities(document, one.virtual_entities(), depth + 1)


def _pieces(kind: str, entity: Any, unit: float) -> Traced:
    """Return an entity's pieces, mm, as ``traced``; a unit of the drawing has ``unit`` mm."""
    dxf = entity.dxf
    # as seen from above: the entity may be in a plane seen from below
    up = dxf.get("extrusion", (0.0, 0.0, 1.0))
    if kind in ("ARC", "CIRCLE", "LWPOLYLINE", "POLYLINE") and abs(abs(up[2]) - 1.0) > 1e-9:
        raise GenevaError(f"{kind} does not lie in the drawing's plane")
    if kind == "SPLINE":
        return _spline(entity.construction_tool(), unit), False
    if kind == "LINE":
        return traced((_complex(dxf.start), _complex(dxf.end)), lambda z: unit * z)
    if kind in ("ELLIPSE", "ARC", "CIRCLE"):
        if kind == "ELLIPSE":
            tool = entity.construction_tool()
        else:
            angles = (dxf.start_angle, dxf.end_angle) if kind == "ARC" else ()
            tool = ConstructionEllipse.from_arc(dxf.center, dxf.radius, up, *angles)
        axes = _complex(tool.center), _complex(tool.major_axis), _complex(tool.minor_axis)
        sweep = (tool.end_param - tool.start_param) % math.tau or math.tau
        return traced(Ellipse(*axes, tool.start_param, sweep), lambda z: unit * z)
    if kind == "LWPOLYLINE":
        points, is_closed = [*entity.get_points("xyb")], entity.closed
    else:
        if entity.is_poly_face_mesh or entity.is_polygon_mesh:
            raise GenevaError("POLYLINE is a mesh, not an outline")
        # 16: points of the frame of a fitted curve
        corners = [v.dxf for v in entity.vertices if not v.dxf.flags & 16]
        points = [(v.location.x, v.location.y, v.bulge) for v in corners]
        is_closed = entity.is_closed
    ends = [((unit * up[2] * x, unit * y), up[2] * b) for x, y, b in points]
    pairs = pairwise([*ends, *ends[: 1 * is_closed]])
    return [Arc(p, q, bulge) if bulge else Line(p, q) for (p, bulge), (q, _) in pairs], True


def _complex(v: Any) -> complex:
    return complex(v[0], v[1])


def _spline(tool: Any, unit: float) -> list[Line | Arc]:
    knots, degree = list(tool.knots()), tool.degree
    if degree == 1:
        points = [(unit * v.x, unit * v.y) for v in tool.control_points]
        return [Line(p, q) for p, q in pairwise(points)]

    def curve(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        low, high = knots[degree], knots[-degree - 1]
        rows = list(tool.derivatives([min(max(float(x), low), high) for x in t], 1))
        points = unit * np.array([(p.x, p.y) for p, _ in rows])
        rates = np.array([(d.x, d.y) for _, d in rows])
        return points, rates / np.hypot(*rates.T)[:, None]

    # at a knot of the degree's multiplicity the curve may have a corner
    inner = sorted(set(knots[degree : len(knots) - degree]))
    corners = [k for k in inner[1:-1] if knots.count(k) >= degree]
    edge = 1e-12 * (inner[-1] - inner[0])
    out: list[Line | Arc] = []
    for a, b in pairwise([inner[0], *corners, inner[-1]]):
        low, high = a + (edge if a in corners else 0.0), b - (edge if b in corners else 0.0)
        out += arcs(curve, low, high, CURVE_MM)
    return out
