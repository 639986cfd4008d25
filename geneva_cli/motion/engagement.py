"""One index of the wheel: pin path, slot and motion; any two determine the third.

An engagement is one roller's passage through one slot. Input angles are in degrees from its own
mid-motion, wheel angles in radians from the middle of the step, lengths in units of the centre
distance L. The wheel's axis is (0, 0), the crank's (1, 0). Derivatives are by input radians.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Generic, NamedTuple, TypeVar, cast

from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Batchable, Truth, all_true, array, blocks, choose, library
from geneva_cli.numerics.jet import Array, Jet, Number, Vector, turned

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Displacement, Path, Rate, Reactions

K = TypeVar("K", float, "Array")

BLOCK = 12288  # angles: their jets stay in the processor's cache
LONG = 8192  # angles a seam, from which polynomials pay


class Slot(Batchable):
    """The curve in the wheel's own frame along which the pin runs: the slot's pitch curve.

    It is straight unless a kind has another curve.
    """

    # True for a curve that was solved for: it has two branches and its own walls.
    curved = False
    # True if the roller drives the wheel throughout, on a straight wall
    walls_flat = True
    # e: distance between a straight slot's axis and the wheel's centre, over L.
    offset: float = 0.0
    tilt: float = 0.0  # angle of that axis at the middle of the step, radians
    # input angles, degrees, at which another formula takes over, but for the motion's own
    seams_deg: tuple[float, ...] = ()
    # The ``Height`` of the pin along the wheel's axis on a sphere, where the path is a projection.
    height: Any = None

    def place(self, input_deg: Number, order: int) -> Jet:
        """Place of the pin along a straight slot's axis, over L; on a sphere its polar angle."""
        raise NotImplementedError

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        """Pin (x, y) in the wheel's frame; on a sphere its polar angle in the flat development."""
        place = self.place(input_deg, order)
        return turned(place, place * 0.0 - self.offset, self.tilt)

    def axis(self, input_deg: Number, order: int = 0) -> Vector:
        """Lever of a straight slot's normal about the wheel's axis, and ``place``."""
        place = self.place(input_deg, order)
        return place, place

    def upright(self, input_deg: Number, order: int = 0) -> Jet | float:
        """Cosine of the angle between the roller's axis and the wheel's."""
        return 1.0

    def play(self, clearance: Number) -> Number:
        """Free angle of the wheel, radians, for a clearance per side over the lever."""
        angle: Number = 2.0 * library(clearance).asin(clearance)
        return angle

    def touches(self, input_deg: Number) -> Number:
        """1 where the roller drives the wheel, 0 where something else does."""
        return 1.0


class AsBuilt(NamedTuple):
    """What a crank as built has: its R/L is not what its straight slots need."""

    crosses: Truth  # the axis of the slot at rest inside the rim, before and after its motion
    # wheel's angle beyond its next rest at which the roller leaves the rim, radians; < 0 before it
    gained: float
    angle: float  # of the slot at rest before the motion, radians from the line of centres
    outer: Truth  # it enters beyond the foot of the perpendicular from the crank's axis


class Peak(NamedTuple, Generic[K]):
    """Greatest size of a quantity, and the signed input angle of its first occurrence, degrees."""

    max: K
    at_deg: K


