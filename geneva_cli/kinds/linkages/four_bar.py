"""A four-bar linkage in front of the wheel: the roller is a point of its coupler.

Crank a leads from the input's axis to the pin A, and coupler b from A to B. Rocker c leads from B
to its own pivot, at the distance g from the input's axis. The roller C is at the distance k from A,
at an angle from the line AB. The wheel's centre is solved for.
"""

from collections.abc import Mapping
from functools import reduce
from typing import Annotated, Any, ClassVar, Self, cast

from geneva_cli.errors import refuse_text
from geneva_cli.kinds.linkages.link_path import Guide, LinkPath, root
from geneva_cli.kinds.linkages.linkage import Linkage, PlaneLink
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.pivots import Dimension, Joint, Layout
from geneva_cli.numerics.arrays import larger, smaller
from geneva_cli.spec.rules import POSITIVE, OneOf, Range


class CouplerPath(LinkPath):
    """The path of a point of the coupler.

    d is the vector from A to the rocker's pivot, D = d² and N = sqrt(4 b² D - (b² + D - c²)²). The
    unit vector from A towards B is e = d k, k = ((D + b² - c²) + i N) / (2 b D). Its numbers are
    crank, ground, coupler, rocker, and the point's coordinates on the coupler: a, g, b, c, p, q.
    """

    side = 1  # on which the coupler is of the crank's line, or -1

    @property
    def guide(self) -> Guide:
        """The rocker, which pushes or pulls."""
        _, g, b, c, _, _ = self.numbers
        return Guide(b, 1.0 / c, g / c, 0.0)

    def pose(self, c: Any, s: Any) -> tuple[Any, Any, Any]:
        """The coupler, whose end B is on a circle."""
        a, ground, b, rocker, _, _ = self.numbers
        x, y = ground - a * c, -a * s
        D = x * x + y * y
        # N² as a product (Heron); products of real numbers take half the time of complex ones
        N = root(((b + rocker) ** 2 - D) * (D - (b - rocker) ** 2)) * self.side
        scale, level = 0.5 / (b * D), D + (b - rocker) * (b + rocker)
        return scale * (x * level - y * N), scale * (y * level + x * N), N * (0.5 / (b * rocker))


class FourBar(Linkage, kw_only=True):
    """A point of a four-bar's coupler carries the roller.

    Links are in mm; ``point_deg`` is the angle from the coupler's line to the roller's. The wheel
    that the path can drive is solved for. Building the machine raises GenevaError if the links do
    not close or their path drives no wheel.

    >>> coupler = FourBar(
    ...     crank_mm=40, ground_mm=90, coupler_mm=100, rocker_mm=100,
    ...     point_mm=161.519, point_deg=-36.138, entry_deg=123.3,
    ... )
    >>> round(Design(External(4), coupler).mechanism.center_distance_mm, 2)
    119.49
    """

    NAME: ClassVar[str] = "four-bar"
    WORDS: ClassVar[str] = "a point of a four-bar linkage"
    CARRIER: ClassVar[str] = "coupler"
    PATH: ClassVar[type[LinkPath]] = CouplerPath
    LENGTHS: ClassVar[Mapping[str, str]] = {
        "crank a": "crank_mm",
        "ground g": "ground_mm",
        "coupler b": "coupler_mm",
        "rocker c": "rocker_mm",
        "roller from A": "point_mm",
    }
    crank_mm: Annotated[float, POSITIVE, "length of crank a"]
    ground_mm: Annotated[float, POSITIVE, "distance g between the fixed pivots"]
    coupler_mm: Annotated[float, POSITIVE, "length of coupler b, from crank pin A to rocker pin B"]
    rocker_mm: Annotated[float, POSITIVE, "length of rocker c"]
    point_mm: Annotated[float, POSITIVE, "distance of roller C from crank pin A"]
    point_deg: Annotated[float, Range(-360.0, 360.0), "angle BAC, from AB to AC"]
    branch: Annotated[str, OneOf(("+", "-")), "side of the crank's line the coupler is on"] = "+"

    def __post_init__(self) -> None:
        super().__post_init__()
        # Grashof's condition for a full turn: the crank is the shortest link, and with the longest
        # it is below the sum of the other two.
        others = [self.ground_mm, self.coupler_mm, self.rocker_mm]
        limit = smaller(reduce(smaller, others), sum(others) - 2.0 * reduce(larger, others))
        text = "crank_mm = {a:g}: the crank cannot make a full turn (Grashof's condition); it must "
        text += "be below {limit:.6g}, which the other links decide"
        wrong, key = self.crank_mm >= limit, ("drive", "crank_mm")
        refuse_text(wrong, key, text, a=self.crank_mm, limit=limit)

    def backwards(self, plan: Plan) -> Self:
        """The mirrored linkage: the other branch, the roller across the coupler."""
        other = "-" if self.branch == "+" else "+"
        return super().backwards(plan).replace(branch=other, point_deg=0.0 - self.point_deg)

    def layout(self, plan: Plan, sign: float) -> Layout:
        """Joints at input 0, and lengths of the links."""
        pivots = self.linked(plan, **{"rocker axis": self.ground_mm})
        return (*pivots, Dimension("branch", self.branch))

    def holder(self, end: Any) -> PlaneLink:
        """The rocker, on a pin in the frame."""
        return "rocker", (end, self.ground_mm), (Joint.PIN, Joint.PIN), 3

    @property
    def roller_path(self) -> LinkPath:
        """Path of the coupler point that carries the roller."""
        path = cast(CouplerPath, super().roller_path)
        path.side = 1 if self.branch == "+" else -1
        return path
