"""The base of the parts of every machine, whatever they are built of."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple, Self

from geneva_cli.kept import cached_property

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import Member
    from geneva_cli.motion.mechanism import Mechanism
    from geneva_cli.parts.gears.gear_blanks import Gear
    from geneva_cli.parts.missing import NamedParts
    from geneva_cli.parts.shafts.bolt_holes import Screws


class Unborne(NamedTuple):
    """A shaft that turns and does not reach the frame, and the reason."""

    name: str
    reason: str


class PartsOfMachine(ABC):
    """The parts of one machine at their positions, at input angle 0."""

    mechanism: Mechanism

    @abstractmethod
    def within(self, tolerance: float, curves: str) -> Self:
        """Return these parts with curves of a kind, "arcs" or "cubics", within a tolerance, mm."""

    @abstractmethod
    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""

    @property
    def gear_pair(self) -> tuple[Member, ...]:
        """The noncircular gears before the crank; none without."""
        return ()

    @property
    def toothed(self) -> tuple[Gear, ...]:
        """Gears with round pitch circles, with teeth if they have a module; none without."""
        return ()

    @cached_property
    def round_gears(self) -> tuple[Member, ...]:
        """Those gears in the machine."""
        return tuple(gear.member for gear in self.toothed)

    @property
    def screws(self) -> tuple[Screws, ...]:
        """The screws between the parts; none without."""
        return ()

    @property
    def to_fix(self) -> tuple[str, ...]:
        """Names of the parts that turn with a shaft in a round bore, which holds nothing."""
        return ()

    @property
    def unborne(self) -> tuple[Unborne, ...]:
        """The shafts that turn and have no bearing."""
        return ()

    @property
    def outside_mm(self) -> float | None:
        """Radius of the outer face from which heights count inwards; None in the plane."""
        return None

    @property
    def horn_mm(self) -> float | None:
        """Thickness of the horns between slots and recesses; None without a lock."""
        return None
