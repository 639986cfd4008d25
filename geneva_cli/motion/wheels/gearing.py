"""The base of the gearings: external, internal and spherical wheels, and racks."""

from __future__ import annotations

import math
from dataclasses import field
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, NamedTuple, Self

from geneva_cli.motion.path_and_slot import AnchoredPath, RadialSlot, StraightSlotMotion
from geneva_cli.motion.pivots import Layout, Pivot, PlaneMotion
from geneva_cli.motion.wheels import classic
from geneva_cli.motion.wheels.classic import HalfStep, PinPose, radial
from geneva_cli.numerics.angles import one_minus_sin_pi, sin_cos_pi
from geneva_cli.numerics.arrays import Truth, choose
from geneva_cli.spec.rules import Z_MAX, OneOf, Range
from geneva_cli.spec.schema import SpecTable

if TYPE_CHECKING:
    from geneva_cli.motion.engagement import AsBuilt, Slot, WheelMotion
    from geneva_cli.numerics.jet import Displacement


class Output(NamedTuple):
    """What a wheel gives out: an angle, or the travel of a rack, with the units of its rates."""

    noun: str  # of the part that moves
    column: str  # name of its position in tables
    unit: str
    per_radian: float  # in that unit
    rate_unit: str
    rate_per_radian: float  # in that unit
    load_keys: str  # what sets a load
    # names of loads, each with that of a load on a wheel's shaft and the ratio to it
    loads: tuple[tuple[str, str, float], ...] = ()
    lacks: tuple[str, ...] = ()  # quantities that only a wheel with a shaft has
    invariants: str = "relative to the input"  # what velocity, acceleration and jerk are
    turns: bool = True  # it is an angle

    def from_deg(self, wheel_deg: float) -> float:
        """Return an angle of the wheel, or of a rack's pinion, in the unit of the output."""
        return wheel_deg if self.turns else math.radians(wheel_deg) * self.per_radian


class RollerPlace(NamedTuple):
    """A roller on the crank, and its passage through a straight slot."""

    step: HalfStep
    half_motion_deg: float
    poses: tuple[PinPose, PinPose, PinPose]  # entry, middle and exit, from the line of centres on
    ratio: float  # its arm over the centre distance
    # Of an offset slot: e; its angle to the line of centres half-way through the step, radians; and
    # the pin's least place along its axis, at mid-motion. Poses at both ends are in the slot's own
    # frame, whose axis is offset by -e from the ray from the wheel's centre.
    e: float = 0.0
    tilt: float = 0.0
    deepest: Any = None
    crank_deg: float = 0.0  # crank angle at which it crosses the line of centres
    # on a sphere: (top, fall) of the pin's position along the wheel's axis, top - fall (1 - cos a);
    # the cosine of its cone; and how far from the wheel's axis the crank's arm turns, over L
    height: tuple[float, float] | None = None
    cone: float = 1.0
    hub: float = 1.0
    closed: tuple[float, float, float] | None = None  # sign, l and 1 - l for closed forms
    built: AsBuilt | None = None


