"""The forces between roller and slot, as formulas for jets of one angle or of many.

With the unit tangent t of the slot (away from the wheel's axis) and the normal n = d i t towards
the wall that bears, d = 1 where the torque T drives the wheel and -1 where it holds it back, the
contact point is C = M + r n and the wheel's balance about its axis

    |T| = N |C x n + f s C x t| = N [M . t + f s (d (M x t) - r)]

(M x t = 0 in a radial slot). s is the sign of the speed at which the roller, fixed to the body
that carries it, rubs along the wall: v = M' . t - d r (rate of that body - rate of the wheel).
"""

from __future__ import annotations

import math
from functools import cached_property
from typing import Generic, NamedTuple

from geneva_cli.analysis.loads.carried import inertia_kgm2, resisting_torque_Nm
from geneva_cli.analysis.loads.contact import Contact
from geneva_cli.analysis.strength.pin import pin_diameter_mm
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import all_true, choose, designs_of, library
from geneva_cli.numerics.jet import Jet, Number, V

ZERO = 1e-12  # share of a torque, a motion, or a lever over L that is rounding


class Setting(NamedTuple):
    """The data on which the loads depend besides the motion."""

    speed_rad_s: float  # of the input
    inertia_Nm: float  # inertia times the square of the input speed
    resists_Nm: float  # torque at the wheel that resists its motion
    L: float  # metres
    radius: float  # of the roller, over L
    friction: float  # along the wall, over the force on it
    efficiency: float
    hertz: float | None  # square of the stress on a flat wall, MPa² per newton; None: no width
    design: int = 0  # the design's number in its batch: (m, 1) of a batch

    @property
    def designs(self) -> int:
        """How many designs it is the setting of."""
        return designs_of(self.design)

    @property
    def rubs(self) -> bool:
        """Whether there is friction along the wall, in any of the designs."""
        return not all_true(self.friction == 0.0)


def setting(mechanism: Mechanism) -> Setting:
    """The setting of a machine's spec."""
    spec = mechanism.spec
    load, size = spec.load, spec.size
    w = omega(spec.drive.n_rpm)
    hertz = None
    if size.face_width_mm is not None:
        # p0² = N E* / (pi b R_e)
        modulus = contact_modulus_GPa(spec) * 1e3
        hertz = modulus / (math.pi * size.face_width_mm * mechanism.roller_radius_mm)
    return Setting(
        w,
        inertia_kgm2(spec) * w * w,
        resisting_torque_Nm(spec),
        mechanism.center_distance_mm / 1000.0,
        mechanism.roller_radius_mm / mechanism.center_distance_mm,
        rubbing(mechanism),
        load.efficiency,
        hertz,
        mechanism.design,
    )


def rubbing(mechanism: Mechanism) -> float:
    """The force along the wall over the force on it, where the roller moves along it.

    A roller that is fast on its pin rubs in the slot, at the coefficient itself. One that turns on
    its pin rolls, held back by its pin: what it bears passes a circle of the pin's radius times
    sin rho, tan rho being the coefficient (the friction circle of a journal), and so leaves the
    wall at an angle whose sine is that of rho times pin over roller. It rubs on its pin as many
    times more slowly as the pin is smaller, so the work is N times the speed along the wall times
    what is returned here in either case.

    >>> from geneva_cli import External, Load
    >>> from geneva_cli.machine.mechanism import build
    >>> from geneva_cli.machine.spec import Spec
    >>> turning = Load(torque_Nm=1.0, friction=0.1, friction_at="pin")  # on a pin half as thick
    >>> round(rubbing(build(Spec(External(6), load=turning))), 6)
    0.049814
    """
    load = mechanism.spec.load
    if all_true(load.friction == 0.0) or load.rubs_in_slot:
        return load.friction
    share = 0.5 * pin_diameter_mm(mechanism) / mechanism.roller_radius_mm
    m = library(share, load.friction)
    sine = share * load.friction / m.hypot(1.0, load.friction)
    turning = sine / m.sqrt((1.0 - sine) * (1.0 + sine))
    coefficient: float = choose(share == 1.0, load.friction, turning)
    return coefficient


def contact_modulus_GPa(spec: Spec) -> float:
    """E* of roller on wheel, 1/E* = (1 - nu1²)/E1 + (1 - nu2²)/E2."""
    both = (spec.material_wheel, spec.material_roller)
    return 1.0 / sum((1.0 - m.poisson_ratio**2) / m.youngs_modulus_GPa for m in both)


class Greatest(NamedTuple):
    """A greatest load, infinite where nothing bounds it, and its input angle in degrees."""

    max: float
    at_deg: float


