"""The solids of a machine, those of one kind together."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeAlias

from geneva_cli.geometry.plates import Part, Plate, Shell, Solid, solids

Kind: TypeAlias = Solid | tuple[str, str] | tuple[Plate, float]


def alike(parts: Iterable[Part]) -> list[list[Solid]]:
    """Return the solids of some parts: a list for each kind, in the order of its first one.

    Plates of one kind may lie at different heights.
    """
    kinds: dict[Kind, list[Solid]] = {}
    for solid in (one for part in parts for one in solids(part)):
        kinds.setdefault(_kind(solid), []).append(solid)
    return list(kinds.values())


def _kind(solid: Solid) -> Kind:
    """Return what is equal for solids of one kind."""
    if isinstance(solid, Shell):
        # shells of one kind lie at different places, and may differ by rounding
        return solid.name, f"{solid.volume:.9g}"
    if isinstance(solid, Plate) and not solid.cross:
        # thicknesses are differences of heights: to a nanometre
        return solid._replace(low=0.0, high=0.0), round(solid.thickness, 6)
    return solid
