"""What happens at an input angle while the wheel moves, with signs and in units.

From the forces of ``forces``: everything that a table of the cycle shows and its summary sums up.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.contact import Contact
from geneva_cli.analysis.loads.forces import Row, Setting, forces, sliding, value
from geneva_cli.numerics.arrays import choose
from geneva_cli.numerics.jet import Jet, Number, V, sqrt

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class Instant(NamedTuple, Generic[V]):
    """Each a jet by the input angle in radians, or the jets' values: numbers or arrays.

    The wheel turns in the positive direction while it indexes, and a torque on it is positive
    where it drives the wheel on. A pin force is positive on the wall that drives the wheel, and
    negative on the one that holds it back. A speed of sliding is positive outwards, from the
    wheel's axis. The input's torque and power are positive where the input drives, and negative
    where the wheel drives it.
    """

    omega_rad_s: V
    alpha_rad_s2: V
    wheel_torque_Nm: V  # I alpha + what resists
    pin_force_N: V
    stress_squared: V | None  # of the contact, MPa²; None without a face width
    sliding_m_s: V  # of the roller, fixed to its pin, along the wall
    input_torque_Nm: V
    power_W: V  # input torque times input speed
    friction_W: V  # that the contact turns to heat
    wheel_bearing_N: V  # size of the force on the wheel, and so of its shaft's reaction
    crank_bearing_squared: V  # of the shaft whose crank carries the roller or link, N²
    guide_squared: V | None  # of rocker, slider, groove or fixed gear; None without
    drives: Number  # sign of the wheel's torque
    slides: Number  # sign of the sliding
    feeds: Number  # sign of the input's torque
    grip: V  # where it is not above 0, friction alone holds the wheel: forces are endless
    held: V | None  # the same for what friction alone makes endless; None without
    edge: V | None  # the same for the stress alone: the wall is sharper than the roller

    @property
    def crank_bearing_N(self) -> V:
        """Size of the force on the crank's shaft, and so of its bearings' reaction."""
        return _root(self.crank_bearing_squared)

    @property
    def guide_force_N(self) -> V | None:
        """Size of the guide's force; None without one."""
        return None if self.guide_squared is None else _root(self.guide_squared)

    @property
    def stress(self) -> Row[V]:
        """The square of the contact stress, likewise."""
        assert self.stress_squared is not None  # there is a face width
        return Row(self.stress_squared, self._pressed)

    @property
    def pressure_speed(self) -> Row[V]:
        """The square of p v, the greatest Hertz pressure times the sliding, likewise; W²/m⁴."""
        pv = self.stress.value * (self.sliding_m_s * self.sliding_m_s * 1e12)
        return Row(pv, self._pressed)

    @property
    def _pressed(self) -> V | None:
        """What the contact stress needs to have a bound: the lesser of ``grip`` and ``edge``."""
        if self.held is None or self.edge is None:
            return self.edge
        return lesser(self.grip, self.edge)

    @property
    def guide(self) -> Row[V]:
        """The square of the guide's force, likewise."""
        assert self.guide_squared is not None  # there is a guide
        return Row(self.guide_squared, self.grip)

    @property
    def pin_force(self) -> Row[V]:
        """The pin force as a quantity that may have no bound, for ``Cycle.extremes``."""
        return Row(self.pin_force_N, self.grip, self.drives)

    @property
    def shaft(self) -> Row[V]:
        """The input's torque, which friction may leave without a bound."""
        return Row(self.input_torque_Nm, self.held)


def lesser(a: V, b: V) -> V:
    """The lesser of two jets, or of their values, element by element."""
    first = value(a) < value(b)
    if not isinstance(a, Jet) or not isinstance(b, Jet):
        out: V = choose(first, a, b)
        return out
    return type(a)([choose(first, c, d) for c, d in zip(a.c, b.c, strict=True)])


def instant(
    given: Setting, at: Contact[V], drives: Number, slides: Number, feeds: Number
) -> Instant[V]:
    """What happens where wheel torque, sliding and input torque have these signs."""
    found = forces(given, at, drives, slides)
    w = given.speed_rad_s
    rubs = sliding(at, drives, given.radius) * (given.L * w)
    # The efficiency counts where the input drives; what the wheel gives back is not lessened by
    # losses that are not known to be there: a brake must hold all of it.
    shaft = found.shaft * (0.5 * (1.0 + feeds) / given.efficiency + 0.5 * (1.0 - feeds))
    rub = given.friction * value(at.touches)
    on_wheel = found.force * (1.0 + rub * rub) ** 0.5
    return Instant(
        at.velocity * w,
        at.acceleration * (w * w),
        found.torque,
        found.force * drives,
        found.square,
        rubs * at.touches,
        shaft,
        shaft * w,
        found.force * rubs * (rub * slides),
        on_wheel,
        *_joints(given, at, found.force, drives, rub * slides, on_wheel),
        drives,
        slides,
        feeds,
        found.grip,
        found.grip if given.rubs else None,
        found.edge,
    )


def _joints(
    given: Setting,
    at: Contact[V],
    force: V,
    drives: Number,
    rub: Number,
    on_wheel: V,
) -> tuple[V, V | None]:
    """Squares of the reactions on the crank's shaft, and of what guides the roller's body besides.

    The pin pushes the wall along d i t + f s t; about its centre that force has a couple too.
    """
    if at.held is None:  # the crank is the roller's body, and what turns it gives it a couple
        return on_wheel * on_wheel, None
    normal, tangent, couple = at.held
    turn = rub * drives * given.radius

    def square(joint: int) -> V:
        x, y = (
            normal[joint][i] * drives + tangent[joint][i] * rub - couple[joint][i] * turn
            for i in (0, 1)
        )
        return force * force * (x * x + y * y)

    return square(0), square(1)


def _root(square: V) -> V:
    return sqrt(square) if isinstance(square, Jet) else np.sqrt(square)


def values(found: Instant[Jet]) -> Instant[Array]:
    """The values of an instant's jets."""
    return Instant._make(x.c[0] if isinstance(x, Jet) else x for x in found)


def bounded(here: Instant[Array]) -> Instant[Array]:
    """Values with infinity where nothing bounds a force, and 0 where none is needed there."""
    held = here.grip > 0.0
    bound = np.where(here.wheel_torque_Nm == 0.0, 0.0, np.inf)
    out = here._asdict()
    out["pin_force_N"] = np.where(held, here.pin_force_N, bound * here.drives)
    for name in ("wheel_bearing_N", "crank_bearing_squared"):
        out[name] = np.where(held, out[name], bound)
    if here.guide_squared is not None:
        out["guide_squared"] = np.where(held, here.guide_squared, bound)
    if here.held is not None:
        for name in ("input_torque_Nm", "power_W", "friction_W"):
            out[name] = np.where(held, out[name], bound)
    if here.edge is not None and here.stress_squared is not None:
        out["stress_squared"] = np.where(held & (here.edge > 0.0), here.stress_squared, bound)
    return Instant(**out)
