"""The change of sides: the wheel coasts through its play and is struck at its end.

If the wheel's torque changes its sign, the roller leaves one wall for the other. The wheel coasts
through the play and is struck at its difference in speed.

Speeds are in units of the input's. Wheel angles are in radians, input angles in degrees from the
engagement's own mid-motion.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.carried import inertia_kgm2, resisting_torque_Nm
from geneva_cli.motion.batch import selection, taken
from geneva_cli.motion.engagement import Engagement, WheelMotion
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import braking, spans
from geneva_cli.numerics.angles import DEGREE, omega
from geneva_cli.numerics.arrays import Mask, Which, Whole, blocks, choose, joined, larger, parameter
from geneva_cli.numerics.extremes import Smooth, cuts
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.quadrature import rule
from geneva_cli.numerics.roots import find_roots
from geneva_cli.numerics.tolerances import ROUNDED


class WallImpacts(NamedTuple):
    """Impacts at changes of sides: the angles at which wheels coast and are struck, and the speeds.

    (k,) each; NaN if the play is not used up in the motion.
    """

    from_deg: Array
    at_deg: Array
    speed: Array  # of the wheel against the slot, over the input's speed


class Changes(NamedTuple):
    """Sign changes of torques, k of them: the designs, and the input angles."""

    which: Whole
    x: Array


def changes(engagement: Engagement, drag: Array) -> Changes:
    """Input angles inside a motion at which the wheel's torque changes sign: psi2 = -drag, (m, 1).

    There are none if a drag holds the roller on one wall.
    """
    motion, m = engagement.motion, len(drag)
    if engagement.paired:  # gears hold the wheel until another roller stops it
        begins = np.broadcast_to(np.ravel(motion.breaks_deg[-2]), m)
        return Changes(np.arange(m), begins.astype(float))
    some = selection(motion)

    def torque(x: Array, which: Which, order: int, _: Sequence[int]) -> list[tuple[Array, ...]]:
        rate = some(which).rate(x, order + 1)
        return [(rate.derivative() + parameter(drag[which])).arrays()]

    f = Smooth(torque, 0, signs=1, unit=DEGREE)
    which, _, (a, b), positive = cuts(f, spans(motion, m))
    (middle,) = f(0.5 * (a + b)[:, None], which, 0)[1][0]
    most = np.zeros(m)
    np.maximum.at(most, which, abs(middle[:, 0]))
    # a law may run at constant speed for a while
    kept = abs(middle[:, 0]) > ROUNDED * most[which]
    which, a, b, above = which[kept], a[kept], b[kept], positive[0, kept]
    before = np.flatnonzero((above[1:] != above[:-1]) & (which[:-1] == which[1:]))
    x = 0.5 * (b[before] + a[before + 1])
    # a change of sign within 1e-12 degrees of mid-motion is at mid-motion
    return Changes(which[before], np.where(abs(x) < 1e-12, 0.0, x))


def impacts_of(engagement: Engagement, at: Changes, play: Array, drag: Array) -> WallImpacts:
    """Impacts after the changes of sides ``at``, for the play of each, (k,) in radians.

    ``drag`` is M_r / (I w²), (m, 1). A wheel coasts from the place where psi2 = -drag, slowed only
    by the drag. It is struck when it is ahead of the slot by the play, or behind if the torque
    returns. If the torque returns before that, the wall that it left strikes it.

        >>> from geneva_cli import Design, External
        >>> [engagement] = Design(External(3)).mechanism.engagements
        >>> drag = np.array([[0.0]])
        >>> impacts_of(engagement, changes(engagement, drag), np.array([1e-4]), drag).at_deg
        array([0.55220712])
    """
    if not len(at.x):
        return WallImpacts(at.x, at.x, at.x)
    follows = np.append(at.which[1:] == at.which[:-1], False)
    until = np.where(follows, np.append(at.x[1:], 0.0), np.nan)
    parts = []
    for part in blocks(len(at.x), 256):  # the integrals of so many fit in the cache
        here = Changes(at.which[part], at.x[part])
        parts.append(_coasts(engagement, here, until[part], play[part], drag))
    x, speed, crosses = joined(parts)
    # a wheel that has not crossed its play leaves no other wall at the next change
    speed[1:][follows[:-1] & ~crosses[:-1]] = np.nan
    return WallImpacts(at.x, at.x + x / DEGREE, speed)


def _coasts(
    engagement: Engagement, at: Changes, until: Array, play: Array, drag: Array
) -> tuple[Array, Array, Mask]:
    """Impacts after changes of sides, up to the next changes ``until`` or, if NaN, to the exits.

    They are radians of the input until the wheels are struck, speeds, and masks of the wheels that
    cross their play. The others may be struck by the wall that they left.
    """
    start, motions, drags = at.x[:, None], taken(engagement.motion, at.which), drag[at.which]
    out: Array = np.full((2, len(start)), np.nan)

    def gained(x: Array, live: Whole) -> tuple[Array, Array]:
        return _gained(taken(motions, live), start[live], drags[live], x[:, None])

    with np.errstate(all="ignore"):
        every = np.arange(len(start))
        span = ((motions.exit_deg - start) * DEGREE)[:, 0]
        # a wheel runs ahead of the slot, or behind, until the next change
        turn = np.where(np.isnan(until), span, (until - at.x) * DEGREE)
        sense = np.copysign(1.0, gained(turn, every)[0])
        ahead_at_exit, speed_at_exit = gained(span, every)
        slows = np.flatnonzero(sense * speed_at_exit < 0.0)

        def faster(x: Array, live: Whole) -> tuple[Array, Array]:
            of = slows[live]
            place = start[of] + x[:, None] / DEGREE
            torque = (taken(motions, of)(place, 2).arrays()[2] + drags[of])[:, 0]
            return sense[of] * gained(x, of)[1], -sense[of] * torque

        most = span.copy()  # where it is farthest from the wall that it left
        most[slows] = find_roots(faster, turn[slows], span[slows])
        crosses = (play > 0.0) & (play <= sense * gained(most, every)[0])
        returns = (play > 0.0) & ~crosses & (sense * ahead_at_exit < 0.0)
        there, gap = np.flatnonzero(crosses | returns), np.where(crosses, play, 0.0)

        def over(x: Array, live: Whole) -> tuple[Array, Array]:
            of = there[live]
            ahead, speed = gained(x, of)
            return sense[of] * ahead - gap[of], sense[of] * speed

        if len(there):
            low, high = np.where(crosses, 0.0, most)[there], np.where(crosses, most, span)[there]
            out[0, there] = find_roots(over, low, high)
            out[1, there] = abs(gained(out[0, there], there)[1])
    return out[0], out[1], crosses


def _gained(motion: WheelMotion, start: Array, drag: Array, x: Array) -> tuple[Array, Array]:
    """Lead of wheels over their slots, and difference in speed, x radians after they coast: (k,).

    d = -int (x - t) (psi2 + drag) dt, which loses no digits even for a small play.
    """
    end = start + x / DEGREE
    inner = [start, *[np.clip(b, start, end) for b in motion.breaks_deg], end]
    halves = [0.5 * (b - a) for a, b in zip(inner[:-1], inner[1:], strict=True)]
    parts = zip(inner[:-1], inner[1:], halves, strict=True)
    nodes, weights = rule(24)  # exact to a double over half a motion
    t = np.hstack([0.5 * (a + b) + half * nodes for a, b, half in parts])
    weight = np.hstack([half * (DEGREE * weights) for half in halves])
    torque = np.where(weight > 0.0, (motion(t, 2).arrays()[2] + drag) * weight, 0.0)
    return -(torque * ((end - t) * DEGREE)).sum(axis=1), -torque.sum(axis=1)


def drag_over(mechanism: Mechanism) -> float:
    """M_r / (I w²) of the spec's load; infinite without an inertia, as then nothing coasts."""
    inertia, w = inertia_kgm2(mechanism.spec), omega(mechanism.spec.drive.n_rpm)
    heavy = inertia > 0.0
    drag = resisting_torque_Nm(mechanism.spec) / (choose(heavy, inertia, 1.0) * w * w)
    out: float = choose(heavy, drag, math.inf)
    return out


def lasting_drag_Nm(mechanism: Mechanism) -> float:
    """Torque to add for the roller to stay on one wall: I w² max(-psi2) - M_r.

    0 if it stays there already; (m, 1) for m designs.
    """
    inertia, w = inertia_kgm2(mechanism.spec), omega(mechanism.spec.drive.n_rpm)
    most = reduce(larger, map(braking, mechanism.engagements))
    return larger(inertia * w * w * most - resisting_torque_Nm(mechanism.spec), 0.0)
