"""The engagement of a wheel that a linkage's path can drive, for one design or a batch."""

from __future__ import annotations

from decimal import localcontext
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, cast

import numpy as np

from geneva_cli.drives.path_wheels.wheel_for_path import ExactPoint, Fit, angle, length, unit
from geneva_cli.drives.path_wheels.wheels_for_paths import (
    LONG_PI,
    Fits,
    long_place,
    long_point,
    polished,
    some_fits,
)
from geneva_cli.drives.roller_path import (
    LinkRate,
    LinkReactions,
    PointDisplacement,
    RollerPath,
    exactly,
    rounded,
)
from geneva_cli.motion.engagement import Anchor, Engagement, RoughMotion
from geneva_cli.motion.path_and_slot import AnchoredPath, RadialSlot, StraightSlotMotion
from geneva_cli.motion.wheels.poses import HalfStep
from geneva_cli.numerics import digits
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import Array, Long, library, parameter
from geneva_cli.numerics.jet import Jet, Number, sine_versine, turning

if TYPE_CHECKING:
    from geneva_cli.drives.path_wheels.wheels_for_paths import LongComplex

Vectors: TypeAlias = "list[tuple[float, float]]"


class LinkageMotion(StraightSlotMotion):
    """Motion of a wheel on a linkage."""

    def __init__(
        self, path: AnchoredPath, half_step: float, about_centre: RoughLinkageMotion
    ) -> None:
        super().__init__(path, half_step, mirrored=False)
        self.about_centre = about_centre

    @property
    def rough(self) -> RoughMotion:
        """The motion without anchors."""
        return self.about_centre


class RoughLinkageMotion(NamedTuple):
    """Motion of a wheel whose centre is at (x, y) in the path's frame."""

    body: LinkRate
    x: float
    y: float

    def rough_rates(self, input_deg: Number, order: int = 2) -> tuple[Array, ...]:
        """Speed and its derivatives at arrays of angles, computed from the path without anchors."""
        x, y = self.body.path.at(radians(input_deg) + self.body.middle, order + 1)
        return (turning(x - self.x, y - self.y) * self.body.sense).arrays()


class PlacedWheel(NamedTuple):
    """The numbers of a wheel on a path, rounded once; lengths are in mm, angles in radians."""

    sense: float
    middle: float  # the crank's angle at mid-motion
    half_deg: float  # half of the motion
    turn: float  # the wheel's angle when the crank is at mid-motion
    ahead: float  # angle from the line of centres to the pin at mid-motion
    x: float  # the wheel's centre on the path's axes
    y: float
    L: float

    def engagement(
        self, path: RollerPath, b: float, cranks: Vectors, rays: Vectors
    ) -> tuple[Engagement, float]:
        """Engagement, and the centre distance; ``rays`` lead from the centre to the pin."""
        anchors = tuple(
            Anchor(
                end * self.half_deg,
                wheel,
                library(x).hypot(x, y) / self.L,
                along_ray(path.about(*crank), (x, y), self.sense, self.L, end),
            )
            for end, wheel, crank, (x, y) in zip(
                (-1.0, 0.0, 1.0), (-b, self.turn, b), cranks, rays, strict=True
            )
        )
        anchored = AnchoredPath(anchors, self.ahead)
        body = LinkRate(path, self.middle, self.sense)
        motion = LinkageMotion(anchored, b, RoughLinkageMotion(body, self.x, self.y))
        reactions = LinkReactions(*body, self.L, -self.x / self.L, -self.y / self.L)
        slot, sense = RadialSlot(anchored), -self.sense
        return Engagement(0.0, anchored, slot, motion, body, reactions, sense), self.L


def engagement_of(path: RollerPath, fit: Fit, step: HalfStep) -> tuple[Engagement, float]:
    """Engagement of a wheel for a path, and the centre distance in mm.

    The computation uses 50 digits and rounds once.
    """
    with localcontext(digits.FIFTY):
        ox, oy = fit.centre
        middle, half = (fit.entry + fit.exit) / 2, (fit.exit - fit.entry) / 2
        places = [ExactPoint.of(path, phi) for phi in (fit.entry, middle, fit.exit)]
        rays = [(p.p[0] - ox, p.p[1] - oy) for p in places]
        first, last = unit(rays[0]), unit(rays[2])
        turn = fit.sense * angle((first[0] + last[0], first[1] + last[1]), rays[1])
        ahead = fit.sense * angle((-ox, -oy), rays[1])
        L = float(length(fit.centre))
        motion = float(middle), digits.to_degrees(half), turn, ahead
        cranks = [(exactly(p.sine), exactly(p.cosine)) for p in places]
        wheel = PlacedWheel(fit.sense, *motion, float(ox), float(oy), L)
        return wheel.engagement(path, step.b, cranks, [(float(x), float(y)) for x, y in rays])


