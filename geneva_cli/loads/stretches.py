"""Division of the motion into stretches in which its loads are smooth.

Loads have a kink or a jump where a sign changes, and at breaks of the motion itself. The signs are
those of the torque (the roller then bears on the other wall), of the sliding (friction reverses)
and of the input's torque.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.loads.contact import NEAR_CUSP, contact
from geneva_cli.loads.forces import NEGLIGIBLE, LoadCase, wheel_torque
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.peak_search import motion_peaks, spans
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask
from geneva_cli.numerics.extremes import Stretches
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.roots import root

# The greatest fraction of the step between two adjacent angles: the loads then keep six digits.
FEWEST_DIGITS = 1e-10


def spans_of(engagement: Engagement, n: int) -> list[tuple[Array, Array]]:
    """Ends of the smooth parts of a motion, one after the other: (n, 1) each."""
    places, out = engagement.motion.breaks(n), []
    for (a, b), (start, end) in zip(pairwise(places), spans(engagement.motion, n), strict=True):
        if engagement.slot.curved:
            start = np.where(a == 0.0, NEAR_CUSP * engagement.exit_deg, start)
            end = np.where(b == 0.0, NEAR_CUSP * engagement.entry_deg, end)
        out.append((start, end))
    return out


def smooth_ranges(engagement: Engagement) -> list[tuple[float, float]]:
    """Ends of the smooth parts of one design's motion, clear of the breaks between them."""
    return [(start.item(), end.item()) for start, end in spans(engagement.motion, 1)]


def to_mid_motion(engagement: Engagement, stretches: Stretches, n: int) -> Stretches:
    """Stretches extended to the mid-motion of a curved slot, where searches stop short."""
    if not engagement.slot.curved:
        return stretches
    x = stretches.x
    for end in (engagement.entry_deg, engagement.exit_deg):
        near = np.broadcast_to(np.ravel(NEAR_CUSP * end), n)[stretches.design]
        x = np.where(x == near, 0.0, x)
    return stretches._replace(x=x)


class Stretch(NamedTuple):
    """Input angles between which the loads are smooth, and the signs that they have there."""

    start: float
    end: float
    drives: float  # sign of the wheel's torque
    slides: float  # sign of the sliding
    feeds: float  # sign of the input's torque: 1 if it drives the machine, -1 if it is driven


def whole(
    engagement: Engagement, case: LoadCase, kinds: Sequence[str], result: Stretches
) -> list[Stretch]:
    """The stretches of one design's motion without gaps, from those of a search."""
    signs = dict(zip(kinds, np.where(result.positive, 1.0, -1.0), strict=True))
    one = np.ones(len(result.design))
    of = (signs.get(kind, one).tolist() for kind in ("drives", "slides", "feeds"))
    every = [Stretch(*row) for row in zip(*result.x.tolist(), *of, strict=True)]
    pieces = every[:1]
    for piece, (last, span) in zip(every[1:], pairwise(result.span), strict=True):
        # only signs that do not matter here divide them
        if span == last and piece[2:] == pieces[-1][2:]:
            pieces[-1] = pieces[-1]._replace(end=piece.end)
        else:
            pieces.append(piece)
    cuts = [engagement.entry_deg]
    cuts += [_between(engagement, case, *both) for both in pairwise(pieces)]
    cuts.append(engagement.exit_deg)
    placed = zip(pieces, pairwise(cuts), strict=True)
    return [p._replace(start=a, end=b) for p, (a, b) in placed if a < b]


def _between(engagement: Engagement, case: LoadCase, before: Stretch, after: Stretch) -> float:
    """The place between two stretches: a break, or a change of sign near it."""
    a, b = before.end, after.start
    if b - a > NEAR_CUSP * engagement.motion_deg * 1e-3 and before.drives != after.drives:

        def torque(travel: float) -> tuple[float, float]:
            at = contact(engagement, a + travel, 1, reactions=False)
            value, rise = wheel_torque(case, at).scalars()
            return value, rise * DEGREE

        if torque(0.0)[0] * torque(b - a)[0] < 0.0:
            return a + root(torque, 0.0, b - a)
    return min(max(a, 0.0), b) if a * b <= 0.0 else float(on_breaks(np.array([a]), engagement)[0])


def on_breaks(x: Array, engagement: Engagement) -> Array:
    """Places of designs, replaced by the breaks that they equal apart from rounding: (..., n)."""
    near = NEGLIGIBLE * np.ravel(engagement.motion_deg)
    for place in engagement.motion.breaks_deg:
        at = np.ravel(place)
        x = np.where(np.abs(x - at) <= near, at, x)
    return x


def refuse_noise(integrals: Sequence[Array | None]) -> None:
    """Raise GenevaError for integrals of noise, which ``span_integrals`` returns as NaN."""
    if any(total is not None and np.isnan(total).any() for total in integrals):
        raise GenevaError(
            "the loads change within the last digits of the input angle, so that their means would "
            "be rounding: make the drive more even",
            ("drive", "kind"),
        )


@lru_cache(maxsize=16)  # the cycle, the strength and the checks of a design need the same answer
def refuse_rounding(engagements: tuple[Engagement, ...]) -> None:
    """Raise GenevaError for a design that is too fast for the digits of its angles."""
    for engagement in engagements:
        (fastest,), (fraction,) = _digits(engagement)
        if fraction > FEWEST_DIGITS:
            raise GenevaError(
                f"the wheel moves {fastest:.2g} times as fast as the input. The last digit of the "
                f"input angle is {fraction:.1g} of its step, so the loads would be rounding. Make "
                "the drive more even (elliptical gears: an eccentricity up to 0.999999)",
                ("drive", "kind"),
            )


def too_fast(engagements: Sequence[Engagement]) -> Mask:
    """True for designs whose motion is too fast for the digits of its angles: (m,) or (1,)."""
    fractions = [_digits(engagement)[1] for engagement in engagements]
    return np.asarray(np.max(np.broadcast_arrays(*fractions), axis=0) > FEWEST_DIGITS)


def _digits(engagement: Engagement) -> tuple[Array, Array]:
    """The greatest velocity, and the step between two adjacent angles there over the whole step."""
    fastest = motion_peaks(engagement.motion, ["velocity"])["velocity"].max
    furthest = np.fmax(np.abs(engagement.entry_deg), np.abs(engagement.exit_deg))
    step = np.ravel(np.spacing(furthest) * DEGREE / (2.0 * np.asarray(engagement.half_step)))
    return fastest, fastest * step
