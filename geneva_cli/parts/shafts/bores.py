"""Bores for shafts: round, round with a keyway, with one flat ("D"), or hexagonal; and screws.

A nominal radius is that of the shaft, or of the circle inside its hexagon; the bore is wider by the
fit. Its direction is that of the keyway, of the flat, or of one side of the hexagon. A screw passes
the part that it fixes, and its thread is in the part below.
"""

import math
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import partial
from itertools import starmap
from operator import attrgetter
from typing import NamedTuple, TypeAlias

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import ORIGIN, Circle, Line, Segment, Shape
from geneva_cli.motion.pivots import Dimension
from geneva_cli.numerics.angles import of_each
from geneva_cli.numerics.arrays import half_or, value_or
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.spec.defaults import ParallelKey, key
from geneva_cli.spec.tables import Size
from geneva_cli.table import in_decimals as length


class Bore(NamedTuple):
    """A bore, and the section of the shaft in it; lengths in mm."""

    radius: float  # of the shaft
    loose: float = 0.0  # by which the bore's is greater
    form: str = "round"  # or "D", "hex"
    flat: float = 0.0  # depth of a D's flat below the circle
    key: ParallelKey | None = None  # of a round bore with a keyway
    standard: str = ""  # of the key
    direction: float = 0.0  # of the keyway, flat or side in the machine at input angle 0, radians

    @property
    def is_plain(self) -> bool:
        """True if the bore is a circle, which has no direction."""
        return self.form == "round" and self.key is None

    @property
    def reach(self) -> float:
        """Greatest distance of the bore's wall from its axis: of a keyway's top, or a corner."""
        radius = self.radius + self.loose
        if self.form == "hex":
            return radius / math.cos(math.pi / 6.0)
        return radius + (self.key.in_hub if self.key else 0.0)

    @property
    def around(self) -> float:
        """Radius of the circle around the shaft."""
        return self._replace(loose=0.0, key=None).reach

    @property
    def note(self) -> str:
        """What a drawing of the bore says besides the diameter."""
        cut = self.radius + self.loose
        if self.key:
            over = length(cut + self.reach)
            return f"keyway {length(self.key.width)} JS9, {over} over bore ({self.standard})"
        if self.form == "hex":
            return f"hexagon {length(2.0 * cut)} across flats"
        return f"flat, {length(2.0 * cut - self.flat)} to the far side" if self.flat else ""

    @property
    def shaft_note(self) -> str:
        """What a drawing of the shaft says besides the diameter.

        >>> Bore(20.0, form="hex").shaft_note, Bore(20.0, 0.1, "D", 4.0).shaft_note
        ('hexagon 40 across flats', 'flat, 36 to the far side')
        >>> bore_of(Size(crank_keyway="DIN 6885-1"), "crank", 20.0).shaft_note
        'keyway 12 P9, 5 deep'
        """
        if self.key:
            return f"keyway {length(self.key.width)} P9, {length(self.key.in_shaft)} deep"
        return self._replace(loose=0.0).note

    def shape(self, layer: shapes.Layer, direction: float, shaft: bool = False) -> Shape:
        """Return the bore about the origin, with its feature in a direction, radians.

        Its first piece is the keyway's top, the flat, or the side in the direction. With ``shaft``
        it is the section of the shaft.
        """
        radius = self.radius if shaft else self.radius + self.loose
        if self.is_plain:
            return Circle(layer, ORIGIN, radius)
        if self.form == "hex":
            reach = self.around if shaft else self.reach
            turns = [(k - 0.5) * math.pi / 3.0 for k in range(6)]
            outline = shapes.polygon(layer, [shapes.polar(ORIGIN, reach, turn) for turn in turns])
            return shapes.placed(outline, turn=direction)
        wide = self.key.width if self.key else 0.0
        half = math.asin(0.5 * wide / radius) if wide else math.acos(1.0 - self.flat / radius)
        first = shapes.about(ORIGIN, radius, half, math.pi - half)
        second = shapes.about(ORIGIN, radius, math.pi, math.pi - half)
        pieces: list[Segment] = [Line(second.end, first.start), first, second]
        if self.key:
            far = radius - self.key.in_shaft if shaft else self.reach
            low, high = (far, -0.5 * wide), (far, 0.5 * wide)
            pieces = [Line(low, high), Line(high, first.start), first, second]
            pieces.append(Line(second.end, low))
        return shapes.placed(shapes.closed(layer, pieces), turn=direction)

    def hole(self, turn: float = 0.0) -> Shape:
        """Return the hole about the origin of a part that stands turned by an angle."""
        return self.shape("BORE", self.direction - turn)


