"""Spherical wheels: shafts that meet at an angle, slots on meridians of a sphere."""

from __future__ import annotations

from typing import Annotated, ClassVar, NamedTuple

from geneva_cli.errors import refuse_text
from geneva_cli.motion.engagement import Slot
from geneva_cli.motion.path_and_slot import AnchoredPath, StraightSlotMotion
from geneva_cli.motion.pivots import Dimension, Pivot
from geneva_cli.motion.wheels.classic import HalfStep, PinPose
from geneva_cli.motion.wheels.gearing import Gearing, RollerPlace
from geneva_cli.numerics.angles import radians, sin_cos_deg
from geneva_cli.numerics.arrays import choose, library
from geneva_cli.numerics.jet import Displacement, Jet, Number, Vector, atan2, sin, sin_cos, sqrt
from geneva_cli.spec.rules import Range


class Spherical(Gearing):
    """Wheel and crank on shafts that meet; at 90 degrees motion and dwell are equal.

    ``z`` is the number of slots, 3 or more; ``axes_deg`` is the angle between the two shafts.

    >>> Design(Spherical(6)).timing.k
    1.0
    >>> round(Design(Spherical(6, axes_deg=60)).timing.motion_deg, 6)
    147.795772
    """

    NAME: ClassVar[str] = "spherical"
    FLAT: ClassVar[bool] = False
    DISTANCE: ClassVar[str] = "sphere's radius"
    axes_deg: Annotated[float, Range(0.0, 180.0, "()"), "angle between the two shafts"] = 90.0

    def __post_init__(self) -> None:
        super().__post_init__()
        angle, least = self.axes_deg, 1e-6  # degrees
        text = "axes_deg = {angle:g}: the shafts are practically parallel: it must be at least "
        text += '{least:g} away from 0 and 180, or choose gearing "external" or "internal"'
        parallel = (angle < least) | (angle > 180.0 - least)
        refuse_text(parallel, ("wheel", "axes_deg"), text, angle=angle, least=least)
        shafts = Dimension("angle of the shafts", angle, "deg")
        vars(self).update(layout=(shafts,), own_sizes={"axes_deg": angle})

    def axes(self, L: float) -> tuple[Pivot, ...]:
        return ()

    def half_motion_deg(self, step: HalfStep) -> float:
        return sphere(step, self.axes_deg).half_motion_deg

    def place(self, step: HalfStep, center_distance_mm: float) -> RollerPlace:
        ball = sphere(step, self.axes_deg)
        top = ball.cos_S * ball.cos_th + ball.sin_S * ball.sin_th  # cos(S - th)
        height = top, ball.sin_S * ball.sin_th
        # the arm's plane is perpendicular to the crank's axis, cos th from the sphere's centre
        hub, cone, half = ball.sin_S * ball.cos_th, ball.cos_th, ball.half_motion_deg
        three = poses(step, ball)
        return RollerPlace(step, half, three, ball.sin_th, height=height, cone=cone, hub=hub)

    def follow(
        self, path: AnchoredPath, place: RollerPlace, turn: Displacement
    ) -> tuple[Slot, StraightSlotMotion]:
        assert place.height is not None  # it is a place on a sphere
        slot = MeridianSlot(path, Height(*place.height, turn))
        return slot, StraightSlotMotion(path, place.step.b)


class Height(NamedTuple):
    """A pin's position along a spherical wheel's axis: top - fall (1 - cos a)."""

    top: float
    fall: float
    turn: Displacement  # of the crank

    def __call__(self, tau: Number, order: int) -> Jet:
        """Position ``tau`` input radians after mid-motion."""
        out: Jet = self.top - self.turn(tau, order)[1] * self.fall
        return out

    @property
    def hub(self) -> float:
        """Position of the centre of the pin's circle."""
        return self.top - self.fall


class MeridianSlot(Slot):
    """A spherical wheel's slot, a meridian: straight in the development."""

    def __init__(self, path: AnchoredPath, height: Height) -> None:
        self.path, self.height = path, height

    def place(self, input_deg: Number, order: int) -> Jet:
        """Polar angle of the pin."""
        x, y = self.path(input_deg, order)
        return atan2(sqrt(x * x + y * y), self.height(radians(input_deg), order))

    def axis(self, input_deg: Number, order: int = 0) -> Vector:
        polar = self.place(input_deg, order)
        return sin(polar), polar

    def upright(self, input_deg: Number, order: int = 0) -> Jet:
        return sin_cos(self.place(input_deg, order))[1]


class Sphere(NamedTuple):
    """A spherical wheel: shafts at the angle S, the pin on a cone of half angle th.

    sin th = sin S sin b, so that the pin enters its meridian slot along it. Projected along the
    wheel's axis, the pin's path is an ellipse: cos th (sin S - tan th cos S cos a, tan th sin a).
    """

    sin_S: float
    cos_S: float
    sin_th: float
    cos_th: float
    cos_a: float  # cosine of the half motion angle: tan th / tan S
    sin_a: float

    @property
    def half_motion_deg(self) -> float:
        """Crank angle in degrees from entry to mid-motion."""
        m = library(self.sin_a)
        half: float = m.degrees(m.atan2(self.sin_a, self.cos_a))
        return half


def sphere(step: HalfStep, axes_deg: float) -> Sphere:
    """Proportions of a spherical wheel with shafts at ``axes_deg``."""
    sin_b, cos_b = step.sin_cos
    sin_S, cos_S = sin_cos_deg(axes_deg)
    sin_th = sin_S * sin_b
    # cos² th = cos² S + sin² S cos² b: a sum of positive terms
    cos_th = library(sin_th).hypot(cos_S, sin_S * cos_b)
    return Sphere(sin_S, cos_S, sin_th, cos_th, sin_b * cos_S / cos_th, cos_b / cos_th)


def poses(step: HalfStep, ball: Sphere) -> tuple[PinPose, PinPose, PinPose]:
    """Entry, middle and exit of a spherical wheel's pin, projected along the wheel's axis."""
    sin_b, cos_b = step.sin_cos
    half = ball.half_motion_deg
    # derivatives of the pin's position by the crank angle a
    across, along = ball.sin_th * ball.cos_S, ball.sin_th
    mouth = library(along).hypot(ball.sin_S * ball.cos_th - across * ball.cos_a, along * ball.sin_a)
    slope = across * ball.sin_a * cos_b + along * ball.cos_a * sin_b
    inward = across * ball.cos_a * cos_b - along * ball.sin_a * sin_b
    sideways = across * ball.cos_a * sin_b + along * ball.sin_a * cos_b
    # sin(S - th); if both terms are positive, as sin² S cos² b / sin(S + th)
    far = ball.sin_S * ball.cos_th
    positive = (ball.sin_S * cos_b) ** 2 / (far + abs(across))
    middle_ = choose(across > 0.0, positive, far - across)
    return (
        PinPose(-half, -step.b, mouth, (-slope, 0.0), (inward, sideways)),
        PinPose(0.0, 0.0, middle_, (0.0, along), (across, 0.0)),
        PinPose(half, step.b, mouth, (slope, 0.0), (inward, -sideways)),
    )
