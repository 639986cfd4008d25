"""Interfaces of a machine's parts, plates or shells, that a full turn works with."""

from __future__ import annotations

from collections.abc import Sized
from typing import TYPE_CHECKING, Protocol, Self

from geneva_cli.errors import GenevaError
from geneva_cli.numerics.arrays import Array

if TYPE_CHECKING:
    from geneva_cli.parts.assembly import Assembly
    from geneva_cli.parts.turn.pairs import Clearances, Pairs


# Of the centre distance, 0.2 um in 100 mm: parts that overlap by less count as touching. No cutter
# and no roller is more accurate, nor are curved walls.
CONTACT = 2e-6


class WorkLimit(GenevaError):
    """Error for a full turn that would take too long."""


class Lengths(Protocol):
    """Lengths of the parts, mm; on a sphere arc lengths, except ``rim``."""

    @property
    def roller(self) -> float:
        """Radius of the roller."""

    @property
    def half_width(self) -> float:
        """Half the width of a slot."""

    @property
    def rim(self) -> float:
        """Distance of the rim from the wheel's axis; of a rack's edge from the origin."""

    @property
    def outer(self) -> float:
        """Radius of the wheel where it extends beyond its rim, or 0."""

    @property
    def arm(self) -> float:
        """Distance of the rollers from the crank's axis."""

    @property
    def horn(self) -> float:
        """Thickness of the horn between slot and recess."""


def rim_lever(parts: MachineParts) -> float:
    """Return how far the wheel's rim moves a radian, mm."""
    return parts.assembly.plane_motion.lever(parts.sizes.rim)


class Turned(Protocol):
    """What is turned: its positions, lengths and clearances."""

    @property
    def assembly(self) -> Assembly:
        """Positions of the parts at any input angle."""

    @property
    def sizes(self) -> Lengths:
        """Lengths of the parts."""

    @property
    def gaps(self) -> Clearances:
        """Clearances between the parts."""


class Shape(Turned, Protocol):
    """Wheel and crank of a machine, as they are cut and turned."""

    @property
    def crank(self) -> Sized:
        """The locking surfaces of the crank; empty if there are none."""

    def _replace(self, *, assembly: Assembly) -> Self:
        """Return these parts with another assembly."""


class MachineParts(Turned, Protocol):
    """What a full turn needs of the parts of a machine; see ``Parts``."""

    @property
    def locked(self) -> bool:
        """True if the crank has locking surfaces."""

    @property
    def close(self) -> float:
        """The overlap, mm, that counts as rounding or as the walls' tolerance."""

    @property
    def contact(self) -> float:
        """The overlap, mm, up to which parts count as touching."""

    def over(self, assembly: Assembly) -> Self:
        """Return these parts with another assembly."""

    def pairs(self, target: float) -> Pairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""

    def in_wheel(self, motion: int, at: Array, lead: Array | float = 0.0) -> Array:
        """Return the centre of a motion's roller in the wheel's frame at input angles (n,), mm."""

    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""