class WheelMotion(Batchable, ABC):
    """The wheel's angle as the input turns, from rest to rest."""

    # False if its two halves differ
    mirrored = True
    # Pin at entry, about which its path is written if the slot follows the pin
    entry: Anchor | None = None
    # Greatest error of the breaks within, as a fraction of the motion; 0 for exact ones.
    breaks_to = 0.0

    def __init__(self, entry_deg: float, exit_deg: float, half_step: float) -> None:
        self.entry_deg = entry_deg  # from mid-motion, negative
        self.exit_deg = exit_deg
        self.half_step = half_step  # b: the wheel turns from -b to b

    @abstractmethod
    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        """Wheel angle with its derivatives by the input angle in radians."""

    def rate(self, input_deg: Number, order: int = 2) -> Jet:
        """Wheel speed over input speed, with derivatives, computed without the angle itself."""
        return self(input_deg, order + 1).derivative()

    @property
    def symmetric(self) -> bool:
        """True if the second half mirrors the first."""
        return self.mirrored and all_true(self.entry_deg == -self.exit_deg)

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        """Entry, places where a derivative may jump, mid-motion, and exit, in degrees."""
        return (self.entry_deg, 0.0, self.exit_deg)

    @property
    def knots_deg(self) -> tuple[float, ...]:
        """The breaks, and places where a derivative above the fourth jumps, in degrees."""
        return self.breaks_deg

    @property
    def seams_deg(self) -> tuple[float, ...]:
        """Entry, every place where another formula takes over, and exit, in degrees."""
        return self.breaks_deg

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        """Peak in closed form, or by a quicker search; else None, in a batch NaN."""
        return None

    def end_rates(self, input_deg: float) -> tuple[float, float]:
        """Sizes of acceleration and jerk at entry or exit, from inside the motion."""
        _, _, acceleration, jerk = self(input_deg).derivatives()
        return abs(acceleration), abs(jerk)

    def derivatives(self, input_deg: Array, orders: Sequence[int] = (0, 1, 2, 3)) -> list[Array]:
        """Wheel angle and its derivatives at many ascending angles: (k,), or (n, k) for n designs.

        At very many angles of one design polynomials take the formulas' place: as exact, and three
        to five times as quick.
        """
        count = len(input_deg)
        one = count >= 4 * LONG and array(self.rate(input_deg[:1], 0).c[0]).ndim < 2
        if one and count >= LONG * len(self.seams_deg):
            from geneva_cli.numerics.fitted import fitted

            seams = {0.0, *self.seams_deg}  # where the acceleration may vanish, and be small
            return fitted(lambda x: self.in_blocks(x, orders), input_deg, sorted(seams))
        return self.in_blocks(input_deg, orders)

    def in_blocks(self, input_deg: Array, orders: Sequence[int]) -> list[Array]:
        """Derivatives by the formulas, in blocks that stay in the processor's cache."""
        import numpy as np

        out: list[Array] = []
        for block in blocks(len(input_deg), BLOCK):
            if 0 in orders:
                every = self(input_deg[block], max(orders)).derivatives()
            else:  # without the wheel's angle
                every = (0.0, *self.rate(input_deg[block], max(orders) - 1).derivatives())
            values = [array(every[k]) for k in orders]
            out = out or [np.empty((*value.shape[:-1], len(input_deg))) for value in values]
            for whole, value in zip(out, values, strict=True):
                whole[..., block] = value
        return out


