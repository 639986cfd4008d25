"""The lines and arcs of an SVG file, in millimetres, with y upwards. Points are complex numbers."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Iterator
from itertools import pairwise
from xml.etree import ElementTree

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.output.foreign.drawn import Curve, Drawn, Ellipse, Frame, traced

# millimetres in a unit of a length; a CSS pixel is 1/96 inch
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0, "q": 0.25}
HIDDEN = {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "title", "style"}
LAYERS = {"center", "pitch", "dimension", "text", "engrave", "hidden"}  # ids of what bounds no part
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
GAP = r"[\s,]*"
# the numbers of each letter of a path; the flags of an arc may stand without a space between them
COUNTS = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_forms = {letter: [f"({NUMBER})"] * count for letter, count in COUNTS.items()}
_forms["A"][3:5] = ["([01])"] * 2
# a frame by the numbers of its transform
TRANSFORMS: dict[str, Callable[..., Frame]] = {
    "matrix": lambda a, b, c, d, e, f: (
        lambda z: complex(a * z.real + c * z.imag + e, b * z.real + d * z.imag + f)
    ),
    "translate": lambda x, y=0.0: lambda z: z + complex(x, y),
    "scale": lambda x, y=None: lambda z: complex(x * z.real, (x if y is None else y) * z.imag),
    "rotate": lambda turn, x=0.0, y=0.0: (
        lambda z: complex(x, y) + cmath.rect(1.0, math.radians(turn)) * (z - complex(x, y))
    ),
}
FORMS = {letter: re.compile(GAP.join(["", *form, ""])) for letter, form in _forms.items()}


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
    pieces: list[Line | Arc] = []
    is_exact = True
    for element, frame in _shapes(root, lambda z: unit * z.conjugate()):  # its y axis points down
        for curve in _curves(element):
            own, exact = traced(curve, frame)
            pieces += own
            is_exact &= exact
    return Drawn(tuple(pieces), notes, is_exact)


def _name(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(NUMBER, text)]


def _shapes(
    element: ElementTree.Element, frame: Frame
) -> Iterator[tuple[ElementTree.Element, Frame]]:
    """Yield the shapes that are shown, with the transforms of their groups."""
    style = element.get("style", "").replace(" ", "") + ";"
    hidden = element.get("display") == "none" or "display:none" in style
    layers = {element.get("id", "").lower(), element.get("class", "").lower()}
    if hidden or layers & LAYERS or _name(element) in HIDDEN:
        return
    for text, name, values in re.findall(r"((\w+)\s*\(([^)]*)\))", element.get("transform", "")):
        try:
            frame = _within(frame, TRANSFORMS[name](*_numbers(values)))
        except (KeyError, TypeError):
            raise GenevaError(f"the transform {cut(text, 100)} is not known") from None
    yield element, frame
    for child in element:
        if isinstance(child.tag, str):
            yield from _shapes(child, frame)


def _within(outer: Frame, inner: Frame) -> Frame:
    return lambda z: outer(inner(z))


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


def _curves(element: ElementTree.Element) -> Iterator[Curve]:
    """Yield the curves of a path or of a basic shape, in its own frame."""
    name = _name(element)
    if name in ("circle", "ellipse"):
        x, y = _lengths(element, "cx cy")
        rx, ry = _lengths(element, "r r" if name == "circle" else "rx ry")
        yield Ellipse(complex(x, y), rx + 0j, ry * 1j)
    elif name == "path":
        yield from _path(element.get("d", ""))
    elif name in ("line", "polygon", "polyline"):
        v = _numbers(element.get("points", ""))
        v = _lengths(element, "x1 y1 x2 y2") if name == "line" else v
        corners = [complex(*pair) for pair in zip(v[::2], v[1::2], strict=False)]
        yield from pairwise([*corners, *corners[: name == "polygon"]])
    elif name in ("image", "rect", "use"):
        raise GenevaError(f"<{name}> is no outline: convert it to a path")


def _path(data: str) -> Iterator[Curve]:
    """Yield the curves of path data. Raises GenevaError, with the place, if it cannot be read."""
    at = first = 0j
    before = ("", 0j)  # the last letter, and the last pole of its curve
    for letter, v in _commands(data):
        kind, base = letter.upper(), at if letter.islower() else 0j
        pole = at
        if kind == "H":
            v = [*v, (at - base).imag]
        elif kind == "V":
            v = [(at - base).real, *v]
        end = first if kind == "Z" else base + complex(*v[-2:])
        if kind == "M":
            first = end
        elif kind in "CSQT":
            poles = [base + complex(*pair) for pair in zip(v[:-2:2], v[1:-2:2], strict=True)]
            if kind in "ST":
                alike = before[0] in ("CS" if kind == "S" else "QT")
                poles.insert(0, 2.0 * at - before[1] if alike else at)
            pole = poles[-1]
            yield at, *poles, end
        else:
            yield _elliptical_arc(at, end, v) if kind == "A" else (at, end)
        at, before = end, (kind, pole)


def _commands(data: str) -> Iterator[tuple[str, list[float]]]:
    """Yield letters with their numbers; a letter may be left out where it repeats."""
    text, place, letter = data.strip(), 0, ""
    if text and text[0] not in "Mm":
        raise GenevaError(f'a path must begin with M, not with "{cut(text, 20)}"')
    while place < len(text):
        if text[place].isalpha():
            letter, place = text[place], place + 1
        form = FORMS.get(letter.upper())
        if form is None:
            shown = cut(text[place - 1 : place + 20], 20)
            raise GenevaError(f'a path has "{shown}": unknown letter')
        numbers = form.match(text, place)
        if not numbers:
            raise GenevaError(
                f'a path breaks off at "{cut(text[place : place + 20], 20)}", where {letter} '
                f"needs {form.groups} numbers"
            )
        yield letter, [*map(float, numbers.groups())]
        place = numbers.end()
        letter = {"M": "L", "m": "l", "Z": "", "z": ""}.get(letter, letter)


def _elliptical_arc(start: complex, end: complex, v: list[float]) -> Curve:
    """Return an elliptical arc by its centre, from both ends as in SVG 1.1, appendix F.6.5."""
    rx, ry, turn = abs(v[0]), abs(v[1]), cmath.exp(1j * math.radians(v[2]))
    if not (rx and ry) or start == end:
        return start, end
    half = 0.5 * (start - end) / turn
    half = complex(half.real / rx, half.imag / ry)  # in the frame in which it is the unit circle
    size = max(abs(half), 1.0)  # above 1 if it is too small to reach both ends
    rx, ry, half = rx * size, ry * size, half / size
    side = 1j if bool(v[3]) == bool(v[4]) else -1j
    middle = half * side * math.sqrt(max(1.0 - abs(half) ** 2, 0.0)) / abs(half)
    first, last = half - middle, -half - middle
    sweep = cmath.phase(last / first)
    sweep = sweep % math.tau if v[4] else -(-sweep % math.tau)
    centre = 0.5 * (start + end) + complex(middle.real * rx, middle.imag * ry) * turn
    return Ellipse(centre, rx * turn, ry * 1j * turn, cmath.phase(first), sweep)
