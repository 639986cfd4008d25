"""What happens at an input angle while the wheel moves, with signs and in units.

From the forces of ``forces``: everything that a table of the cycle shows and its summary sums up.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Generic

import numpy as np

from geneva_cli.analysis.loads.contact import Contact, valued
from geneva_cli.analysis.loads.forces import Forces, Row, Setting, Worked, pressed, value
from geneva_cli.numerics.jet import Jet, Number, V, sqrt

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

# What is known of an instant.
NAMES = (
    *("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "pin_force_N", "stress_squared"),
    *("sliding_m_s", "input_torque_Nm", "power_W", "friction_W", "wheel_bearing_N"),
    *("crank_bearing_squared", "guide_squared", "drives", "slides", "feeds"),
    *("grip", "held", "edge"),
)


class Instant(Generic[V]):
    """What happens where wheel torque, sliding and input torque have known signs.

    Each quantity is a jet by the input angle in radians, or the jets' values: numbers or arrays. It
    is worked out when it is first asked for.

    The wheel turns in the positive direction while it indexes, and a torque on it is positive
    where it drives the wheel on. A pin force is positive on the wall that drives the wheel, and
    negative on the one that holds it back. A speed of sliding is positive outwards, from the
    wheel's axis. The input's torque and power are positive where the input drives, and negative
    where the wheel drives it.
    """

    at: Contact[V]
    forces: Forces[V]

    def __init__(
        self,
        given: Setting,
        at: Contact[V],
        drives: Number,
        slides: Number,
        feeds: Number,
        *,
        worked: Worked[V] | None = None,
    ) -> None:
        self.given, self.at = given, at
        self.drives = drives  # sign of the wheel's torque
        self.slides = slides  # sign of the sliding
        self.feeds = feeds  # sign of the input's torque
        self.forces = Forces(given, at, drives, slides, worked)

    @classmethod
    def known(cls, quantities: Mapping[str, object]) -> Instant[Array]:
        """An instant of which each of ``NAMES`` is known already."""
        found: Instant[Array] = cls.__new__(Instant)
        vars(found).update(quantities)
        return found

    def quantities(self) -> dict[str, Number | V | None]:
        """Each of ``NAMES``; None for what this machine has not."""
        return {name: getattr(self, name) for name in NAMES}

    @cached_property
    def omega_rad_s(self) -> V:
        """The wheel's speed."""
        return self.at.velocity * self.given.speed_rad_s

    @cached_property
    def alpha_rad_s2(self) -> V:
        """The wheel's acceleration."""
        w = self.given.speed_rad_s
        return self.at.acceleration * (w * w)

    @cached_property
    def wheel_torque_Nm(self) -> V:
        """I alpha + what resists."""
        return self.forces.torque

    @cached_property
    def pin_force_N(self) -> V:
        """On the wall that bears."""
        return self.forces.force * self.drives

    @cached_property
    def stress_squared(self) -> V | None:
        """Of the contact, MPa²; None without a face width."""
        return self.forces.square

    @cached_property
    def sliding_m_s(self) -> V:
        """Of the roller, fixed to its pin, along the wall."""
        return self._rubs * self.at.touches

    @cached_property
    def input_torque_Nm(self) -> V:
        """Of the input shaft, its losses included."""
        # The efficiency counts where the input drives; what the wheel gives back is not lessened
        # by losses that are not known to be there: a brake must hold all of it.
        share = 0.5 * (1.0 + self.feeds) / self.given.efficiency + 0.5 * (1.0 - self.feeds)
        return self.forces.shaft * share

    @cached_property
    def power_W(self) -> V:
        """Input torque times input speed."""
        return self.input_torque_Nm * self.given.speed_rad_s

    @cached_property
    def friction_W(self) -> V:
        """What the contact turns to heat."""
        return self.forces.force * self._rubs * (self._rub * self.slides)

    @cached_property
    def wheel_bearing_N(self) -> V:
        """Size of the force on the wheel, and so of its shaft's reaction."""
        return self.forces.force * (1.0 + self._rub * self._rub) ** 0.5

    @cached_property
    def crank_bearing_squared(self) -> V:
        """Of the reaction on the shaft whose crank carries the roller or link, N²."""
        if self.at.held is None:  # the crank is the roller's body; what turns it gives it a couple
            return self.wheel_bearing_N * self.wheel_bearing_N
        return self._reaction(0)

    @cached_property
    def guide_squared(self) -> V | None:
        """Of the reaction of rocker, slider, groove or fixed gear; None without."""
        return None if self.at.held is None else self._reaction(1)

    @cached_property
    def grip(self) -> V:
        """Where it is not above 0, friction alone holds the wheel: forces are endless."""
        return self.forces.grip

    @cached_property
    def held(self) -> V | None:
        """The same for what friction alone makes endless; None without."""
        return self.grip if self.given.rubs else None

    @cached_property
    def edge(self) -> V | None:
        """The same for the stress alone: the wall is sharper than the roller."""
        return self.forces.edge

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
        return Row(self.stress_squared, pressed(self.held, self.edge))

    @property
    def pressure_speed(self) -> Row[V]:
        """The square of p v, the greatest Hertz pressure times the sliding, likewise; W²/m⁴."""
        pv = self.stress.value * (self.sliding_m_s * self.sliding_m_s * 1e12)
        return Row(pv, pressed(self.held, self.edge))

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

    @cached_property
    def _rubs(self) -> V:
        """Speed at which the roller rubs along the wall, m/s."""
        return self.forces.sliding * (self.given.L * self.given.speed_rad_s)

    @property
    def _rub(self) -> Number:
        """The force along the wall over the one on it."""
        return self.given.friction * value(self.at.touches)

    def _reaction(self, joint: int) -> V:
        """The square of the reaction of a joint that holds the roller's body.

        The pin pushes the wall along d i t + f s t; about its centre that force has a couple too.
        """
        assert self.at.held is not None
        normal, tangent, couple = self.at.held
        rub = self._rub * self.slides
        turn = rub * self.drives * self.given.radius
        x, y = (
            normal[joint][i] * self.drives + tangent[joint][i] * rub - couple[joint][i] * turn
            for i in (0, 1)
        )
        force = self.forces.force
        return force * force * (x * x + y * y)


def _root(square: V) -> V:
    return sqrt(square) if isinstance(square, Jet) else np.sqrt(square)


def values(found: Instant[Jet]) -> Instant[Array]:
    """The same of the values of an instant's jets."""
    return Instant(found.given, valued(found.at), found.drives, found.slides, found.feeds)


def bounded(here: Instant[Array]) -> Instant[Array]:
    """Values with infinity where nothing bounds a force, and 0 where none is needed there."""
    held = here.grip > 0.0
    bound = np.where(here.wheel_torque_Nm == 0.0, 0.0, np.inf)
    endless = ["wheel_bearing_N", "crank_bearing_squared"]
    endless += [] if here.guide_squared is None else ["guide_squared"]
    endless += [] if here.held is None else ["input_torque_Nm", "power_W", "friction_W"]
    out = here.quantities()
    out |= {name: np.where(held, getattr(here, name), bound) for name in endless}
    out["pin_force_N"] = np.where(held, here.pin_force_N, bound * here.drives)
    if here.edge is not None and here.stress_squared is not None:
        out["stress_squared"] = np.where(held & (here.edge > 0.0), here.stress_squared, bound)
    return Instant.known(out)
