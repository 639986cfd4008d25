"""The part that a drawing shows and its contours, for formats of solids."""

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Part, Plate
from geneva_cli.geometry.shapes import Circle, Contour
from geneva_cli.geometry.sheet import Drawing, prepared


def solid_part(drawing: Drawing, format: str) -> Part:
    """Return the part of a drawing. Raises GenevaError, naming the format, for one without."""
    whole = drawing.shells or drawing.solid
    if whole is None:
        text = f"no solid to write as {format}: solids are --part wheel, crank, arm and assembly. "
        raise GenevaError(f"{text}Write other drawings, and paths with --kerf, as .dxf or .svg")
    return whole


def plate_contours(plate: Plate) -> tuple[Contour | Circle, ...]:
    """Return a plate's outline and holes without pieces too small for any file.

    Raises GenevaError for a coordinate that is not finite, or a plate without thickness.
    """
    if not plate.thickness > 0.0:
        text = f"{plate.name}: a solid of {plate.thickness:g} mm; it must be thicker than 0"
        raise GenevaError(text)
    return prepared(Drawing(plate.name, (plate.outline, *plate.holes))).shapes
