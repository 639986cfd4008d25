"""The product on the dial: its acceleration, and whether it slips."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.analysis.product import ProductMotion


def acceleration(name: str, mechanism: Mechanism) -> Check | None:
    """The product's greatest acceleration, where ``[limits]`` bounds it."""
    limit = mechanism.spec.limits.product_acceleration_max_m_s2
    if limit is None:
        return None
    most, at_deg = _motion(mechanism).acceleration_m_s2
    return compared(name, most.item(), "at most", limit, at_deg.item())


def slipping(name: str, mechanism: Mechanism) -> Check | None:
    """The friction coefficient that holds the product, where ``[product]`` has its own."""
    friction = mechanism.spec.product.friction
    if friction is None or mechanism.spec.support.axis != "vertical":
        return None
    motion = _motion(mechanism)
    at_deg = motion.acceleration_m_s2.at_deg
    return compared(name, motion.friction_needed.item(), "at most", friction, at_deg.item())


def _motion(mechanism: Mechanism) -> ProductMotion:
    """The product's motion, which the quantities of the same design share."""
    from geneva_cli.verdict.quantities.designs import single  # for names alone, no numbers
    from geneva_cli.verdict.quantities.product import motion_of

    motion = single(mechanism).once(motion_of)
    assert motion is not None  # the spec refuses limit and friction without the product's place
    return motion
