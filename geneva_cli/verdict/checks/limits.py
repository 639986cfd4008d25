"""Limits of the spec for peaks, for loads, and for the product on the dial.

Peaks are derivatives by the input's radians.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peaks import worst, worst_of
from geneva_cli.spec import load_limits
from geneva_cli.verdict.checks.check import Check, compared

if TYPE_CHECKING:
    from geneva_cli.loads.product import ProductMotion


def limited_peak(name: str, mechanism: Mechanism) -> Check | None:
    """The peak that a key of ``[limits]`` bounds."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    values: dict[str, Callable[[Mechanism], float]] = {
        "velocity_max": lambda m: worst_of(m, "velocity").max,
        "acceleration_max": lambda m: worst_of(m, "acceleration").max,
        "acceleration_entry_max": lambda m: worst(m).ends.acceleration_entry,
        "jerk_max": lambda m: worst(m).jerk.max,
    }
    return compared(name, values[name](mechanism), "at most", limit)


def limited_load(name: str, mechanism: Mechanism) -> Check | None:
    """The load that a key of ``[limits]`` bounds, and its input angle."""
    limit = mechanism.spec.limits.as_dict()[name]
    if limit is None:
        return None
    from geneva_cli.verdict.quantities.batch_designs import (  # for names alone, none
        number_of,
        single,
    )
    from geneva_cli.verdict.quantities.load_quantities import greatest

    peaks, load = single(mechanism).columns(greatest), load_limits.limited_load(name)
    most, at_deg = peaks[f"{load}.max"], peaks[f"{load}.at_deg"]
    assert most is not None  # the spec refuses a limit without a load
    assert at_deg is not None
    return compared(name, number_of(most, 0), "at most", limit, number_of(at_deg, 0))


def product_acceleration(name: str, mechanism: Mechanism) -> Check | None:
    """The product's greatest acceleration, where ``[limits]`` bounds it."""
    limit = mechanism.spec.limits.product_acceleration_max_m_s2
    if limit is None:
        return None
    most, at_deg = _product_motion(mechanism).acceleration_m_s2
    return compared(name, most.item(), "at most", limit, at_deg.item())


def product_slip(name: str, mechanism: Mechanism) -> Check | None:
    """The friction coefficient that holds the product, where ``[product]`` has its own."""
    friction = mechanism.spec.product.friction
    if friction is None or mechanism.spec.support.axis != "vertical":
        return None
    motion = _product_motion(mechanism)
    at_deg = motion.acceleration_m_s2.at_deg
    return compared(name, motion.friction_needed.item(), "at most", friction, at_deg.item())


def _product_motion(mechanism: Mechanism) -> ProductMotion:
    """The product's motion, which the quantities of the same design share."""
    from geneva_cli.verdict.quantities.batch_designs import single  # for names alone, no numbers
    from geneva_cli.verdict.quantities.motion_quantities import product_motion_of

    motion = single(mechanism).once(product_motion_of)
    assert motion is not None  # the spec refuses limit and friction without the product's place
    return motion
