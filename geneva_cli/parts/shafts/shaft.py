"""Shafts and pivots, and what sits on them."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Member, Part, Plate
from geneva_cli.geometry.shapes import Point
from geneva_cli.parts.shafts.bores import Bore
from geneva_cli.spec.tables import Size

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
    seats: tuple[Seat, ...]  # from the lowest up
    low: float
    high: float
    at: Point
    direction: float = 0.0  # of the bore's keyway or flat
    turn: float = 0.0
    turns: bool = True  # in a bearing of the frame

    @property
    def to_fix(self) -> list[str]:
        """The names of parts that turn with the shaft, but that nothing holds on it."""
        return [seat.part for seat in self.seats if seat.held and self.bore.is_plain]

    @property
    def member(self) -> Member:
        """The shaft in the machine.

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
        plate = Plate(self.name, "SHAFT", section, (), self.low, self.high)
        return Member(plate, self.at, self.turn)


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
