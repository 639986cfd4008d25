"""Loads at mid-motion of curved slots, where slopes nearby are lost to rounding.

There the pin reverses in a cusp of its pitch curve, or crosses the radius.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP, NEGLIGIBLE, LoadCase, contact, contact_values, value
from geneva_cli.loads.instant import STATES, Instant, LoadQuantity, bounded, lacks
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.path_and_slot import retraces
from geneva_cli.numerics.arrays import Mask, Number, array
from geneva_cli.numerics.jet import Array, Jet


def at_mid_motion(
    engagement: Engagement, case: LoadCase, quantities: Sequence[str | LoadQuantity], n: int
) -> list[tuple[int, Array, Array]]:
    """The quantities of n designs at mid-motion, which no stretch reaches.

    They are numbers of quantities, with places and values (n,); NaN where undefined.

    Where the pin crosses the radius, its lever is 0 and a torque takes an unbounded force; instead
    of 0/0 the limits from both sides are returned. At a cusp the wall turns away from the roller on
    one side. A law that jumps at its middle has another acceleration after it: the slot then has a
    corner there, whose two sides are mirror images.
    """
    out: list[tuple[int, Array, Array]] = []
    middle = np.zeros((n, 1))

    def add(number: int, known: Number, where: Mask) -> None:
        out.append((number, middle[:, 0], np.where(where, known, np.full((n, 1), np.nan))[:, 0]))

    with np.errstate(all="ignore"):
        near = np.broadcast_to(NEAR_CUSP * np.reshape(engagement.entry_deg, (-1, 1)), (n, 1))
        at = contact(engagement, middle)
        before = array(at.acceleration.c[0])
        # just after mid-motion: 0 is exact, and a smaller number might become 0
        after = array(engagement.motion(middle + 1e-300, 2).derivatives()[2])
        # the two halves of a law are equal there to some roundings, or its acceleration jumps
        jumps = np.abs(after - before) > 1e-6 * (np.abs(after) + engagement.usual_acceleration)
        limits = []
        for x in (near, -near):  # the limits of 0/0, from values near mid-motion
            instant = Instant(case, contact(engagement, x, 2))
            each = [instant.quantity(of).value for of in quantities]
            limits.append([_limit(jet, np.radians(x)) for jet in each])
        # The tangent points away from the axis at entry and exit; at a cusp both are one.
        crosses = ~np.asarray(retraces(engagement))
        for sense, acceleration in ((1.0, at.acceleration), (-1.0, Jet([after]))):
            here = at._replace(
                acceleration=acceleration,
                along=at.along * sense,
                offset=at.offset * sense,
                curvature=at.curvature * sense,
            )
            instant = Instant(case, here)
            torque = value(instant.wheel_torque_Nm)
            loaded = case.is_loaded(engagement, torque)
            for k, of in enumerate(quantities):
                row, margin, sign = instant.quantity(of)
                known, bar = value(row), np.inf if margin is None else value(margin)
                finite = np.isfinite(known)
                add(k, known, np.isinf(bar) & finite)
                for limit in limits:
                    # on this side friction alone holds the wheel, whatever the torque
                    none = np.where(bar < -NEGLIGIBLE, np.nan, limit[k])
                    none = np.where(loaded, np.inf * sign, none)
                    limited = np.where((bar > NEGLIGIBLE) & finite, known, none)
                    add(k, limited, crosses | jumps | (sense > 0.0))
    return out


def at_crossing(engagement: Engagement, case: LoadCase) -> dict[str, Array] | None:
    """The ``States`` where the pin crosses the slot without a torque; None elsewhere."""
    if not engagement.slot.curved or retraces(engagement):
        return None
    with np.errstate(all="ignore"):
        middle, near = np.zeros(1), np.array([NEAR_CUSP * engagement.entry_deg])
        jets = Instant(case, contact(engagement, near, 2))
        # the torque's own sign is rounding, and where friction leaves no lever its force is 0/0
        signs = jets.drives, jets.slides, jets.feeds
        here = Instant(case, contact_values(contact(engagement, middle)), *signs)
        if np.any(case.is_loaded(engagement, here.wheel_torque_Nm)):
            return None
        open_ = np.abs(here.grip) <= NEGLIGIBLE
        beside = Instant(case, contact_values(jets.at), *signs)
        known, near_values, out = bounded(here), bounded(beside), {}
        for state in STATES.keys() - {*lacks(case, jets.at)}:
            one, other = getattr(known, state), getattr(near_values, state)
            limit = _limit(jets.quantity(STATES[state]).value, np.radians(near))
            limit = np.where(np.isfinite(other), limit, other)
            out[state] = np.where(open_ & ~np.isfinite(one), limit, one)
        return out


def _limit(jet: Jet, h: Array) -> Array:
    """The value at mid-motion of a quantity known h radians after it."""
    return array(jet.c[0] - h * (jet.c[1] - h * jet.c[2]))
