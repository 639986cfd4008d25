"""The first contact of a roller with a wheel at rest, as it enters a slot or leaves in reverse.

A wheel whose rim reaches the roller is met by a wall of the slot: then the roller's centre is off
the slot's middle by the clearance. A shorter rim is met later, by the corner of the mouth or by the
rim beside it, and the roller is farther off.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array, scalar
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.turn.machine_parts import MachineParts

POSITIONS = 65  # from an end of a motion to its middle, a degree or so of the input apart
# From entry to exit, of a slot's middle. Its chords are within 1e-6 of the centre distance, half of
# what counts as touching.
SAMPLES = 721


class FirstContact(NamedTuple):
    """A roller's offset from the slot's middle beyond the clearance, mm, and its input angle."""

    offset_mm: float
    at_deg: float


def first_contact(parts: MachineParts) -> FirstContact:
    """Return the first contact that is farthest off its slot's middle.

    Each kind of motion has one, at entry or at exit: where the roller comes nearer to the rim's
    inside. At the other end no rim reaches it that lets it pass at both.
    """
    motions: dict[Engagement, int] = {}
    for i, (engagement, _) in enumerate(parts.assembly.motions):
        motions.setdefault(engagement, i)
    contacts = [
        _contact(parts, i, _tighter_end(parts, engagement)) for engagement, i in motions.items()
    ]
    return max(contacts, key=lambda contact: contact.offset_mm)


def _tighter_end(parts: MachineParts, engagement: Engagement) -> float:
    """Return the end of a motion that limits the rim, as in ``mouth``: -1 for entry, 1 for exit.

    The mouth of an offset slot has a corner for each end, and the rim is at the farther one.
    """
    ahead = scalar(engagement.exit_reach) - scalar(engagement.entry_reach)
    farther = -1.0 if engagement.slot.offset else parts.assembly.sign
    return 1.0 if farther * ahead < -SAME_LENGTH else -1.0


def _contact(parts: MachineParts, motion: int, end: float) -> FirstContact:
    """Return the first contact of a motion's roller at entry (-1) or, in reverse, at exit (1)."""
    assembly, gaps = parts.assembly, parts.gaps
    engagement, mid = assembly.motions[motion]
    start = mid + engagement.end_deg(end)
    rest = assembly.wheel(np.array([start]))
    before = sum(len(one.engagement.passages) for one in assembly.motions[:motion])
    own = slice(before, before + len(engagement.passages))

    def margin(at: Array) -> Array:
        """Return the gaps of the motion's rollers to the wheel at rest, mm."""
        pose = gaps.pose(at)
        gap: Array = gaps.rollers(pose, rest - pose.wheel)[:, own].min(axis=1)
        return gap - parts.close

    if margin(np.array([start]))[0] <= 0.0:  # the roller is in the slot's middle there
        return FirstContact(0.0, start)
    at = np.linspace(start, mid, POSITIONS)
    meets = margin(at) <= 0.0
    first = int(np.argmax(meets)) if meets.any() else POSITIONS - 1
    x = boundary_by_sections(margin, at[first - 1], at[first])
    place = np.array([x])
    if parts.past_mouth(motion, place)[0] >= 0.0:  # a wall meets it, no corner
        return FirstContact(0.0, x)
    roller = parts.in_wheel(motion, place, rest - assembly.wheel(place))
    whole = mid + np.linspace(engagement.entry_deg, engagement.exit_deg, SAMPLES)
    middle = parts.in_wheel(motion, whole)
    off = _distance(roller[0], middle) - (parts.sizes.half_width - parts.sizes.roller)
    return FirstContact(off if off > parts.contact else 0.0, x)


def _distance(point: Array, line: Array) -> float:
    """Return the distance of a point from a line through points (n, k)."""
    start, step = line[:-1], np.diff(line, axis=0)
    # a roller that stops takes steps of no length
    square = np.maximum((step * step).sum(axis=1), 1e-300)
    along = np.clip(((point - start) * step).sum(axis=1) / square, 0.0, 1.0)
    return float(np.linalg.norm(start + along[:, None] * step - point, axis=1).min())