def bore_of(size: Size, part: str, radius: float) -> Bore:
    """Return the bore of a part, "wheel" or "crank", for a shaft with a radius in mm.

    A flat is by default a tenth of the diameter deep; motors have 0.5 mm on shafts of 5 mm. Raises
    GenevaError, naming the key, where the standard has no such keyway, and for a shape that a bore
    cannot have.

    >>> bore_of(Size(crank_keyway="DIN 6885-1"), "crank", 10.0).reach
    12.8
    >>> bore_of(Size(wheel_bore="D"), "wheel", 5.0).note
    'flat, 9 to the far side'
    """
    values, loose = vars(size), 0.5 * size.allowances.shaft_fit_mm
    form, standard = values[f"{part}_bore"], values[f"{part}_keyway"]
    if form == "round":
        fitting = key(standard, radius, part)
        return Bore(radius, loose, key=fitting, standard=standard if fitting else "")
    text = f'{part}_keyway: {part}_bore = "{form}" holds the shaft without a key; remove one'
    refuse_size(standard is not None, f"{part}_keyway", text)
    text = f'{part}_bore = "{form}": the {part} has no bore; set {part}_bore_mm, or remove it'
    refuse_size(not radius, f"{part}_bore", text)
    if form == "hex":
        return Bore(radius, loose, form)
    flat = value_or(values[f"{part}_flat_mm"], 0.2 * radius)
    text = f"the flat must be less deep than the bore's radius of {radius:g} mm"
    refuse_size(flat >= radius, f"{part}_flat_mm", text, flat)
    return Bore(radius, loose, form, flat)


def round_bore(size: Size, radius: float) -> Bore:
    """Return the round bore for a shaft or pin; none where its radius is 0."""
    return Bore(radius, 0.5 * size.allowances.shaft_fit_mm if radius else 0.0)


def has_shape(size: Size, part: str) -> bool:
    """Return True if the bore of a part is not merely round."""
    values = vars(size)
    return values[f"{part}_keyway"] is not None or values[f"{part}_bore"] != "round"


def reach_or_bore(size: Size, part: str, bore: float) -> float:
    """Return how far bores reach with their shape; the radius where one cannot be made."""
    if not has_shape(size, part):
        return bore + 0.5 * size.allowances.shaft_fit_mm

    def reach(radius: float) -> tuple[float]:
        try:
            return (bore_of(size, part, radius).reach,)
        except GenevaError:  # reported where the part is cut
            return (radius,)

    return of_each(reach, bore)[0]


class Screw(NamedTuple):
    """A metric screw: thread, pitch, and hole that it passes, mm."""

    thread: float
    pitch: float
    through: float


# Sizes by ISO 262, coarse pitches by ISO 261, clearance holes by ISO 273 (medium).
# fmt: off
SCREWS = [*starmap(Screw, (
    (1.6, 0.35, 1.8), (2, 0.4, 2.4), (2.5, 0.45, 2.9), (3, 0.5, 3.4), (4, 0.7, 4.5), (5, 0.8, 5.5),
    (6, 1.0, 6.6), (8, 1.25, 9.0), (10, 1.5, 11.0), (12, 1.75, 13.5), (16, 2.0, 17.5),
    (20, 2.5, 22.0), (24, 3.0, 26.0), (30, 3.5, 33.0), (36, 4.0, 39.0), (42, 4.5, 45.0),
    (48, 5.0, 52.0), (56, 5.5, 62.0), (64, 6.0, 70.0),
))]
# fmt: on


def circles(layer: shapes.Layer, places: Iterable[shapes.Point], radius: float) -> list[Circle]:
    """Return equal circles about some places."""
    return [*map(partial(Circle, layer, radius=radius), places)]


