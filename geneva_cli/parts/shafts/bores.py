"""Bores for shafts: round, round with a keyway, with one flat ("D"), or hexagonal.

A bore's nominal radius is that of its shaft: of the circle, or of the circle inside a hexagon. The
bore is cut wider by the fit. It has a direction about its axis: that of the keyway, of the flat, or
of one side of the hexagon.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, field, replace
from typing import ClassVar, Self

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import at
from geneva_cli.geometry.shapes import (
    ORIGIN,
    Arc,
    Circle,
    Layer,
    Line,
    Point,
    Shape,
    about,
    closed,
    polygon,
)
from geneva_cli.spec.keyways import ParallelKey, key
from geneva_cli.spec.tables import Size
from geneva_cli.spec.written import length


@dataclass(frozen=True)
class Bore(ABC):
    """A bore, and the section of the shaft in it; round in all that a shape does not change.

    >>> round_bore(Size(shaft_fit_mm=0.4), 6.0).reach
    6.2
    """

    is_round: ClassVar[bool] = True  # a diameter is a dimension of the bore
    is_plain: ClassVar[bool] = False  # the bore is a circle, which has no direction
    keyed: ClassVar[bool] = False  # the shaft has a keyway

    radius: float  # of the shaft
    loose: float = field(default=0.0, kw_only=True)  # by which the bore's is greater

    @abstractmethod
    def _outline(self, layer: Layer, direction: float) -> Shape:
        """Return a bore as wide as its shaft."""

    def shape(self, layer: Layer, direction: float) -> Shape:
        """Return the bore about the origin, with its feature in a direction, radians."""
        return self.cut._outline(layer, direction)

    def section(self, layer: Layer, direction: float) -> Shape:
        """Return the section of the shaft."""
        return replace(self, loose=0.0)._outline(layer, direction)

    @property
    def cut(self) -> Self:
        """The bore as it is cut: as wide as it is, without a fit."""
        return replace(self, radius=self.radius + self.loose, loose=0.0)

    @property
    def reach(self) -> float:
        """Greatest distance of the bore's wall from its axis."""
        return self.radius + self.loose

    @property
    def around(self) -> float:
        """Radius of the circle around the shaft."""
        return self.radius

    @property
    def note(self) -> str:
        """What a drawing of the bore says besides the diameter."""
        return ""

    @property
    def shaft_note(self) -> str:
        """What a drawing of the shaft says besides the diameter."""
        return replace(self, loose=0.0).note

    @property
    def end_diameter(self) -> float | None:
        """Diameter of a round end of the shaft beyond the bore; None where there is none."""
        return 2.0 * self.radius

    @property
    def running(self) -> Bore:
        """The bore of a part in which the shaft turns."""
        return RoundBore(self.around, loose=self.loose)


@dataclass(frozen=True)
class RoundBore(Bore):
    """A round bore."""

    is_plain: ClassVar[bool] = True

    def _outline(self, layer: Layer, direction: float) -> Shape:
        """Return the circle."""
        return Circle(layer, ORIGIN, self.radius)


@dataclass(frozen=True)
class KeyedBore(Bore):
    """A round bore with a keyway by a standard."""

    keyed: ClassVar[bool] = True

    standard: str
    key: ParallelKey

    @property
    def reach(self) -> float:
        """Distance of the keyway's top from the axis."""
        return self.radius + self.loose + self.key.in_hub

    @property
    def note(self) -> str:
        """Width of the keyway, and the bore's height over it."""
        over = self.cut.radius + self.reach
        wide = length(self.key.width, fine=True)
        return f"keyway {wide} JS9, {length(over)} over bore ({self.standard})"

    @property
    def shaft_note(self) -> str:
        """Width and depth of the shaft's keyway."""
        wide, deep = length(self.key.width, fine=True), length(self.key.in_shaft)
        return f"keyway {wide} P9, {deep} deep ({self.standard})"

    def _outline(self, layer: Layer, direction: float) -> Shape:
        """Return the bore; its first piece is the keyway's top."""
        first, second = self._arcs(direction)
        low, high = self._across(self.reach, direction)
        sides = Line(high, first.start), first, second, Line(second.end, low)
        return closed(layer, [Line(low, high), *sides])

    def section(self, layer: Layer, direction: float) -> Shape:
        """Return the shaft's section with its keyway."""
        first, second = self._arcs(direction)
        low, high = self._across(self.radius - self.key.in_shaft, direction)
        sides = Line(second.end, low), Line(low, high), Line(high, first.start)
        return closed(layer, [first, second, *sides])

    def _arcs(self, direction: float) -> tuple[Arc, Arc]:
        return _arcs(self.radius, direction, math.asin(0.5 * self.key.width / self.radius))

    def _across(self, x: float, direction: float) -> tuple[Point, Point]:
        """Return both ends of the keyway's bottom or top, at a distance from the axis."""
        half = 0.5 * self.key.width
        return _turned(x, -half, direction), _turned(x, half, direction)


