"""What the loads depend on: the contact of roller and slot, the load case, Hertz's pressure."""

from __future__ import annotations

import math
from typing import Generic, NamedTuple, Protocol

import numpy as np

from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Mask, N, Whole, all_true, choose, library
from geneva_cli.numerics.jet import Array, Jet, Number, V
from geneva_cli.spec.workshops import Stock

NEGLIGIBLE = 1e-12  # fraction of a torque, of a motion, or of a lever over L that is rounding


class Contact(NamedTuple, Generic[V]):
    """The state of roller and slot that the loads depend on: jets of one order, or values."""

    velocity: V
    acceleration: V
    lever: V  # M . t: of the walls' normal about the wheel's axis
    offset: V  # M x t: of the slot's tangent from the wheel's axis
    along: V  # the roller centre's speed along t
    curvature: V  # of the pitch curve, positive to the left of t: 0 in a straight slot
    spin: V  # rate of the roller's body relative to the wheel
    arm: V  # of friction at the wall about the wheel's axis, beyond M's: over the radius
    touches: V  # 0 while gears drive and no roller does, else 1
    crank: V  # rate of the shaft that carries the crank
    # Reactions of the joints of the roller's body (the crank's shaft, a guide) to a force of 1
    # along the normal i t, to one along t, and to a couple of 1; None where there is only a shaft.
    reactions: tuple[tuple[tuple[V, V], tuple[V, V]], ...] | None = None


def contact_values(at: Contact[Jet]) -> Contact[Array]:
    """The values of a contact's jets."""
    *jets, joints = at
    reactions = joints and [[(x.c[0], y.c[0]) for x, y in pair] for pair in joints]
    return Contact._make([*[jet.c[0] for jet in jets], reactions])


class Guide(Protocol):
    """A guide in which the output slides."""

    @property
    def friction(self) -> float:
        """Friction in it, (m, 1) for m designs."""

    def drag(self, case: LoadCase, at: Contact[V], drives: Number, slides: Number) -> V:
        """Friction in it over the pin's force."""

    def leaning(self, case: LoadCase, at: Contact[V], drives: Number, slides: Number) -> V:
        """A smooth value, at whose changes of sign the drag has a corner."""


class LoadCase(NamedTuple):
    """The data that the loads depend on besides the motion; floats, or (m, 1) for m designs."""

    speed_rad_s: float  # of the input
    inertia_Nm: float  # inertia times the square of the input speed
    resists_Nm: float  # torque at the wheel that resists its motion
    L: float  # metres
    radius: float  # of the roller, over L
    friction: float  # ratio of the force along the wall to the force on it
    efficiency: float
    # square of the stress on a flat wall, MPa² per newton; None without a face width
    hertz: float | None
    # turns of the wheel's frame in one turn of the input, positive as the wheel turns in it
    frame: float = 0.0
    guide: Guide | None = None  # in which the output slides
    design: int | Whole = 0  # the design's number in its batch: (m, 1) in a batch

    @property
    def designs(self) -> int:
        """The number of designs in the load case."""
        return 1 if isinstance(self.design, int) else len(self.design)

    def at_speed(self, ratio: float) -> LoadCase:
        """The case at another speed, over its own: inertia grows with the square."""
        return self._replace(inertia_Nm=self.inertia_Nm * (ratio * ratio))

    @property
    def rubs(self) -> bool:
        """True if there is friction along the wall in any of the designs."""
        return not all_true(self.friction == 0.0)

    def is_loaded(self, engagement: Engagement, torque: Number) -> Mask:
        """True where a torque at the wheel is more than rounding."""
        usual = self.inertia_Nm * engagement.usual_acceleration + self.resists_Nm
        loaded: Mask = np.abs(torque) > NEGLIGIBLE * usual
        return loaded

    @property
    def frictionless(self) -> LoadCase:
        """The case without friction."""
        return self._replace(friction=0.0, guide=None)

    @property
    def guided(self) -> bool:
        """True if there is friction in the output's guide in any of the designs."""
        return self.guide is not None and not all_true(self.guide.friction == 0.0)

    @property
    def all_friction(self) -> float:
        """A number that is above 0 for a design with any friction, which may hold the wheel."""
        return self.friction + self.guide.friction if self.guide else self.friction


def contact_modulus_GPa(one: Stock, other: Stock) -> float:
    """E* of two materials in contact, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2."""
    each = ((1.0 - m.poisson_ratio**2) / m.youngs_modulus_GPa for m in (one, other))
    return 1.0 / sum(each)


def hertz_MPa(modulus_GPa: float, line_N_mm: N, radius_mm: float) -> N:
    """Hertz stress on a line, from E*, the force per length and the effective radius.

    p0² = F E* / (pi b R)
    """
    modulus = modulus_GPa * 1e3
    out: N = library(line_N_mm, radius_mm).sqrt(line_N_mm * modulus / (math.pi * radius_mm))
    return out


class QuantityValue(NamedTuple, Generic[V]):
    """A quantity, and the margin that must be above 0 for the quantity to be bounded.

    Without a margin the quantity is always bounded. ``sign`` is that of the infinity that replaces
    an unbounded value.
    """

    value: V
    margin: V | None = None
    sign: Number = 1.0


def value(quantity: V) -> Number:
    """The value of a jet; a value unchanged."""
    return quantity.c[0] if isinstance(quantity, Jet) else quantity


def lesser(a: V, b: V) -> V:
    """The lesser of two jets, or of their values, element by element."""
    first = value(a) < value(b)
    if not isinstance(a, Jet) or not isinstance(b, Jet):
        out: V = choose(first, a, b)
        return out
    return type(a)([choose(first, c, d) for c, d in zip(a.c, b.c, strict=True)])
