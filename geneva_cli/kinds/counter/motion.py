"""The counter drive: two teeth of a driver turn a pinion whose teeth are wide and narrow by turns.

The driver is a gear of N teeth of which two are left. The pinion has 2 z teeth, and every second
one is narrow: the driver's locking rim lies beside the narrow ones, and two wide ones slide on it.
While the two teeth pass, the gears roll on their pitch circles. So the pinion turns at the constant
ratio u = N/(2 z), by two of its teeth, while the driver turns by two of its own, 720°/N. Before
and after it is at rest, so that its speed jumps by u of the driver's.

A number wheel of N teeth on the driver's axis meshes with the pinion and turns at the driver's
speed. It drives the next pinion by two teeth of its own, and so on. All two teeth pass their
pinions at the digit 0, so that the k-th number wheel moves by one digit in (N/2)^(k-2) turns.

The point of the driver's pitch circle between the two teeth stands for the roller. It is on the
line of centres at mid-motion, l = N/(N + 2 z) from the driver's axis.
"""

import math
from typing import Annotated, ClassVar

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.motion.engagement import Displacement, Peak, Slot, SlotAxis, WheelMotion, in_wheel
from geneva_cli.motion.path_and_slot import AnchoredPath
from geneva_cli.motion.wheels.gearing import Gearing, Output, RollerPlace
from geneva_cli.motion.wheels.poses import HalfStep, PinPose, middle
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import library
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.spec.rules import Z_MAX, Range
from geneva_cli.spec.schema import Example


class Counter(Gearing):
    """A pinion of 2 z teeth, wide and narrow by turns, that two teeth of a driver turn.

    ``driver_teeth`` counts the teeth that the whole driver would have. A number wheel with as many
    teeth, on the driver's axis, makes driver_teeth/2 steps in a turn.

    >>> Design(Counter(4, driver_teeth=20)).timing.motion_deg
    36.0
    """

    NAME: ClassVar[str] = "counter"
    EXAMPLE: ClassVar[Example] = Example(
        "a counter's carry: two teeth turn a pinion, and a rim locks it",
        {"wheel": {"z": 4, "driver_teeth": 20}},
    )
    USUAL_LOAD: ClassVar[dict[str, float]] = {"inertia_kgm2": 1e-6}
    USUAL_LIMITS: ClassVar[dict[str, float]] = {}  # none of what has no bound
    FLAT: ClassVar[bool] = False
    PARTS: ClassVar[str] = "counter"
    LOCK: ClassVar[str] = "locking rim"
    JUMPS: ClassVar[bool] = True
    # ISO 6336-1 and DIN 3990-1, method C: a pair of steel teeth has c' = 14 N/(mm µm), a mesh 20.
    # Method B gives 10.4 to 15.7 for counters: a force is at most 6 % too low, or 17 % too high.
    TOOTH_N_mm2: ClassVar[float] = 14e3
    DRIVES: ClassVar[tuple[str, ...]] = ("crank",)
    driver_teeth: Annotated[int, Range(6, 2 * Z_MAX), "counter: teeth of the whole driver, N"] = 20
    number_wheels: Annotated[
        int, Range(2, 24), "counter: number wheels in a row, the driver's among them"
    ] = 2

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse(
            (self.number_wheels > 2) & (self.driver_teeth % 2 > 0),
            lambda: GenevaError(
                f"driver_teeth = {self.driver_teeth}: a number wheel makes driver_teeth/2 steps in "
                "a turn, and with more than 2 number wheels that must be whole: use "
                f"{self.driver_teeth + 1}",
                ("wheel", "driver_teeth"),
            ),
        )

    @property
    def pinions(self) -> int:
        """Number of pinions, one behind each number wheel but the last."""
        return self.number_wheels - 1

    @property
    def ratio(self) -> float:
        """The pinion's speed over the driver's while they mesh, u = N/(2 z)."""
        return self.driver_teeth / (2 * self.z)

    def output(self, center_distance_mm: float) -> Output:
        """The pinion's angle; no keys give it loads with a bound."""
        keys = "a gearing whose speed does not jump; here it does, and forces have no bound"
        lacks = "alpha_rad_s2", "sliding_m_s"
        angle = super().output(center_distance_mm)
        return angle._replace(noun="pinion", load_keys=keys, lacks=lacks)

    @property
    def title(self) -> str:
        """The title of a design without one of its own."""
        return f"Counter with a pinion of {2 * self.z} teeth"

    def words(self, slots: str) -> str:
        """The pinion in words."""
        return f"counter pinion of {self.z} wide and {self.z} narrow teeth"

    def driven_by(self, drive: str, behind: str, rollers: str) -> str:
        """The two teeth of its driver in words."""
        return f"a driver{behind} with two of its {self.driver_teeth} teeth"

    def half_motion_deg(self, step: HalfStep) -> float:
        """Crank angle of one of the driver's teeth, 360°/N."""
        return 360.0 / self.driver_teeth

    def place(self, step: HalfStep, center_distance_mm: float) -> RollerPlace:
        """Place of the point of the driver's pitch circle between its two teeth."""
        l = self.driver_teeth / (self.driver_teeth + 2 * self.z)
        half = self.half_motion_deg(step)
        poses = _pose(-half, l), middle(self.SIGN, l, 1.0 - l), _pose(half, l)
        return RollerPlace(step, half, poses, l)

    def follow(
        self, path: AnchoredPath, place: RollerPlace, turn: Displacement
    ) -> tuple[Slot, WheelMotion]:
        """Rolling pitch circles, and the motion at a constant ratio."""
        motion = RollingMotion(place.half_motion_deg, place.step.b, self.ratio)
        return PitchCircle(path, motion), motion


