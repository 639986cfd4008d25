"""The parts of one machine and their full turn, each computed once, on first use.

A kind names its own in its record. What builds them is imported at its first use.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, ClassVar, NamedTuple, Self, TypeAlias

from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle
from geneva_cli.kept import cached_property, load_named
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.registry import FRONT, named, thing
from geneva_cli.parts.shafts.bores import Screwed, tapped
from geneva_cli.parts.turn.turned_parts import TurnedParts

if TYPE_CHECKING:
    from geneva_cli.geometry.fit import Writer
    from geneva_cli.parts.outlines.outlines import Outlines
    from geneva_cli.parts.projection import NamedParts
    from geneva_cli.parts.turn.full_turn import FullTurn

NamedBuilds: TypeAlias = "list[tuple[str, Callable[[], Parts]]]"


class Parts(TurnedParts):
    """The parts of one machine at their positions, at input angle 0, and their full turn."""

    # parts that are bent of sheet, and cut by outlines laid flat
    LAID_FLAT: ClassVar[tuple[str, ...]] = ()

    @property
    def screws(self) -> tuple[Screwed, ...]:
        """The screws between the parts; none without."""
        return ()

    @property
    def unborne(self) -> tuple[tuple[str, str], ...]:
        """The shafts that turn and have no bearing, each with the reason."""
        return ()

    @property
    def outside_mm(self) -> float | None:
        """Radius of the outer face from which heights count inwards; None in the plane."""
        return None

    @property
    def horn_mm(self) -> float | None:
        """Thickness of the horns between slots and recesses; None without a lock."""
        return self.sizes.horn if self.locked else None

    @property
    def outlines(self) -> Outlines:
        """The outlines of wheel and crank. Raises GenevaError where they are not flat."""
        return self.flat.outlines

    @cached_property
    def turn(self) -> FullTurn:
        """The full turn; raises GenevaError where it takes too many positions.

        The sizes that a load chooses do not change it, and may leave no parts: see ``built``.
        """
        from geneva_cli.parts.turn.full_turn import full_turn

        return full_turn(self)

    def following(self, mechanism: Mechanism) -> Parts:
        """Return the parts of the next design, with this turn if it is the same."""
        return parts_of(mechanism)

    @property
    def built(self) -> Self:
        """These parts. Raises GenevaError where the sizes leave no wheel or no crank."""
        _ = self.shape
        return self

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
        finer = type(self)(self.mechanism, tolerance, curves)
        if "shape" in vars(self):
            vars(finer)["shape"] = self.shape
        return finer

    @property
    @abstractmethod
    def members(self) -> tuple[Member, ...]:
        """All parts at their positions."""

    @property
    def required(self) -> tuple[Member, ...]:
        """The parts without which the machine is not built."""
        return self.members

    @abstractmethod
    def by_name(self) -> Iterator[NamedParts]:
        """Yield all parts in the order of a list, as names and functions that build them."""


class FrameAndShafts(NamedTuple):
    """The frame, what is on it, and the shafts, whether they reach it or not."""

    plate: Plate
    shafts: tuple[Member, ...]
    spacers: tuple[Member, ...] = ()  # below the parts that are screwed to it
    screwed: tuple[Screwed, ...] = ()  # by screws whose threads are in it
    bridge: tuple[Member, ...] = ()  # one that bears the crank's shaft from above, or none
    unborne: tuple[tuple[str, str], ...] = ()  # shafts that do not reach it, and why
    mounts: tuple[Circle, ...] = ()  # holes about its corners

    @property
    def on_it(self) -> tuple[Member, ...]:
        """The parts on the frame that stand still."""
        return (*self.spacers, *self.bridge)

    @property
    def threads(self) -> tuple[Circle, ...]:
        """The tapped holes of the frame."""
        return tuple(tapped(hole) for *_, hole in self.screwed)

    @property
    def screws(self) -> tuple[Screwed, ...]:
        """The screws that fix parts to the frame, and those of its mounting holes."""
        return (*self.screwed, *(("frame", "its base", hole) for hole in self.mounts))


class EdgedParts(Parts):
    """Parts of wheels and racks: plates, frame and shafts."""

    def writer(self, fine: float) -> Writer:
        """Return a function that fits curves: within ``fine`` mm where no tolerance is set."""
        from geneva_cli.geometry import fit

        kind = fit.KINDS["cubics" if self.tolerance is None else self.curves]
        return lambda curve, a, b: kind(curve, a, b, self.tolerance or fine)

    @property
    @abstractmethod
    def wheel(self) -> Member:
        """The wheel or the rack."""

    @cached_property
    def crank(self) -> Member:
        """The crank: locking disc or sectors, arm, rollers on their pins, hub."""
        return self.crank_with(arm=True)

    @abstractmethod
    def crank_with(self, arm: bool) -> Member:
        """Return the crank in the machine; without its arm as it lies in the wheel's plane."""

    @property
    @abstractmethod
    def framed(self) -> FrameAndShafts:
        """The frame, what is on it, and the shafts."""

    @cached_property
    def shafts(self) -> tuple[Member, ...]:
        """All shafts, whether they reach the frame or not."""
        return self.framed.shafts

    @cached_property
    def frame(self) -> Member:
        """The frame, which holds the shafts."""
        return Member(self.framed.plate)

    @property
    def unborne(self) -> tuple[tuple[str, str], ...]:
        """The shafts that turn and have no bearing, each with the reason."""
        return self.framed.unborne


def parts_of(mechanism: Mechanism) -> Parts:
    """Return the parts of a machine; nothing is built yet."""
    name = mechanism.spec.wheel.NAME
    drawn = not mechanism.spec.no_parts or named(name, "front")
    kind: type[Parts] = (drawn and thing(name, "parts")) or load_named(FRONT)
    return kind(mechanism)
