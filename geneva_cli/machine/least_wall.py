"""The least wall between two holes or edges of a part."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.numerics.arrays import larger
from geneva_cli.spec.default_sizes import value_or
from geneva_cli.spec.workshops import workshop

if TYPE_CHECKING:
    from geneva_cli.spec.tables import Size


def wall_min(size: Size, L: float) -> float:
    """Return the least wall that ``check`` lets pass, mm; (m, 1) for m designs."""
    return value_or(size.wall_min_mm, larger(L / 200.0, workshop(size.process).wall_mm))
