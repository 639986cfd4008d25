"""The solids of a part as meshes: one for each kind of solid, with its places."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cache, lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Group, Member, Part, Shell, Solid, Stack
from geneva_cli.geometry.shapes import Layer, Point
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.geometry.stacks import Run, Side, levels, outline_of, sides
from geneva_cli.numerics.arrays import Array
from geneva_cli.output.mesh.plate_meshes import plate_mesh
from geneva_cli.output.mesh.polygons import (
    Fans,
    Surface,
    chord_points,
    rounded,
    triangles,
)
from geneva_cli.output.mesh.shells import shell_mesh
from geneva_cli.output.solid_part import plate_contours, solid_part

if TYPE_CHECKING:
    pass


class Place(NamedTuple):
    """A solid's position: p becomes ``turn`` @ p + ``shift``, in mm."""

    turn: Array  # (3, 3)
    shift: Array  # (3,)

    def __call__(self, corners: Array) -> Array:
        """Return corners (n, 3) at this position, rounded as those of a surface."""
        return rounded(corners @ self.turn.T + self.shift)


class Body(NamedTuple):
    """A kind of solid: its name and layer, its surface, and where it stands."""

    name: str
    layer: Layer
    surface: Surface
    places: tuple[Place, ...]


def bodies(drawing: Drawing, units: str, format: str) -> list[Body]:
    """Return the kinds of solids of a drawing; their chords keep the drawing's tolerance.

    Raises GenevaError for a drawing without solids, for a unit other than mm, and for a solid that
    has no closed surface.
    """
    kinds: dict[Solid, list[Place]] = {}
    here = Place(np.eye(3), np.zeros(3))
    for solid, place in _placed(solid_part(drawing, units, format), here):
        kinds.setdefault(solid, []).append(place)
    return [
        Body(solid.name, solid.layer, _surface(solid, drawing.tolerance), tuple(places))
        for solid, places in kinds.items()
    ]


def _placed(part: Part, at: Place) -> Iterator[tuple[Solid, Place]]:
    """Yield every solid of a part at its position."""
    if not isinstance(part, Group):
        yield part, at
        return
    for member in part.members:
        own = _place(member)
        yield from _placed(member.part, Place(at.turn @ own.turn, at.turn @ own.shift + at.shift))


def _place(member: Member) -> Place:
    if member.frame:
        turn = np.array([member.frame.x, member.frame.y, member.frame.z]).T
    else:
        c, s = math.cos(member.turn), math.sin(member.turn)
        turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return Place(turn, np.array([*member.at, 0.0]))


@lru_cache(maxsize=32)  # an export writes each solid by itself, and all of them together
def _surface(solid: Solid, tolerance: float) -> Surface:
    """Return the surface of a solid, which must not be changed."""
    if not tolerance > 0.0:
        raise GenevaError(f"--tolerance {tolerance:g}: it must be above 0 mm")
    if isinstance(solid, Shell):
        return shell_mesh(solid, tolerance)
    if isinstance(solid, Stack):
        return _stack_mesh(solid, tolerance)
    return plate_mesh(solid, tolerance)


def _stack_mesh(stack: Stack, tolerance: float) -> Surface:
    """Return a turned part's surface; its chords keep the tolerance, mm.

    Raises GenevaError for a step without thickness, and for outlines that cross.
    """
    fans = Fans()

    @cache
    def points(side: Side) -> list[Point]:
        return chord_points(side, tolerance)

    def along(run: Run) -> list[Point]:
        own = points(run.side)
        return own if run.forward else own[::-1]

    for plate in stack.plates:
        plate_contours(plate)  # refuses what is no solid
        for side in sides(outline_of(plate)):
            for p, q in pairwise(points(side)):
                fans.add([(*p, plate.low), (*q, plate.low), (*q, plate.high), (*p, plate.high)])
    for level in levels(stack):
        loops = [[point for run in runs for point in along(run)[:-1]] for runs in level.loops]
        outer_first = loops if level.up else [loop[::-1] for loop in loops]
        corners = [(*point, level.z) for loop in outer_first for point in loop]
        for a, b, c in triangles(outer_first, stack.name):
            fans.add([corners[k] for k in ((a, b, c) if level.up else (c, b, a))])
    return fans.surface()
