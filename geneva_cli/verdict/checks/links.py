"""Checks of links: their walls, and their clearance to parts that pass through their planes."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.parts.links import drawn_links, link_wall
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.turn.planes import planes
from geneva_cli.verdict.checks.check import Check, compared

KEYS = ("link_pin_mm", "link_bore_mm", "link_width_mm", "press_fit_mm", "pin_mm")


def wall(name: str, found: Outlines) -> Check | None:
    """The least wall around the links' holes, if one of their keys is given."""
    given = vars(found.assembly.mechanism.spec.size)
    if not any(given[key] for key in KEYS):
        return None
    try:
        made = drawn_links(found.assembly.full, found)
    except GenevaError as error:
        return Check(name, None, "at least", found.sizes.wall_min, False, str(error))
    least = min(map(link_wall, made.plates), default=None)
    return None if least is None else compared(name, least, "at least", found.sizes.wall_min)


def gap(name: str, found: Outlines) -> Check | None:
    """The gap in a whole turn between links and hub, shaft and pins through their planes."""
    try:
        seen = planes(found)
    except GenevaError as error:
        return Check(name, None, "at least", 0.0, False, str(error))
    given = found.assembly.full
    if seen.way_out is not None:
        one = seen.way_out
        return Check(
            name,
            one.gap,
            "at least",
            0.0,
            False,
            f"{one.passing} meets the {one.link}: it needs an eccentric in a hollow input shaft, "
            "or another path to its bearings",
            given.shown_deg(one.input_deg),
        )
    if seen.nearest is None:
        return None
    return compared(
        name, seen.nearest.gap, "at least", 0.0, given.shown_deg(seen.nearest.input_deg)
    )
