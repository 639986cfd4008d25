"""Shafts and pivots, plain or with steps as a lathe turns them, and the bearings on them.

The bearing of a turned shaft is in the frame, flush with its upper face, between the shoulder above
and a circlip below. The lowest part stands on the shoulder. Where other parts pass below that part,
the shoulder is a collar just above the frame. Above the highest part there is a circlip if there is
space.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.pieces import SHORTEST_MM
from geneva_cli.geometry.plates import Member, Part, Plate, Stack
from geneva_cli.geometry.shapes import ORIGIN, Circle, Point, Shape
from geneva_cli.parts.shafts.bores import Bore, rounded
from geneva_cli.spec.tables import Size


class Bearing(NamedTuple):
    """A deep groove ball bearing: bore, outside diameter and width, mm."""

    name: str
    bore: float
    outside: float
    width: float

    @property
    def shoulder(self) -> float:
        """Diameter of the shaft's shoulder: at least the abutment of DIN 5418 for this series."""
        return max(1.25 * self.bore, self.bore + 2.0)


# ISO 15:2017, dimension series 10, which makers call 60.
# fmt: off
SERIES_60 = [Bearing(*row) for row in (
    ("604", 4, 12, 4), ("605", 5, 14, 5), ("606", 6, 17, 6), ("607", 7, 19, 6), ("608", 8, 22, 7),
    ("609", 9, 24, 7), ("6000", 10, 26, 8), ("6001", 12, 28, 8), ("6002", 15, 32, 9),
    ("6003", 17, 35, 10), ("6004", 20, 42, 12), ("6005", 25, 47, 12), ("6006", 30, 55, 13),
    ("6007", 35, 62, 14), ("6008", 40, 68, 15), ("6009", 45, 75, 16), ("6010", 50, 80, 16),
    ("6011", 55, 90, 18), ("6012", 60, 95, 18), ("6013", 65, 100, 18), ("6014", 70, 110, 20),
    ("6015", 75, 115, 20), ("6016", 80, 125, 22), ("6017", 85, 130, 22), ("6018", 90, 140, 24),
    ("6019", 95, 145, 24), ("6020", 100, 150, 24),
)]
# fmt: on


class Circlip(NamedTuple):
    """A circlip for a shaft, and its groove, mm."""

    shaft: float  # d1, its nominal diameter
    groove: float  # d2, diameter of the groove
    width: float  # m, of the groove

    @property
    def edge(self) -> float:
        """Least distance n from the groove to the shaft's end: three times the groove's depth."""
        return 1.5 * (self.shaft - self.groove)


# DIN 471:1981, normal type.
# fmt: off
DIN_471 = [Circlip(*row) for row in (
    (3, 2.8, 0.5), (4, 3.8, 0.5), (5, 4.8, 0.7), (6, 5.7, 0.8), (7, 6.7, 0.9), (8, 7.6, 0.9),
    (9, 8.6, 1.1), (10, 9.6, 1.1), (11, 10.5, 1.1), (12, 11.5, 1.1), (13, 12.4, 1.1),
    (14, 13.4, 1.1), (15, 14.3, 1.1), (16, 15.2, 1.1), (17, 16.2, 1.1), (18, 17.0, 1.3),
    (19, 18.0, 1.3), (20, 19.0, 1.3), (22, 21.0, 1.3), (24, 22.9, 1.3), (25, 23.9, 1.3),
    (28, 26.6, 1.6), (30, 28.6, 1.6), (32, 30.3, 1.6), (35, 33.0, 1.6), (38, 36.0, 1.85),
    (40, 37.5, 1.85), (42, 39.5, 1.85), (45, 42.5, 1.85), (48, 45.5, 1.85), (50, 47.0, 2.15),
    (55, 52.0, 2.15), (60, 57.0, 2.15), (65, 62.0, 2.65), (70, 67.0, 2.65), (75, 72.0, 2.65),
    (80, 76.5, 2.65), (85, 81.5, 3.15), (90, 86.5, 3.15), (95, 91.5, 3.15), (100, 96.5, 3.15),
)]
# fmt: on


def bearing_up_to(diameter: float, shaft: str, key: str) -> Bearing:
    """Return the largest bearing whose bore is no wider than a shaft, mm.

    Raises GenevaError, naming the key of its bore, for a shaft below the smallest one.

    >>> bearing_up_to(16.0, "wheel's shaft", "wheel_bore_mm").name
    '6002'
    """
    bearing = bearing_within(diameter)
    if bearing is None:
        raise GenevaError(
            f'shafts = "turned": the {shaft} of {diameter:.4g} mm is too thin for a ball bearing; '
            f"set {key} to at least {SERIES_60[0].bore:g}",
            ("size", "shafts"),
        )
    return bearing


