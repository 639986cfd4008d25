"""The lines and arcs of an SVG file, in millimetres, with y upwards. Points are complex numbers."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from xml.etree import ElementTree

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.foreign.drawn import Drawn, bezier_pieces, ellipse_pieces

# millimetres in a unit of a length; a CSS pixel is 1/96 inch
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0, "q": 0.25}
HIDDEN = {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "title", "style"}
LAYERS = {"center", "pitch", "dimension", "text", "engrave", "hidden"}  # ids of what bounds no part
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
# the numbers of each letter of a path
COUNTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}


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
    unit = UNITS.get(width[2].lower()) if width else None
    notes: tuple[str, ...] = ()
    if width is None or unit is None:
        unit, notes = 1.0, ("has no width in mm: its units are taken as millimetres",)
    elif len(box) == 4:
        size = float(width[1]) * unit
        if not (box[2] > 0.0 and size > 0.0):
            raise GenevaError("width and viewBox must be above 0")
        unit = size / box[2]
    traced = _Traced()
    up = _matrix(unit, 0.0, 0.0, -unit)  # its y axis points down
    for element, traced.frame in _shapes(root, up):
        _trace(element, traced)
    return Drawn(tuple(traced.pieces), notes, traced.is_exact)


def _name(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(NUMBER, text)]


def _shapes(
    element: ElementTree.Element, frame: Array
) -> Iterator[tuple[ElementTree.Element, Array]]:
    """Yield the shapes that are shown, with the transforms of their groups."""
    style = element.get("style", "").replace(" ", "") + ";"
    hidden = element.get("display") == "none" or "display:none" in style
    layers = {element.get("id", "").lower(), element.get("class", "").lower()}
    if hidden or layers & LAYERS or _name(element) in HIDDEN:
        return
    text = element.get("transform", "")
    for function, values in re.findall(r"(\w+)\s*\(([^)]*)\)", text):
        try:
            frame = frame @ _transform(function, _numbers(values))
        except (IndexError, TypeError):
            raise GenevaError(f'transform="{cut(text, 100)}" cannot be read') from None
    yield element, frame
    for child in element:
        if isinstance(child.tag, str):
            yield from _shapes(child, frame)


def _transform(name: str, v: list[float]) -> Array:
    if name == "matrix" and len(v) == 6:
        return _matrix(*v)
    if name == "translate":
        return _matrix(1.0, 0.0, 0.0, 1.0, v[0], v[1] if len(v) > 1 else 0.0)
    if name == "scale":
        return _matrix(v[0], 0.0, 0.0, v[1] if len(v) > 1 else v[0])
    if name == "rotate":
        c, s = math.cos(math.radians(v[0])), math.sin(math.radians(v[0]))
        x, y = (*v[1:3], 0.0, 0.0)[:2]
        return _matrix(c, s, -s, c, x - c * x + s * y, y - s * x - c * y)
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


def _trace(element: ElementTree.Element, out: _Traced) -> None:
    """Add the pieces of a path or of a basic shape."""
    name = _name(element)
    if name in ("circle", "ellipse"):
        x, y = _lengths(element, "cx cy")
        rx, ry = _lengths(element, "r r" if name == "circle" else "rx ry")
        out.ellipse(complex(x, y), rx + 0j, ry * 1j, 0.0, math.tau)
    elif name == "path":
        _trace_path(element.get("d", ""), out)
    elif name in ("line", "polygon", "polyline"):
        v = _numbers(element.get("points", ""))
        v = _lengths(element, "x1 y1 x2 y2") if name == "line" else v
        corners = [complex(*pair) for pair in zip(v[::2], v[1::2], strict=False)]
        for p, q in pairwise([*corners, *corners[: name == "polygon"]]):
            if p != q:
                out.line(p, q)
    elif name in ("image", "rect", "use"):
        raise GenevaError(f"<{name}> is no outline: convert it to a path")


def _matrix(a: float, b: float, c: float, d: float, e: float = 0.0, f: float = 0.0) -> Array:
    """The transform x' = a x + c y + e, y' = b x + d y + f."""
    return np.array([[a, c, e], [b, d, f], [0.0, 0.0, 1.0]])


class _Traced:
    """The pieces of shapes, each with the transform of its place."""

    def __init__(self) -> None:
        self.pieces: list[Line | Arc] = []
        self.is_exact = True
        self.frame = np.eye(3)

    def placed(self, z: complex, shift: float = 1.0) -> complex:
        """The image of a point, or without a shift of a direction."""
        x, y, _ = self.frame @ (z.real, z.imag, shift)
        return complex(x, y)

    def line(self, p: complex, q: complex) -> None:
        """Add a line."""
        p, q = self.placed(p), self.placed(q)
        self.pieces.append(Line((p.real, p.imag), (q.real, q.imag)))

    def curve(self, poles: Sequence[complex]) -> None:
        """Add a quadratic or cubic Bézier curve, as arcs."""
        self.pieces += bezier_pieces([*map(self.placed, poles)])
        self.is_exact = False

    def ellipse(
        self, centre: complex, major: complex, minor: complex, start: float, sweep: float
    ) -> None:
        """Add a part of an ellipse from its half axes, as arcs; angles are parameters, radians."""
        p, q = self.placed(major, 0.0), self.placed(minor, 0.0)
        if abs((p.conjugate() * q).imag) <= 1e-9 * max(abs(p), abs(q)) ** 2:
            raise GenevaError("a circle or ellipse has no width: remove it")
        self.pieces += ellipse_pieces(self.placed(centre), (p, q), (start, sweep))


def _trace_path(data: str, out: _Traced) -> None:
    """Add the pieces of path data. Raises GenevaError, with the place, for what it cannot read."""
    at = first = 0j
    before = ("", 0j)  # the last letter, and the last pole of its curve
    for letter, v in _commands(data):
        kind, relative = letter.upper(), letter.islower()
        base = at if relative else 0j
        if kind == "M":
            at = first = base + complex(*v)
            before = ("M", at)
            continue
        pole = at
        if kind == "Z":
            end = first
        elif kind == "H":
            end = complex(v[0] + base.real, at.imag)
        elif kind == "V":
            end = complex(at.real, v[0] + base.imag)
        else:
            end = base + complex(*v[-2:])
        if kind in "CSQT":
            poles = [base + complex(*pair) for pair in zip(v[:-2:2], v[1:-2:2], strict=True)]
            if kind in "ST":
                alike = before[0] in ("CS" if kind == "S" else "QT")
                poles.insert(0, 2.0 * at - before[1] if alike else at)
            pole = poles[-1]
            out.curve((at, *poles, end))
        elif kind == "A":
            _elliptical_arc(at, end, v, out)
        elif end != at:
            out.line(at, end)
        at, before = end, (kind, pole)


def _commands(data: str) -> Iterator[tuple[str, list[float]]]:
    """Yield letters with their numbers; a letter may be left out where it repeats."""
    text, place, letter = data.strip(), 0, ""
    if text and text[0] not in "Mm":
        raise GenevaError(f'a path must begin with M, not with "{cut(text, 20)}"')
    while place < len(text):
        if text[place].isspace() or text[place] == ",":
            place += 1
            continue
        if text[place].isalpha():
            letter = text[place]
            place += 1
        if letter.upper() not in COUNTS:
            shown = cut(text[place - 1 : place + 20], 20)
            raise GenevaError(f'a path has "{shown}": unknown letter')
        values: list[float] = []
        for k in range(COUNTS[letter.upper()]):
            # the flags of an arc may stand without a space between them
            form = r"[01]" if letter in "Aa" and k in (3, 4) else NUMBER
            found = re.compile(rf"[\s,]*({form})").match(text, place)
            if not found:
                raise GenevaError(
                    f'a path breaks off at "{cut(text[place : place + 20], 20)}", where {letter} '
                    f"needs {COUNTS[letter.upper()]} numbers"
                )
            values.append(float(found[1]))
            place = found.end()
        yield letter, values
        letter = {"M": "L", "m": "l", "Z": "", "z": ""}.get(letter, letter)


def _elliptical_arc(start: complex, end: complex, v: list[float], out: _Traced) -> None:
    """Add an elliptical arc by its centre, from both ends as in SVG 1.1, appendix F.6.5."""
    rx, ry, turn = abs(v[0]), abs(v[1]), cmath.exp(1j * math.radians(v[2]))
    if not (rx and ry) or start == end:
        out.line(start, end)
        return
    half = 0.5 * (start - end) / turn
    x, y = half.real / rx, half.imag / ry
    size = math.hypot(x, y)
    if size > 1.0:  # too small to reach both ends
        rx, ry, x, y = rx * size, ry * size, x / size, y / size
        size = 1.0
    root = math.sqrt(max(1.0 - size * size, 0.0)) / size
    side = 1.0 if bool(v[3]) != bool(v[4]) else -1.0
    middle = complex(y, -x) * root * side  # in the frame in which it is the unit circle
    first, last = complex(x, y) - middle, complex(-x, -y) - middle
    sweep = cmath.phase(last / first)
    if v[4] and sweep < 0.0:
        sweep += math.tau
    elif not v[4] and sweep > 0.0:
        sweep -= math.tau
    centre = 0.5 * (start + end) + complex(middle.real * rx, middle.imag * ry) * turn
    out.ellipse(centre, rx * turn, ry * 1j * turn, cmath.phase(first), sweep)
