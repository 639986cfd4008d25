"""The worst effects of tolerances on motions and entries, for a batch of designs.

The other results of a study need random machines, which are an array already. A batch would save no
time there, so they are computed design by design.

    >>> import numpy as np
    >>> from geneva_cli import External, Tolerance
    >>> from geneva_cli.motion.many import many
    >>> from geneva_cli.motion.machine_spec import Spec
    >>> spec = Spec(External(6), tolerance=Tolerance(slot_angle_deg=0.1, crank_radius_mm=0.02))
    >>> batch = many(spec, {"wheel.z": np.array([4, 6])})
    >>> motion_plays(batch.machine).worst_deg.round(6)
    array([0.122925, 0.115281])
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.impacts.impacts import arm_mm
from geneva_cli.loads.impacts.shock import first_contacts
from geneva_cli.loads.tolerance.dimensions import corners, tolerances, without_effect
from geneva_cli.loads.tolerance.motion_error import MOTION_SAMPLES, WorstErrors, motion_errors
from geneva_cli.motion.batch import taken
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, blocks, joined, parameter


class MotionPlays(NamedTuple):
    """Greatest errors of wheels during a motion, each at its own place: (m,) each.

    NaN if tolerances are all 0, or too wide for a machine.
    """

    worst_deg: Array
    rss_deg: Array
    at_deg: Array


def used(mechanism: Mechanism) -> dict[str, float]:
    """Plus or minus of each dimension, 0 if it has no effect; (m, 1) for m designs."""
    return tolerances(mechanism.spec) | dict.fromkeys(without_effect(mechanism.spec), 0.0)


def motion_plays(mechanism: Mechanism) -> MotionPlays | None:
    """Greatest errors of m designs; None for curved slots, which are solved for."""
    errors, sizes = motion_errors(mechanism), list(used(mechanism).values())
    if not errors:
        return None
    m, machines = mechanism.designs, 2 ** sum(bool(np.any(size)) for size in sizes)
    # a million places of machines with deviations are computed together
    group = max(1, (1 << 20) // (machines * MOTION_SAMPLES))
    return joined([_of(taken(mechanism, b), b.stop - b.start) for b in blocks(m, group)])


def _of(mechanism: Mechanism, n: int) -> MotionPlays:
    use = used(mechanism)
    sizes = list(use.values())
    best = WorstErrors(*np.full((3, n), -1.0))
    rss, shown = np.zeros((2, n))
    known = sum(sizes) > np.zeros((n, 1))
    for engagement, error in zip(mechanism.engagements, motion_errors(mechanism), strict=True):
        worst = WorstErrors(*(np.resize(row, n) for row in error.greatest(corners(sizes))))
        more = worst.error > best.error
        best = worst.beyond(best)
        rss = np.maximum(rss, error.greatest_rss(sizes).error)
        at_deg = mechanism.shown_deg(parameter(engagement.mid_deg + worst.at_deg[:, None]))
        shown = np.where(more, np.ravel(at_deg), shown)
        both = use["center_distance_mm"] + use["crank_radius_mm"]
        known = known & (both < error.margin_mm(mechanism.spec, use))
    rows = (np.degrees(best.error), np.degrees(rss), shown)
    return MotionPlays(*(np.where(known[:, 0], row, np.nan) for row in rows))


def entry_jumps_worst(mechanism: Mechanism, use: Mapping[str, float]) -> Array | None:
    """Greatest jump of velocity at entry for any of the deviations, over the input's speed.

    (m,) for m designs; 0 if the roller always misses the slot's axis. None for slots and grooves
    that are solved for.
    """
    worst: Array | None = None
    for engagement in mechanism.engagements:
        crank = use["crank_radius_mm"] / arm_mm(mechanism, engagement)
        center = use["center_distance_mm"] / mechanism.center_distance_mm
        for one, other in product((-1.0, 1.0), repeat=2):
            contacts = first_contacts(engagement, one * crank, other * center)
            if contacts is None:
                return None
            jump = np.nan_to_num(abs(contacts.jump))
            worst = jump if worst is None else np.maximum(worst, jump)
    return worst
