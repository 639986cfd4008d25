"""Lengths, in millimetres or inches, and angles as texts on a drawing sheet."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from geneva_cli.table import in_decimals

# The unit of the sheet that is being drawn, and its size in mm. Each thread has its own.
_unit: ContextVar[tuple[str, float]] = ContextVar("unit", default=("mm", 1.0))


@contextmanager
def writing_in(units: str) -> Iterator[None]:
    """Write the lengths of sheets in ``units``, mm or inch, within the block.

    >>> with writing_in("inch"):
    ...     length(20.0), length(20.0, fine=True), unit()
    ('0.787', '0.7874', 'in')
    """
    before = _unit.set(("mm", 1.0) if units == "mm" else ("in", 25.4))
    try:
        yield
    finally:
        _unit.reset(before)


def unit() -> str:
    """Return the unit's sign."""
    return _unit.get()[0]


def is_metric() -> bool:
    """Return True if lengths are in millimetres."""
    return unit() == "mm"


def number(value: float, decimals: int = 3) -> str:
    """Return a value as text, without trailing zeros.

    >>> number(173.20508), number(20.0)
    ('173.205', '20')
    """
    return in_decimals(value, decimals)


def degrees(angle: float, decimals: int = 3) -> str:
    """Return an angle in radians as degrees.

    >>> degrees(0.5)
    '28.648°'
    """
    return f"{number(math.degrees(angle), decimals)}°"


def length(mm: float, fine: bool = False) -> str:
    """Return a length, to 0.001 of its unit; in inches to 0.0001 if it is a ``fine`` one.

    >>> length(173.20508)
    '173.205'
    """
    return number(mm / _unit.get()[1], 3 if is_metric() or not fine else 4)


def coordinate(mm: float) -> str:
    """Return a coordinate of a table of points, with all its zeros; in inches to 0.0001.

    >>> coordinate(-0.00001), coordinate(12.5)
    ('0.000', '12.500')
    """
    decimals = 3 if is_metric() else 4
    return f"{round(mm / _unit.get()[1], decimals) + 0.0:.{decimals}f}"


def quantity(value: float, of: str, decimals: int = 3) -> tuple[str, str]:
    """Return a value and its unit as texts; a length is in the sheet's unit.

    >>> quantity(30.0, "deg"), quantity(5.0, "mm")
    (('30', 'deg'), ('5', 'mm'))
    """
    if of == "mm" and not is_metric():
        return length(value, fine=decimals > 3), unit()
    return number(value, decimals), of


def deviation(mm: float) -> str:
    """Return the size of a deviation without its sign, in inches to 0.0001.

    >>> deviation(0.02)
    '0.02'
    """
    return f"{mm:g}" if is_metric() else number(mm / 25.4, 4)


def signed(mm: float) -> str:
    """Return a limit deviation with its sign; 0 without one.

    >>> signed(0.021), signed(-0.02), signed(0.0)
    ('+0.021', '-0.02', '0')
    """
    text = deviation(abs(mm))
    return text if text == "0" else ("+" if mm > 0.0 else "-") + text
