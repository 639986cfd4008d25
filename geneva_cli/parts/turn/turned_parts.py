"""What a full turn asks of the parts of a machine: wheel, crank and rollers, and their gaps."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, NamedTuple, Protocol, Self

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly

if TYPE_CHECKING:
    from collections.abc import Sized

    from geneva_cli.numerics.arrays import Array
    from geneva_cli.parts.turn.stops import Pose, Stops

    class _Lengths(Protocol):
        """Lengths of the parts, mm; on a sphere arc lengths, except ``rim``.

        They are the radius of the roller, half the width of a slot, the distance of the rim from
        the wheel's axis (of a rack's edge from the origin) and that of the rollers from the
        crank's, and the thickness of the horn between slot and recess.
        """

        @property
        def roller(self) -> float: ...
        @property
        def half_width(self) -> float: ...
        @property
        def rim(self) -> float: ...
        @property
        def arm(self) -> float: ...
        @property
        def horn(self) -> float: ...

    class Clearances(Protocol):
        """The clearances between wheel, crank and rollers, mm, negative where they overlap.

        They are in n poses, with the wheel turned on by ``lead`` radians, and at most ``near`` mm.
        """

        @property
        def near(self) -> float:
            """The widest clearance that is distinguished from wider ones, mm."""

        @property
        def stops(self) -> Stops:
            """The stops of the wheel, turned back and on."""

        def pose(self, input_deg: Array) -> Pose:
            """Return the positions at input angles (n,), degrees."""

        def in_wheel(self, motion: int, at: Array, lead: Array | float = 0.0) -> Array:
            """Return a motion's roller in the frame of the wheel, mm, (n, 2) or (n, 3)."""

        def rollers(self, pose: Pose, lead: Array | float = 0, near: float | None = None) -> Array:
            """Return the clearance of each roller to the wheel, (n, m)."""

        def locking(self, pose: Pose, lead: Array | float = 0, near: float | None = None) -> Array:
            """Return the clearance between the crank's locking surfaces and the wheel, (n,)."""

    class _Pairs(Protocol):
        """The pairs of parts that may meet, with bounds of their gaps on n intervals.

        They are the crank's locking surfaces and the wheel, and a roller and the wheel: in its slot
        between two input angles, or outside the slot that it drives. Both answers, (n,) each, are
        in mm: the gap in the middle of each interval, and a proved lower bound of it throughout.
        """

        def lock(self, window: Window, on: Intervals) -> tuple[Array, Array]: ...
        def roller(
            self, number: int, window: Window, span: tuple[float, float] | None, on: Intervals
        ) -> tuple[Array, Array]: ...

    class _Shape(Protocol):
        """Wheel and crank of a machine, as they are cut and turned."""

        @property
        def assembly(self) -> Assembly: ...
        @property
        def sizes(self) -> _Lengths: ...
        @property
        def gaps(self) -> Clearances: ...
        @property
        def crank(self) -> Sized: ...
        def _replace(self, *, assembly: Assembly) -> Self: ...


# Of the centre distance, 0.2 um in 100 mm: parts that overlap by less count as touching. No cutter
# and no roller is more accurate, nor are curved walls.
CONTACT = 2e-6


class Window(NamedTuple):
    """A motion, or the dwell after it: input angles at its ends, and the motion's number.

    ``spans`` divide it: both ends of each, and the roller that is in its slot there, or None.
    """

    start: float
    end: float
    motion: int
    rests: bool
    spans: tuple[tuple[float, float, int | None], ...]


class Intervals(NamedTuple):
    """Intervals of the input angle, and how far crank and wheel are at most from their middles."""

    start: Array  # degrees of the input, (n,)
    end: Array
    crank: Array  # radians
    wheel: Array
    at_start: Pose
    at_middle: Pose
    at_end: Pose


class TurnedParts(ABC):
    """Wheel, crank and rollers of one machine, which a full turn checks.

    Curves are "arcs" or "cubics" within ``tolerance`` mm; by default they are as accurate as the
    checks need them. Without ``advice`` an error does not name the roller that fits.
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
    def _shape(self) -> _Shape:
        """Wheel and crank as they are turned. Raises GenevaError where the sizes leave none."""

    @property
    def assembly(self) -> Assembly:
        """The positions of the parts at any input angle."""
        return self._shape.assembly

    @property
    def sizes(self) -> _Lengths:
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

    def over(self, assembly: Assembly) -> Self:
        """Return the parts of a machine whose wheel and crank are equal, at its own positions."""
        other = type(self)(assembly.full, self.advice)
        vars(other)["_shape"] = self._shape._replace(assembly=assembly)
        return other

    @abstractmethod
    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""

    @abstractmethod
    def pairs(self, target: float) -> _Pairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""