def _pose(crank_deg: float, l: float) -> PinPose:
    """Pose of a point at a radius l on the driver, at a crank angle from the line of centres."""
    a = radians(crank_deg)
    m = library(a, l)
    s, c = m.sin(a), m.cos(a)
    x, y = 1.0 - l * c, l * s
    r = m.hypot(x, y)
    p, q = x / r, y / r
    slope, bend = (l * s, l * c), (l * c, -l * s)
    turned = [(p * u + q * v, p * v - q * u) for u, v in (slope, bend)]
    return PinPose(crank_deg, m.atan2(y, x), r, *turned)


class RollingMotion(WheelMotion):
    """Motion at a constant ratio: its velocity jumps at entry and exit."""

    def __init__(self, half_deg: float, half_step: float, ratio: float) -> None:
        super().__init__(-half_deg, half_deg, half_step)
        self.ratio = ratio

    @property
    def jump(self) -> float:
        """Jump of the wheel's velocity at entry, over the input's: the ratio."""
        return self.ratio

    def closed_peak(self, quantity: str) -> Peak[float]:
        """Peak of a quantity: the ratio, or infinite at entry for the rates that follow a jump."""
        return Peak(self.ratio if quantity == "velocity" else math.inf, self.entry_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        """Wheel angle in proportion to the input's."""
        still = input_deg * 0.0
        rates = (still + self.ratio, *[still] * order)[:order]
        return Jet((radians(input_deg) * self.ratio, *rates))


class PitchCircle(Slot):
    """The curve that a point of the driver's pitch circle describes on the pinion."""

    relieved = True

    def __init__(self, path: AnchoredPath, motion: RollingMotion) -> None:
        self.path, self.motion = path, motion

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """The point (x, y) in the pinion, on an epicycloid."""
        return in_wheel(self.path(input_deg, order), self.motion(input_deg, order))

    def axis(self, input_deg: Number, order: int = 0) -> SlotAxis:
        """Lever, the pinion's pitch radius, and no sliding."""
        still = Jet((input_deg * 0.0, *[0.0] * order))
        return SlotAxis(still + 1.0 / (1.0 + self.motion.ratio), still)

    def touches(self, input_deg: Number) -> Number:
        """0: teeth drive the pinion, not a roller."""
        return input_deg * 0.0
