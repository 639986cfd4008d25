"""A slider-crank in front of the wheel: the roller is a point of its connecting rod.

Crank a leads from the input's axis to the pin A, and rod b from A to the slider B. The slider's
line passes the crank's axis at the height h. The roller C is at the distance k from A, at an angle
from the line AB. The wheel's centre is solved for.
"""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Self

from geneva_cli.errors import refuse_text
from geneva_cli.kinds.linkages.link_path import Guide, LinkPath, root
from geneva_cli.kinds.linkages.linkage import Linkage, PlaneLink
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.pivots import Joint, Layout
from geneva_cli.spec.rules import LENGTH, POSITIVE, Range


class SlidingRod(LinkPath):
    """The path of a point of the connecting rod.

    Its numbers are crank, rod, height, and the point's coordinates on the rod: a, b, h, p, q.
    """

    @property
    def guide(self) -> Guide:
        """The slider's line, across which it pushes."""
        return Guide(self.numbers[1], 0.0, 0.0, 1.0)

    def pose(self, c: Any, s: Any) -> tuple[Any, Any, Any]:
        """The rod, whose end B is on a line."""
        a, b, h, _, _ = self.numbers
        y = (h - a * s) / b
        x = root((1.0 - y) * (1.0 + y))
        return x, y, -x


class SliderCrank(Linkage, kw_only=True):
    """A point of a connecting rod carries the roller.

    Links are in mm; ``point_deg`` is the angle from the rod's line to the roller's. The wheel that
    the path can drive is solved for. Building the machine raises GenevaError if the rod is too
    short or the path drives no wheel.

    >>> rod = SliderCrank(crank_mm=40, rod_mm=100, point_mm=80, point_deg=90)
    >>> round(Design(External(8), rod).mechanism.center_distance_mm, 2)
    211.92
    """

    NAME: ClassVar[str] = "slider-crank"
    WORDS: ClassVar[str] = "a point of a slider-crank"
    CARRIER: ClassVar[str] = "rod"
    PATH: ClassVar[type[LinkPath]] = SlidingRod
    LENGTHS: ClassVar[Mapping[str, str]] = {
        "crank a": "crank_mm",
        "rod b": "rod_mm",
        "slider's line from the crank's axis h": "height_mm",
        "roller from A": "point_mm",
    }
    crank_mm: Annotated[float, POSITIVE, "length of crank a"]
    rod_mm: Annotated[float, POSITIVE, "length of connecting rod b, from crank pin A to slider B"]
    point_mm: Annotated[float, POSITIVE, "distance of roller C from crank pin A"]
    point_deg: Annotated[float, Range(-360.0, 360.0), "angle BAC, from AB to AC"]
    height_mm: Annotated[float, LENGTH, "slider's line from the crank's axis, h"] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        a, b, h = self.crank_mm, self.rod_mm, self.height_mm
        text = "crank_mm = {a:g}: the crank cannot make a full turn; it must be below {limit:.6g}, "
        text += "the rod minus the height of the slider's line"
        refuse_text(a + abs(h) >= b, ("drive", "crank_mm"), text, a=a, limit=b - abs(h))

    def backwards(self, plan: Plan) -> Self:
        """The mirrored linkage: the slider's line and the roller on their other sides."""
        mirrored = {"height_mm": 0.0 - self.height_mm, "point_deg": 0.0 - self.point_deg}
        return super().backwards(plan).replace(**mirrored)

    def layout(self, plan: Plan, sign: float) -> Layout:
        """Joints at input 0, two points of the slider's line, and lengths of the links."""
        foot = 1j * self.height_mm
        line = {"foot": foot, "ahead": self.rod_mm + foot}
        return self.linked(plan, **{f"slider's line, {end}": at for end, at in line.items()})

    def holder(self, end: Any) -> PlaneLink:
        """The slider's fixed guide: its line as far as the slider can reach."""
        foot = 1j * self.height_mm
        ahead = self.crank_mm + self.rod_mm + foot
        return "guide", (foot, ahead, end), (Joint.NONE, Joint.NONE, Joint.SLIDE), 3
