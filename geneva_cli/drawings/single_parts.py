"""Every kind of part as a drawing of its own, with the number of its copies."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.plates import Plate, Shell, Solid
from geneva_cli.parts.alike import alike
from geneva_cli.parts.missing import Missing, built_of
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.projection import outlines_of, titled


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
