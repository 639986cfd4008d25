"""What the loads depend on besides the motion: the load case of a machine, from its spec."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Generic, NamedTuple

import numpy as np

from geneva_cli.loads.carried import carried_kg, inertia_kgm2, resisting_torque_Nm
from geneva_cli.loads.strength.pin import pin_diameter_mm
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.records import thing
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import Array, Mask, N, Whole, all_true, choose, library
from geneva_cli.numerics.jet import Jet, Number, V
from geneva_cli.spec.materials import roller_material, wheel_material
from geneva_cli.spec.workshops import Stock

NEGLIGIBLE = 1e-12  # fraction of a torque, of a motion, or of a lever over L that is rounding


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
    guide: Any = None  # in which the output slides: a rack's, with its friction and drag
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
    """Hertz stress on a line, from E*, the force per length and the effective radius."""
    modulus = modulus_GPa * 1e3
    out: N = library(line_N_mm, radius_mm).sqrt(line_N_mm * modulus / (math.pi * radius_mm))
    return out


class QuantityValue(NamedTuple, Generic[V]):
    """A quantity, the margin that bounds it where above 0, and the sign of its infinity."""

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


def load_case(mechanism: Mechanism) -> LoadCase:
    """The load case of a machine's spec."""
    spec = mechanism.spec
    load, size = spec.load, spec.size
    w = omega(spec.drive.n_rpm)
    hertz = None
    if size.face_width_mm is not None:
        # p0² = N E* / (pi b R_e)
        modulus = contact_modulus_GPa(wheel_material(spec), roller_material(spec)) * 1e3
        hertz = modulus / (math.pi * size.face_width_mm * mechanism.roller_radius_mm)
    case = LoadCase(
        w,
        inertia_kgm2(spec) * w * w,
        resisting_torque_Nm(spec),
        mechanism.center_distance_mm / 1000.0,
        mechanism.roller_radius_mm / mechanism.center_distance_mm,
        rubbing(mechanism),
        load.efficiency,
        hertz,
        mechanism.frame,
        design=mechanism.design,
    )
    complete: Callable[[Mechanism, LoadCase], LoadCase] | None
    complete = thing(spec.wheel.NAME, "load_case")
    return complete(mechanism, case) if complete else case


def rubbing(mechanism: Mechanism) -> float:
    """Ratio of the force along the wall to the force on it, for a roller that moves along it.

    A roller fixed to its pin rubs in the slot, with the coefficient itself. One that turns on its
    pin rolls, held back by the pin: the load passes a circle with the pin's radius times sin rho,
    tan rho being the coefficient. So its angle to the wall's normal has the sine: sin rho times pin
    over roller. In either case the friction work is N times the speed along the wall times this
    ratio.
    """
    load = mechanism.spec.load
    if all_true(load.friction == 0.0) or load.rubs_in_slot:
        return load.friction
    thickness = 0.5 * pin_diameter_mm(mechanism) / mechanism.roller_radius_mm
    m = library(thickness, load.friction)
    sine = thickness * load.friction / m.hypot(1.0, load.friction)
    turning = sine / m.sqrt((1.0 - sine) * (1.0 + sine))
    coefficient: float = choose(thickness == 1.0, load.friction, turning)
    return coefficient


def centrifugal_N(mechanism: Mechanism) -> Array:
    """The centrifugal force of all bodies on a wheel on a carrier, N, (m, 1)."""
    spec, L = mechanism.spec, mechanism.center_distance_mm / 1000.0
    return np.atleast_2d(carried_kg(spec) * omega(spec.drive.n_rpm) ** 2 * L)
