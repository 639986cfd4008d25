"""The solids of a machine, those of one kind together."""

from __future__ import annotations

from collections.abc import Iterable

from geneva_cli.curves.plates import Part, Plate, Shell, solids


def alike(parts: Iterable[Part]) -> list[list[Plate | Shell]]:
    """Return the solids of some parts: a list for each kind, in the order of its first one."""
    kinds: dict[Plate | tuple[str, str], list[Plate | Shell]] = {}
    for solid in (one for part in parts for one in solids(part)):
        # Shells of one kind lie at different places, and may differ by rounding.
        kind = solid if isinstance(solid, Plate) else (solid.name, f"{solid.volume:.9g}")
        kinds.setdefault(kind, []).append(solid)
    return list(kinds.values())
