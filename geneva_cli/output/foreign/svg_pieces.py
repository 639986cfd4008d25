"""The lines and arcs of an SVG file, in millimetres, with y upwards."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple
from xml.etree import ElementTree

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.output.foreign.drawn import Drawn, bezier_pieces, ellipse_pieces
from geneva_cli.output.foreign.svg_paths import Move, moves, numbers

# millimetres in a unit of a length; a CSS pixel is 1/96 inch
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0, "q": 0.25}
HIDDEN = {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "title", "style"}
LAYERS = {"center", "pitch", "dimension", "text", "engrave", "hidden"}  # ids of what bounds no part

DEEPEST = 16  # <use> of <use>
SHAPES_MAX = 100_000  # that <use> may make of a short file

Pieces = list[Line | Arc]


class Affine(NamedTuple):
    """x and y of a point, as columns of a matrix: x' = a x + c y + e, y' = b x + d y + f."""

    a: float = 1.0
    b: float = 0.0
    c: float = 0.0
    d: float = 1.0
    e: float = 0.0
    f: float = 0.0

    def __call__(self, z: complex) -> complex:
        """The image of a point."""
        x, y = z.real, z.imag
        return complex(self.a * x + self.c * y + self.e, self.b * x + self.d * y + self.f)

    def turned(self, z: complex) -> complex:
        """The image of a direction."""
        return self(z) - self(0j)

    def after(self, other: Affine) -> Affine:
        """This one after another."""
        p, q, r = other(0j), other(1 + 0j), other(1j)
        e, x, y = self(p), self(q), self(r)
        one, two = x - e, y - e
        return Affine(one.real, one.imag, two.real, two.imag, e.real, e.imag)


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
    unit, note = _unit(root)
    up = Affine(unit, 0.0, 0.0, -unit)  # its y axis points down
    pieces: Pieces = []
    is_exact = True
    named = {element.get("id", ""): element for element in root.iter()}
    for count, (element, frame) in enumerate(_shapes(root, up, named)):
        if count > SHAPES_MAX:
            raise GenevaError(f"it shows more than {SHAPES_MAX} shapes, with those of <use>")
        for move in _moves(element):
            pieces += _pieces(move, frame)
            is_exact &= move.kind != "C"
    return Drawn(tuple(pieces), (note,) if note else (), is_exact)


def _name(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _unit(root: ElementTree.Element) -> tuple[float, str]:
    """Return the millimetres in a unit of the drawing, and a note where they are not known."""
    width = re.fullmatch(r"\s*([\d.eE+-]+)\s*([a-zA-Z]*|%)\s*", root.get("width", ""))
    box = numbers(root.get("viewBox", ""))
    unit = UNITS.get(width[2].lower()) if width else None
    if width is None or unit is None:
        return 1.0, "has no width in mm: its units are taken as millimetres"
    size = float(width[1]) * unit
    if len(box) != 4:
        return unit, ""
    if not (box[2] > 0.0 and size > 0.0):
        raise GenevaError("width and viewBox must be above 0")
    return size / box[2], ""


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
    frame = frame.after(_transform(element.get("transform", "")))
    if name == "use":
        if depth >= DEEPEST:
            raise GenevaError(f"<use> is nested more than {DEEPEST} deep")
        x, y = _sizes(element, "x y")
        yield from _shapes(_used(element, named), frame.after(Affine(e=x, f=y)), named, depth + 1)
        return
    yield element, frame
    for child in element:
        if isinstance(child.tag, str):
            yield from _shapes(child, frame, named, depth)


def _used(
    element: ElementTree.Element, named: dict[str, ElementTree.Element]
) -> ElementTree.Element:
    """Return the element that a <use> shows."""
    link = element.get("href") or element.get("{http://www.w3.org/1999/xlink}href") or ""
    target = named.get(link.removeprefix("#")) if link.startswith("#") else None
    if target is None:
        raise GenevaError(f'<use href="{cut(link, 40)}"> names nothing in the file')
    if target.get("viewBox"):
        raise GenevaError(f'<use href="{cut(link, 40)}"> has a viewBox of its own: convert it')
    return target


def _transform(text: str) -> Affine:
    out = Affine()
    for name, values in re.findall(r"(\w+)\s*\(([^)]*)\)", text):
        v = numbers(values)
        try:
            out = out.after(_matrix(name, v))
        except (IndexError, TypeError):
            raise GenevaError(f'transform="{cut(text, 100)}" cannot be read') from None
    return out


def _matrix(name: str, v: list[float]) -> Affine:
    if name == "matrix" and len(v) == 6:
        return Affine(*v)
    if name == "translate":
        return Affine(e=v[0], f=v[1] if len(v) > 1 else 0.0)
    if name == "scale":
        return Affine(a=v[0], d=v[1] if len(v) > 1 else v[0])
    if name == "rotate":
        c, s = math.cos(math.radians(v[0])), math.sin(math.radians(v[0]))
        own = Affine(c, s, -s, c)
        if len(v) < 3:
            return own
        return Affine(e=v[1], f=v[2]).after(own).after(Affine(e=-v[1], f=-v[2]))
    if name in ("skewX", "skewY"):
        slope = math.tan(math.radians(v[0]))
        return Affine(c=slope) if name == "skewX" else Affine(b=slope)
    raise GenevaError(f"transform {cut(name, 20)}() is not known")


def _moves(element: ElementTree.Element) -> Iterator[Move]:
    """Yield the pieces of a path or of a basic shape."""
    name = _name(element)
    if name == "path":
        yield from moves(element.get("d", ""))
    elif name in ("circle", "ellipse"):
        x, y = _sizes(element, "cx cy")
        rx, ry = _sizes(element, "r r" if name == "circle" else "rx ry")
        yield Move("A", (complex(x, y), rx + 0j, ry * 1j), (0.0, math.tau))
    elif name == "line":
        x1, y1, x2, y2 = _sizes(element, "x1 y1 x2 y2")
        yield Move("L", (complex(x1, y1), complex(x2, y2)))
    elif name in ("polygon", "polyline"):
        v = numbers(element.get("points", ""))
        points = [complex(*pair) for pair in zip(v[::2], v[1::2], strict=False)]
        ends = [*points, *points[:1]] if name == "polygon" else points
        yield from (Move("L", pair) for pair in pairwise(ends))
    elif name == "rect":
        x, y, w, h = _sizes(element, "x y width height")
        yield from _rectangle(complex(x, y), w, h, _rounding(element, w, h))
    elif name == "image":
        raise GenevaError("<image> is no outline: convert it to a path")


def _rounding(element: ElementTree.Element, w: float, h: float) -> tuple[float, float]:
    """Return the half axes of a rectangle's corners; one that is not given is as the other."""
    given = [key for key in ("rx", "ry") if element.get(key, "auto") != "auto"]
    if not given:
        return 0.0, 0.0
    rx, ry = _length(element, given[0]), _length(element, given[-1])
    return min(rx, 0.5 * w), min(ry, 0.5 * h)


