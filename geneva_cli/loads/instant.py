"""Motion and loads at an input angle while the wheel moves, with signs and in units.

t is the unit tangent of the slot, away from the wheel's axis. The normal n = d i t points towards
the wall that bears: d is the sign of the torque T. The wheel's balance about its axis is

    |T| = N |C x n + f s C x t| = N [M . t + f s (d (M x t) - r)],    C = M + r n

s is the sign of v = M' . t - d r (rate of the roller's body - rate of the wheel), at which the
roller, fixed to its body, rubs along the wall.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

import numpy as np

from geneva_cli.kept import cached_property
from geneva_cli.loads.contact import Contact, LoadCase, QuantityValue, lesser
from geneva_cli.numerics.arrays import all_true, array
from geneva_cli.numerics.jet import Array, Jet, Number


class Instant:
    """Motion and loads for the signs of wheel torque, sliding and input torque.

    Quantities are jets by the input angle in radians; most are computed at first use. A
    torque that drives the wheel, and a pin force on the wall that drives it, are positive; so is a
    sliding speed away from the wheel's axis, and the input's torque where the input drives.

    Forces are unbounded where ``grip`` <= 0: there friction alone holds the wheel. Stresses are
    also unbounded where ``edge`` <= 0: there the wall is more sharply curved than the roller.
    """

    at: Contact
    wheel_torque_Nm: Jet  # that the wheel needs for inertia and resistance, N m
    slip: Jet  # speed at which the roller rubs along the wall, over L, per input radian
    slot_grip: Jet  # the grip without friction in a guide
    drag: Jet  # friction in a guide over the pin's force
    grip: Jet  # torque on the wheel over L times the pin force, the margin of all forces

    def __init__(self, case: LoadCase, at: Contact, *signs: Number | None) -> None:
        """Of wheel torque, sliding and input torque those that are None, or NaN, are as here."""
        drives, slides, feeds = (*signs, None, None, None)[:3]
        self.case, self.at = case, at
        self.wheel_torque_Nm = at.acceleration * case.inertia_Nm + case.resists_Nm
        self.drives = sign_of(self.wheel_torque_Nm, drives)
        self.slip = at.along - at.spin * (self.drives * case.radius)
        self.slides = sign_of(self.slip, slides)
        self.slot_grip = at.lever
        if case.rubs:
            rub = at.touches * (case.friction * self.slides)
            self.slot_grip = at.lever + rub * (at.offset * self.drives - at.arm * case.radius)
        self.grip = self.slot_grip
        if case.guided:
            self.drag = case.guide.drag(case, at, self.drives, self.slides)
            self.grip = self.slot_grip - self.drag * self.drives
        self.feeds = feeds if isinstance(feeds, float) else sign_of(self.feeding, feeds)
        # ratio of the input's torque to that without losses: 1 where the wheel drives
        self.losses = 0.5 * (1.0 + self.feeds) / case.efficiency + 0.5 * (1.0 - self.feeds)

    @cached_property
    def feeding(self) -> Jet:
        """A value with the sign of the input's torque: always finite, and smooth between its signs.

        It is the ratio of the input's torque to the wheel's, times ``grip``.
        """
        at, case = self.at, self.case
        lost = self.slip * at.touches * (case.friction * self.slides * self.drives)
        gain = at.velocity * self.slot_grip + lost
        if all_true(case.frame == 0.0):
            return gain * self.drives
        return self.wheel_torque_Nm * gain + self.frame_torque_Nm * self.grip

    @property
    def frame_torque_Nm(self) -> Jet:
        """The torque on the carrier that speeds the wheel up against the ground, N m."""
        return self.at.acceleration * (self.case.inertia_Nm * self.case.frame)

    @property
    def leaning(self) -> Jet:
        """A value at whose changes of sign the friction in a guide has a corner."""
        leaning: Jet = self.case.guide.leaning(self.case, self.at, self.drives, self.slides)
        return leaning

    @cached_property
    def edge(self) -> Jet:
        """1 - curvature of the bearing wall's pitch curve times the roller's radius."""
        return 1.0 - self.at.curvature * (self.drives * self.case.radius)

    @cached_property
    def friction_margin(self) -> Jet | None:
        """Margin of quantities that only friction makes unbounded; None without friction."""
        free = self.case.all_friction == 0.0  # designs of the batch, whose margin is infinite
        if all_true(free):
            return None
        return self.grip + np.where(free, np.inf, 0.0) if np.any(free) else self.grip

    @cached_property
    def force_N(self) -> Jet:
        """The force on the pin, along the wall's normal, N."""
        return self.wheel_torque_Nm * self.drives / (self.grip * self.case.L)

    @cached_property
    def slot_torque_Nm(self) -> Jet:
        """The part of the input's torque that goes through the slot, before the efficiency, N m."""
        at, case = self.at, self.case
        moved = self.wheel_torque_Nm * at.velocity
        if not (case.rubs or case.guided):
            return moved
        # what friction takes, in the slot and in a guide
        rubbed = self.force_N * (at.touches * (case.friction * self.slides)) * self.slip * case.L
        if case.guided:
            rubbed = rubbed + self.force_N * self.drag * at.velocity * case.L
        # designs of the batch without friction, whose force may be infinite
        free = case.all_friction == 0.0
        if np.any(free):
            rubbed = Jet(np.where(free, 0.0, c) for c in rubbed.c)
        return moved + rubbed

    @cached_property
    def input_torque_Nm(self) -> Jet:
        """Torque of the input shaft, N m, losses included."""
        lossless = self.slot_torque_Nm
        if not all_true(self.case.frame == 0.0):
            lossless = lossless + self.frame_torque_Nm
        return lossless * self.losses

    @cached_property
    def wheel_bearing_N(self) -> Jet:
        """Size of the force on the wheel, and so of its shaft's reaction, N."""
        rub = self.case.friction * self.at.touches.c[0]
        return self.force_N * (1.0 + rub * rub) ** 0.5

    @cached_property
    def crank_bearing_squared(self) -> Jet:
        """The square of the reaction on the shaft whose crank carries the roller or link, N²."""
        if self.at.reactions is None:  # the crank is the roller's body, and its drive turns it
            return self.wheel_bearing_N * self.wheel_bearing_N
        return self.reaction_squared(0)

    def reaction_squared(self, joint: int) -> Jet:
        """The square of the reaction of a joint that holds the roller's body, N²."""
        assert self.at.reactions is not None
        normal, tangent, couple = self.at.reactions
        rub = self.case.friction * self.at.touches.c[0] * self.slides
        turn = rub * self.drives * self.case.radius
        x, y = (
            normal[joint][i] * self.drives + tangent[joint][i] * rub - couple[joint][i] * turn
            for i in (0, 1)
        )
        return self.force_N * self.force_N * (x * x + y * y)

    def pressed(self, sliding: Jet | float = 1.0) -> QuantityValue:
        """The square of the contact stress, MPa, times a speed; it needs a face width."""
        assert self.case.hertz is not None
        square = self.force_N * self.at.touches * self.case.hertz / self.edge
        square = square * (sliding * sliding)
        friction = self.friction_margin
        return QuantityValue(square, self.edge if friction is None else lesser(friction, self.edge))


