"""Reduction of a full turn to one motion, where all motions are equal."""

from __future__ import annotations

from typing import TypeVar

from geneva_cli.parts.turn.machine_parts import MachineParts

Parts = TypeVar("Parts", bound=MachineParts)


def one_motion(parts: Parts) -> Parts:
    """Return the parts, checked over one motion and its dwell if all rollers move alike.

    Otherwise the parts are returned unchanged. This is for pass or fail: input angles refer to the
    first motion, and values may differ from those of the whole turn by rounding.
    """
    assembly = parts.assembly
    motions, m = assembly.motions, assembly.mechanism.spec.drive.rollers
    one = len(assembly.mechanism.engagements) == 1
    alike = one and len(motions) == len(assembly.rollers) == m > 1
    if not (alike and parts.gaps.repeats(m)):
        return parts
    once = assembly._replace(motions=motions[:1], span_deg=assembly.turn_deg / m)
    return parts.over(once)
