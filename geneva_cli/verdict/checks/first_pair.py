"""Stresses of the first of two wheels in series and of its crank, under their load.

They are the checks of a machine of one wheel (``strength``), made of that first pair.
"""

from __future__ import annotations

from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.verdict.checks.check import Check
from geneva_cli.verdict.checks.registry import LIMITS, check_named


def first_stress(name: str, parts: FlatParts) -> Check | None:
    """A stress of the first pair; None for a machine without one, or without a load."""
    front = parts.front if parts.mechanism.spec.is_loaded else None
    if front is None:
        return None
    check = check_named(LIMITS, name.removeprefix("first_"), front.mechanism)
    if check is None:
        return None
    # its sizes are those of links; its angles are counted from another motion of the first wheel
    why = check.why.replace("arm_thickness_mm", "link_thickness_mm")
    why = why.replace("the crank's shaft", "the first crank's shaft")
    return check._replace(name=name, at_deg=None, why=why)
