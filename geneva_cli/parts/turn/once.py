"""What of a whole turn repeats itself, looked at once."""

from __future__ import annotations

from geneva_cli.parts.turn.turned import Turned


def looked_at_once(parts: Turned) -> Turned:
    """The parts, of whose turn no more is looked at than the first of rollers that all move alike
    goes through: its motion and the dwell after it.

    For a verdict: places of what fails are those of the first motion, and values may differ from
    those of the whole turn by rounding.
    """
    assembly = parts.assembly
    motions, m = assembly.motions, assembly.mechanism.spec.drive.rollers
    one = len(assembly.mechanism.engagements) == 1
    alike = one and len(motions) == len(assembly.rollers) == m > 1
    if not (alike and parts.gaps.repeats(m)):
        return parts
    once = assembly._replace(motions=motions[:1], span_deg=assembly.turn_deg / m)
    return parts.over(once)
