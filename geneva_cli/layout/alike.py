"""The solids of a machine, those of one kind together."""

from __future__ import annotations

from collections.abc import Iterable

from geneva_cli.curves.plates import Part, Shell, Solid, solids


def alike(parts: Iterable[Part]) -> list[list[Solid]]:
    """Return the solids of some parts: a list for each kind, in the order of its first one."""
    kinds: dict[Solid | tuple[str, str], list[Solid]] = {}
    for solid in (one for part in parts for one in solids(part)):
        # Shells of one kind lie at different places, and may differ by rounding.
        kind = (solid.name, f"{solid.volume:.9g}") if isinstance(solid, Shell) else solid
        kinds.setdefault(kind, []).append(solid)
    return list(kinds.values())
