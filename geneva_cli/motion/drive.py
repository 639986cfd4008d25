"""The base of the drives, which turn the crank or move the roller."""

from __future__ import annotations

from abc import abstractmethod
from typing import TYPE_CHECKING, Annotated, ClassVar, NamedTuple, Self

from geneva_cli.errors import GenevaError, refuse_text
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.pivots import Layout, Link, ShaftPlace
from geneva_cli.motion.wheels.classic import refuse_jam, rollers_max
from geneva_cli.numerics.arrays import larger
from geneva_cli.spec.rules import SPEED, Z_MAX, FromZero, Range
from geneva_cli.spec.schema import SpecTable

if TYPE_CHECKING:
    from geneva_cli.motion.laws.law import Motion
    from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace
    from geneva_cli.numerics.arrays import Array
    from geneva_cli.numerics.jet import Displacement


class Plan(NamedTuple):
    """The engagements of a machine's period, and the proportions that were solved for."""

    engagements: tuple[Engagement, ...]
    period_deg: float  # input angle after which the engagements repeat
    ratio: float  # l = R/L at mid-motion
    rollers_max: int  # greatest number of evenly spaced rollers that do not jam
    center_distance_mm: float


class Gears(NamedTuple):
    """A pair of gears: the distance of their axes, and the crank's rotation from input angle 0."""

    distance_mm: float
    advance: Displacement


class Drive(SpecTable, kw_only=True, table="drive"):
    """A kind of drive; its fields are the keys of ``[drive]``."""

    SHARED: ClassVar[tuple[str, ...]] = ("rollers",)  # they decide how many engagements there are
    NAME: ClassVar[str]
    # name of the drive in a sentence
    WORDS: ClassVar[str]
    # True if the roller stays as far from the crank's axis as at mid-motion
    ONE_ARM: ClassVar[bool] = False
    # True if its crank can carry a locking disc about the line of centres
    LOCKS: ClassVar[bool] = True
    # what turns the input shaft of another drive, in [drive.before]; empty if it cannot
    IN_FRONT: ClassVar[str] = ""
    # reason why no drive may stand before it; empty if one may
    FIRST: ClassVar[str] = ""
    # True if the input shaft carries the crank, so that the classic closed forms hold
    direct: ClassVar[bool] = False
    # names of its links that are gears with pitch circles
    round_gears: ClassVar[tuple[str, ...]] = ()
    length_key: ClassVar[str] = ""  # the optional key of a length that its reactions need, if any
    # A kind whose keys decide these sets them as it is made:
    turns: ClassVar[int] = 1  # input turns in one turn of the crank
    wheels_on_carrier: ClassVar[int] = 0  # that orbit on it, as the input turns it; 0 without one
    # places of the cranks about the wheel, in steps from the first one
    cranks: ClassVar[tuple[float, ...]] = (0.0,)
    n_rpm: Annotated[float, SPEED, "speed of the input shaft; the other way: --reverse"] = 60.0
    rollers: Annotated[int, Range(1, Z_MAX), "number of rollers (pins) on the crank, m"] = 1
    roller_angles_deg: Annotated[
        tuple[float, ...] | None,
        Range(0.0, 360.0, "[)"),
        "angles of rollers that are not evenly spaced",
    ] = None
    stop_s: Annotated[FromZero, "time by which a stop of the input lengthens each dwell"] = 0.0
    start_s: Annotated[FromZero, "time in which the input starts after a stop"] = 0.0
    brake_s: Annotated[FromZero, "time in which the input brakes to a stop"] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        lost_s = 0.5 * (self.start_s + self.brake_s)
        text = "stop_s = {stop_s:g}: to brake and to start takes {lost_s:g} s longer than to run "
        text += "on, so the input would not come to rest: it must be at least {lost_s:g}"
        short, key = lost_s > self.stop_s * (1.0 + 1e-12), (self.TABLE, "stop_s")
        refuse_text(short, key, text, stop_s=self.stop_s, lost_s=lost_s)

    @property
    def stands_s(self) -> float:
        """Time for which the input stands still in each stop, between braking and starting."""
        return larger(self.stop_s - 0.5 * (self.start_s + self.brake_s), 0.0)

    @property
    def brake_and_start_deg(self) -> tuple[float, float]:
        """Angles through which the input turns while it brakes, and while it starts, degrees."""
        return 3.0 * self.n_rpm * self.brake_s, 3.0 * self.n_rpm * self.start_s

    def backwards(self, plan: Plan) -> Self:
        """The drive that turns the other way, as seen from its other side.

        ``plan`` is the plan of the machine that turns forwards.
        """
        if not self.roller_angles_deg:
            return self
        others = self.roller_angles_deg[:0:-1]
        return self.replace(roller_angles_deg=(0.0, *(360.0 - angle for angle in others)))

    @property
    def crank(self) -> Drive | None:
        """A plain crank with the same rollers; None if no crank carries them."""
        return None

    @property
    def gears(self) -> Gears | None:
        """Noncircular gears between input and crank; None for a drive without."""
        return None

    def first_wheel(self, L: float) -> tuple[int, float] | None:
        """Slots and centre distance of an external wheel that turns the crank; None without.

        ``L`` is the second wheel's centre distance.
        """
        return None

    def input_deg(self, crank_deg: float) -> float:
        """Input angle from mid-motion at a crank angle from mid-motion, degrees."""
        return crank_deg

    def input_shaft(self, plan: Plan, sign: float, sense: float) -> ShaftPlace:
        """Its own input shaft; ``sign`` is the wheel's, ``sense`` that of the crank's rotation."""
        return ShaftPlace(plan.center_distance_mm, sense)

    def layout(self, plan: Plan, sign: float) -> Layout:
        """Pivots and dimensions of this kind of drive; ``sign`` is the wheel's (-1 inside)."""
        return ()

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        """Links that turn the crank or carry the roller, at input angles from mid-motion."""
        return ()

    def distance_mm(self, wheel: Gearing, motion: Motion | None, radius_mm: float) -> float:
        """Centre distance L for a crank radius R, mm, where the kind's shape fixes R/L."""
        text = f'kind = "{self.NAME}" has no crank of one radius: remove crank_radius_mm'
        raise GenevaError(text, ("size", "crank_radius_mm"))

    def as_built(self, wheel: Gearing, place: RollerPlace, L: float) -> Plan | None:
        """Plan of straight slots for a roller's place on a crank as built; None if it takes none.

        ``L`` is the centre distance, mm. Raises GenevaError if rollers would jam.
        """
        return None

    def planned(self, own: Engagement, ratio: float, L: float) -> Plan:
        """The plan of one engagement for each roller. Raises GenevaError if they would jam."""
        refuse_jam(self.rollers, own.motion_deg)
        period = 360.0 * self.turns / self.rollers
        return Plan((own,), period, ratio, rollers_max(own.motion_deg), L)

    @abstractmethod
    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        """Engagements and proportions of a machine; without a motion its slots are straight.

        ``L`` is the centre distance, mm, where the drive does not solve for it.
        """
