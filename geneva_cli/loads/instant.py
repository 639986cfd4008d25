"""Motion and loads at an input angle while the wheel moves, with signs and in units.

They follow from the forces of ``forces``, and are the columns of the cycle's table and summary.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Generic

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.forces import (
    Contact,
    LoadCase,
    QuantityValue,
    contact_values,
    feeding,
    frame_torque,
    sliding,
    stress_margin,
    value,
    wheel_grip,
    wheel_torque,
    without,
)
from geneva_cli.numerics.arrays import all_true
from geneva_cli.numerics.jet import Array, Jet, Number, V, sqrt

# Names of an instant's quantities.
INSTANT_QUANTITIES = (
    *("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "pin_force_N", "stress_squared"),
    *("sliding_m_s", "input_torque_Nm", "power_W", "friction_W", "wheel_bearing_N"),
    *("crank_bearing_squared", "guide_squared", "drives", "slides", "feeds"),
    *("grip", "friction_margin", "edge"),
)


class Instant(Generic[V]):
    """Motion and loads for known signs of wheel torque, sliding and input torque.

    Each quantity is a jet by the input angle in radians, or the jets' values (numbers or arrays).
    It is computed at first use.

    The wheel turns in the positive direction while it indexes, and a torque that drives it is
    positive. A pin force is positive on the wall that drives the wheel, and negative on the wall
    that holds it back. A sliding speed is positive away from the wheel's axis. The input's torque
    and power are positive where the input drives the wheel, and negative where the wheel drives it.

    Forces are unbounded where ``grip`` <= 0: there friction alone holds the wheel. Stresses are
    also unbounded where ``edge`` <= 0: there the wall is more sharply curved than the roller.
    """

    at: Contact[V]

    def __init__(
        self,
        case: LoadCase,
        at: Contact[V],
        drives: Number = 1.0,
        slides: Number = 1.0,
        feeds: Number = 1.0,
    ) -> None:
        self.case, self.at = case, at
        self.drives = drives  # sign of the wheel's torque
        self.slides = slides  # sign of the sliding
        self.feeds = feeds  # sign of the input's torque

    @classmethod
    def known(cls, quantities: Mapping[str, object]) -> Instant[Array]:
        """An instant whose quantities ``INSTANT_QUANTITIES`` are known already."""
        known: Instant[Array] = cls.__new__(Instant)
        vars(known).update(quantities)
        return known

    def quantities(self) -> dict[str, Number | V | None]:
        """Each of ``INSTANT_QUANTITIES``; None for a quantity that the machine lacks."""
        return {name: getattr(self, name) for name in INSTANT_QUANTITIES}

    @cached_property
    def omega_rad_s(self) -> V:
        """The wheel's speed, rad/s."""
        return self.at.velocity * self.case.speed_rad_s

    @cached_property
    def alpha_rad_s2(self) -> V:
        """The wheel's acceleration, rad/s²."""
        w = self.case.speed_rad_s
        return self.at.acceleration * (w * w)

    @cached_property
    def wheel_torque_Nm(self) -> V:
        """Torque at the wheel, N m: I alpha plus resistance."""
        return wheel_torque(self.case, self.at)

    @cached_property
    def slip(self) -> V:
        """Speed at which the roller rubs along the wall, over L, per input radian."""
        return sliding(self.at, self.drives, self.case.radius)

    @cached_property
    def grip(self) -> V:
        """Torque on the wheel over L times the pin force, the margin of all forces."""
        return wheel_grip(self.case, self.at, self.drives, self.slides)

    @cached_property
    def force_N(self) -> V:
        """The force on the pin, along the wall's normal, N."""
        return self.wheel_torque_Nm * self.drives / (self.grip * self.case.L)

    @cached_property
    def pin_force_N(self) -> V:
        """Pin force on the wall that bears, N, with its sign."""
        return self.force_N * self.drives

    @property
    def leaning(self) -> V | None:
        """A value at whose changes of sign the friction in a guide has a corner."""
        guide = self.case.guide
        return guide and guide.leaning(self.case, self.at, self.drives, self.slides)

    @cached_property
    def edge(self) -> V | None:
        """1 - curvature of the bearing wall's pitch curve times the roller's radius.

        A wall at the roller's radius r from its pitch curve, of curvature k towards the wall, has
        1/R_e = 1/r + k/(1 - k r) = 1/(r (1 - k r)).
        """
        if self.case.hertz is None:
            return None
        return 1.0 - self.at.curvature * (self.drives * self.case.radius)

    @cached_property
    def stress_squared(self) -> V | None:
        """The square of the contact stress, MPa²; None without a face width."""
        if self.case.hertz is None or self.edge is None:
            return None
        return self.force_N * self.at.touches * self.case.hertz / self.edge

    @cached_property
    def sliding_m_s(self) -> V:
        """Sliding speed along the wall of a roller that is fixed to its pin, m/s."""
        return self.slip * (self.case.L * self.case.speed_rad_s) * self.at.touches

    @cached_property
    def rubbed_Nm(self) -> V:
        """The part of the input's torque that friction takes, in the slot and in a guide, N m."""
        rub = self.at.touches * (self.case.friction * self.slides)
        torque = self.force_N * rub * self.slip * self.case.L
        if self.case.guide and self.case.guided:
            drag = self.case.guide.drag(self.case, self.at, self.drives, self.slides)
            torque = torque + self.force_N * drag * self.at.velocity * self.case.L
        # designs of the batch without friction, whose force may be infinite
        free = self.case.all_friction == 0.0
        return without(free, torque) if np.any(free) else torque

    @cached_property
    def slot_torque_Nm(self) -> V:
        """The part of the input's torque that goes through the slot, before the efficiency, N m."""
        slot = self.wheel_torque_Nm * self.at.velocity
        return slot + self.rubbed_Nm if self.case.rubs or self.case.guided else slot

    @cached_property
    def lossless_torque_Nm(self) -> V:
        """Torque of the input shaft before the efficiency, N m.

        A carrier also takes the torque that speeds up the wheel against the ground.
        """
        if all_true(self.case.frame == 0.0):
            return self.slot_torque_Nm
        return self.slot_torque_Nm + frame_torque(self.case, self.at)

    @cached_property
    def input_torque_Nm(self) -> V:
        """Torque of the input shaft, N m, losses included."""
        return self.lossless_torque_Nm * self._losses

    @property
    def crank_torque_Nm(self) -> V:
        """Torque of the shaft that carries the crank, N m, losses included.

        It has the power that goes through the slot, at its own rate. On a carousel that is the
        standing shaft of the finger, which does not speed the wheels up against the ground.
        """
        return self.slot_torque_Nm * self._losses / self.at.crank

    @cached_property
    def power_W(self) -> V:
        """Power of the input, W: its torque times its speed."""
        return self.input_torque_Nm * self.case.speed_rad_s

    @cached_property
    def friction_W(self) -> V:
        """Power that friction turns to heat, in the slot and in a rack's guide, W."""
        return self.rubbed_Nm * self.case.speed_rad_s

    @cached_property
    def wheel_bearing_N(self) -> V:
        """Size of the force on the wheel, and so of its shaft's reaction, N."""
        return self.force_N * (1.0 + self._rub * self._rub) ** 0.5

    @cached_property
    def crank_bearing_squared(self) -> V:
        """The square of the reaction on the shaft whose crank carries the roller or link, N²."""
        if (
            self.at.reactions is None
        ):  # the crank is the roller's body, and its drive gives it a couple
            return self.wheel_bearing_N * self.wheel_bearing_N
        return self._reaction(0)

    @cached_property
    def guide_squared(self) -> V | None:
        """The square of the guide's reaction (rocker, slider, groove, fixed gear), N²; or None."""
        return None if self.at.reactions is None else self._reaction(1)

    @cached_property
    def friction_margin(self) -> V | None:
        """Margin of quantities that only friction makes unbounded; None without friction."""
        if not (self.case.rubs or self.case.guided):
            return None
        free = self.case.all_friction == 0.0  # designs of the batch, whose margin is infinite
        return self.grip + np.where(free, np.inf, 0.0) if np.any(free) else self.grip

    @property
    def crank_bearing_N(self) -> V:
        """Size of the force on the crank's shaft, and so of its bearings' reaction, N."""
        return _root(self.crank_bearing_squared)

    @property
    def guide_force_N(self) -> V | None:
        """Size of the guide's force, N; None without a guide."""
        return None if self.guide_squared is None else _root(self.guide_squared)

    @property
    def stress(self) -> QuantityValue[V]:
        """The square of the contact stress, MPa², and its margin."""
        assert self.stress_squared is not None  # there is a face width
        return QuantityValue(self.stress_squared, stress_margin(self.friction_margin, self.edge))

    @property
    def pressure_speed(self) -> QuantityValue[V]:
        """The square of p v, greatest Hertz pressure times sliding, W²/m⁴, and its margin."""
        pv = self.stress.value * (self.sliding_m_s * self.sliding_m_s * 1e12)
        return QuantityValue(pv, stress_margin(self.friction_margin, self.edge))

    @property
    def guide(self) -> QuantityValue[V]:
        """The square of the guide's force, N², and its margin."""
        assert self.guide_squared is not None  # there is a guide
        return QuantityValue(self.guide_squared, self.grip)

    @property
    def _losses(self) -> Number:
        """Ratio of the input's torque to that without losses."""
        # The efficiency counts where the input drives. Where the wheel drives, the losses are not
        # known to exist and reduce nothing: a brake must hold all of the torque.
        return 0.5 * (1.0 + self.feeds) / self.case.efficiency + 0.5 * (1.0 - self.feeds)

    @property
    def _rub(self) -> Number:
        """Ratio of the force along the wall to the force on it."""
        return self.case.friction * value(self.at.touches)

    def _reaction(self, joint: int) -> V:
        """The square of the reaction of a joint that holds the roller's body.

        The pin pushes the wall along d i t + f s t; about the pin's centre that force also has a
        couple.
        """
        assert self.at.reactions is not None
        normal, tangent, couple = self.at.reactions
        rub = self._rub * self.slides
        turn = rub * self.drives * self.case.radius
        x, y = (
            normal[joint][i] * self.drives + tangent[joint][i] * rub - couple[joint][i] * turn
            for i in (0, 1)
        )
        return self.force_N * self.force_N * (x * x + y * y)


