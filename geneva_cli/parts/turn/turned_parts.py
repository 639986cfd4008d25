"""What a full turn needs of the parts of a machine."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sized
from typing import Protocol, Self

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.turn.pairs import CONTACT, Clearances, Lengths, Pairs


class Shape(Protocol):
    """Wheel and crank of a machine, as they are cut and turned."""

    @property
    def assembly(self) -> Assembly:
        """Positions of the parts at any input angle."""

    @property
    def sizes(self) -> Lengths:
        """Lengths of the parts."""

    @property
    def gaps(self) -> Clearances:
        """Clearances between the parts."""

    @property
    def crank(self) -> Sized:
        """The locking surfaces of the crank; empty if there are none."""

    def _replace(self, *, assembly: Assembly) -> Self:
        """Return these parts with another assembly."""


class TurnedParts(ABC):
    """Wheel, crank and rollers of one machine, which a full turn checks.

    Curved outlines are ``curves``, "arcs" or "cubics", within ``tolerance`` mm. Without a tolerance
    they are as accurate as the checks need them. Without ``advice`` an error does not name the
    roller that fits, which takes long to find.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        advice: bool = True,
        tolerance: float | None = None,
        curves: str = "arcs",
    ) -> None:
        self.mechanism, self.advice = mechanism, advice
        self.tolerance, self.curves = tolerance, curves

    @property
    @abstractmethod
    def _shape(self) -> Shape:
        """Wheel and crank as they are turned. Raises GenevaError where the sizes leave none."""

    @property
    def assembly(self) -> Assembly:
        """The positions of the parts at any input angle."""
        return self._shape.assembly

    @property
    def sizes(self) -> Lengths:
        """The lengths of the parts."""
        return self._shape.sizes

    @property
    def gaps(self) -> Clearances:
        """The clearances between the parts."""
        return self._shape.gaps

    @property
    def locked(self) -> bool:
        """True if the crank has locking surfaces."""
        return len(self._shape.crank) > 0

    @property
    def close(self) -> float:
        """The overlap, mm, that counts as rounding or as the walls' tolerance."""
        return SAME_LENGTH * self.assembly.L

    @property
    def contact(self) -> float:
        """The overlap, mm, up to which parts count as touching."""
        return CONTACT * self.assembly.L

    @property
    def rim_lever(self) -> float:
        """How far the wheel's rim moves a radian, mm."""
        return self.assembly.plane_motion.lever(self.sizes.rim)

    def over(self, assembly: Assembly) -> Self:
        """Return the parts of a machine whose wheel and crank are equal, at its own positions."""
        other = type(self)(assembly.full, self.advice)
        vars(other)["_shape"] = self._shape._replace(assembly=assembly)
        return other

    def in_wheel(self, motion: int, at: Array, lead: Array | float = 0.0) -> Array:
        """Return the centre of a motion's roller in the wheel's frame at input angles (n,), mm.

        It is an array (n, 2), or on a sphere (n, 3). The wheel is turned on by ``lead`` radians.
        """
        return self.assembly.in_wheel(motion, at, lead)

    @abstractmethod
    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""

    @abstractmethod
    def pairs(self, target: float) -> Pairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
