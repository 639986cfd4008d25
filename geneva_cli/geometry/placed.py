"""Shapes and plates at their positions, seen along the axis."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from geneva_cli.geometry.measure import S, mapped, turned
from geneva_cli.geometry.plates import Group, Member, Plate, steps_of
from geneva_cli.geometry.shapes import Point


def placed(shape: S, at: Point, turn: float) -> S:
    """Return a shape turned about its own origin, and then moved."""
    if at == (0.0, 0.0) and not turn:
        return shape
    return mapped(turned(shape, turn), lambda p: (p[0] + at[0], p[1] + at[1]))


def in_place(members: Iterable[Member]) -> Iterator[tuple[Plate, Plate]]:
    """Yield each plate, and each step of a turned part, in its own frame and at its position."""
    for one in members:
        if isinstance(one.part, Group):
            inner = in_place(one.part.members)
        else:
            inner = ((step, step) for step in steps_of(one.part))
        for own, plate in inner:
            outline, *holes = (
                placed(shape, one.at, one.turn) for shape in (plate.outline, *plate.holes)
            )
            yield own, plate._replace(outline=outline, holes=tuple(holes))
