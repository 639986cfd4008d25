"""The base of the linkages: a roller on a closed path, and the wheel that the path can drive."""

from __future__ import annotations

import copy
from abc import abstractmethod
from decimal import Decimal, localcontext
from functools import reduce
from typing import (
    TYPE_CHECKING,
    Annotated,
    ClassVar,
    Self,
    TypeAlias,
    TypeVar,
    cast,
)

from geneva_cli.drives.pin_path import PinPath
from geneva_cli.drives.roller_path import LinkReactions, RollerPath, rounded
from geneva_cli.errors import GenevaError, refuse
from geneva_cli.kinds.linkages import driven_wheel
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.pivots import Dimension, Joint, Layout, Link, Pivot
from geneva_cli.numerics import digits
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Array, Long, array, larger, library, parameter, smaller
from geneva_cli.numerics.jet import Jet, sin_cos
from geneva_cli.spec.rules import Range, is_array
from geneva_cli.spec.tables import DISTANCE_MM

if TYPE_CHECKING:
    from geneva_cli.motion.motion import Motion
    from geneva_cli.motion.wheels.gearing import Gearing

Place = TypeVar("Place", float, "Array")
Moving: TypeAlias = "tuple[Array, Array]"  # x and y at input angles


class Linkage(PinPath, kw_only=True):
    """A linkage; the position of the wheel's centre is solved for.

    Its crank does not carry the roller, and so it has no locking disc.
    """

    LOCKS: ClassVar[bool] = False
    CARRIER: ClassVar[str]  # link that carries the roller
    entry_deg: Annotated[
        float | None, Range(-360.0, 360.0), "crank angle near entry, to choose among several wheels"
    ] = None

    @property
    @abstractmethod
    def roller_path(self) -> RollerPath:
        """The roller's path about the crank's axis."""

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        """The engagement of the wheel that the path can drive.

        If there are several wheels, it is the one with the least peak velocity, or the one whose
        entry is nearest to ``entry_deg``. Raises GenevaError if there is none, or if the spec sets
        the centre distance, which follows from the linkage.
        """
        refuse(
            L != DISTANCE_MM,
            lambda: GenevaError(
                f'center_distance_mm follows from the linkage of kind = "{self.NAME}": remove it',
                ("size", "center_distance_mm"),
            ),
        )
        step, path = wheel.step, self.roller_path
        if self.varies or is_array(step.b):
            engagement, L = driven_wheel.solve_batch(path, step, self._wanted, self._alone)
        else:
            solved = driven_wheel.solve(path, step, self._wanted)
            if solved is None:
                raise driven_wheel.none_fits(wheel.z)
            engagement, L = solved
        x, y = engagement.path(0.0, 0)
        return self.planned(engagement, parameter(library(L).hypot(1.0 - x.c[0], y.c[0])), L)

    def backwards(self, plan: Plan) -> Self:
        """The drive on the same path, which it enters where it left it; a kind adds its mirror."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        entry_deg = 0.0 - (at.middle / DEGREE + plan.engagements[0].exit_deg)
        return self.replace(
            entry_deg=entry_deg - 360.0 * library(entry_deg).floor(entry_deg / 360.0)
        )

    def placed(self, plan: Plan, name: str, x: float, y: float) -> Pivot:
        """Pivot at a point (mm) of the linkage's own frame, whose origin is the crank's axis."""
        return Pivot(name, *self._placed(plan, x, y))

    def linked(self, plan: Plan) -> Layout:
        """The crank's pin, the roller, and the crank's sense of rotation, at input angle 0."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        direction = sin_cos(Jet((at.middle,)))
        pin, roller = at.path.joint(*direction), at.path.place(*direction)
        return (
            self.placed(plan, "crank pin A", *(parameter(x.c[0]) for x in pin)),
            self.placed(plan, "roller C", *(parameter(x.c[0]) for x in roller)),
            Dimension("crank turns", "counterclockwise" if at.sense > 0.0 else "clockwise"),
        )

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        """The crank, the link that carries the roller, and the one that holds that link."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        turn = radians(input_deg) + at.middle
        direction = sin_cos(Jet((turn,)))
        pin, unit, roller = (
            (array(x.c[0]), array(y.c[0]))
            for x, y in (f(*direction) for f in (at.path.joint, at.path.link, at.path.place))
        )
        reach = at.path.hold(*direction)[0]
        end = pin[0] + reach * unit[0], pin[1] + reach * unit[1]
        origin = 0.0 * turn, 0.0 * turn
        own = (
            Link("crank", (origin, pin), (Joint.SHAFT, Joint.PIN), 2),
            Link(self.CARRIER, (pin, end, roller), (Joint.PIN, Joint.PIN, Joint.ROLLER), 1),
            self.holder(end),
        )
        return tuple(
            link._replace(joints=tuple(self._placed(plan, x, y) for x, y in link.joints))
            for link in own
        )

    def _placed(self, plan: Plan, x: Place, y: Place) -> tuple[Place, Place]:
        """Transform points from the linkage's own frame to the machine's."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        ahead, sideways = x * at.x + y * at.y, at.sense * (y * at.x - x * at.y)
        return plan.center_distance_mm + ahead, sideways

    @abstractmethod
    def holder(self, end: Moving) -> Link:
        """The link or guide that holds the carrying link at its end B, in the linkage's frame."""

    @property
    def varies(self) -> bool:
        """True if a length or angle is an array of designs."""
        return any(is_array(value) for key, value in vars(self).items() if key != "n_rpm")

    @property
    def _wanted(self) -> float | None:
        """``entry_deg`` in radians."""
        return None if self.entry_deg is None else radians(self.entry_deg)

    def _alone(self, i: int) -> tuple[RollerPath, float | None]:
        """Path and entry of the i-th design. Raises GenevaError for a refused one."""
        one = copy.copy(self)
        for key, value in vars(self).items():
            if is_array(value):
                vars(one)[key] = float(value[i, 0])
        one.__post_init__()
        return one.roller_path, one._wanted


