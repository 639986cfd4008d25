"""Motion and loads at an input angle while the wheel moves, with signs and in units.

t is the unit tangent of the slot, away from the wheel's axis. The normal n = d i t points towards
the wall that bears: d is the sign of the torque T. The wheel's balance about its axis is

    |T| = N |C x n + f s C x t| = N [M . t + f s (d (M x t) - r)],    C = M + r n

s is the sign of v = M' . t - d r (rate of the roller's body - rate of the wheel), at which the
roller, fixed to its body, rubs along the wall.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Generic, Protocol, Self

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.contact import Contact, LoadCase, QuantityValue, contact_values, value
from geneva_cli.numerics.arrays import all_true
from geneva_cli.numerics.jet import Array, Jet, Number, V

# Names of an instant's quantities.
INSTANT_QUANTITIES = (
    *("omega_rad_s", "alpha_rad_s2", "wheel_torque_Nm", "pin_force_N", "stress_squared"),
    *("sliding_m_s", "input_torque_Nm", "rubbed_Nm", "wheel_bearing_N", "crank_bearing_squared"),
    *("guide_squared", "drives", "slides", "feeds", "grip", "friction_margin", "edge"),
)


class Instant(Generic[V]):
    """Motion and loads for known signs of wheel torque, sliding and input torque.

    Quantities are jets by the input angle in radians, or values; they are computed at first use. A
    torque that drives the wheel, and a pin force on the wall that drives it, are positive; so is a
    sliding speed away from the wheel's axis, and the input's torque where the input drives.

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

    def signed(self, drives: Array | None = None) -> Self:
        """Set the signs to those of the values; ``drives`` is that of the torque, if known."""
        self.drives = np.copysign(1.0, value(self.wheel_torque_Nm)) if drives is None else drives
        self.slides = np.copysign(1.0, value(self.slip))
        self.feeds = np.copysign(1.0, value(self.feeding))
        return self

    def values(self: Instant[Jet]) -> Instant[Array]:
        """The instant with values in place of jets."""
        signs = self.drives, self.slides, self.feeds
        return Instant(self.case, contact_values(self.at), *signs)

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
        """The torque that the wheel needs for inertia and resistance, N m."""
        return self.at.acceleration * self.case.inertia_Nm + self.case.resists_Nm

    @cached_property
    def frame_torque_Nm(self) -> V:
        """The torque on the carrier that speeds the wheel up against the ground, N m."""
        return self.at.acceleration * (self.case.inertia_Nm * self.case.frame)

    @cached_property
    def slip(self) -> V:
        """Speed at which the roller rubs along the wall, over L, per input radian."""
        return self.at.along - self.at.spin * (self.drives * self.case.radius)

    @cached_property
    def sliding_m_s(self) -> V:
        """Sliding speed along the wall of a roller that is fixed to its pin, m/s."""
        return self.slip * (self.case.L * self.case.speed_rad_s) * self.at.touches

    @cached_property
    def _slot_grip(self) -> V:
        """The grip without friction in a guide."""
        at, case = self.at, self.case
        if not case.rubs:
            return at.lever
        rub = at.touches * (case.friction * self.slides)
        return at.lever + rub * (at.offset * self.drives - at.arm * case.radius)

    @cached_property
    def _drag(self) -> V:
        """Friction in the guide over the pin's force."""
        drag: V = self.case.guide.drag(self.case, self.at, self.drives, self.slides)
        return drag

    @cached_property
    def grip(self) -> V:
        """Torque on the wheel over L times the pin force, the margin of all forces."""
        return self._slot_grip - self._drag * self.drives if self.case.guided else self._slot_grip

    @property
    def leaning(self) -> V | None:
        """A value at whose changes of sign the friction in a guide has a corner."""
        if self.case.guide is None:
            return None
        leaning: V = self.case.guide.leaning(self.case, self.at, self.drives, self.slides)
        return leaning

    @cached_property
    def friction_margin(self) -> V | None:
        """Margin of quantities that only friction makes unbounded; None without friction."""
        if not (self.case.rubs or self.case.guided):
            return None
        free = self.case.all_friction == 0.0  # designs of the batch, whose margin is infinite
        return self.grip + np.where(free, np.inf, 0.0) if np.any(free) else self.grip

    @cached_property
    def feeding(self) -> V:
        """A value with the sign of the input's torque: always finite, and smooth between its signs.

        It is the ratio of the input's torque to the wheel's, times ``grip``.
        """
        lost = self.slip * self.at.touches * (self.case.friction * self.slides * self.drives)
        gain = self.at.velocity * self._slot_grip + lost
        if all_true(self.case.frame == 0.0):
            return gain * self.drives
        return self.wheel_torque_Nm * gain + self.frame_torque_Nm * self.grip

    @cached_property
    def force_N(self) -> V:
        """The force on the pin, along the wall's normal, N."""
        return self.wheel_torque_Nm * self.drives / (self.grip * self.case.L)

    @cached_property
    def pin_force_N(self) -> V:
        """Pin force on the wall that bears, N, with its sign."""
        return self.force_N * self.drives

    @cached_property
    def edge(self) -> V | None:
        """1 - curvature of the bearing wall's pitch curve times the roller's radius, or None."""
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
    def rubbed_Nm(self) -> V:
        """The part of the input's torque that friction takes, in the slot and in a guide, N m."""
        rub = self.at.touches * (self.case.friction * self.slides)
        torque = self.force_N * rub * self.slip * self.case.L
        if self.case.guided:
            torque = torque + self.force_N * self._drag * self.at.velocity * self.case.L
        # designs of the batch without friction, whose force may be infinite
        free = self.case.all_friction == 0.0
        if not np.any(free):
            return torque
        if isinstance(torque, Jet):
            return type(torque)([np.where(free, 0.0, c) for c in torque.c])
        out: V = np.where(free, 0.0, torque)
        return out

    @cached_property
    def slot_torque_Nm(self) -> V:
        """The part of the input's torque that goes through the slot, before the efficiency, N m."""
        slot = self.wheel_torque_Nm * self.at.velocity
        return slot + self.rubbed_Nm if self.case.rubs or self.case.guided else slot

    @cached_property
    def lossless_torque_Nm(self) -> V:
        """Torque of the input shaft before the efficiency, N m."""
        if all_true(self.case.frame == 0.0):
            return self.slot_torque_Nm
        return self.slot_torque_Nm + self.frame_torque_Nm

    @property
    def _losses(self) -> Number:
        """Ratio of the input's torque to that without losses: 1 where the wheel drives."""
        return 0.5 * (1.0 + self.feeds) / self.case.efficiency + 0.5 * (1.0 - self.feeds)

    @cached_property
    def input_torque_Nm(self) -> V:
        """Torque of the input shaft, N m, losses included."""
        return self.lossless_torque_Nm * self._losses

    @property
    def crank_torque_Nm(self) -> V:
        """Torque of the shaft that carries the crank, N m: that of the power through the slot."""
        return self.slot_torque_Nm * self._losses / self.at.crank

    @property
    def _rub(self) -> Number:
        """Ratio of the force along the wall to the force on it."""
        return self.case.friction * value(self.at.touches)

    @cached_property
    def wheel_bearing_N(self) -> V:
        """Size of the force on the wheel, and so of its shaft's reaction, N."""
        return self.force_N * (1.0 + self._rub * self._rub) ** 0.5

    @cached_property
    def crank_bearing_squared(self) -> V:
        """The square of the reaction on the shaft whose crank carries the roller or link, N²."""
        if self.at.reactions is None:  # the crank is the roller's body, and its drive turns it
            return self.wheel_bearing_N * self.wheel_bearing_N
        return self._reaction(0)

    @cached_property
    def guide_squared(self) -> V | None:
        """The square of the guide's reaction (rocker, slider, groove, fixed gear), N²; or None."""
        return None if self.at.reactions is None else self._reaction(1)

    def _reaction(self, joint: int) -> V:
        """The square of the reaction of a joint that holds the roller's body."""
        assert self.at.reactions is not None
        normal, tangent, couple = self.at.reactions
        rub = self._rub * self.slides
        turn = rub * self.drives * self.case.radius
        x, y = (
            normal[joint][i] * self.drives + tangent[joint][i] * rub - couple[joint][i] * turn
            for i in (0, 1)
        )
        return self.force_N * self.force_N * (x * x + y * y)


