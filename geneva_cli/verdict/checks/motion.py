"""The wheel's motion: the dwell between two steps, its direction, and the gears in front of it."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared
from geneva_cli.verdict.motion_warnings import turns_back


def shortest_dwell(name: str, mechanism: Mechanism) -> Check:
    """The shortest dwell, degrees of the input: below 0 a roller enters before another has left."""
    least = min(mechanism.dwell_deg(i) for i in range(len(mechanism.engagements)))
    return compared(name, least, "at least", 0.0)


def least_velocity(name: str, mechanism: Mechanism) -> Check | None:
    """The least velocity of a wheel that follows a law, 0 if it never turns back."""
    if mechanism.law is None:
        return None
    value, at_deg = turns_back(mechanism) or (0.0, None)
    return compared(name, value, "at least", 0.0, at_deg)


def gear_convexity(name: str, mechanism: Mechanism) -> Check | None:
    """The least curvature of the driving or the driven gear."""
    gears = mechanism.spec.gears
    if not gears:
        return None
    from geneva_cli.layout.gear_curves import convexity

    least = convexity(gears)._asdict()[name.removesuffix("_gear_convexity")]
    return compared(name, least, "above", 0.0)
