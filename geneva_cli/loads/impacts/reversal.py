"""The change of sides: the wheel coasts through its play and is struck at its end.

If the wheel's torque changes its sign, the roller leaves one wall for the other, which then strikes
it at their difference in speed. Speeds are in units of the input's, wheel angles in radians, input
angles in degrees from the engagement's own mid-motion.
"""

import math
from functools import reduce

import numpy as np

from geneva_cli.loads.contact import LoadCase, contact
from geneva_cli.loads.impacts.shock_force import Impacts, hardest, shown
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import LoadFunctions
from geneva_cli.loads.strength.pin_arm_key import PinSize
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import braking
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Whole, all_true, choose, larger, parameter
from geneva_cli.numerics.roots import find_roots
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.spec.workshops import WORKSHOPS


def changes(engagement: Engagement, drag: Array) -> tuple[Whole, Array]:
    """Designs and input angles (k,) at which the wheel's torque changes sign: psi2 = -drag."""
    m = len(drag)
    if engagement.paired:  # gears hold the wheel until another roller stops it
        begins = np.broadcast_to(np.ravel(engagement.motion.breaks_deg[-2]), m)
        return np.arange(m), begins.astype(float)
    one = parameter(drag)
    case = LoadCase(1.0, 1.0, one, 1.0, 0.0, 0.0, 1.0, None, design=np.arange(m)[:, None])
    load = LoadFunctions(engagement, case)
    which, _, (a, b), positive = load.stretches()
    torque = load.at(0.5 * (a + b)[:, None], which)[0].wheel_torque_Nm.derivatives()[0][:, 0]
    most = np.zeros(m)
    np.maximum.at(most, which, abs(torque))
    # a law may run at constant speed for a while
    kept = abs(torque) > ROUNDED * most[which]
    which, a, b, above = which[kept], a[kept], b[kept], positive[0, kept]
    before = np.flatnonzero((above[1:] != above[:-1]) & (which[:-1] == which[1:]))
    x = 0.5 * (b[before] + a[before + 1])
    # a change of sign within 1e-12 degrees of mid-motion is at mid-motion
    return which[before], np.where(abs(x) < 1e-12, 0.0, x)


def impacts_of(
    engagement: Engagement, at: tuple[Whole, Array], play: Array, drag: Array
) -> tuple[Array, Array]:
    """Angles at which wheels are struck after changes of sides ``at``, and the speeds.

    ``play`` is that of each change, (k,) in radians; ``drag`` M_r / (I w²), (m, 1), slows the
    coasting wheel. It is struck when it is ahead of the slot by the play; if the torque returns
    before that, by the wall that it left. NaN if the play is not used up in the motion.
    """
    which, begin = at
    follows = np.append(which[1:] == which[:-1], False)
    until = np.where(follows, np.append(begin[1:], 0.0), np.nan)
    motions, start, drags = taken(engagement.motion, which), begin[:, None], drag[which]
    turned, speed = (row + 0.0 * start for row in motions(start, 1).derivatives())

    def gained(x: Array, live: Whole) -> tuple[Array, Array]:
        """Lead of wheels over their slots, and difference in speed, x radians after they coast."""
        x = x[:, None]
        angle, rate = taken(motions, live)(start[live] + x / DEGREE, 1).derivatives()
        own, slower = speed[live], drags[live] * x
        lead = own * x - 0.5 * slower * x - (angle - turned[live])
        return lead[:, 0], (own - slower - rate)[:, 0]

    with np.errstate(all="ignore"):
        every = np.arange(len(start))
        span = ((motions.exit_deg - start) * DEGREE)[:, 0]
        # a wheel runs ahead of the slot, or behind, until the next change
        turn = np.where(np.isnan(until), span, (until - start[:, 0]) * DEGREE)
        sense = np.copysign(1.0, gained(turn, every)[0])
        ahead_at_exit, speed_at_exit = gained(span, every)

        def faster(x: Array, live: Whole) -> tuple[Array, Array]:
            place = start[live] + x[:, None] / DEGREE
            torque = (taken(motions, live)(place, 2).derivatives()[2] + drags[live])[:, 0]
            return sense[live] * gained(x, live)[1], -sense[live] * torque

        # where it is farthest from the wall that it left
        slower = np.where(sense * speed_at_exit < 0.0, span, np.nan)
        most = np.where(np.isnan(slower), span, find_roots(faster, turn, slower))
        crosses = (play > 0.0) & (play <= sense * gained(most, every)[0])
        returns = (play > 0.0) & ~crosses & (sense * ahead_at_exit < 0.0)
        gap = np.where(crosses, play, 0.0)

        def over(x: Array, live: Whole) -> tuple[Array, Array]:
            ahead, speed = gained(x, live)
            return sense[live] * ahead - gap[live], sense[live] * speed

        low = np.where(crosses, 0.0, np.where(returns, most, np.nan))
        struck = find_roots(over, low, np.where(crosses, most, span))
        hit = abs(gained(struck, every)[1])
    # a wheel that has not crossed its play leaves no other wall at the next change
    hit[1:][follows[:-1] & ~crosses[:-1]] = np.nan
    return begin + struck / DEGREE, hit