class BoltCircle(NamedTuple):
    """Holes evenly on a circle about an axis: both radii, mm, and the holes in a plate."""

    radius: float
    hole: float
    holes: tuple[Circle, ...]


# a screw: the part that it fixes, the part with its thread, and the hole that it passes
Screwed: TypeAlias = tuple[str, str, Circle]


def listed(screws: Iterable[Screwed]) -> Iterator[Dimension]:
    """Yield the number and thread of equal screws; the hole where no screw is so thin.

    >>> [*listed(("dial", "the dial", Circle("BORE", ORIGIN, 2.75)) for _ in range(4))]
    [Dimension(name='screws of the dial, tapped in the dial', value='4 × M5', unit='')]
    """
    kinds = Counter((fixed, into, hole.radius) for fixed, into, hole in screws)
    for (fixed, into, radius), number in kinds.items():
        one = screw_through(2.0 * radius)
        what = f"× M{one.thread:g}" if one else f"holes of {2.0 * radius:g} mm"
        yield Dimension(f"screws of the {fixed}, tapped in {into}", f"{number} {what}")


def screw_through(hole_mm: float) -> Screw | None:
    """Return the largest screw that passes a hole of a diameter with clearance; None below M1.6.

    >>> screw_through(6.25).thread, screw_through(1.7)
    (5, None)
    """
    fits = bisect_right(SCREWS, hole_mm * (1.0 + ROUNDED), key=attrgetter("through"))
    return SCREWS[fits - 1] if fits else None


def screw_radius(hole_mm: float) -> float:
    """Return the radius of the clearance hole of that screw; 0 where none is so thin."""
    one = screw_through(hole_mm)
    return 0.5 * one.through if one else 0.0


def tapped(hole: Circle) -> Circle:
    """Return the hole before the thread is cut for the screw that passes another hole.

    By ISO 2306 its diameter is thread minus pitch. It is as wide as the other hole where no screw
    is so thin.
    """
    one = screw_through(2.0 * hole.radius)
    return hole._replace(radius=0.5 * (one.thread - one.pitch)) if one else hole


def bolt_radius(
    diameter_mm: float | None, L: float, half_width: float, key: str = "", asked: int | None = None
) -> float:
    """Return the radius of a screw's hole in the middle of a ring, twice ``half_width`` wide.

    By default it takes at most half of the ring, and L/40; it is 0 where that leaves no screw.
    Raises GenevaError, naming the ``key``, where the spec has ``asked`` for screws.

    >>> bolt_radius(None, 100.0, 10.0), bolt_radius(None, 60.0, 10.0)
    (1.2, 0.0)
    """
    radius = half_or(diameter_mm, screw_radius(min(L / 40.0, half_width)))
    text = f"the parts are too small for a screw of M{SCREWS[0].thread:g}; set {key}_mm for other "
    refuse_size(asked and not radius, f"{key}s", f"{text}holes, or remove {key}s", asked)
    return radius


def bolt_circle(
    size: Size, part: str, L: float, ring: tuple[float, float], start: float
) -> BoltCircle:
    """Return the bolts of a part, "dial" or "gear"; by default in the middle of a ring.

    ``ring`` has its inner and outer radius, and ``start`` is the first hole's direction. Where no
    screw is thin enough there are none; for a dial that is an error.

    >>> bolt_circle(Size(dial_bolts=4), "dial", 100.0, (20.0, 40.0), 0.0)[:2]
    (30.0, 1.2)
    """
    values, (low, high) = vars(size), ring
    count: int = values[f"{part}_bolts"]
    radius = half_or(values[f"{part}_bolt_circle_mm"], 0.5 * (low + high))
    asked = count if part == "dial" else 0
    hole = bolt_radius(values[f"{part}_bolt_mm"], L, 0.5 * (high - low), "dial_bolt", asked)
    holes = list[Circle]()
    for k in range(count if hole else 0):
        at = shapes.polar(ORIGIN, radius, start + math.tau * k / count)
        holes.append(Circle("BORE", at, hole))
    return BoltCircle(radius, hole, tuple(holes))
