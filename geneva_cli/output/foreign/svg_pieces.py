"""The lines and arcs of an SVG file, in millimetres, with y upwards. Points are complex numbers."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from itertools import pairwise
from xml.etree import ElementTree

from geneva_cli.errors import GenevaError, cut
from geneva_cli.output.foreign.drawn import Drawn
from geneva_cli.output.foreign.svg_paths import NUMBER, Affine, Traced, matrix, trace_path

# millimetres in a unit of a length; a CSS pixel is 1/96 inch
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0, "q": 0.25}
HIDDEN = {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "title", "style"}
LAYERS = {"center", "pitch", "dimension", "text", "engrave", "hidden"}  # ids of what bounds no part
DEEPEST = 16  # <use> of <use>
SHAPES_MAX = 100_000  # that <use> may make of a short file


def read_svg(data: bytes) -> Drawn:
    """Return the lines and arcs of an SVG file: paths and basic shapes, with their transforms.

    Raises GenevaError for data that is no SVG file, and for a path that cannot be read.
    """
    if b"<!ENTITY" in data:
        raise GenevaError("it defines entities, which no drawing needs: save it as plain SVG")
    try:
        root = ElementTree.fromstring(data)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise GenevaError(f"not an SVG file that can be read: {error}") from None
    if _name(root) != "svg":
        raise GenevaError(f"this is no SVG file: its first element is <{cut(_name(root), 50)}>")
    width = re.fullmatch(r"\s*([\d.eE+-]+)\s*([a-zA-Z]*|%)\s*", root.get("width", ""))
    box = _numbers(root.get("viewBox", ""))
    unit, notes = UNITS.get(width[2].lower()) if width else None, ()
    if width is None or unit is None:
        unit, notes = 1.0, ("has no width in mm: its units are taken as millimetres",)
    elif len(box) == 4:
        size = float(width[1]) * unit
        if not (box[2] > 0.0 and size > 0.0):
            raise GenevaError("width and viewBox must be above 0")
        unit = size / box[2]
    traced = Traced()
    named = {element.get("id", ""): element for element in root.iter()}
    up = matrix(unit, 0.0, 0.0, -unit)  # its y axis points down
    for count, (element, frame) in enumerate(_shapes(root, up, named)):
        if count > SHAPES_MAX:
            raise GenevaError(f"it shows more than {SHAPES_MAX} shapes, with those of <use>")
        traced.frame = frame
        _trace(element, traced)
    return Drawn(tuple(traced.pieces), notes, traced.is_exact)


def _name(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(NUMBER, text)]


def _shapes(
    element: ElementTree.Element,
    frame: Affine,
    named: dict[str, ElementTree.Element],
    depth: int = 0,
) -> Iterator[tuple[ElementTree.Element, Affine]]:
    """Yield the shapes that are shown, with the transforms of their groups and of <use>."""
    style = element.get("style", "").replace(" ", "") + ";"
    hidden = element.get("display") == "none" or "display:none" in style
    name, layer = _name(element), element.get("id", "").lower()
    if hidden or layer in LAYERS or element.get("class", "").lower() in LAYERS:
        return
    if name in HIDDEN and not (name == "symbol" and depth):  # a symbol is shown by <use>
        return
    text = element.get("transform", "")
    for function, values in re.findall(r"(\w+)\s*\(([^)]*)\)", text):
        try:
            frame = frame.after(_transform(function, _numbers(values)))
        except (IndexError, TypeError):
            raise GenevaError(f'transform="{cut(text, 100)}" cannot be read') from None
    if name == "use":
        if depth >= DEEPEST:
            raise GenevaError(f"<use> is nested more than {DEEPEST} deep")
        link = element.get("href") or element.get("{http://www.w3.org/1999/xlink}href") or ""
        target = named.get(link.removeprefix("#")) if link.startswith("#") else None
        if target is None:
            raise GenevaError(f'<use href="{cut(link, 40)}"> names nothing in the file')
        if target.get("viewBox"):
            raise GenevaError(f'<use href="{cut(link, 40)}"> has a viewBox of its own: convert it')
        shift = Affine(shift=complex(*_lengths(element, "x y")))
        yield from _shapes(target, frame.after(shift), named, depth + 1)
        return
    yield element, frame
    for child in element:
        if isinstance(child.tag, str):
            yield from _shapes(child, frame, named, depth)


def _transform(name: str, v: list[float]) -> Affine:
    if name == "matrix" and len(v) == 6:
        return matrix(*v)
    if name == "translate":
        return Affine(shift=complex(v[0], v[1] if len(v) > 1 else 0.0))
    if name == "scale":
        return matrix(v[0], 0.0, 0.0, v[1] if len(v) > 1 else v[0])
    if name == "rotate":
        turn, centre = cmath.exp(1j * math.radians(v[0])), complex(*v[1:3])
        return Affine(turn, 0j, centre - turn * centre)
    if name in ("skewX", "skewY"):
        slope = math.tan(math.radians(v[0]))
        return matrix(1.0, 0.0, slope, 1.0) if name == "skewX" else matrix(1.0, slope, 0.0, 1.0)
    raise GenevaError(f"transform {cut(name, 20)}() is not known")


def _lengths(element: ElementTree.Element, keys: str) -> list[float]:
    """Return the sizes of some keys. Raises GenevaError for what is no number."""
    sizes = []
    for key in keys.split():
        text = element.get(key, "0").strip().removesuffix("px")
        try:
            size = float(text)
        except ValueError:
            size = math.nan
        if not math.isfinite(size):
            raise GenevaError(f'<{_name(element)}> {key}="{cut(text, 40)}" is no number')
        sizes.append(size)
    return sizes


def _trace(element: ElementTree.Element, out: Traced) -> None:
    """Add the pieces of a path or of a basic shape."""
    name = _name(element)
    if name == "path":
        trace_path(element.get("d", ""), out)
    elif name in ("circle", "ellipse"):
        x, y = _lengths(element, "cx cy")
        rx, ry = _lengths(element, "r r" if name == "circle" else "rx ry")
        out.ellipse(complex(x, y), rx + 0j, ry * 1j, 0.0, math.tau)
    elif name == "line":
        x1, y1, x2, y2 = _lengths(element, "x1 y1 x2 y2")
        out.line(complex(x1, y1), complex(x2, y2))
    elif name in ("polygon", "polyline"):
        v = _numbers(element.get("points", ""))
        points = [complex(*pair) for pair in zip(v[::2], v[1::2], strict=False)]
        for p, q in pairwise([*points, *points[:1]] if name == "polygon" else points):
            out.line(p, q)
    elif name == "rect":
        _rectangle(element, out)
    elif name == "image":
        raise GenevaError("<image> is no outline: convert it to a path")


def _rectangle(element: ElementTree.Element, out: Traced) -> None:
    """Add the edges of a rectangle, and its corners: quarters of ellipses, if any."""
    x, y, w, h = _lengths(element, "x y width height")
    rx = ry = 0.0
    # one half axis of the corners that is not given is as the other
    given = [key for key in ("rx", "ry") if element.get(key, "auto") != "auto"]
    if given:
        rx, ry = _lengths(element, f"{given[0]} {given[-1]}")
        rx, ry = min(rx, 0.5 * w), min(ry, 0.5 * h)
    if not (rx > 0.0 and ry > 0.0):
        rx = ry = 0.0
    middle, inner = complex(x + 0.5 * w, y + 0.5 * h), complex(0.5 * w - rx, 0.5 * h - ry)
    for k, (sx, sy) in enumerate(((1, -1), (1, 1), (-1, 1), (-1, -1))):
        # corners from that at x + w, y on, each with the edge before it
        centre = middle + complex(sx * inner.real, sy * inner.imag)
        start = math.pi * (0.5 * k - 0.5)
        along = 2.0 * inner.real if k % 2 == 0 else 2.0 * inner.imag
        begin = centre + complex(rx * math.cos(start), ry * math.sin(start))
        if along > 0.0:
            out.line(begin - along * 1j**k, begin)
        if rx > 0.0:
            out.ellipse(centre, rx + 0j, ry * 1j, start, 0.5 * math.pi)
