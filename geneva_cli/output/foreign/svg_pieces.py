"""The lines and arcs of an SVG file, in millimetres, with y upwards. Points are complex numbers."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Iterator
from itertools import pairwise
from xml.etree import ElementTree

from fontTools.misc.transform import Identity, Transform
from fontTools.svgLib.path.parser import parse_path

from geneva_cli.errors import GenevaError, cut
from geneva_cli.geometry.shapes import Point
from geneva_cli.output.foreign.drawn import Curve, Drawn, Ellipse, Frame, drawing, traced

# millimetres in a unit of a length; a CSS pixel is 1/96 inch
UNITS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72.0, "pc": 25.4 / 6.0, "q": 0.25}
HIDDEN = {"defs", "symbol", "clipPath", "mask", "marker", "pattern", "metadata", "title", "style"}
LAYERS = {"center", "pitch", "dimension", "text", "engrave", "hidden"}  # ids of what bounds no part
NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
PATH = re.compile(r"[Mm][MZLHVCSQTAmzlhvcsqta\d\s.,eE+-]*")
TRANSFORMS: dict[str, Callable[..., Transform]] = {
    "matrix": lambda a, b, c, d, e, f: Transform(a, b, c, d, e, f),
    "translate": Identity.translate,
    "scale": Identity.scale,
    "rotate": lambda turn, x=0.0, y=0.0: (
        Identity.translate(x, y).rotate(math.radians(turn)).translate(-x, -y)
    ),
}


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
    width = re.fullmatch(rf"\s*({NUMBER})\s*([a-zA-Z]*|%)\s*", root.get("width", ""))
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
    shown = _shapes(root, Identity.scale(unit, -unit))  # its y axis points down
    rows = [traced(curve, _moves(frame)) for one, frame in shown for curve in _curves(one)]
    return drawing(rows, notes)


def _moves(frame: Transform) -> Frame:
    return lambda z: complex(*frame.transformPoint((z.real, z.imag)))


def _name(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(NUMBER, text)]


def _shapes(
    element: ElementTree.Element, frame: Transform
) -> Iterator[tuple[ElementTree.Element, Transform]]:
    """Yield the shapes that are shown, with the transforms of their groups."""
    style = element.get("style", "").replace(" ", "") + ";"
    hidden = element.get("display") == "none" or "display:none" in style
    layers = {element.get("id", "").lower(), element.get("class", "").lower()}
    if hidden or layers & LAYERS or _name(element) in HIDDEN:
        return
    for text, name, values in re.findall(r"((\w+)\s*\(([^)]*)\))", element.get("transform", "")):
        try:
            frame = frame.transform(TRANSFORMS[name](*_numbers(values)))
        except (KeyError, TypeError):
            raise GenevaError(f"the transform {cut(text, 100)} is not known") from None
    yield element, frame
    for child in element:
        if isinstance(child.tag, str):
            yield from _shapes(child, frame)


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


class _Pen:
    """The curves of a path, as a parser draws them."""

    def __init__(self) -> None:
        self.curves, self.at = list[Curve](), 0j

    def moveTo(self, start: Point) -> None:
        self.at = complex(*start)

    def lineTo(self, *poles: Point) -> None:
        ends = [complex(*pole) for pole in poles]
        self.curves.append((self.at, *ends))
        self.at = ends[-1]

    def arcTo(self, rx: float, ry: float, turn: float, large: bool, on: bool, to: Point) -> None:
        """Add an elliptical arc by its centre, from both ends as in SVG 1.1, appendix F.6.5."""
        start, end, ahead = self.at, complex(*to), cmath.exp(1j * math.radians(turn))
        if not (rx and ry) or start == end:
            self.lineTo(to)
            return
        half = 0.5 * (start - end) / ahead
        # in the frame in which it is the unit circle
        half = complex(half.real / rx, half.imag / ry)
        size = max(abs(half), 1.0)  # above 1 if it is too small to reach both ends
        rx, ry, half = rx * size, ry * size, half / size
        side = 1j if large == on else -1j
        middle = half * side * math.sqrt(max(1.0 - abs(half) ** 2, 0.0)) / abs(half)
        first, last = half - middle, -half - middle
        sweep = cmath.phase(last / first)
        sweep = sweep % math.tau if on else -(-sweep % math.tau)
        centre = 0.5 * (start + end) + complex(middle.real * rx, middle.imag * ry) * ahead
        own = Ellipse(centre, rx * ahead, ry * 1j * ahead, cmath.phase(first), sweep)
        self.curves.append(own)
        self.at = end

    def closePath(self) -> None:
        """Do nothing: the parser has drawn the last line."""

    curveTo = qCurveTo = lineTo
    endPath = closePath


def _path(data: str) -> list[Curve]:
    """Return the curves of path data. Raises GenevaError for data that cannot be read."""
    pen, data = _Pen(), data.strip()
    # The parser takes 5. and 05 for two numbers; but 05 may be two flags of an arc.
    data = re.sub(r"(\d)\.(?!\d)", r"\1.0", data)
    if "a" not in data.lower():
        data = re.sub(r"(?<![\d.])0+(?=\d)", "", data)
    try:
        if data and not PATH.fullmatch(data):
            raise ValueError("it must have M, then letters of paths and numbers")
        parse_path(data, pen)
    except (ValueError, IndexError) as error:
        raise GenevaError(
            f'a path "{cut(data, 40)}" cannot be read: {cut(str(error), 100)}'
        ) from None
    return pen.curves