class Row(NamedTuple, Generic[V]):
    """A quantity, and ``room``, which must be positive for it to have a bound.

    ``way`` is the sign of the infinity to which it goes where ``room`` is not positive.
    """

    value: V
    room: V | None = None
    way: Number = 1.0


def value(quantity: V) -> Number:
    """A jet's value; a value as it is."""
    return quantity.c[0] if isinstance(quantity, Jet) else quantity


def sliding(at: Contact[V], drives: Number, radius: float) -> V:
    """Speed at which the roller rubs along the wall, over L, per input radian."""
    return at.along - at.spin * (drives * radius)


def wheel_torque(given: Setting, at: Contact[V]) -> V:
    """The torque that the wheel needs, N m: inertia and resistance; positive drives it on."""
    return at.acceleration * given.inertia_Nm + given.resists_Nm


def gain(given: Setting, at: Contact[V], drives: Number, slides: Number) -> V:
    """The torque on the input shaft over the wheel's, times ``grip``, which is always finite."""
    lost = sliding(at, drives, given.radius) * at.touches * (given.friction * slides * drives)
    return at.velocity * _grip(given, at, drives, slides) + lost


def _grip(given: Setting, at: Contact[V], drives: Number, slides: Number) -> V:
    if not given.rubs:
        return at.lever
    rub = at.touches * (given.friction * slides)
    return at.lever + rub * (at.aside * drives - at.arm * given.radius)


class Worked(NamedTuple, Generic[V]):
    """What was worked out already, to tell the signs."""

    torque: V | None = None
    sliding: V | None = None


class Forces(Generic[V]):
    """What acts for a torque of the sign ``drives`` and a sliding of the sign ``slides``.

    Jets, or their values; each is worked out when it is first asked for. Forces have no bound where
    ``grip`` <= 0, stresses where ``edge`` is: there friction alone holds the wheel, or the wall is
    more sharply curved than the roller.
    """

    at: Contact[V]

    def __init__(
        self,
        given: Setting,
        at: Contact[V],
        drives: Number,
        slides: Number,
        worked: Worked[V] | None = None,
    ) -> None:
        self.given, self.at, self.drives, self.slides = given, at, drives, slides
        self.worked: Worked[V] = worked or Worked()

    @cached_property
    def torque(self) -> V:
        """That the wheel needs."""
        torque = self.worked.torque
        return wheel_torque(self.given, self.at) if torque is None else torque

    @cached_property
    def sliding(self) -> V:
        """Speed at which the roller rubs along the wall, over L, per input radian."""
        speed = self.worked.sliding
        return sliding(self.at, self.drives, self.given.radius) if speed is None else speed

    @cached_property
    def grip(self) -> V:
        """Torque on the wheel over L times the pin force."""
        return _grip(self.given, self.at, self.drives, self.slides)

    @cached_property
    def force(self) -> V:
        """On the pin, along the wall's normal."""
        return self.torque * self.drives / (self.grip * self.given.L)

    @cached_property
    def shaft(self) -> V:
        """Torque on the input shaft, before the efficiency."""
        shaft = self.torque * self.at.velocity
        if not self.given.rubs:
            return shaft
        rub = self.at.touches * (self.given.friction * self.slides)
        return shaft + self.force * rub * self.sliding * self.given.L

    @cached_property
    def edge(self) -> V | None:
        """1 - curvature of the bearing wall's pitch curve times the roller's radius."""
        # R_e of a wall at the roller's radius from its pitch curve, of curvature k towards the
        # wall, is r (1 - k r): 1/r + k/(1 - k r) = 1/(r (1 - k r)).
        if self.given.hertz is None:
            return None
        return 1.0 - self.at.curvature * (self.drives * self.given.radius)

    @cached_property
    def square(self) -> V | None:
        """Of the contact stress; None without a face width."""
        if self.given.hertz is None or self.edge is None:
            return None
        return self.force * self.at.touches * self.given.hertz / self.edge


def pressed(held: V | None, edge: V | None) -> V | None:
    """What the contact stress needs to have a bound: the lesser of the two that are known."""
    return edge if held is None or edge is None else lesser(held, edge)


def lesser(a: V, b: V) -> V:
    """The lesser of two jets, or of their values, element by element."""
    first = value(a) < value(b)
    if not isinstance(a, Jet) or not isinstance(b, Jet):
        out: V = choose(first, a, b)
        return out
    return type(a)([choose(first, c, d) for c, d in zip(a.c, b.c, strict=True)])
