"""The roller as a bearing in its slot: work, turns and life.

Over a motion it rolls along its wall under a force N, and turns by |v_s|/r per second, v_s being
the speed at which it would slide. By ISO 281 (roller bearings) the life is that under

    P = (∫ N^p |v_s| dt / ∫ |v_s| dt)^(1/p),  p = 10/3,  L10 = 10^6 (C/P)^p revolutions.

Between changes of sign and breaks of the motion the integrals are exact to the last digits.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.contact import LoadCase
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import LoadFunctions, refuse_noise
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, array, parameter
from geneva_cli.numerics.extremes import Stretches

LIFE_EXPONENT = 10.0 / 3.0  # p, of line contact


class SlotPassage(NamedTuple):
    """One roller's passage through one slot, (m,) each, SI units; infinite if the force is."""

    travel_m: float  # of the contact along the walls, in and out
    rolled_m: float  # ∫ |v_s| dt
    work: float  # ∫ N |v_s| dt, joules: friction work for a coefficient of 1
    load: float  # ∫ N^p |v_s| dt


def passage(engagement: Engagement, case: LoadCase, half: float = 0.0) -> SlotPassage:
    """Integrals over a motion of m designs, (m,) each; or over the ``half`` before or after 0."""
    # A roller on a crank's arm turns back on the line of centres, unless its motion is tilted. In a
    # curved slot both branches begin at mid-motion. Spans end there.
    middle = engagement.slot.curved or (engagement.on_arm and engagement.motion.symmetric)
    more = ("slides",) if middle else ("slides", "along")
    load, n = LoadFunctions(engagement, case, ("pin_force_N",), more=more), np.size(case.design)
    result = load.search()
    bounded = np.isfinite(result.most[0])  # the integrals are, where the force is
    pieces = load.stretches(result)
    own = half * pieces.x.sum(axis=0) >= 0.0
    pieces = Stretches._make(row[..., own] for row in pieces)

    def functions(here: Instant, _: object) -> tuple[Array, ...]:
        """Speed along the slot with its sign, |v_s|, N |v_s| and N^p |v_s|."""
        L, touches = here.case.L, array(here.at.touches.c[0])
        rubs = abs(here.slip.derivatives()[0]) * L
        # near the torque's change of sign the force may be slightly negative by rounding
        force = np.maximum(here.force_N.c[0], 0.0)
        force = np.where(here.grip.c[0] > 0.0, force, np.inf) * touches
        # nothing presses on a wall if nothing must be turned
        force = np.where(here.wheel_torque_Nm.c[0] == 0.0, 0.0, force)
        along = here.at.along.derivatives()[0] * L * touches
        return along, rubs, force * rubs, force**LIFE_EXPONENT * rubs

    every_one = np.full(n, True)
    needed = np.stack((every_one, every_one, bounded, bounded))
    moved, *others = load.integrals(pieces, functions, needed)
    total = [np.bincount(pieces.design, row, n) for row in (abs(moved), *others)]
    return SlotPassage(*map(parameter, np.array(total)))


def passages(mechanism: Mechanism, by_roller: bool = False) -> list[SlotPassage]:
    """Passage of each engagement of a period: (m,) for m designs.

    ``by_roller`` makes two of one in which a roller starts and another stops the wheel. Raises
    GenevaError where the numbers of a single design are rounding.
    """
    case, out = load_case(mechanism), []
    for one in mechanism.under_load.engagements:
        for half in (-1.0, 1.0) if by_roller and one.paired else (0.0,):
            out.append(passage(one, case, half))
            if isinstance(mechanism.design, int):
                refuse_noise([array(row) for row in out[-1]])
    return out


def lives(mechanism: Mechanism, each: Sequence[SlotPassage]) -> dict[str, Array]:
    """Life of the most loaded roller of m designs, (m,) each, from the passages of their rollers.

    Turns, motions of this roller and hours need a capacity; they are infinite without a force.
    """
    spec = mechanism.spec
    m = len(spec.wheel.steps or spec.drive.roller_angles_deg or ()) or spec.drive.rollers
    m *= len(mechanism.engagements[0].passages)  # rollers on the crank
    radius_m = np.ravel(mechanism.roller_radius_mm / 1000.0)
    rows = []
    per_h = 60.0 * spec.drive.n_rpm * 360.0 / mechanism.under_load.lasting_deg  # periods an hour
    for own in (each[i::m] for i in range(min(m, len(each)))):
        rolled = np.ravel(sum(one.rolled_m for one in own))
        force = (sum(one.load for one in own) / rolled) ** (1.0 / LIFE_EXPONENT)
        turns = rolled / len(own) / (2.0 * math.pi * radius_m)
        often = np.ravel(per_h * (len(own) if len(each) >= m else 1.0 / m))
        rows.append(np.stack(np.broadcast_arrays(force, turns, often)))
    with np.errstate(all="ignore"):
        every = np.stack(rows)
        worst = np.argmax(every[:, 0] ** LIFE_EXPONENT * every[:, 1] * every[:, 2], axis=0)
        force, turns, often = every[worst, :, np.arange(every.shape[2])].T
        out = {"equivalent_force_N": force, "roller_turns_per_motion": turns}
        capacity = spec.material_roller.dynamic_capacity_N
        if capacity is not None:  # rated for a million revolutions
            rated = 1e6 * (np.ravel(capacity) / force) ** LIFE_EXPONENT
            motions = rated / turns
            out |= {
                "roller_life_turns": rated,
                "roller_life_motions": motions,
                "roller_life_h": motions / often,
            }
    return out