def _root(square: V) -> V:
    return sqrt(square) if isinstance(square, Jet) else np.sqrt(square)


def signs(
    case: LoadCase, at: Contact[V], drives: Array | None = None
) -> tuple[Array, Array, Array]:
    """Signs of the wheel's torque, unless known, of the sliding and of the input's torque."""
    if drives is None:
        drives = np.copysign(1.0, value(wheel_torque(case, at)))
    slides = np.copysign(1.0, value(sliding(at, drives, case.radius)))
    return drives, slides, np.copysign(1.0, value(feeding(case, at, drives, slides)))


def bounded_loads(
    case: LoadCase, at: Contact[Array], drives: Array | None = None
) -> Instant[Array]:
    """The values at a contact with the signs that they have there, as ``bounded`` has them.

    ``drives`` is the sign of the wheel's torque, if known.
    """
    with np.errstate(all="ignore"):
        return bounded(Instant(case, at, *signs(case, at, drives)))


def values(instant: Instant[Jet]) -> Instant[Array]:
    """The instant with values in place of jets."""
    return Instant(
        instant.case, contact_values(instant.at), instant.drives, instant.slides, instant.feeds
    )


def bounded(here: Instant[Array]) -> Instant[Array]:
    """Values with infinity where a force is unbounded, and 0 where no force is needed there."""
    is_held = here.grip > 0.0
    bound = np.where(here.wheel_torque_Nm == 0.0, 0.0, np.inf)
    endless = ["wheel_bearing_N", "crank_bearing_squared"]
    endless += [] if here.guide_squared is None else ["guide_squared"]
    endless += [] if here.friction_margin is None else ["input_torque_Nm", "power_W", "friction_W"]
    out = here.quantities()
    out |= {name: np.where(is_held, getattr(here, name), bound) for name in endless}
    out["pin_force_N"] = np.where(is_held, here.pin_force_N, bound * here.drives)
    if here.edge is not None and here.stress_squared is not None:
        out["stress_squared"] = np.where(is_held & (here.edge > 0.0), here.stress_squared, bound)
    return Instant.known(out)
