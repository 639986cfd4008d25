"""The walls of a curved slot as lines, arcs and cubics: the chain of walls, fitted."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.curves import fit
from geneva_cli.curves.shapes import Contour, Segment, about, joined
from geneva_cli.machine.engagement import Engagement
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.walls.chain import Piece, chain

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

LAYER = "WHEEL"


def curved_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """A curved slot from one corner of its mouth round the bottom to the other, counterclockwise
    about the wheel's axis; within ``tolerance`` mm of the true walls, and never inside them.

    What is fitted is the slot of a roller larger by half the tolerance, so that no fit leaves
    material in the roller's way. ``curves`` is "arcs" or "cubics", what the walls become where
    they are no arcs. Raises GenevaError where the walls do not close.
    """
    pieces: list[Segment] = []
    half = 0.5 * tolerance
    for piece in chain(assembly, sizes._replace(half_width=sizes.half_width + half), engagement):
        pieces += _segments(piece, half, curves)
    return Contour(LAYER, joined(pieces), closed=False)


def _segments(piece: Piece, tolerance: float, curves: str) -> list[Segment]:
    wall, a, b = piece
    if wall.centre is not None:
        return [about(wall.centre, wall.radius, a, b - a)]
    fitted = fit.KINDS[curves]
    if a < b:
        return [*fitted(wall.curve, a, b, tolerance)]

    def back(t: Array) -> tuple[Array, Array]:
        points, tangents = wall.curve(-t)
        return points, -tangents

    return [*fitted(back, -a, -b, tolerance)]
