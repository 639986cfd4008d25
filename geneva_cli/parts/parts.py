"""The parts of one machine and their full turn, each computed once, on first use.

A kind derives its own from ``Parts`` and names them in its record. What builds them is imported at
its first use: most runs need few of the parts.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, ClassVar, Self, TypeAlias

from geneva_cli.kept import cached_property
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import named, parts_class, thing
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly, input_of
from geneva_cli.parts.turn.machine_parts import CONTACT, Lengths, Shape, WorkLimit
from geneva_cli.parts.turn.pairs import Clearances

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import Member
    from geneva_cli.motion.pivots import Dimension
    from geneva_cli.numerics.arrays import Array
    from geneva_cli.parts.gears.gear_blanks import Gear
    from geneva_cli.parts.mounted_plate import Unborne
    from geneva_cli.parts.outlines.outlines import Outlines
    from geneva_cli.parts.projection import NamedParts
    from geneva_cli.parts.shafts.screws import Screws
    from geneva_cli.parts.turn.full_turn import FullTurn
    from geneva_cli.parts.turn.pairs import Pairs

NamedBuilds: TypeAlias = "list[tuple[str, Callable[[], Parts]]]"


class Parts(ABC):
    """The parts of one machine at their positions, at input angle 0, and their full turn.

    Curved outlines are ``curves``, "arcs" or "cubics", within ``tolerance`` mm. Without a tolerance
    they are as accurate as the checks need them. Without ``advice`` an error does not name the
    roller that fits, which takes long to find.
    """

    # parts that are bent of sheet, and cut by outlines laid flat
    LAID_FLAT: ClassVar[tuple[str, ...]] = ()

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
    def outlines(self) -> Outlines:
        """The outlines of wheel and crank. Raises GenevaError where they are not flat."""
        return self.flat.outlines

    @abstractmethod
    def pairs(self, target: float) -> Pairs:
        """Return the pairs of parts that may meet, with gaps bounded up to ``target`` mm."""

    def in_wheel(self, motion: int, at: Array, lead: Array | float = 0.0) -> Array:
        """Return the centre of a motion's roller in the wheel's frame at input angles (n,), mm.

        It is an array (n, 2), or on a sphere (n, 3). The wheel is turned on by ``lead`` radians.
        """
        return self.assembly.in_wheel(motion, at, lead)

    @abstractmethod
    def past_mouth(self, motion: int, at: Array) -> Array:
        """Return how far a motion's roller is in its slot, beyond the mouth's corners, mm, (n,)."""

    @property
    def turn(self) -> FullTurn:
        """The full turn; raises WorkLimit where it takes too long."""
        if isinstance(self._turn, WorkLimit):
            raise self._turn
        return self._turn

    @cached_property
    def _turn(self) -> FullTurn | WorkLimit:
        from geneva_cli.parts.turn.full_turn import full_turn

        # That it takes too long is remembered too.
        try:
            return full_turn(self)
        except WorkLimit as error:
            return error

    def over(self, assembly: Assembly) -> Self:
        """Return the parts of a machine whose wheel and crank are equal, at its own positions."""
        other = type(self)(assembly.full, self.advice)
        vars(other)["_shape"] = self._shape._replace(assembly=assembly)
        return other

    def of(self, mechanism: Mechanism) -> Self:
        """Return the parts of a machine whose wheel, crank and positions are equal."""
        return self.over(self.assembly._replace(full=mechanism, to_input=input_of(mechanism)))

    def following(self, mechanism: Mechanism) -> Parts:
        """Return the parts of the next design, with these outlines and this turn if they are equal.

        They are equal if wheel, drive, motion and ``[size]`` are, but for the speed, and all sizes
        that follow from the load.
        """
        computed = vars(self)
        if "_shape" not in computed or not self._has_shape_of(mechanism):
            return parts_of(mechanism)
        parts = self.of(mechanism)
        if "_turn" in computed:
            vars(parts)["_turn"] = computed["_turn"]
        return parts

    def _has_shape_of(self, mechanism: Mechanism) -> bool:
        own, other = (
            (spec.wheel, spec.drive.replace(n_rpm=1.0), spec.motion, spec.size)
            for spec in (self.mechanism.spec, mechanism.spec)
        )
        return own == other and self._has_sizes_of(mechanism)

    def _has_sizes_of(self, mechanism: Mechanism) -> bool:
        """Return True if the sizes of a machine with an equal spec, but for its load, are equal."""
        return False

    @property
    def turned(self) -> Self:
        """These parts. Raises GenevaError where there is nothing to turn."""
        _ = self._shape
        return self

    @property
    def built(self) -> Self:
        """These parts. Raises GenevaError where the sizes leave no wheel or no crank."""
        return self.turned

    @cached_property
    def flat(self) -> Parts:
        """The flat parts: all, or the links and gears in front of a crank that is not flat."""
        front: type[Parts] | None = thing(self.mechanism.spec.wheel.NAME, "front")
        return front(self.mechanism) if front else self.built

    @property
    def all_built(self) -> NamedBuilds:
        """Names of all parts, and functions that raise GenevaError where there are none."""
        if named(self.mechanism.spec.wheel.NAME, "front"):
            return [("wheel and crank", lambda: self.built), ("all parts", lambda: self.flat)]
        return [("all parts", lambda: self.built)]

    @property
    def front(self) -> Parts:
        """The parts of the first of two wheels in series. Raises GenevaError without a second."""
        return self.flat.front

    def within(self, tolerance: float, curves: str) -> Self:
        """Return these parts with curves of a kind within a tolerance, mm."""
        finer = type(self)(self.mechanism, self.advice, tolerance, curves)
        vars(finer).update({k: v for k, v in vars(self).items() if k == "_shape"})
        return finer

    def finer(self, tolerance: float) -> Self:
        """Return these parts with curves that are at least so accurate, mm."""
        own = self.tolerance
        return self.within(tolerance if own is None else min(tolerance, own), self.curves)

    @property
    @abstractmethod
    def members(self) -> tuple[Member, ...]:
        """All parts at their positions."""

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

    @property
    def tooth_dimensions(self) -> tuple[Dimension, ...]:
        """Dimensions of the gears' teeth; none without teeth."""
        return ()


def parts_of(mechanism: Mechanism, advice: bool = True) -> Parts:
    """Return the parts of a machine; nothing is built yet."""
    kind: type[Parts] = parts_class(mechanism.spec.wheel.NAME)
    return kind(mechanism, advice)