class LoadQuantity(Protocol):
    """A quantity: a function without numbers, or a tuple whose numbers may be arrays (m, 1)."""

    def __call__(self, i: Instant, /) -> QuantityValue:
        """The quantity, and the margin that bounds it."""


NO_FUNCTIONS: Mapping[str, LoadQuantity] = MappingProxyType({})
# Those of the cycle; those of ``SQUARED`` as squares.
QUANTITIES: dict[str, LoadQuantity] = {
    "omega_rad_s": lambda i: QuantityValue(i.at.velocity * i.case.speed_rad_s),
    "alpha_rad_s2": lambda i: QuantityValue(i.at.acceleration * i.case.speed_rad_s**2),
    "wheel_torque_Nm": lambda i: QuantityValue(i.wheel_torque_Nm),
    "pin_force_N": lambda i: QuantityValue(i.force_N, i.grip),
    "wall_force_N": lambda i: QuantityValue(i.force_N * i.drives, i.grip, i.drives),
    "contact_stress_MPa": lambda i: i.pressed(),
    # of a roller that is fixed to its pin
    "sliding_m_s": lambda i: QuantityValue(i.slip * (i.case.L * i.case.speed_rad_s) * i.at.touches),
    "input_torque_Nm": lambda i: QuantityValue(i.input_torque_Nm, i.friction_margin),
    "wheel_bearing_N": lambda i: QuantityValue(i.wheel_bearing_N, i.grip),
    "crank_bearing_N": lambda i: QuantityValue(i.crank_bearing_squared, i.grip),
    "pv_W_m2": lambda i: i.pressed(QUANTITIES["sliding_m_s"](i).value * 1e6),
    # of rocker, slider, groove or fixed gear
    "guide_force_N": lambda i: QuantityValue(i.reaction_squared(1), i.grip),
}


def sign_of(jet: Jet, known: Number | None) -> Number:
    """The sign of a jet's value, or the known one; NaN in an array of signs is not known."""
    if isinstance(known, float):
        return known
    own = np.copysign(1.0, jet.c[0])
    return own if known is None else np.where(np.isnan(known), own, known)


def bounded(here: Instant, quantity: LoadQuantity) -> Array:
    """A quantity, infinite where a force is unbounded, and 0 where no force is needed there."""
    own, margin, sign = quantity(here)
    if margin is None:
        return array(own.c[0])
    bound = np.where(here.wheel_torque_Nm.c[0] == 0.0, 0.0, np.inf) * sign
    is_bounded = (array(here.grip.c[0]) > 0.0) & (array(margin.c[0]) > 0.0)
    return np.where(is_bounded, own.c[0], bound)
