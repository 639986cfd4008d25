"""The base of the linkages: a roller on a closed path, and the wheel that the path can drive."""

from abc import abstractmethod
from collections.abc import Mapping
from functools import reduce
from typing import Annotated, Any, ClassVar, Self, TypeAlias, cast

from geneva_cli.errors import refuse_text
from geneva_cli.kinds.linkages.link_path import LinkPath, LinkReactions
from geneva_cli.motion.drive import Drive, Plan
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.pivots import Dimension, Joint, Layout, Link, Pivot
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import DEGREE, radians
from geneva_cli.numerics.arrays import Array, Number, larger, library, parameter, smaller
from geneva_cli.spec.rules import Range
from geneva_cli.spec.tables import DISTANCE_MM

# name, joints as complex numbers in the linkage's own frame, their kinds, plane below the wheel
PlaneLink: TypeAlias = tuple[str, tuple[Any, ...], tuple[Joint, ...], int]


class Linkage(Drive, kw_only=True):
    """A linkage; the position of the wheel's centre is solved for.

    Its crank does not carry the roller, and so it has no locking disc.
    """

    LOCKS: ClassVar[bool] = False
    CARRIER: ClassVar[str]  # link that carries the roller
    LENGTHS: ClassVar[Mapping[str, str]]  # their keys by their names, the roller's the last
    PATH: ClassVar[type[LinkPath]]
    entry_deg: Annotated[
        float | None, Range(-360.0, 360.0), "crank angle near entry, to choose among several wheels"
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        ratio = 1e4  # of two links: beyond it the path is a point, or rounding
        lengths = [vars(self)[key] for key in self.LENGTHS.values() if key != "height_mm"]
        limit, text = ratio * reduce(smaller, lengths), "links differ by more than 10000 times: "
        text += "the longest must be at most {limit:g} mm"
        wrong = reduce(larger, lengths) > limit
        refuse_text(wrong, ("drive", "crank_mm"), text, limit=limit)

    @property
    def roller_path(self) -> LinkPath:
        """The roller's path about the crank's axis."""
        *lengths, reach_mm = (vars(self)[key] for key in self.LENGTHS.values())
        return self.PATH(*lengths, reach_mm=reach_mm, angle_deg=vars(self)["point_deg"])

    def plan(self, wheel: Gearing, motion: Motion | None, L: float) -> Plan:
        """The engagement of the wheel that the path can drive: the gentlest, or by ``entry_deg``.

        Raises GenevaError if there is none, or if the spec sets the centre distance.
        """
        text = 'center_distance_mm follows from the linkage of kind = "{name}": remove it'
        refuse_text(L != DISTANCE_MM, ("size", "center_distance_mm"), text, name=self.NAME)
        from geneva_cli.kinds.linkages.path_wheels import solve

        wanted = None if self.entry_deg is None else radians(self.entry_deg)
        engagement, L = solve(self.roller_path, wheel.step, wanted)
        x, y = engagement.path(0.0, 0)
        return self.planned(engagement, parameter(library(L).hypot(1.0 - x.c[0], y.c[0])), L)

    def backwards(self, plan: Plan) -> Self:
        """The drive on the same path, which it enters where it left it; a kind adds its mirror."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        entry_deg = 0.0 - (at.middle / DEGREE + plan.engagements[0].exit_deg)
        entry_deg = entry_deg - 360.0 * library(entry_deg).floor(entry_deg / 360.0)
        return self.replace(entry_deg=entry_deg)

    def linked(self, plan: Plan, **fixed: complex) -> Layout:
        """Fixed points of the linkage's own frame, crank pin and roller at input 0, and lengths."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        pin, _, roller = self._joints(plan, 0.0)
        points = {**fixed, "crank pin A": pin, "roller C": roller}
        return (
            *(Pivot(name, *self._placed(plan, z)) for name, z in points.items()),
            Dimension("crank turns", "counterclockwise" if at.sense > 0.0 else "clockwise"),
            *(Dimension(name, vars(self)[key], "mm") for name, key in self.LENGTHS.items()),
            Dimension("angle BAC", vars(self)["point_deg"], "deg"),
        )

    def links(self, plan: Plan, sign: float, input_deg: Array) -> tuple[Link, ...]:
        """The crank, the link that carries the roller, and the one that holds that link."""
        pin, end, roller = self._joints(plan, radians(input_deg))
        own: tuple[PlaneLink, ...] = (
            ("crank", (0.0, pin), (Joint.SHAFT, Joint.PIN), 2),
            (self.CARRIER, (pin, end, roller), (Joint.PIN, Joint.PIN, Joint.ROLLER), 1),
            self.holder(end),
        )
        return tuple(
            Link(name, tuple(self._placed(plan, z + 0.0 * pin) for z in points), kinds, plane)
            for name, points, kinds, plane in own
        )

    def _joints(self, plan: Plan, since: Number) -> tuple[Any, Any, Any]:
        """Joints A and B and the roller's centre, ``since`` radians after mid-motion; complex."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        turn, m = since + at.middle, library(since, at.middle)
        return at.path.joints(m.cos(turn) + 1j * m.sin(turn))

    def _placed(self, plan: Plan, z: Any) -> tuple[Any, Any]:
        """Transform a point, complex, from the linkage's own frame to the machine's."""
        at = cast(LinkReactions, plan.engagements[0].reactions)
        seen = z * (at.x - 1j * at.y)
        return plan.center_distance_mm + seen.real, at.sense * seen.imag

    @abstractmethod
    def holder(self, end: Any) -> PlaneLink:
        """The link or guide that holds the carrying link at its end B."""
