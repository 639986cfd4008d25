"""The walls of a curved slot as lines, arcs and cubics: the chain of walls, fitted."""

from __future__ import annotations

import itertools
import math

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import fit
from geneva_cli.geometry.measure import mirrored
from geneva_cli.geometry.shapes import Contour, Segment, about, joined
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.walls.chain import WallPiece, chain
from geneva_cli.parts.outlines.walls.joint import points_at
from geneva_cli.parts.outlines.walls.path_walls import walls
from geneva_cli.parts.sizes import Sizes

# A wall ends at an intersection, whose last bits differ between processors, and many bits where two
# walls nearly touch. Ends are rounded: of curves in degrees of input, of arcs in radians. That is
# some 1e-7 mm of 100 mm.
STEP, ARC_STEP = 2.0**-24, 2.0**-30


def curved_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """Return a curved slot's walls, counterclockwise from one corner of its mouth to the other.

    They are within ``tolerance`` mm of the true walls, and never inside them. For that the slot of
    a roller larger by half the tolerance is fitted. So no fit leaves material in the roller's path.
    ``curves`` is "arcs" or "cubics", the form of walls that are no arcs. Raises GenevaError where
    the walls do not close.
    """
    half = 0.5 * tolerance
    runs: list[list[Segment]] = []
    larger = sizes._replace(half_width=sizes.half_width + half)
    pieces = chain(assembly, larger, walls(assembly, larger, engagement))
    for i, piece in enumerate(pieces):
        other = len(pieces) - 1 - i
        both = other < i and engagement.mirrored
        # walls count as mirror images within 1e-10 of the centre distance
        if both and _mirrors(pieces[other], piece, 1e-10 * assembly.L):
            runs.append(mirrored(runs[other]))
        else:
            runs.append(_segments(piece, half, curves))
    return Contour("WHEEL", joined(itertools.chain(*runs)), closed=False)


def _mirrors(one: WallPiece, other: WallPiece, near: float) -> bool:
    """Return True if a piece is the other's mirror image in the slot's axis, run backwards."""
    there = points_at(one.wall, one.start, one.end, 0.5 * (one.start + one.end))
    back = points_at(other.wall, other.end, other.start, 0.5 * (other.start + other.end))
    pairs = zip(there, back, strict=True)
    return all(math.hypot(v - x, w + y) <= near for (x, y), (v, w) in pairs)


def _segments(piece: WallPiece, tolerance: float, curves: str) -> list[Segment]:
    wall, *ends = piece
    step = STEP if wall.centre is None else ARC_STEP
    a, b = (round(end / step) * step for end in ends)
    if wall.centre is not None:
        return [about(wall.centre, wall.radius, a, b - a)]
    fitted = fit.KINDS[curves]
    if a == b:
        start, end = points_at(wall, *ends)
        if math.dist(start, end) > tolerance:
            raise GenevaError(
                "walls of the slot change within the last digits of the input angle: make the "
                "drive more even"
            )
        return []
    if a < b:
        return [*fitted(wall.curve, a, b, tolerance)]

    def back(t: Array) -> tuple[Array, Array]:
        points, tangents = wall.curve(-t)
        return points, -tangents

    return [*fitted(back, -a, -b, tolerance)]