def bearing_within(diameter: float) -> Bearing | None:
    """Return the largest bearing whose bore is no wider than a diameter; None if all are wider."""
    return next((one for one in reversed(SERIES_60) if one.bore <= diameter), None)


def shoulder_length(size: Size, L: float) -> float:
    """Return the least length of a turned shaft's shoulder above its bearing; 0 for plain ones."""
    return L / 50.0 if size.shafts == "turned" else 0.0


def circlip_up_to(diameter: float) -> Circlip:
    """Return the largest circlip for a shaft up to a diameter of at least 3 mm.

    >>> circlip_up_to(9.6)
    Circlip(shaft=9, groove=8.6, width=1.1)
    """
    return [one for one in DIN_471 if one.shaft <= diameter][-1]


# what the sheet and the list of parts say of a part in a round bore that turns with its shaft
FIX = "fix on the shaft: pin, key or adhesive"


class Seat(NamedTuple):
    """Where a part sits on its shaft: its name, its lower and its upper face."""

    part: str
    low: float
    high: float
    held: bool = True  # it turns with the shaft; False if it turns on it, or stands still


def seat_of(part: Part, held: bool = True) -> Seat:
    """Return where a plate sits."""
    assert isinstance(part, Plate)
    return Seat(part.name, part.low, part.high, held)


class Shaft(NamedTuple):
    """A shaft or pivot; heights are along its axis, and angles in radians."""

    name: str
    part: str  # whose keys of [size] set its ends
    bore: Bore  # of the parts on it
    seats: tuple[Seat, ...]  # from the lowest up; held ones have the bore's shape
    low: float
    high: float
    at: Point
    direction: float = 0.0  # of the bore's keyway or flat
    turn: float = 0.0
    turns: bool = True  # in a bearing of the frame
    ends_here: bool = True  # nothing may stand above the last seat

    @property
    def bore_key(self) -> str:
        """The key of ``[size]`` that sets the bore."""
        own = f"{self.part}_bore_mm"
        return own if hasattr(Size, own) else "link_bore_mm"

    @property
    def to_fix(self) -> list[str]:
        """The names of parts that turn with the shaft, but that nothing holds on it."""
        return [seat.part for seat in self.seats if seat.held and self.bore.is_plain]

    def plain(self) -> Member:
        """Return the shaft with one section all along.

        Raises GenevaError, naming the key, where its lower end is not below its upper one.
        """
        if not self.low < self.high:
            key = f"{self.part}_shaft_low_mm"
            raise GenevaError(
                f"{key}: the {self.part}'s shaft would reach from {self.low:g} up to {self.high:g} "
                f"mm (0 is the wheel's lower face); reduce {key} or increase "
                f"{self.part}_shaft_high_mm",
                ("size", key),
            )
        section = self.bore.section("SHAFT", self.direction)
        return Member(
            Plate(self.name, "SHAFT", section, (), self.low, self.high), self.at, self.turn
        )


class Ends(NamedTuple):
    """Ends of the shafts of wheel and crank, as far as links share them."""

    lowest: float  # the frame's lower face
    top: float  # the wheel's upper face
    stop: float | None = None  # height at which the crank's shaft ends above that face
    crank_has_one: bool = False  # the crank's shaft carries more than links: another function's
    wheel_has_one: bool = False


def shaft_ends(size: Size, part: str, low: float, high: float) -> tuple[float, float]:
    """Return the ends of a part's shaft: those of the spec, or else the heights low and high."""
    values = vars(size)
    ends = values.get(f"{part}_shaft_low_mm"), values.get(f"{part}_shaft_high_mm")
    return low if ends[0] is None else ends[0], high if ends[1] is None else ends[1]


class Step(NamedTuple):
    """One step of a shaft: what it is, its section, and its upper end."""

    name: str
    section: Shape
    high: float


def bearing_of(shaft: Shaft) -> Bearing:
    """Return the bearing of a shaft. Raises GenevaError for a shaft that is too thin for one."""
    return bearing_up_to(2.0 * shaft.bore.radius, shaft.name, shaft.bore_key)


def shoulder_mm(shaft: Shaft) -> float:
    """Return the diameter of a shoulder: wider than bearing and bore by a quarter, or by 2 mm."""
    wide = max(bearing_of(shaft).shoulder, 2.5 * shaft.bore.around)
    # rounded up to half a millimetre; the last term drops rounding errors
    return 0.5 * math.ceil(2.0 * wide - 1e-9)


