"""One shaft or pivot before it is built: where it stands, its bore, and what it carries."""

from __future__ import annotations

from collections.abc import Iterator
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

    def to_fix(self, size: Size) -> Iterator[str]:
        """Yield the names of parts that turn with the shaft, but that nothing holds on it."""
        for seat in self.seats:
            screws = (vars(size).get(f"{seat.part}_{key}_mm") for key in ("screw", "clamp"))
            if seat.held and self.bore.is_plain and not any(screws):
                yield seat.part

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
