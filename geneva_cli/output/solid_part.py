"""The part that a drawing shows and its contours, for formats of solids."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.inset import lines_and_arcs
from geneva_cli.geometry.pieces import prepared
from geneva_cli.geometry.plates import Part, Plate, Shell
from geneva_cli.geometry.shapes import Circle, Contour, closed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.geometry.stacks import require_faces


def solid_part(drawing: Drawing, format: str) -> Part:
    """Return the part of a drawing. Raises GenevaError, naming the format, for one without."""
    whole = drawing.shells or drawing.solid
    if whole is None:
        raise GenevaError(
            f"no solid to write as {format}: solids are --part wheel, crank, arm and assembly. "
            "Write other drawings, and paths with --kerf, as .dxf or .svg"
        )
    return whole


def plate_contours(plate: Plate) -> tuple[Contour | Circle, ...]:
    """Return a plate's outline and holes without pieces too small for any file.

    Raises GenevaError for a coordinate that is not finite, or a plate without thickness.
    """
    if not plate.thickness > 0.0:
        raise GenevaError(
            f"{plate.name}: a solid of {plate.thickness:g} mm; it must be thicker than 0"
        )
    if 2.0 * plate.edge.size >= plate.thickness:
        raise GenevaError(
            f"{plate.edge.key} = {plate.edge.size:g}: the {plate.name} is {plate.thickness:g} mm "
            f"thick; it must be below {0.5 * plate.thickness:g}",
            ("size", plate.edge.key),
        )
    shapes = prepared(Drawing(plate.name, (plate.outline, *plate.holes))).shapes
    if not plate.edge.size:
        return shapes
    outline, *holes = shapes
    require_faces(plate._replace(outline=outline, holes=tuple(holes)))
    return tuple(closed(shape.layer, lines_and_arcs(shape)) for shape in shapes)


def require_thick(shell: Shell) -> None:
    """Raise GenevaError for a shell without thickness, or one that reaches the centre."""
    if not 0.0 < shell.inner < shell.outer:
        raise GenevaError(
            f"{shell.name}: a shell from {shell.inner:g} to {shell.outer:g} mm is no solid"
        )
