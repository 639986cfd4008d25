"""Undercut of a curved slot's walls."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared
from geneva_cli.verdict.motion_warnings import SHOWN_UNDERCUT


def undercut_depth(name: str, mechanism: Mechanism) -> Check | None:
    """The depth of the undercut, mm; 0 if there is none."""
    if not mechanism.engagements[0].slot.curved:
        return None
    from geneva_cli.analysis.undercut import undercut

    place = undercut(mechanism)
    depth, at_deg = (place.depth_mm, place.at_deg) if place else (0.0, None)
    return compared(name, depth, "at most", SHOWN_UNDERCUT, at_deg)