@dataclass(frozen=True)
class FlatBore(Bore):
    """A round bore with one flat, for the flattened end of a motor's shaft."""

    depth: float  # of the flat below the circle

    @property
    def note(self) -> str:
        """Height of the bore over its flat."""
        return f"flat, {length(2.0 * self.cut.radius - self.depth)} to the far side"

    @property
    def end_diameter(self) -> float | None:
        """None: the flat is milled up to the shaft's end."""
        return None

    def _outline(self, layer: Layer, direction: float) -> Shape:
        """Return the bore; its first piece is the flat."""
        half = math.acos(1.0 - self.depth / self.radius)
        first, second = _arcs(self.radius, direction, half)
        return closed(layer, [Line(second.end, first.start), first, second])


@dataclass(frozen=True)
class HexBore(Bore):
    """A hexagonal bore; its radius is half of its width across flats."""

    is_round: ClassVar[bool] = False

    @property
    def reach(self) -> float:
        """Distance of a corner from the axis."""
        return self.cut.radius / math.cos(math.pi / 6.0)

    @property
    def around(self) -> float:
        """Distance of a corner of the shaft from the axis."""
        return replace(self, loose=0.0).reach

    @property
    def note(self) -> str:
        """Width across flats."""
        return f"hexagon {length(2.0 * self.cut.radius)} across flats"

    @property
    def end_diameter(self) -> float | None:
        """Diameter that the lathe leaves within the hexagon, a twentieth below its flats."""
        return 1.9 * self.radius

    def _outline(self, layer: Layer, direction: float) -> Shape:
        """Return the bore; its first piece is the side in the direction."""
        corners = [
            _turned(self.reach, 0.0, direction + (2 * k - 1) * math.pi / 6.0) for k in range(6)
        ]
        return polygon(layer, corners)


def bore_of(size: Size, part: str, radius: float) -> Bore:
    """Return the bore of a part, "wheel" or "crank", for a shaft with a radius in mm.

    Raises GenevaError, naming the key, for a keyway that its standard does not have, for one in a
    bore that is not round, for a flat that leaves no bore, and for a shape without a bore.

    >>> bore_of(Size(crank_keyway="DIN 6885-1"), "crank", 10.0).reach
    12.8
    >>> bore_of(Size(wheel_bore="D"), "wheel", 5.0).note
    'flat, 9 to the far side'
    """
    values, loose = vars(size), size.allowances.around_shaft_mm
    shape, standard = values[f"{part}_bore"], values[f"{part}_keyway"]
    if shape == "round":
        fitting = key(standard, radius, part)
        return (
            KeyedBore(radius, standard, fitting, loose=loose)
            if fitting
            else RoundBore(radius, loose=loose)
        )
    if standard is not None:
        raise GenevaError(
            f'{part}_keyway: {part}_bore = "{shape}" holds the shaft without a key; remove one',
            ("size", f"{part}_keyway"),
        )
    if not radius:
        raise GenevaError(
            f'{part}_bore = "{shape}": the {part} has no bore; set {part}_bore_mm, or remove it',
            ("size", f"{part}_bore"),
        )
    if shape == "hex":
        return HexBore(radius, loose=loose)
    return replace(_flat(values[f"{part}_flat_mm"], part, radius), loose=loose)


def round_bore(size: Size, radius: float) -> RoundBore:
    """Return the round bore for a shaft, or for a pin on which a part turns, with a radius in mm.

    Without a shaft, of radius 0, there is no bore.

    >>> round_bore(Size(process="print"), 6.0)
    RoundBore(radius=6.0, loose=0.2)
    """
    return RoundBore(radius, loose=size.allowances.around_shaft_mm if radius else 0.0)