def drag_over(case: LoadCase) -> float:
    """M_r / (I w²) of a load; infinite without an inertia, as then nothing coasts."""
    heavy = case.inertia_Nm > 0.0
    drag = case.resists_Nm / choose(heavy, case.inertia_Nm, 1.0)
    return choose(heavy, drag, math.inf)


def lasting_drag_Nm(mechanism: Mechanism) -> float:
    """Torque to add for the roller to stay on one wall: I w² max(-psi2) - M_r."""
    case, most = load_case(mechanism), reduce(larger, map(braking, mechanism.engagements))
    return larger(case.inertia_Nm * most - case.resists_Nm, 0.0)


def reversal_impacts(mechanism: Mechanism, pin: PinSize | None = None) -> Impacts:
    """Hardest impacts of m designs at a change of sides with the greatest play.

    Without the ``pin`` as it is drawn, forces are not known. The play is the clearance over the
    lever, for the smallest roller in the widest slot, with the process's fits where both are
    nominal.
    """
    spec, case = mechanism.spec, load_case(mechanism)
    given = spec.size.allowances.slot_clearance_mm
    both = spec.tolerance.roller_diameter_mm + spec.tolerance.slot_width_mm
    play_mm = choose(given == 0.0, WORKSHOPS[spec.size.process].slot_play_mm, given) + 0.5 * both
    drag = drag_over(case)
    if all_true((drag == np.inf) | (play_mm == 0.0)):
        return Impacts(*np.full((5, mechanism.designs), np.nan))
    numbers = mechanism.center_distance_mm, drag, play_mm, case.radius
    rows = [np.broadcast_to(x, (mechanism.designs, 1)) for x in numbers]
    each = (shown(mechanism, one, *_reversal(one, *rows)) for one in mechanism.engagements)
    return hardest(mechanism, each, pin)


def _reversal(
    engagement: Engagement, L: Array, drag: Array, play_mm: Array, radius: Array
) -> Array:
    """Input angles, jumps and edges of one engagement's hardest impacts, (3, m)."""
    out = np.full((3, len(drag)), np.nan)
    of, x = at = changes(engagement, drag)
    if not len(x):
        return out
    lever = abs(contact(taken(engagement, of), x[:, None]).lever.derivatives()[0][:, 0])
    least = 1e-6  # of the centre distance: where the slot lies across the path, play is unbounded
    sine = play_mm[of, 0] / (np.maximum(lever, least) * L[of, 0])
    play = np.where(lever > least, engagement.slot.play(np.minimum(sine, 1.0)), 0.0)
    at_deg, speed = impacts_of(engagement, at, play, drag)
    # hardest of each design; of equal ones the first
    order = np.lexsort((np.nan_to_num(-speed, nan=np.inf), of))
    which, first = np.unique(of[order], return_index=True)
    places = out[0, which] = at_deg[order][first]
    out[1, which] = speed[order][first]
    wall = contact(taken(engagement, which), places[:, None])
    # the torque that the wheel then needs is that of the wall which strikes it
    bears = np.copysign(1.0, wall.acceleration.derivatives()[0] + drag[which])
    out[2, which] = (1.0 - wall.curvature.derivatives()[0] * bears * radius[which])[:, 0]
    return out


def arrival(mechanism: Mechanism) -> tuple[float, float] | None:
    """The resisting torque where one wall alone stops the wheel; None if a slot has two.

    Also the greatest with which the wheel reaches its dwell. If gears drive between two rollers,
    the slot of the second has a wall behind its roller only. From the handover at s the wheel
    coasts: psi'' = -m with m = M_r / (I w²). -psi'' of a straight slot has one peak, and is not 0
    at the exit e. So the wheel reaches its dwell if m <= -psi''(e) and if m is at most
    2 (psi'(s) (e - s) - (psi(e) - psi(s))) / (e - s)².
    """
    engagement = mechanism.engagements[0]
    if not engagement.paired or not mechanism.spec.is_loaded:
        return None
    case, motion = load_case(mechanism), engagement.motion
    begin, exit_deg = motion.breaks_deg[-2], engagement.exit_deg
    start, u = motion(begin, 1).derivatives()[:2]
    end, _, last = motion(exit_deg, 2).derivatives()[:3]
    span = (exit_deg - begin) * DEGREE
    late = 2.0 * (u * span - (end - start)) / (span * span)
    return case.resists_Nm, case.inertia_Nm * max(0.0, min(-last, late))
