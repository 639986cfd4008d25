"""Lengths and angles as texts on a drawing sheet."""

import math

from geneva_cli.table import in_decimals


def length(value: float, decimals: int = 3) -> str:
    """Return a value, such as a length in mm, as text without trailing zeros."""
    return in_decimals(value, decimals)


def degrees(angle: float, decimals: int = 3) -> str:
    """Return an angle in radians as degrees."""
    return f"{length(math.degrees(angle), decimals)}°"


def signed(mm: float) -> str:
    """Return a limit deviation with its sign; 0 without one.

    >>> signed(0.021), signed(-0.02), signed(0.0)
    ('+0.021', '-0.02', '0')
    """
    return f"{mm:+g}" if mm else "0"