def turned_shaft(size: Size, shaft: Shaft, frame: float, free: float | None = None) -> Member:
    """Return a shaft with its steps.

    ``frame`` is the frame's upper face. Other parts pass above ``free``, where the shoulder ends;
    otherwise it reaches the lowest part. Raises GenevaError, naming the key, for
    a shaft that is too thin for a bearing, and for ends that leave no space for the circlips.
    """
    bearing, own = bearing_of(shaft), shaft.bore
    under = frame - bearing.width
    ring = circlip_up_to(bearing.bore)
    groove = under - ring.width
    values = vars(size)
    low_key, high_key = f"{shaft.part}_shaft_low_mm", f"{shaft.part}_shaft_high_mm"
    low = _end(low_key, values.get(low_key), groove - ring.edge, -1.0)
    steps = [
        Step("end", _circle(ring.shaft), groove),
        Step("circlip groove, DIN 471", _circle(ring.groove), under),
        Step(f"seat of bearing {bearing.name}", _circle(bearing.bore), frame),
        *_above(shaft, own, free),
    ]
    *others, last = steps
    high = _end(high_key, values.get(high_key), last.high, 1.0)
    steps = [*others, last._replace(high=high)]
    heights = pairwise([low, *(step.high for step in steps)])
    plates = (
        Plate(step.name, "SHAFT", step.section, (), *ends)
        for step, ends in zip(steps, heights, strict=True)
    )
    return Member(Stack(shaft.name, "SHAFT", tuple(plates)), shaft.at, shaft.turn)


def _above(shaft: Shaft, own: Bore, free: float | None) -> Iterator[Step]:
    """Yield the steps from the frame's upper face up."""
    section = own.section("SHAFT", shaft.direction)
    below = rounded(section) if own.is_round else _circle(2.0 * own.radius)
    first = shaft.seats[0].low if shaft.seats else shaft.high
    top = first if free is None else min(first, free)
    yield Step("shoulder", _circle(shoulder_mm(shaft)), top)
    if first - top > SHORTEST_MM:
        yield Step("shaft", below, first)
    for seat, after in pairwise(shaft.seats):
        if seat.held:
            yield from _on_part(own, seat, section, ends_here=True)
            # a flat or a hexagon does not pass a round step; what is keyed does
            below = below if own.key else section
        else:
            yield Step(f"seat of {seat.part}", below, seat.high)
        if after.low - seat.high > SHORTEST_MM:  # faces that touch may differ by rounding
            yield Step("shaft", below, after.low)
    if shaft.seats:
        yield from _on_part(own, shaft.seats[-1], section, shaft.ends_here)


def _on_part(own: Bore, seat: Seat, section: Shape, ends_here: bool) -> Iterator[Step]:
    """Yield the steps of a part's seat, and a circlip where there is space above it."""
    name, long = f"seat of {seat.part}", seat.high - seat.low
    if own.key:
        # a keyway that ends before both faces leaves a round seat on each side
        yield Step(name, rounded(section), seat.low + 0.1 * long)
        yield Step(f"{name}, {own.shaft_note}", section, seat.high - 0.1 * long)
        yield Step(name, rounded(section), seat.high)
    else:
        yield Step(f"{name}, {own.shaft_note}".removesuffix(", "), section, seat.high)
    if own.end_diameter and not ends_here:
        ring = circlip_up_to(own.end_diameter)
        yield Step("circlip groove, DIN 471", _circle(ring.groove), seat.high + ring.width)
        yield Step("end", _circle(ring.shaft), seat.high + ring.width + ring.edge)


def _end(key: str, own: float | None, needed: float, outwards: float) -> float:
    """Return a shaft's end: that of the spec, if it leaves space for the steps."""
    if own is not None and outwards * (needed - own) > 0.0:
        raise GenevaError(
            f"{key} = {own:g}: the turned shaft needs its end at {needed:.6g} mm or beyond; remove "
            "the key",
            ("size", key),
        )
    return needed if own is None else own


def _circle(diameter: float) -> Circle:
    return Circle("SHAFT", ORIGIN, 0.5 * diameter)


def built_shafts(
    size: Size, own: list[Shaft], adjacent: list[Seat], heights: tuple[float, float, float]
) -> tuple[list[Member], float]:
    """Return the shafts, plain or turned, and the frame's lower face.

    Shafts that turn in the frame and reach its lower face are turned. ``adjacent`` are the faces of
    parts that pass them. ``heights`` are the lower face of a frame of plain shafts, the upper face,
    and the lowest height at which parts pass.
    """
    usual, top, free = heights
    turned = [size.shafts == "turned" and one.turns and one.low <= usual for one in own]
    bottom = usual
    if any(turned):
        widths = (bearing_of(one).width for one, steps in zip(own, turned, strict=True) if steps)
        bottom = min([usual, *(top - width for width in widths)])
    axles = []
    for one, steps in zip(own, turned, strict=True):
        if not steps:
            axles.append(one._replace(low=bottom if one.low == usual else one.low).plain())
            continue
        lowest = one.seats[0].low if one.seats else one.high
        own_parts = {seat.part for seat in one.seats}
        passed = any(part.low < lowest and part.part not in own_parts for part in adjacent)
        axles.append(turned_shaft(size, one, top, free if passed else None))
    return axles, bottom
