"""How far the input's work swings about its mean: what a flywheel has to take up and give back."""

from __future__ import annotations

from bisect import bisect
from collections.abc import Iterable
from itertools import accumulate, pairwise
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.loads.contact import contact
from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.analysis.loads.instant import Instant, values
from geneva_cli.analysis.loads.means import TORQUE, means_of
from geneva_cli.analysis.loads.stretches import stretches, whole
from geneva_cli.analysis.loads.zeros import zeros
from geneva_cli.machine.engagement import Engagement
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.quadrature import integral_of_each

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Whole
    from geneva_cli.numerics.jet import Array
    from geneva_cli.numerics.scan import Scan


NOUGHT = 1e-26  # a mean whose square is so small a share of the mean square is rounding


def fluctuation_J(cycle: Cycle) -> float:
    """Greatest minus least of the input's cumulated work less its mean line over a period.

    The work turns where the torque is its mean: there the motions are cut, and the torque is
    integrated between. Of inertia alone it is I w² psi1max²/2. Infinite where the torque's
    integral is.
    """
    found = means_of(cycle).get(TORQUE)
    if found is None or not np.isfinite(found.square):
        return float("inf")
    # of inertia alone the mean is nothing but rounding
    mean = found.mean if found.mean**2 > NOUGHT * found.square else 0.0
    parts, end = [], None
    for engagement, samples in zip(cycle.mechanism.engagements, cycle.samples[TORQUE], strict=True):
        if end is not None:
            parts.append(-mean * (engagement.mid_deg + engagement.entry_deg - end) * DEGREE)
        parts += [work - mean * way for work, way in _work(cycle, engagement, samples, mean)]
        end = engagement.mid_deg + engagement.exit_deg
    return swing(parts)


def swing(parts: Iterable[float]) -> float:
    """Greatest minus least of the sums of parts from the first on.

    >>> swing([2.0, -5.0, 3.0])
    5.0
    """
    sums = [0.0, *accumulate(parts)]
    return max(sums) - min(sums)


def flywheel_kgm2(energy_J: float, speed_variation: float, w: float) -> float:
    """Inertia that keeps a mean speed, rad/s, within a share of it: dE / (Cs w²).

    >>> round(flywheel_kgm2(15125.0, 0.02, 1200.0 * DEGREE), 2)  # 1200 degrees a second
    1724.04
    """
    return energy_J / (speed_variation * w * w)


def _work(
    cycle: Cycle, engagement: Engagement, samples: Scan, mean: float
) -> list[tuple[float, float]]:
    """Work in joules and input angle in radians, between places where the torque is its mean."""
    given = cycle.given
    pieces = whole(engagement, given)
    ends = [piece.start for piece in pieces]
    # where the mean is nothing the torque changes sign, and there the pieces are cut already
    crossed = _crossings(cycle, engagement, samples, mean).tolist() if mean else []
    places = sorted({*ends, *crossed, pieces[-1].end})
    spans = list(pairwise(places))
    of = np.array([bisect(ends, 0.5 * (a + b)) - 1 for a, b in spans])
    signs = np.array([piece[2:] for piece in pieces]).T

    def torque(x: Array, span: Whole) -> Array:
        at = contact(engagement, x, reactions=False)
        return values(Instant(given, at, *signs[:, of[span]])).input_torque_Nm

    works = integral_of_each(torque, spans)
    return [(work * DEGREE, (b - a) * DEGREE) for work, (a, b) in zip(works, spans, strict=True)]


def _crossings(cycle: Cycle, engagement: Engagement, samples: Scan, mean: float) -> Array:
    """Input angles at which the torque is its mean, from the engagement's mid-motion.

    ``samples`` are those among which its greatest and least values were looked for.
    """
    given = cycle.given
    pieces = stretches(engagement, given)
    signs = np.array([piece[2:] for piece in pieces]).T

    def above(x: Array, span: Whole) -> tuple[Array, Array]:
        at = contact(engagement, x, 1, reactions=False)
        value, slope = Instant(given, at, *signs[:, span]).input_torque_Nm.arrays()
        return value - mean, slope * DEGREE

    found = samples._replace(value=samples.value - mean)
    before, after = found.changes(0)
    return zeros(
        lambda x, which: above(x, found.span[before[which]]), found, 0 * before, before, after
    )
