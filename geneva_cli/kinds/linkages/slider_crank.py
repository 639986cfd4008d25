"""A slider-crank in front of the wheel: the roller is a point of its connecting rod.

Crank a leads from the input's axis to the pin A, and rod b from A to the slider B. The slider's
line passes the crank's axis at the height h. The roller C is at the distance k from A, at an angle
from the line AB. The wheel's centre is solved for.
"""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, NamedTuple, Self, cast

from geneva_cli.errors import refuse_text
from geneva_cli.kinds.linkages.link_path import Displacement, LinkPath
from geneva_cli.kinds.linkages.linkage import Linkage, Moving
from geneva_cli.motion.drive import Plan
from geneva_cli.motion.pivots import Joint, Layout, Link
from geneva_cli.numerics.arrays import Array, Complex, enclosed, library
from geneva_cli.numerics.jet import Jet, sqrt
from geneva_cli.spec.rules import LENGTH, POSITIVE, Range


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
        line = {"foot": (0.0, self.height_mm), "ahead": (self.rod_mm, self.height_mm)}
        return self.linked(plan, **{f"slider's line, {end}": at for end, at in line.items()})

    def holder(self, end: Moving) -> Link:
        """The slider's fixed guide: its line as far as the slider can reach."""
        still = 0.0 * end[0]
        foot, ahead = still, still + (self.crank_mm + self.rod_mm)
        line = still + self.height_mm
        joints = ((foot, line), (ahead, line), end)
        return Link("guide", joints, (Joint.NONE, Joint.NONE, Joint.SLIDE), 3)

    @property
    def roller_path(self) -> "SlidingRod":
        """Path of the rod's point that carries the roller."""
        lengths = (self.crank_mm, self.rod_mm, self.height_mm)
        return SlidingRod(*lengths, reach_mm=self.point_mm, angle_deg=self.point_deg)


class SlidingRod(LinkPath):
    """The path of a point of the connecting rod.

    Its numbers are crank, rod, height, and the point's coordinates on the rod: a, b, h, p, q.
    """

    def link(self, sine: Jet, cosine: Jet) -> tuple[Jet, Jet]:
        """Unit vector along the rod, from A towards B."""
        a, b, h, _, _ = self.numbers
        ey = (h - sine * a) / b
        return sqrt((1.0 - ey) * (ey + 1.0)), ey

    def turned(self, sine: Array, cosine: Array, order: int) -> tuple[Any, ...]:
        """The rod's unit vector, its rate of rotation, and that rate's slope."""
        a, b, h, _, _ = self.numbers
        y = (h - a * sine) / b
        x = library(y).sqrt((1.0 - y) * (1.0 + y))
        rate = -a * cosine / (b * x)
        return x + 1j * y, rate, (a * sine / b + rate * rate * y) / x

    def hold(self, sine: Jet, cosine: Jet) -> tuple[float, tuple[Jet, Jet]]:
        """Rod length from A to B, and the direction of the guide's push, across its line."""
        _, b, *_ = self.numbers
        return b, (sine * 0.0, cosine * 0.0 + 1.0)

    def about(self, crank: Any, velocity: Any = None) -> Displacement:
        """Displacement since a direction of the crank."""
        a, b, h, p, q = self.numbers
        s, t, arm = a * crank.imag, a * crank.real, p + 1j * q
        level, less, more = (h - s) / b, (b - h + s) / b, (b + h - s) / b
        ex = library(level).sqrt(less * more)
        slope = level / ex
        if velocity is None:
            velocity = 1j * (t + 1j * s) + (slope - 1j) * (t / b) * arm
        change = (1j - slope) * (s / b) * arm - (t + 1j * s)
        out = velocity.real, velocity.imag, change.real, change.imag
        return RodDisplacement(s / b, t / b, level, ex, less, more, slope, p, q, *out)


class RodDisplacement(NamedTuple):
    """Displacement of the rod's point, from the numbers of one crank angle.

    It is the velocity there times sin d, and terms of second order: so it has all its digits where
    the point is much slower than its links.
    """

    s: float  # a sin phi / b
    t: float  # a cos phi / b
    ey: float  # unit vector along the rod
    ex: float
    less: float  # 1 - ey
    more: float
    slope: float  # of ex by -ey
    P: float  # the point's coordinates on the rod
    Q: float
    vx: float  # velocity of the point
    vy: float
    wx: float  # factor of 1 - cos d
    wy: float

    @property
    def velocity(self) -> Complex:
        """Complex velocity at that angle."""
        return cast("Complex", self.vx + 1j * self.vy)

    def __call__(self, sine: Jet, versine: Jet) -> tuple[Jet, Jet]:
        """Displacement from sin d and 1 - cos d of the crank's rotation d since then."""
        s, t, ey, ex, less, more, slope, P, Q, vx, vy, wx, wy = enclosed(sine.c[0], self)
        dy = versine * s - sine * t
        share = 1.0 / (sqrt((less - dy) * (dy + more)) + ex)
        # what ex changes by beyond its linear part
        dx = dy * dy * ((dy + 2.0 * ey) * share * slope + 1.0) * share * -1.0
        return sine * vx + versine * wx + dx * P, sine * vy + versine * wy + dx * Q