class Gearing(SpecTable, table="wheel"):
    """A wheel; its fields are the keys of ``[wheel]``. Raises GenevaError for impossible values."""

    NAME: ClassVar[str]
    # usual keys of [load] in a new spec
    USUAL_LOAD: ClassVar[dict[str, float]] = {"inertia_kgm2": 0.05, "torque_Nm": 2}
    # +1 if the crank's axis is outside the wheel, -1 if inside
    SIGN: ClassVar[float] = 1.0
    # True if wheel and crank are flat parts on parallel shafts
    FLAT: ClassVar[bool] = True
    # meaning of center_distance_mm
    DISTANCE: ClassVar[str] = "centre distance"
    # title of a design without one of its own, and the wheel in words, for a kind of slots
    TITLE: ClassVar[str] = "Geneva wheel of {} slots"
    WORDS: ClassVar[str] = "{0.NAME} wheel of {0.z} {1} slots"
    # what locks it in the dwell, on a crank
    LOCK: ClassVar[str] = "locking disc"
    # These are set as the wheel is made, where a kind decides them:
    step: ClassVar[HalfStep]  # half the wheel's step, for equal steps
    steps: ClassVar[tuple[float, ...]] = ()  # pattern of unequal ones, degrees; empty if all equal
    stopped: ClassVar[bool] = False  # a convex face in place of a recess stops the crank
    skewed: ClassVar[Truth] = False  # some slots are not radial, or not all are alike
    layout: ClassVar[Layout] = ()  # dimensions of the kind, in addition to the number of slots
    own_sizes: ClassVar[dict[str, float]] = {}  # by name, which a report shows for this kind only
    z: Annotated[int, Range(3, Z_MAX), "number of slots"]
    held_by: Annotated[
        str | None,
        OneOf(("brake", "detent", "pin")),
        "device that holds the wheel at rest, if no locking disc does",
    ] = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        half = HalfStep(1, self.z, math.pi / self.z, sin_cos_pi(1, self.z))
        vars(self)["step"] = half

    @property
    def backwards(self) -> Self:
        """The wheel that turns the other way, as seen from its other side."""
        return self

    @property
    def title(self) -> str:
        """The title of a design without one of its own."""
        return self.TITLE.format(self.z)

    def axes(self, L: float) -> tuple[Pivot, ...]:
        """Axes of wheel and crank in the plane of the parts, for a centre distance in mm."""
        return Pivot("wheel axis", 0.0, 0.0), Pivot("crank axis", L, 0.0)

    def output(self, center_distance_mm: float) -> Output:
        """What the wheel gives out: its angle, in degrees."""
        keys = "inertia_kgm2 or torque_Nm in [load], or a [[mass]]"
        return Output("wheel", "wheel_deg", "deg", 180.0 / math.pi, "rad", 1.0, keys)

    def index_deg(self, i: int) -> float:
        """The wheel's step at its i-th engagement, degrees; unequal steps repeat."""
        return self.steps[i % len(self.steps)] if self.steps else 360.0 / self.z

    def half_motion_deg(self, step: HalfStep) -> float:
        """Crank angle in degrees from entry to the line of centres, for an entry without shock."""
        return classic.half_motion_deg(self.SIGN, step.p, step.q)

    def place(self, step: HalfStep, center_distance_mm: float) -> RollerPlace:
        """Place of a roller in a straight slot, which is radial in a flat wheel."""
        three, l = radial(self.SIGN, step), step.sin_cos[0]
        closed = self.SIGN, l, one_minus_sin_pi(step.p, step.q)
        return RollerPlace(step, three[2].crank_deg, three, l, closed=closed)

    def distance_mm(self, crank_radius_mm: float) -> float:
        """Centre distance L for a crank radius R, mm, with straight slots."""
        return crank_radius_mm / self.place(self.step, 1.0).ratio

    def as_built(self, ratio: float, rim: float, L: float) -> RollerPlace | None:
        """Place of a roller on a crank of another R/L than the slots need.

        ``ratio`` and the ``rim`` are over the centre distance ``L``, mm. None for a wheel that
        takes no other R/L. Raises GenevaError if the roller cannot pass the line of centres.
        """
        return None

    def follow(
        self, path: AnchoredPath, place: RollerPlace, turn: Displacement
    ) -> tuple[Slot, WheelMotion]:
        """Straight slot of no offset for a roller's path, and the motion that follows.

        ``turn`` is the crank's rotation from mid-motion, as its sine and versine.
        """
        return RadialSlot(path), StraightSlotMotion(path, place.step.b)

    def plane_motion(self, center_distance_mm: float) -> PlaneMotion:
        """How the wheel moves in its plane, for lengths in millimetres."""
        return PlaneMotion(center_distance_mm)

    def matched_ratio(self, v: float) -> float:
        """R/L at which the pin crosses the line of centres as fast as its slot does; NaN if none.

        ``v`` is the wheel's speed over the crank's there: l/(1 - l), inside l/(1 + l).
        """
        able = (v > 0.0) & ((1.0 - self.SIGN) * v < 1.0)
        ratio: float = choose(able, v, math.nan) / (1.0 + self.SIGN * choose(able, v, 0.0))
        return ratio
