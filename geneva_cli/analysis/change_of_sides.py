"""The change of sides: the wheel coasts through its play and is struck at its end.

If the wheel's torque changes its sign, the roller leaves one wall for the other. The wheel coasts
through the play and is struck at its difference in speed.

Speeds are in units of the input's. Wheel angles are in radians, input angles in degrees from the
engagement's own mid-motion.
"""

from __future__ import annotations

import math
from typing import NamedTuple, cast

import numpy as np

from geneva_cli.analysis.carried import inertia_kgm2, resisting_torque_Nm
from geneva_cli.analysis.peak_search import landmarks
from geneva_cli.kinematics.engagement import Engagement, WheelMotion
from geneva_cli.machine.many import designs_in, taken
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE, omega
from geneva_cli.numerics.arrays import Whole, blocks, choose, joined, larger
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.newton import find_roots
from geneva_cli.numerics.quadrature import rule
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
    which, x, torque = landmarks(motion, "acceleration", m)
    torque = torque + drag[which, 0]
    most = np.zeros(m)
    np.maximum.at(most, which, abs(torque))
    # a law may run at constant speed for a while
    kept = abs(torque) > ROUNDED * most[which]
    which, x, torque = which[kept], x[kept], torque[kept]
    before = np.flatnonzero((torque[:-1] * torque[1:] < 0.0) & (which[:-1] == which[1:]))
    of = which[before]

    def over(place: Array, live: Whole) -> tuple[Array, Array]:
        _, _, a, j = taken(motion, of[live])(place[:, None], 3).arrays()
        return (a + drag[of[live]])[:, 0], (j * DEGREE + 0.0 * place[:, None])[:, 0]

    # after a Newton step of 1e-9 of the bracket the rest is rounding
    roots = find_roots(over, x[before], x[before + 1], 1e-9)
    # a change of sign within 1e-12 degrees of mid-motion is at mid-motion
    return Changes(of, np.where(abs(roots) < 1e-12, 0.0, roots))


def impacts_of(engagement: Engagement, at: Changes, play: Array, drag: Array) -> WallImpacts:
    """Impacts after the changes of sides ``at``, for the play of each, (k,) in radians.

    ``drag`` is M_r / (I w²), (m, 1). A wheel coasts from the place where psi2 = -drag, slowed only
    by the drag. It is struck when it is ahead of the slot by the play, or behind if the torque
    returns.

        >>> from geneva_cli import Design, External
        >>> [engagement] = Design(External(3)).mechanism.engagements
        >>> drag = np.array([[0.0]])
        >>> impacts_of(engagement, changes(engagement, drag), np.array([1e-4]), drag).at_deg
        array([0.55220712])
    """
    if not len(at.x):
        return WallImpacts(at.x, at.x, at.x)
    parts = []
    for part in blocks(len(at.x), 256):  # the integrals of so many fit in the cache
        parts.append(_impacts(engagement, Changes(at.which[part], at.x[part]), play[part], drag))
    return joined(parts)


def _impacts(engagement: Engagement, at: Changes, play: Array, drag: Array) -> WallImpacts:
    start = at.x[:, None]

    def gained(x: Array, live: Whole) -> tuple[Array, Array]:
        of = at.which[live]
        return _gained(taken(engagement.motion, of), start[live], drag[of], x[:, None])

    with np.errstate(all="ignore"):
        span = ((taken(engagement.motion, at.which).exit_deg - start) * DEGREE)[:, 0]
        whole = gained(span, np.arange(len(span)))[0]
        there = np.flatnonzero((play > 0.0) & (play <= abs(whole)))

        def over(x: Array, live: Whole) -> tuple[Array, Array]:
            ahead, faster = gained(x, there[live])
            sense = np.copysign(1.0, ahead)
            return sense * ahead - play[there[live]], sense * faster

        x, speed = np.full((2, len(span)), np.nan)
        if len(there):
            x[there] = find_roots(over, np.zeros(len(there)), span[there])
            speed[there] = abs(gained(x[there], there)[1])
    return WallImpacts(at.x, at.x + x / DEGREE, speed)


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
    inertia = inertia_kgm2(mechanism.spec)
    w = omega(mechanism.spec.drive.n_rpm)
    heavy = inertia > 0.0
    drag = resisting_torque_Nm(mechanism.spec) / (choose(heavy, inertia, 1.0) * w * w)
    out: float = choose(heavy, drag, math.inf)
    return out


def lasting_drag_Nm(mechanism: Mechanism) -> float:
    """Torque to add for the roller to stay on one wall: I w² max(-psi2) - M_r.

    0 if it stays there already; (m, 1) for m designs.
    """
    inertia = inertia_kgm2(mechanism.spec)
    w = omega(mechanism.spec.drive.n_rpm)
    most = braking(mechanism.engagements[0])
    for engagement in mechanism.engagements[1:]:
        most = larger(most, braking(engagement))
    return larger(inertia * w * w * most - resisting_torque_Nm(mechanism.spec), 0.0)


def braking(engagement: Engagement) -> float:
    """Greatest -psi2 of a motion; (m, 1) for m designs."""
    motion = engagement.motion
    m = designs_in(motion)
    which, _, value = landmarks(motion, "acceleration", m)
    most = np.full(m, -np.inf)
    np.maximum.at(most, which, -value)
    one = m == 1 and isinstance(motion.entry_deg, float)
    return float(most[0]) if one else cast("float", most[:, None])
