"""The distance of a curved slot's entry and exit branches.

If it exceeds the slot's width, an island between them falls out.
"""

from __future__ import annotations

import numpy as np

from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check, compared


def apart(name: str, parts: FlatParts) -> Check | None:
    """The greatest distance where the branches are on their own sides."""
    return _greatest(name, parts, 1.0)


def crossed(name: str, parts: FlatParts) -> Check | None:
    """The greatest distance where the branches have crossed."""
    return _greatest(name, parts, -1.0)


def _greatest(name: str, parts: FlatParts, side: float) -> Check | None:
    outlines = parts.outlines
    engagement = outlines.assembly.slots[0][0]
    if not engagement.slot.curved:
        return None
    samples = 400
    t = engagement.entry_deg * (1.0 - np.arange(samples) / samples)
    (x, y), (u, v) = (engagement.slot(s * t, 0) for s in (1.0, -1.0))
    turn = np.remainder(
        np.arctan2(y.c[0], x.c[0]) - np.arctan2(v.c[0], u.c[0]) + np.pi, 2.0 * np.pi
    )
    gap = 2.0 * outlines.assembly.L * np.hypot(x.c[0], y.c[0]) * np.sin(0.5 * (turn - np.pi)) * side
    i = int(np.argmax(gap))
    at_deg = outlines.assembly.full.shown_deg(engagement.mid_deg + float(t[i]))
    return compared(
        name, max(float(gap[i]), 0.0), "at most", 2.0 * outlines.sizes.half_width, at_deg
    )
