"""What motions leave of the swing of oscillators, each of which has a motion of its own.

The integrals are those of ``swing``, over pairs of an oscillator and a panel of its motion.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.vibration.panels import Panels
from geneva_cli.analysis.vibration.swing import (
    LARGE,
    PAIRS,
    SMALL,
    Swing,
    by_ends,
    by_powers,
    by_recurrence,
)

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Complex, Whole

MOST = 1 << 14  # pairs at a time, so that they stay in the cache


def residual_swing_of_many(panels: Panels, motion: Whole, swing: Swing) -> Complex:
    """What each motion leaves of its oscillator's swing, as of ``swing.residual_swing``: (n,).

    ``motion`` (n,) are the motions of the oscillators, by their numbers among the panels'.
    """
    out = np.empty(len(motion), dtype=complex)
    ends = panels.ends
    order = _orders(panels, motion, swing)
    for k in range(1, int(order.max(initial=0)) + 1):
        at = np.flatnonzero(order == k)
        count = np.cumsum((ends[1:] - ends[:-1])[motion[at]])
        start = 0
        while start < len(at):
            done = count[start - 1] if start else 0
            stop = max(start + 1, int(np.searchsorted(count, done + MOST, side="right")))
            part = at[start:stop]
            some = Swing(swing.ratio[part], swing.damping[part])
            p = some.p
            # By parts: a derivative more, where it vanishes at both ends, is worth a factor p.
            out[part] = -_integral(panels, k, motion[part], some) * p ** (2 - k) / p.imag
            start = stop
    return out


def _orders(panels: Panels, motion: Whole, swing: Swing) -> Whole:
    """Which derivative, 1 or higher, is best integrated: rounding is a share of its greatest."""
    best = np.ones(len(motion), dtype=np.intp)
    omega = 2.0 * np.pi * swing.ratio
    with np.errstate(all="ignore"):
        for k in range(2, len(panels.greatest) + 1):
            rate = (panels.greatest[k - 1] / panels.greatest[k - 2])[motion]
            best[(k <= panels.smooth[motion] + 1) & (omega > rate)] = k
    return best


def _integral(panels: Panels, order: int, motion: Whole, swing: Swing) -> Complex:
    """Integrals of a derivative of each oscillator's motion."""
    of, panel, first = panels.paired(motion)
    p, h = swing.p[of], panels.half[panel]
    each = Swing(swing.ratio[of], swing.damping[of])
    series = panels.series[order - 1, panel]
    # Without damping q = -i omega h, and all recurrences are real ones of omega h.
    unit = 1.0 if swing.damping.any() else -1j
    size = np.abs(p) * h
    reduced = -p * h if unit == 1.0 else size
    found = np.empty(len(of), dtype=complex)
    after = each.after(1.0 - panels.right[panel])
    large = size >= LARGE
    for here, moments in (
        (size < SMALL, by_powers),
        ((size >= SMALL) & ~large, by_recurrence),
    ):
        if here.any():
            found[here] = moments(reduced[here], unit, series[here], PAIRS) * h[here] * after[here]
    if large.any():
        some = Swing(each.ratio[large], each.damping[large])
        one, other = by_ends(reduced[large], unit, series[large], PAIRS)
        both = some.after(1.0 - panels.left[panel[large]]) * one + after[large] * other
        found[large] = both / p[large]
    return np.add.reduceat(found, first)
