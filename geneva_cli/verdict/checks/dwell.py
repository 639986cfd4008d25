"""The dwell between two steps."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared


def shortest_dwell(name: str, mechanism: Mechanism) -> Check:
    """The shortest dwell, degrees of the input: below 0 a roller enters before another has left."""
    least = min(mechanism.dwell_deg(i) for i in range(len(mechanism.engagements)))
    return compared(name, least, "at least", 0.0)
