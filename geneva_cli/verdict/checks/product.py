"""The product on the dial: its acceleration, and whether it slips."""

from __future__ import annotations

from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.verdict.checks.check import Check, compared


def acceleration(name: str, mechanism: Mechanism) -> Check | None:
    """The product's greatest acceleration, where ``[limits]`` bounds it."""
    limit = mechanism.spec.limits.product_acceleration_max_m_s2
    if limit is None:
        return None
    from geneva_cli.analysis.product import product_motion  # who asks for names needs no numbers

    motion = product_motion(mechanism)
    assert motion is not None  # the spec refuses the limit without the product's place
    most, at_deg = motion.acceleration_m_s2
    return compared(name, most.item(), "at most", limit, at_deg.item())


def slipping(name: str, mechanism: Mechanism) -> Check | None:
    """The friction coefficient that holds the product, where ``[product]`` has its own."""
    friction = mechanism.spec.product.friction
    if friction is None or mechanism.spec.support.axis != "vertical":
        return None
    from geneva_cli.analysis.product import product_motion

    motion = product_motion(mechanism)
    assert motion is not None  # the spec refuses friction without the product's place
    return compared(
        name,
        motion.friction_needed.item(),
        "at most",
        friction,
        motion.acceleration_m_s2.at_deg.item(),
    )
