"""Noncircular gears in front of the crank: equal ellipses, or the ratio of a side-crank.

Elliptical gears each turn about a focus. With the driver at phi the driven gear is at f:
tan(f/2) = (1-e)/(1+e) tan(phi/2), as Kepler's true anomaly; the directions of the half angles are
(cos phi/2, sin phi/2) and ((1+e) cos .., (1-e) sin ..).
"""

from __future__ import annotations

from typing import Annotated, ClassVar, NamedTuple

from geneva_cli.drives.pushed import Mesh
from geneva_cli.drives.transmission import LocalTransmission, Transmission
from geneva_cli.drives.whitworth import Whitworth, refuse_near_one
from geneva_cli.motion.drive import Gears, Plan
from geneva_cli.motion.pivots import Dimension, Layout, Pivot, ShaftPlace
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.angles import sin_cos_deg
from geneva_cli.numerics.arrays import enclosed, library
from geneva_cli.numerics.jet import Displacement, Jet, Number, cosines_after, sine_versine_of
from geneva_cli.spec.rules import POSITIVE, OneOf, Range


class GearPair(Transmission, kw_only=True):
    """Two gears with pitch curves that are no circles about their axes."""

    gear_distance_mm: Annotated[float, POSITIVE, "distance between the two gears' axes, C"] = 100.0

    @property
    def gears(self) -> Gears:
        return Gears(self.gear_distance_mm, self.about(0.0)[1])

    def input_shaft(self, plan: Plan, sign: float, sense: float) -> ShaftPlace:
        return ShaftPlace(plan.center_distance_mm + self.gear_distance_mm, -sense)

    def layout(self, plan: Plan, sign: float) -> Layout:
        return (
            Pivot("driver gear axis", plan.center_distance_mm + self.gear_distance_mm, 0.0),
            Dimension("gears' axes", self.gear_distance_mm, "mm"),
        )

    def reactions(self, wheel: Gearing, advance: Displacement, mid_deg: float, L: float) -> Mesh:
        return Mesh(advance, self.gear_distance_mm / L, -wheel.SIGN)


class EllipticalGears(GearPair, kw_only=True):
    """Two equal elliptical gears, with the index in their slow phase or in their quick one.

    ``eccentricity`` is that of the pitch ellipses, 0 or more and below 1; they turn about a focus.

    >>> round(Design(External(6), EllipticalGears(eccentricity=0.3)).timing.motion_deg, 6)
    187.984352
    """

    NAME: ClassVar[str] = "elliptical-gears"
    WORDS: ClassVar[str] = "a crank behind elliptical gears"
    IN_FRONT: ClassVar[str] = "elliptical gears"
    eccentricity: Annotated[float, Range(0.0, 1.0, "[)"), "of the gears' pitch ellipses"]
    phase: Annotated[str, OneOf(("slow", "quick")), "phase of the gears at mid-motion"] = "slow"

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_near_one("eccentricity", self.eccentricity)

    def layout(self, plan: Plan, sign: float) -> Layout:
        a = 0.5 * self.gear_distance_mm
        return (
            *super().layout(plan, sign),
            Dimension("gears' semi-major axis", a, "mm"),
            Dimension("gears' focus from centre", a * self.eccentricity, "mm"),
            Dimension("index in the gears' phase", self.phase),
        )

    def about(self, crank_deg: float) -> LocalTransmission:
        e = self.eccentricity if self.phase == "slow" else -self.eccentricity
        sin_h, cos_h = sin_cos_deg(0.5 * crank_deg)
        a, b = (1.0 + e) * sin_h, (1.0 - e) * cos_h
        m = library(e, crank_deg)
        size, phi = m.hypot(a, b), 2.0 * m.degrees(m.atan2(a, b))
        turns = (crank_deg - phi) / 720.0  # half angles repeat after two turns
        phi = phi + 720.0 * (round(turns) if isinstance(turns, float) else m.rint(turns))
        return phi, Focal(e, sin_h, cos_h, a / size, b / size, size)


class Focal(NamedTuple):
    """The gears about one angle f of the driven one.

    It holds half angles: the direction of the driven gear, then that of the driver. ``size``² is W
    = 1 + e² + 2 e cos phi there, a sum of positive terms.
    """

    e: float
    sin_h: float
    cos_h: float
    sin_p: float
    cos_p: float
    size: float

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """sin d and 1 - cos d of the driven gear's rotation d, ``tau`` input radians later."""
        e, sin_h, cos_h, sin_p, cos_p, size = enclosed(tau, self)
        m = library(tau, e, size)
        least = (1.0 - e) * (1.0 + e)
        s, c = m.sin(0.5 * tau), m.cos(0.5 * tau)
        # Half angles: the driver's direction, and the driven gear's from its own at f.
        sine, cosine = sin_p * c + cos_p * s, cos_p * c - sin_p * s
        across = size * size * s
        along = least * c - 4.0 * e * sin_h * cos_h * s
        x, y = along * along - across * across, 2.0 * along * across
        W = ((1.0 + e) * cosine) ** 2 + ((1.0 - e) * sine) ** 2
        sin_phi, cos_phi = 2.0 * sine * cosine, (cosine - sine) * (cosine + sine)
        cosines = cosines_after(sin_phi, cos_phi, max(order, 1) - 1)
        rate = least / Jet((W, *[2.0 * e * t for t in cosines[1:]]))
        return sine_versine_of(rate, y, x, order)


class NoncircularGears(GearPair, Whitworth, kw_only=True):
    """Gears with the ratio of a side-crank, whose ``A`` they have.

    >>> round(Design(External(6), NoncircularGears(A=0.6)).peaks.velocity.max, 12)
    0.625
    """

    NAME: ClassVar[str] = "noncircular-gears"
    WORDS: ClassVar[str] = "a crank behind noncircular gears"
    IN_FRONT: ClassVar[str] = "noncircular gears"
    A: Annotated[float, Range(-1.0, 1.0, "()"), "ratio of a side-crank with this A"]

    def layout(self, plan: Plan, sign: float) -> Layout:
        ratio = Dimension("gears' ratio as of side-crank A", self.A)
        return (*super().layout(plan, sign), ratio)
