"""The search for peaks of motions, a single design as a batch of one.

A peak is a root of the next derivative, an end or a break, refined to the last bit.
"""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from geneva_cli.motion.batch import designs_in, selection, taken
from geneva_cli.motion.engagement import Engagement, Peak, WheelMotion
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Which, array, parameter
from geneva_cli.numerics.extremes import SearchResult, Smooth, search
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.tolerances import TIE

ORDERS = {"velocity": 1, "acceleration": 2, "jerk": 3, "power": 2}  # derivatives in the quantity
QUANTITIES = tuple(ORDERS)


PeakArray: TypeAlias = Peak[Array]  # the peaks of m designs: (m,)


def curves(motion: WheelMotion, quantities: Sequence[str]) -> Smooth:
    """Quantities of motions over the input angle in degrees."""
    some = selection(motion)

    def jets(x: Array, which: Which, order: int, requested: Sequence[int]) -> list[Jet]:
        names = [quantities[i] for i in requested]
        velocity = some(which).rate(x, max(ORDERS[name] for name in names) - 1 + order)
        out = []
        for name in names:
            jet = velocity
            for _ in range(1, ORDERS[name]):
                jet = jet.derivative()
            out.append(velocity.lower * jet if name == "power" else jet)
        return out

    return Smooth(jets, len(quantities), unit=DEGREE)


def spans(motion: WheelMotion, m: int) -> list[tuple[Array, Array]]:
    """Ends of the smooth parts of m motions, (m, 1) each, clear of the breaks between them.

    A function may jump at the breaks. They are known to a fraction ``breaks_to`` of the motion, but
    0 is exact. The value at a break itself belongs to the part before it, so that the part after it
    begins at least one double later.
    """
    begin, *inner, last, _ = np.broadcast_arrays(*motion.breaks_deg, np.empty((m, 1)))
    blur, out = motion.breaks_to * (last - begin), []
    for x in inner:
        clear = np.where(x == 0.0, 0.0, blur)
        out.append((np.minimum(begin, last), np.maximum(begin, x - clear)))
        # beyond 0 the next double would become 0 again where it is scaled
        with np.errstate(under="ignore"):  # of 0, which is replaced
            beyond = np.where(x == 0.0, 1e-300, np.nextafter(x, np.inf))
        begin = np.maximum(beyond, x + clear)
    return [*out, (np.minimum(begin, last), np.maximum(begin, last))]


def pole_deg(even: Jet) -> Array:
    """Distance from mid-motion of a function's nearest pole, degrees, from its jet near there."""
    return np.sqrt(np.abs(array(even.c[0]) / even.c[2])) / DEGREE


def search_motion(motion: WheelMotion, f: Smooth, sized: bool = True) -> SearchResult:
    """The greatest sizes of functions over motions, or their greatest and least values."""
    m = designs_in(motion)
    parts = spans(motion, m)
    if motion.symmetric and sized:
        parts = [(a, b) for a, b in parts if np.all(b <= 0.0)]
    with np.errstate(all="ignore"):
        w = pole_deg(motion.rate(0.01 * array(motion.exit_deg), 2))
        w = np.fmin(np.where(w > 0.0, w, np.inf), 10.0 * motion.exit_deg) + 0.0 * parts[0][0]
    return search(f, parts, sized, w=w)


def motion_peaks(
    motion: WheelMotion, quantities: Sequence[str] = QUANTITIES
) -> dict[str, PeakArray]:
    """Greatest sizes over the motions of m designs, ends included, and their input angles."""
    peaks: dict[str, PeakArray] = {}
    for name in quantities:
        known = motion.closed_peak(name)
        if known is not None:
            peaks[name] = PeakArray(*(np.ravel(v) for v in np.broadcast_arrays(*known)))
    sought = [name for name in quantities if name not in peaks]
    if sought:
        peaks |= search_peaks(motion, sought)
    for name, peak in peaks.items():
        open_ = np.flatnonzero(np.isnan(peak.max))
        if len(open_):
            rest = search_peaks(taken(motion, open_), [name])[name]
            peak.max[open_], peak.at_deg[open_] = rest
    return peaks


def search_peaks(motion: WheelMotion, quantities: Sequence[str]) -> dict[str, PeakArray]:
    """The peaks from the search only, without closed forms; NaN for designs that are NaN."""
    most, x, _ = search_motion(motion, curves(motion, quantities))
    most = np.where(most < 0.0, np.nan, most)
    return dict(zip(quantities, map(PeakArray, most, x), strict=True))


def greater(first: PeakArray, other: PeakArray) -> PeakArray:
    """The greater of two sizes; if they are equal, at the place of the first."""
    most = np.where(other.max > first.max, other.max, first.max)
    more = other.max > first.max * (1.0 + TIE)
    return PeakArray(most, np.where(more, other.at_deg, first.at_deg))


def braking(engagement: Engagement) -> float:
    """Greatest -psi2 of a motion; (m, 1) for m designs."""
    motion = engagement.motion
    most = search_motion(motion, curves(motion, ["acceleration"]), sized=False).most[1]
    return float(most[0]) if isinstance(motion.entry_deg, float) else parameter(most[:, None])
