"""What a full turn needs to know of a machine's parts, whether these are plates or shells."""

from __future__ import annotations

from collections.abc import Sized
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array
    from geneva_cli.parts.assembly import Assembly


class Pose(NamedTuple):
    """The positions of a machine's parts at n input angles."""

    wheel: Array  # (n,) radians
    crank: Array  # (n,) radians
    pins: Array  # (n, m, 2) of the m rollers, mm, or (n, m, 3), directions from a sphere's centre


class Stopped(NamedTuple):
    """How far the wheel can be turned one way from n poses."""

    lead: Array  # (n,) radians
    pressure: Array  # (n,) radians, the pressure angle of a roller that stops it; 0 of all else


class Gapped(Protocol):
    """The gaps between wheel, crank and rollers, mm, negative where they overlap.

    In n poses with the wheel turned on by ``lead``, radians; gaps wider than ``near`` mm are given
    as that.
    """

    @property
    def near(self) -> float:
        """The widest gap that is told from others, mm."""

    def begin(self) -> None:
        """Count work from here on; too much of it raises NotProved."""

    def pose(self, input_deg: Array) -> Pose:
        """The positions at input angles (n,), degrees."""

    def gap(self, pose: Pose, lead: Array, near: float) -> Array:
        """The smallest gap, (n,)."""

    def rollers(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """The gap of each roller to the wheel, (n, m)."""

    def locking(self, pose: Pose, lead: Array | float = 0.0, near: float | None = None) -> Array:
        """The gap between what locks on the crank and the wheel, (n,)."""

    def repeats(self, count: int) -> bool:
        """Whether wheel and crank are as before after a slot and a turn over ``count``."""

    def stops(self, pose: Pose, most: float, close: float) -> tuple[Stopped, Stopped]:
        """What stops the wheel on its way back and on from positions where nothing overlaps by
        ``close`` mm, until something does, or as far as ``most`` radians.
        """


class Lengths(Protocol):
    """Lengths of the parts, mm; on a sphere arcs of it, but for ``rim``."""

    @property
    def roller(self) -> float:
        """The roller's radius."""

    @property
    def half_width(self) -> float:
        """Half a slot's width."""

    @property
    def rim(self) -> float:
        """The rim's distance from the wheel's axis."""

    @property
    def outer(self) -> float:
        """The radius of a wheel that is farther out than its rim, or 0."""

    @property
    def arm(self) -> float:
        """The rollers' distance from the crank's axis."""

    @property
    def horn(self) -> float:
        """The thickness of the horn between slot and recess."""


class Turned(Protocol):
    """A machine's parts that can be turned."""

    @property
    def assembly(self) -> Assembly:
        """Where they stand at an input angle."""

    @property
    def sizes(self) -> Lengths:
        """Their lengths."""

    @property
    def gaps(self) -> Gapped:
        """Their gaps."""

    @property
    def crank(self) -> Sized:
        """What locks on the crank; empty where nothing does."""

    @property
    def close(self) -> float:
        """The overlap, mm, that is rounding, or the walls' tolerance."""

    @property
    def contact(self) -> float:
        """The overlap, mm, up to which parts count as touching."""

    def over(self, assembly: Assembly) -> Turned:
        """The same parts where another assembly has them."""

    def in_wheel(self, motion: int, at: Array) -> Array:
        """The centre of a motion's roller in the wheel's frame, mm, at input angles (n,).

        An array (n, 2), or (n, 3) of directions on a sphere.
        """

    def past_mouth(self, motion: int, at: Array) -> Array:
        """How far that is in its slot, past the mouth's corners, mm, (n,)."""
