"""The direction of the wheel's motion."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared
from geneva_cli.verdict.motion_warnings import turns_back


def least_velocity(name: str, mechanism: Mechanism) -> Check | None:
    """The least velocity of a wheel that follows a law, 0 if it never turns back."""
    if mechanism.law is None:
        return None
    value, at_deg = turns_back(mechanism) or (0.0, None)
    return compared(name, value, "at least", 0.0, at_deg)