def refuse_proportions(**lengths: float) -> None:
    """Raise GenevaError for lengths too different for a wheel to be solved for."""
    ratio = 1e4  # of two links: beyond it the path is a point, or rounding
    limit = ratio * reduce(smaller, lengths.values())

    def error() -> GenevaError:
        name = max(lengths, key=lengths.__getitem__)
        return GenevaError(
            f"{name} = {lengths[name]:g}: links differ by more than {ratio:g} times: it must be "
            f"at most {limit:g}",
            ("drive", name),
        )

    refuse(reduce(larger, lengths.values()) > limit, error)


class RodPath(RollerPath):
    """The path of a point on the link that crank pin A carries: a coupler, or a connecting rod.

    Its numbers are the lengths, with the crank's a first. Last are the point's coordinates p along
    the link and q across it.
    """

    def __init__(self, *lengths: float, reach_mm: float, angle_deg: float) -> None:
        many = any(is_array(x) for x in (*lengths, reach_mm, angle_deg))
        numbers = (_long if many else _exactly)(*lengths, reach_mm=reach_mm, angle_deg=angle_deg)
        self.exact = cast("tuple[float, ...]", numbers)
        self.rough = tuple(rounded(x) for x in numbers)

    def joint(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Crank pin A (x, y)."""
        a, *_ = self.rough
        return cosine * a, sine * a

    def place(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """Point (x, y) on the link: crank pin plus the vector on the link."""
        a, *_, p, q = self.exact if exact else self.rough
        x, y = self.carried(p, q, sine, cosine, exact)
        return x + cosine * a, y + sine * a

    def link(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """Unit vector along the link, from A towards B."""
        return self.carried(1, 0, sine, cosine, exact)

    @abstractmethod
    def carried(
        self, p: float, q: float, sine: Jet, cosine: Jet, exact: bool = False
    ) -> tuple[Jet, Jet]:
        """Vector in the frame that is p along the link and q across it."""


def _exactly(*lengths: float, reach_mm: float, angle_deg: float) -> tuple[Decimal, ...]:
    """Lengths, and a point's coordinates from its distance and angle, in 50 digits."""
    with localcontext(digits.FIFTY):
        sine, cosine = digits.sin_cos(Decimal(angle_deg) * digits.PI / 180)
        point = Decimal(reach_mm) * cosine, Decimal(reach_mm) * sine
        return (*(Decimal(x) for x in lengths), *point)


def _long(*lengths: float, reach_mm: float, angle_deg: float) -> tuple[Long, ...]:
    """Lengths, and a point's coordinates from its distance and angle, in long doubles."""
    import numpy as np  # of a batch

    from geneva_cli.drives.path_wheels.wheels_for_paths import LONG_PI

    turned = np.asarray(angle_deg, dtype=np.longdouble) * (LONG_PI / 180)
    point = reach_mm * np.cos(turned), reach_mm * np.sin(turned)
    return tuple(np.asarray(x, dtype=np.longdouble) for x in (*lengths, *point))
