"""All parts side by side on one bed, and each part by itself."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.drawings.sheet.packing import Block, packed_apart
from geneva_cli.geometry.plates import Group, Member, Plate, Solid, solids
from geneva_cli.geometry.shapes import bounds_of
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.geometry.sphere_shell import Shell
from geneva_cli.parts.parts import EdgedParts, Parts
from geneva_cli.parts.projection import Missing, alike, built_of, outlines_of, titled

APART = 5.0  # mm between parts, and round them


def plate(parts: EdgedParts) -> Drawing:
    """Return all parts, each as often as the machine has it, in front of and right of the origin.

    Raises GenevaError for a part that cannot be built.
    """
    every = (one for _, build in parts.turned.by_name() for part in build() for one in solids(part))
    whole = [one for one in every if not isinstance(one, Shell)]
    title = titled(parts.mechanism, "plate")
    solid = Group(title, tuple(_laid(whole)))
    return Drawing(title, outlines_of(solid), solid=solid)


def _laid(whole: list[Plate]) -> list[Member]:
    """Return parts at z = 0 side by side, on a square bed that is as small as they allow."""
    blocks = [Block(*bounds_of(outlines_of(one)), (), ()) for one in whole]
    side = math.sqrt(sum((b.width + APART) * (b.height + APART) for b in blocks))
    placed = None
    while placed is None:
        area = (0.0, 0.0, side, side)
        placed = packed_apart(blocks, (), area, lambda b: -b.width * b.height, APART)
        # the bed grows by a tenth until all parts fit
        side *= 1.1
    return [
        Member(one._replace(low=0.0, high=one.thickness), (to.x0 - before.x0, to.y0 - before.y0))
        for one, before, to in zip(whole, blocks, placed, strict=True)
    ]


class SinglePart(NamedTuple):
    """A kind of part: its name and number, thickness in mm, and drawing with its solid."""

    name: str
    copies: int  # in the machine
    thickness_mm: float
    is_cut: bool  # True for a flat part that is cut out of a plate
    drawing: Drawing


def single_parts(
    parts: Parts, tolerance_mm: float, curves: str
) -> tuple[list[SinglePart], list[Missing]]:
    """Return every kind of part, with curves as in ``part_drawing``, and those without a drawing.

    A shell of a sphere has a solid and no outline.
    """
    missing = list[Missing]()
    built = (build().within(tolerance_mm, curves) for _, build in parts.all_built)
    every = [part for one in built for part in built_of(one.by_name(), missing)]
    return [_single(parts, kind[0], len(kind), tolerance_mm) for kind in alike(every)], missing


def _single(parts: Parts, solid: Solid, count: int, tolerance_mm: float) -> SinglePart:
    title = titled(parts.mechanism, solid.name)
    shapes = () if isinstance(solid, Shell) else outlines_of(solid)
    thickness = solid.outer - solid.inner if isinstance(solid, Shell) else solid.thickness
    drawing = Drawing(title, shapes, solid=solid, tolerance=tolerance_mm)
    cut = isinstance(solid, Plate) and is_cut(solid)
    return SinglePart(solid.name, count, thickness, cut, drawing)


def is_cut(plate: Plate) -> bool:
    """Return True for a part that is cut out of a plate; others are turned or bought."""
    return plate.layer in ("WHEEL", "CRANK", "ARM", "LINK", "GROOVE", "FRAME")
