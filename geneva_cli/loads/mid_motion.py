"""Loads at mid-motion of curved slots, where slopes nearby are lost to rounding.

There the pin reverses in a cusp of its pitch curve, or crosses the radius. Stretches stop short of
it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP, contact
from geneva_cli.loads.forces import (
    NEGLIGIBLE,
    Contact,
    LoadCase,
    QuantityValue,
    is_loaded,
    value,
    wheel_torque,
)
from geneva_cli.loads.instant import Instant, bounded, signs, values
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.pitch_curve import retraces
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.jet import Array, Jet, Number

# contact, signs of torque, of sliding and of the input's torque -> the quantities
Rows: TypeAlias = Callable[[Contact[Jet], Number, Number, Number], list[QuantityValue[Jet]]]


class MidMotionValues(NamedTuple):
    """Values of one of the quantities, of n designs: (n,) each."""

    row: int  # the quantity's number
    x: Array
    value: Array  # infinite if unbounded; NaN if undefined


def at_mid_motion(
    engagement: Engagement, case: LoadCase, rows: Rows, n: int = 1
) -> list[MidMotionValues]:
    """The values of ``rows`` at mid-motion, and nearer to it than any stretch.

    Where the pin crosses the radius, its lever is 0 and a torque takes an unbounded force. Instead
    of 0/0 the limits from both sides are returned. At a cusp the wall turns away from the roller on
    one side. A quantity without margin on the other side goes to 0 there. So does a quantity of a
    torque that changes sign nearer to mid-motion than the stretches.

    A law that jumps at its middle, as ``s-curve`` without cruise and ramp, has another acceleration
    after it. The slot then has a corner there, whose two sides are mirror images.
    """
    middle, near = np.zeros(n), NEAR_CUSP * np.reshape(engagement.entry_deg, (-1, 1))
    out = []
    with np.errstate(all="ignore"):
        at = contact(engagement, np.zeros((n, 1)))
        before, after = array(at.acceleration.c[0]), _acceleration_after(engagement, n)
        # the two halves of a law are equal there to some roundings, or its acceleration jumps
        jumps = np.abs(after - before) > 1e-6 * (np.abs(after) + engagement.usual_acceleration)
        accelerations = at.acceleration, Jet([after])
        near_places = [np.broadcast_to(x, (n, 1)) for x in (near, -near)]
        limits = [_limits(engagement, case, rows, x) for x in near_places]
        # The tangent points away from the axis at entry and exit; at a cusp both are one.
        crosses = np.broadcast_to(~np.asarray(retraces(engagement)), (n, 1))
        for sense, acceleration, near_it in zip(
            (1.0, -1.0), accelerations, near_places, strict=True
        ):
            here = at._replace(
                acceleration=acceleration,
                along=at.along * sense,
                offset=at.offset * sense,
                curvature=at.curvature * sense,
            )
            torque = value(wheel_torque(case, here))
            loaded = is_loaded(case, engagement, torque)
            for k, row in enumerate(rows(here, *signs(case, here))):
                known = np.broadcast_to(value(row.value), (n, 1))
                margin = np.inf if row.margin is None else value(row.margin)
                there = (margin > NEGLIGIBLE) & np.isfinite(known)
                away = np.isinf(margin) & np.isfinite(known)
                out.append(MidMotionValues(k, middle, np.where(away, known, np.nan)[:, 0]))
                # on this side friction alone holds the wheel, whatever the torque
                by_friction = margin < -NEGLIGIBLE
                for limit in limits:
                    none = np.where(by_friction, np.nan, limit[k])
                    none = np.where(loaded, np.inf * row.sign, none)
                    limited = np.where(there, known, none)
                    own = crosses | jumps | (sense > 0.0)
                    out.append(MidMotionValues(k, middle, np.where(own, limited, np.nan)[:, 0]))
            out += _without_torque(engagement, case, rows, torque, near_it)
    return out


def _acceleration_after(engagement: Engagement, n: int) -> Array:
    """The wheel's acceleration just after mid-motion, as an invariant: (n, 1)."""
    x = np.full((n, 1), 1e-300)  # 0 is exact, and a smaller number might become 0
    return array(engagement.motion(x, 2).derivatives()[2])


def at_crossing(engagement: Engagement, case: LoadCase) -> dict[str, Array] | None:
    """The quantities of ``Instant`` at mid-motion, where the pin crosses the slot without a torque.

    They are arrays of one, with the limits of entry. None in all other cases.
    """
    if not engagement.slot.curved or retraces(engagement):
        return None
    with np.errstate(all="ignore"):
        middle, near = np.zeros(1), np.array([NEAR_CUSP * engagement.entry_deg])
        at, before, h = contact(engagement, middle), contact(engagement, near, 2), np.radians(near)
        if np.any(is_loaded(case, engagement, value(wheel_torque(case, at)))):
            return None
        # the torque's own sign is rounding, and where friction leaves no lever its force is 0/0
        here, jets = (Instant(case, x, *signs(case, before)) for x in (at, before))
        open_ = np.abs(value(here.grip)) <= NEGLIGIBLE
        known, near_values = bounded(values(here)), bounded(values(jets))
        out = {}
        for name, jet in jets.quantities().items():
            if isinstance(jet, Jet):
                one, other = getattr(known, name), getattr(near_values, name)
                limit = np.where(np.isfinite(other), _limit(jet, h), other)
                out[name] = np.where(open_ & ~np.isfinite(one), limit, one)
        return out


def _limit(jet: Jet, h: Array) -> Array:
    """The value at mid-motion of a quantity known h radians after it."""
    return array(jet.c[0] - h * (jet.c[1] - h * jet.c[2]))


def _limits(engagement: Engagement, case: LoadCase, rows: Rows, x: Array) -> list[Array]:
    """The limits of 0/0 at mid-motion, from values near it."""
    at = contact(engagement, x, 2)
    return [_limit(row.value, np.radians(x)) for row in rows(at, *signs(case, at))]


def _without_torque(
    engagement: Engagement, case: LoadCase, rows: Rows, middle: Number, near: Array
) -> list[MidMotionValues]:
    """The values where the torque changes sign between mid-motion and the nearest stretch."""

    def torque(x: Array) -> tuple[Array, Array]:
        _, _, acceleration, jerk = engagement.motion(x, 3).derivatives()
        left = acceleration * case.inertia_Nm + case.resists_Nm
        return array(left), array(jerk * (case.inertia_Nm * DEGREE))

    end = torque(near)[0]
    changes = np.broadcast_to(middle * end < 0.0, near.shape)[:, 0]
    if not changes.any():
        return []
    x = near * (middle / (middle - end))
    for _ in range(2):  # Newton steps from a chord of 1e-4 of the motion: the rest is rounding
        left, rise = torque(x)
        x = np.clip(x - left / rise, np.minimum(near, 0.0), np.maximum(near, 0.0))
    at = contact(engagement, x)
    _, slides, feeds = signs(case, at)
    unforced = at._replace(lever=at.lever + np.inf)  # the rest of the torque takes no force
    out = []
    for drives in (1.0, -1.0):  # it is 0 on both sides
        pairs = zip(*(rows(here, drives, slides, feeds) for here in (at, unforced)), strict=True)
        for k, (row, none) in enumerate(pairs):
            known = np.broadcast_to(value(none.value), near.shape)[:, 0]
            margin = np.inf if row.margin is None else value(row.margin)
            there = (
                np.broadcast_to(margin > NEGLIGIBLE, near.shape)[:, 0]
                & np.isfinite(known)
                & changes
            )
            out.append(MidMotionValues(k, x[:, 0], np.where(there, known, np.nan)))
    return out