def engagement_of_batch(path: RollerPath, fits: Fits, step: HalfStep) -> tuple[Engagement, float]:
    """Engagements of wheels for the paths of n designs, and their centre distances (n, 1).

    The computation uses long doubles, if the computer has them, and rounds once.
    """
    path, fits, step = _alike(path, fits, step)
    sense = parameter(fits.sense)
    with np.errstate(all="ignore"):
        entry, exit_ = polished(path, fits, step)
    middle, half = (entry + exit_) / 2, (exit_ - entry) / 2
    cranks = _cranks(middle, half)
    (p, t), (q, u) = (long_point(path, *cranks[i]) for i in (0, 2))
    rho = np.abs(q - p) / np.abs(t + u)
    centre = ((p + rho * t) + (q - rho * u)) / 2
    rays = [place - centre for place in (p, long_place(path, *cranks[1]), q)]
    half_way = rays[0] / np.abs(rays[0]) + rays[2] / np.abs(rays[2])
    # arc tangents of long doubles take ten times as long
    turn, ahead = (
        sense * parameter(np.angle((rays[1] * line.conj()).astype(complex)))
        for line in (half_way, -centre)
    )
    numbers = middle, half * (180 / LONG_PI), centre.real, centre.imag, np.abs(centre)
    mid, half_deg, x, y, L = (rounded(number) for number in numbers)
    wheel = PlacedWheel(sense, mid, half_deg, turn, ahead, x, y, L)
    exact = [(exactly(sine), exactly(cosine)) for sine, cosine in cranks]
    return wheel.engagement(
        path, step.b, exact, [(rounded(ray.real), rounded(ray.imag)) for ray in rays]
    )


def _alike(path: RollerPath, fits: Fits, step: HalfStep) -> tuple[RollerPath, Fits, HalfStep]:
    """Designs of a batch, with the first that has a wheel in place of those that have none.

    Designs without a wheel are refused already, and NaN in long doubles takes a hundred times as
    long.
    """
    has_wheel = fits.entry[:, 0] == fits.entry[:, 0]
    if has_wheel.all() or not has_wheel.any():
        return path, fits, step
    which = np.where(has_wheel, np.arange(len(has_wheel)), has_wheel.argmax())
    return some_fits(path, fits, step, which)


def _cranks(middle: Array | Long, half: Array | Long) -> list[tuple[Long, Long]]:
    """Sines and cosines of the crank's angles at entry, mid-motion and exit.

    Long doubles lose no digit of a double in products, which take a tenth of a sine's time.
    """
    at, turn = (np.cos(x) + 1j * np.sin(x) for x in (middle, half))
    cranks = cast("list[LongComplex]", [at * turn.conj(), at, at * turn])
    return [(crank.imag, crank.real) for crank in cranks]


class AlongRay(NamedTuple):
    """The pin's displacement along a ray (x, y) and across it, positive with the wheel."""

    displacement: PointDisplacement
    x: float
    y: float
    scale: float
    sense: float
    cuts: tuple[float, ...] = ()

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """Displacement after ``tau`` radians of crank rotation."""
        x, y = self.displacement(*sine_versine(Jet.variable(tau, order)))
        along = (x * self.x + y * self.y) * self.scale
        across = (y * self.x - x * self.y) * (self.sense * self.scale)
        return along, across


def along_ray(
    displacement: PointDisplacement, ray: tuple[float, float], sense: float, L: float, end: float
) -> AlongRay:
    """Displacement along and across a ray; at an end (-1, 1) the ray is the pin's own direction.

    There the ray is the velocity of ``displacement`` itself, so that the velocity across it is
    exactly 0.
    """
    ux, uy = ray
    if end:
        x, y = displacement(*sine_versine(Jet.variable(0.0, 1)))
        ux, uy = end * parameter(x.c[1]), end * parameter(y.c[1])
    return AlongRay(displacement, ux, uy, 1.0 / (library(ux).hypot(ux, uy) * L), sense)
