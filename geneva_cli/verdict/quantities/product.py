"""The product on the dial: travel, speed, acceleration, jerk, slipping and swinging."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.analysis.product import ProductMotion, product_motion

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.verdict.quantities.designs import Columns, Designs


def motion_of(of: Designs) -> ProductMotion | None:
    """The motion of the products; None if their place is not known."""
    return product_motion(of.machine)


def product(of: Designs) -> Columns:
    """The product's motion; None without its place. Infinite where a design has no value."""
    motion = of.once(motion_of)
    if motion is None:
        return {}
    out: dict[str, Number | None] = {}
    for name, value in motion._asdict().items():
        if isinstance(value, tuple):
            out[f"{name}.max"], out[f"{name}.at_deg"] = value
        else:
            out[name] = np.where(np.isnan(value), np.inf, value)
    return out