def _rectangle(first: complex, w: float, h: float, round_: tuple[float, float]) -> Iterator[Move]:
    """Yield the edges of a rectangle, and its corners: quarters of ellipses, if any."""
    rx, ry = round_
    if not (rx > 0.0 and ry > 0.0):
        rx = ry = 0.0
    middle, inner = first + complex(0.5 * w, 0.5 * h), complex(0.5 * w - rx, 0.5 * h - ry)
    for k in range(4):
        # corners from that at x + w, y on, each with the edge before it
        sx, sy = ((1, -1), (1, 1), (-1, 1), (-1, -1))[k]
        centre = middle + complex(sx * inner.real, sy * inner.imag)
        start = math.pi * (0.5 * k - 0.5)
        along = 2.0 * inner.real if k % 2 == 0 else 2.0 * inner.imag
        begin = centre + complex(rx * math.cos(start), ry * math.sin(start))
        back = -along * 1j**k
        if along > 0.0:
            yield Move("L", (begin + back, begin))
        if rx > 0.0:
            yield Move("A", (centre, rx + 0j, ry * 1j), (start, 0.5 * math.pi))


def _sizes(element: ElementTree.Element, keys: str) -> list[float]:
    return [_length(element, key) for key in keys.split()]


def _length(element: ElementTree.Element, key: str) -> float:
    text = element.get(key, "0").strip().removesuffix("px")
    try:
        size = float(text)
    except ValueError:
        size = math.nan
    if math.isfinite(size):
        return size
    raise GenevaError(f'<{_name(element)}> {key}="{cut(text, 40)}" is no number')


def _pieces(move: Move, frame: Affine) -> Pieces:
    if move.kind == "L":
        p, q = (frame(z) for z in move.points)
        return [Line((p.real, p.imag), (q.real, q.imag))]
    if move.kind == "C":
        return bezier_pieces([frame(z) for z in move.points])
    centre, major, minor = move.points
    axes = _axes(frame.turned(major), frame.turned(minor))
    if min(map(abs, axes[:2])) <= 1e-9 * max(map(abs, axes[:2])):
        raise GenevaError("a circle or ellipse has no width: remove it")
    shift = cmath.phase(complex(*axes[2]))
    return ellipse_pieces(frame(centre), axes[:2], (move.span[0] - shift, move.span[1]))


def _axes(p: complex, q: complex) -> tuple[complex, complex, tuple[float, float]]:
    """Return the half axes, at right angles, of the ellipse p cos t + q sin t.

    The last pair has cosine and sine of the t at which the first of them is reached.
    """
    t = 0.5 * math.atan2(2.0 * (p.conjugate() * q).real, abs(p) ** 2 - abs(q) ** 2)
    c, s = math.cos(t), math.sin(t)
    return p * c + q * s, q * c - p * s, (c, s)