@dataclass(eq=False)
class Engagement(Batchable):
    """Pin path, slot and motion of one roller in one slot.

    ``body`` carries the roller: the crank's arm, or else a link that ``reactions`` hold.
    """

    mid_deg: float  # the machine's input angle at its mid-motion
    path: Path
    slot: Slot
    motion: WheelMotion
    body: Rate | float | None  # its rate; a number if that is constant; None for a ``carrier``
    reactions: Reactions | None = None
    crank_sense: float = 0.0  # of a crank that does not carry it: -1 with the wheel, 1 against it
    groove: Any = None  # the ``SolvedPath``, if a fixed groove guides the roller along the crank
    hub: float = 1.0  # the arm's centre of rotation on the line of centres; less on a sphere
    built: AsBuilt | None = None  # the wheel's velocity then jumps at entry and exit
    # of a roller that starts the wheel and of another that stops it, each in its own slot: passage,
    # and input angle by which it leads
    pair: tuple[tuple[Engagement, float], ...] = ()
    entry_deg: float = field(init=False)  # input angle at which the motion begins, from mid-motion
    exit_deg: float = field(init=False)
    motion_deg: float = field(init=False)
    half_step: float = field(init=False)  # of the wheel, radians
    paired: bool = field(init=False)
    apart: float = field(init=False)  # half the angle between the slots of a pair, radians
    on_arm: bool = field(init=False)  # the crank's arm carries the roller, and turns as ``carrier``

    def __post_init__(self) -> None:
        motion = self.motion
        self.entry_deg, self.exit_deg = motion.entry_deg, motion.exit_deg
        self.half_step = motion.half_step
        self.motion_deg = motion.exit_deg - motion.entry_deg
        self.paired, own = bool(self.pair), self.pair[0][0] if self.pair else self
        self.apart = self.half_step - own.half_step
        self.on_arm = all_true(self.crank_sense == 0.0)

    @property
    def jumps(self) -> tuple[Number, Number]:
        """Velocities to which the wheel jumps at entry, and from which it stops at exit.

        They are 0 but on a crank as built, and NaN there if the roller never crosses the slot.
        """
        if self.built is None:
            return 0.0, 0.0
        rates = (self.motion.rate(at, 0).c[0] for at in (self.entry_deg, self.exit_deg))
        entry, exit_ = (choose(self.built.crosses, rate, math.nan) for rate in rates)
        return entry, exit_

    @property
    def usual_acceleration(self) -> float:
        """The step over the square of the motion, of which accelerations are multiples."""
        motion = radians(self.motion_deg)
        return 2.0 * self.half_step / (motion * motion)

    @property
    def mirrored(self) -> bool:
        """True if motion, slot and loads are symmetric about mid-motion."""
        return self.motion.symmetric

    def end_deg(self, end: float) -> float:
        """Input angle at entry, where ``end`` is -1, or at exit, where it is 1."""
        return self.entry_deg if end < 0.0 else self.exit_deg

    def reach(self, input_deg: float) -> Number:
        """Pin distance from the wheel's axis, in units of L."""
        x, y = self.slot(input_deg, 0)
        return library(x.c[0], y.c[0]).hypot(x.c[0], y.c[0])

    def carrier(self, input_deg: Number, order: int = 0) -> Jet:
        """Rate of the body that carries the roller, about its axis, positive with the wheel."""
        if callable(self.body):
            return self.body(radians(input_deg), order)
        return Jet((input_deg * 0.0 + cast(float, self.body), *[0.0] * order))

    def shaft(self, input_deg: Number, order: int = 0) -> Jet:
        """Angle of the drive's own input shaft from mid-motion, radians."""
        return Jet.variable(radians(input_deg), order)

    def own_deg(self, input_deg: Array) -> Array:
        """Angle of the drive's own input shaft at input angles from mid-motion, degrees."""
        return input_deg

    def inputs_deg(self, own_deg: Array) -> Array:
        """Input angles from mid-motion at angles of the drive's own input shaft, degrees."""
        return own_deg

    @property
    def own(self) -> Engagement:
        """The engagement by the angle of the drive's own input shaft; itself without another."""
        return self

    @property
    def passages(self) -> tuple[tuple[Engagement, float], ...]:
        """Passage of each roller through a whole slot, and the input angle by which it leads."""
        return self.pair or ((self, 0.0),)

    @property
    def through(self) -> Engagement:
        """Engagement whose roller runs through the whole slot: itself, except for gear sectors."""
        return self.pair[0][0] if self.pair else self


class Anchor(NamedTuple):
    """An input angle about which the pin's path is written without cancellation."""

    input_deg: float
    wheel: float  # direction of the ray from the wheel's axis to the pin there, radians
    along: float  # distance from the wheel's axis to the pin there
    displacement: Displacement  # since then, along the ray and across it

    def __call__(self, input_deg: Number, order: int = 3) -> Vector:
        """Pin position (along the anchor's ray, across it) at an input angle in degrees."""
        along, across = self.displacement(radians(input_deg - self.input_deg), order)
        return along + self.along, across
