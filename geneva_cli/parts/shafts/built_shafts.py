"""The shafts of a machine as they are built, plain or turned, and the lower face of their frame."""

from __future__ import annotations

from collections.abc import Iterable

from geneva_cli.geometry.plates import Member
from geneva_cli.parts.shafts.shaft import Seat, Shaft
from geneva_cli.spec.tables import Size


def built_shafts(
    size: Size, own: list[Shaft], adjacent: list[Seat], heights: tuple[float, float, float]
) -> tuple[list[Member], float]:
    """Return the shafts, plain or turned, and the frame's lower face.

    Shafts that turn in the frame and reach its lower face are turned. ``adjacent`` are the faces of
    parts that pass them. ``heights`` are the lower face of a frame of plain shafts, the upper face,
    and the lowest height at which parts pass.
    """
    usual, top, free = heights
    turned = [size.shafts == "turned" and one.turns and one.low <= usual for one in own]
    bottom = usual
    if any(turned):
        from geneva_cli.parts.shafts.turned_shafts import bearing_of, turned_shaft

        widths = (bearing_of(one).width for one, steps in zip(own, turned, strict=True) if steps)
        bottom = min([usual, *(top - width for width in widths)])
    axles = []
    for one, steps in zip(own, turned, strict=True):
        if steps:
            axles.append(turned_shaft(size, one, top, free if _is_passed(one, adjacent) else None))
        else:
            axles.append(one._replace(low=bottom if one.low == usual else one.low).plain())
    return axles, bottom


def _is_passed(shaft: Shaft, adjacent: Iterable[Seat]) -> bool:
    """Return True if parts on other axes are lower than what a shaft carries."""
    low = shaft.seats[0].low if shaft.seats else shaft.high
    own = {seat.part for seat in shaft.seats}
    return any(one.low < low and one.part not in own for one in adjacent)
