"""Convexity of noncircular gears, since a hob cannot cut hollow ones."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared


def gear_convexity(name: str, mechanism: Mechanism) -> Check | None:
    """The least curvature of the driving or the driven gear."""
    gears = mechanism.spec.gears
    if not gears:
        return None
    from geneva_cli.layout.gear_curves import convexity

    least = convexity(gears)._asdict()[name.removesuffix("_gear_convexity")]
    return compared(name, least, "above", 0.0)
