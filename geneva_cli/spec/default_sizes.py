"""Values of the spec or their defaults, and the record of thicknesses."""

from __future__ import annotations

from typing import NamedTuple


class Thicknesses(NamedTuple):
    """The parts' thicknesses along the axis, mm."""

    wheel: float
    lock: float
    arm: float
    link: float


def value_or(value: float | None, default: float) -> float:
    """Return a value of the spec, or else the default."""
    return default if value is None else value


def half_or(diameter: float | None, default: float) -> float:
    """Return half of a diameter, or the default radius if that is None."""
    return default if diameter is None else 0.5 * diameter


def unrounded(length: float) -> float:
    """Return a length as it is: a batch has arrays of sizes, which nobody rounds."""
    return length