def bounded(here: Instant[Array]) -> Instant[Array]:
    """Values with infinity where a force is unbounded, and 0 where no force is needed there."""
    with np.errstate(all="ignore"):
        out, is_held = here.quantities(), here.grip > 0.0
        bound = np.where(here.wheel_torque_Nm == 0.0, 0.0, np.inf)
        endless = ["wheel_bearing_N", "crank_bearing_squared"]
        endless += [] if here.guide_squared is None else ["guide_squared"]
        if here.friction_margin is not None:
            endless += ["input_torque_Nm", "rubbed_Nm"]
        for name in endless:
            out[name] = np.where(is_held, getattr(here, name), bound)
        out["pin_force_N"] = np.where(is_held, here.pin_force_N, bound * here.drives)
        if here.edge is not None and here.stress_squared is not None:
            is_pressed = is_held & (here.edge > 0.0)
            out["stress_squared"] = np.where(is_pressed, here.stress_squared, bound)
    return Instant.known(out)


def bounded_loads(
    case: LoadCase, at: Contact[Array], drives: Array | None = None
) -> Instant[Array]:
    """The values at a contact with the signs that they have there, as ``bounded`` has them."""
    with np.errstate(all="ignore"):
        return bounded(Instant(case, at).signed(drives))


class LoadQuantity(Protocol):
    """A function that holds no numbers, or a tuple whose numbers may be arrays (m, 1)."""

    def __call__(self, i: Instant[Jet], /) -> QuantityValue[Jet]:
        """A quantity, and the margin that bounds it."""