def bore_in(size: Size, part: str, shape: Shape) -> Bore:
    """Return the bore of a part from its shape."""
    # without the rounding errors of the sum, which would choose another key
    return bore_of(size, part, round(radius_of(shape) - size.allowances.around_shaft_mm, 9))


def _flat(depth: float | None, part: str, radius: float) -> FlatBore:
    """Return a bore with a flat; by default a tenth of the diameter deep.

    Motors have 0.5 mm on shafts of 5 mm.
    """
    depth = 0.2 * radius if depth is None else depth
    if depth >= radius:
        raise GenevaError(
            f"{part}_flat_mm = {depth:g}: the flat must be less deep than the bore's radius of "
            f"{radius:g} mm",
            ("size", f"{part}_flat_mm"),
        )
    return FlatBore(radius, depth)


def has_shape(size: Size, part: str) -> bool:
    """Return True if the bore of a part is not merely round."""
    values = vars(size)
    return values[f"{part}_keyway"] is not None or values[f"{part}_bore"] != "round"


def rounded(section: Shape) -> Shape:
    """Return the circle of a shaft's section, with the section's own arcs among its pieces."""
    if isinstance(section, Circle):
        return section
    arcs = [piece for piece in section.segments if isinstance(piece, Arc)]
    rest = math.tau - sum(arc.sweep for arc in arcs)
    closing = Arc(arcs[-1].end, arcs[0].start, math.tan(0.25 * rest))
    return section._replace(segments=(*arcs, closing))


def reach_or_bore(size: Size, part: str, bore: float) -> float:
    """Return how far a bore reaches with its shape; its radius where it cannot be made."""
    try:
        return bore_of(size, part, bore).reach
    except GenevaError:  # reported where the part is cut
        return bore


def radius_of(shape: Shape) -> float:
    """Return the radius of a bore from its shape.

    >>> hexagon = HexBore(4.0).shape("BORE", 0.3)
    >>> round(radius_of(hexagon), 12), radius_of(FlatBore(4.0, 1.0).shape("BORE", 0.0))
    (4.0, 4.0)
    """
    if isinstance(shape, Circle):
        return shape.radius
    arcs = [piece for piece in shape.segments if not isinstance(piece, Line)]
    if arcs:
        return math.hypot(*arcs[0].start)
    (x, y), (u, v) = shape.segments[0].start, shape.segments[0].end
    return math.hypot(0.5 * (x + u), 0.5 * (y + v))


def section_note(section: Shape) -> str:
    """Return what a drawing of a shaft says of its section besides the diameter.

    >>> section_note(HexBore(20.0).section("SHAFT", 0.3))
    'hexagon 40 across flats'
    >>> section_note(FlatBore(20.0, 4.0).section("SHAFT", 0.3))
    'flat, 36 to the far side'
    >>> section_note(bore_of(Size(crank_keyway="DIN 6885-1"), "crank", 20.0).section("SHAFT", 0.3))
    'keyway 12 P9, 5 deep'
    """
    if isinstance(section, Circle):
        return ""
    lines = [piece for piece in section.segments if isinstance(piece, Line)]
    radius = radius_of(section)
    if len(lines) == len(section.segments):
        return HexBore(radius).note
    # the flat, or the keyway's bottom, is nearer to the axis than the keyway's sides
    far, bottom = min((math.hypot(*at(line, 0.5)), line) for line in lines)
    if len(lines) == 1:
        return FlatBore(radius, radius - far).note
    wide = length(math.dist(bottom.start, bottom.end), fine=True)
    return f"keyway {wide} P9, {length(radius - far)} deep"


def around(section: Shape) -> float:
    """Return the radius of the circle around a shaft's section."""
    if isinstance(section, Circle):
        return section.radius
    return max(math.hypot(*piece.start) for piece in section.segments)


def _turned(x: float, y: float, direction: float) -> Point:
    c, s = math.cos(direction), math.sin(direction)
    return x * c - y * s, x * s + y * c


def _arcs(radius: float, direction: float, half: float) -> tuple[Arc, Arc]:
    """Return two arcs round the axis, from ``half`` after a direction to ``half`` before it."""
    sweep = math.pi - half
    first = about(ORIGIN, radius, direction + half, sweep)
    return first, about(ORIGIN, radius, direction + half + sweep, sweep)
