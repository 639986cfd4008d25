"""The solids of a part as meshes: one for each kind of solid, with its places."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.plates import Group, Member, Part, Shell, Solid, Stack
from geneva_cli.errors import GenevaError
from geneva_cli.named_tuple import NamedTuple
from geneva_cli.output.mesh.plates import plate_mesh
from geneva_cli.output.mesh.shells import shell_mesh
from geneva_cli.output.mesh.stacks import stack_mesh
from geneva_cli.output.mesh.surface import Surface, rounded
from geneva_cli.output.solid_part import solid_part

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


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
    layer: str
    surface: Surface
    places: tuple[Place, ...]


def bodies(drawing: Drawing, units: str, format: str) -> list[Body]:
    """Return the kinds of solids of a drawing; their chords keep the drawing's tolerance.

    Raises GenevaError for a drawing without solids, for a unit other than mm, and for a solid that
    has no closed surface.
    """
    return [
        Body(solid.name, solid.layer, _surface(solid, drawing.tolerance), tuple(places))
        for solid, places in solid_kinds(drawing, units, format).items()
    ]


def solid_kinds(drawing: Drawing, units: str, format: str) -> dict[Solid, list[Place]]:
    """Return the kinds of solids of a drawing, each with its positions.

    Raises GenevaError for a drawing without solids, and for a unit other than mm.
    """
    kinds: dict[Solid, list[Place]] = {}
    here = Place(np.eye(3), np.zeros(3))
    for solid, place in _placed(solid_part(drawing, units, format), here):
        kinds.setdefault(solid, []).append(place)
    return kinds


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


def _surface(solid: Solid, tolerance: float) -> Surface:
    if not tolerance > 0.0:
        raise GenevaError(f"--tolerance {tolerance:g}: it must be above 0 mm")
    if isinstance(solid, Shell):
        return shell_mesh(solid, tolerance)
    if isinstance(solid, Stack):
        return stack_mesh(solid, tolerance)
    return plate_mesh(solid, tolerance)
