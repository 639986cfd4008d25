"""OpenSCAD: a module for each kind of solid, and a line for each position, in mm.

A plate is an outline without its holes, extruded; circles stay circles, so that a person can change
them. A turned part is one on another. A shell of a sphere, or a plate whose edges are
not sharp, is a polyhedron.
"""

from __future__ import annotations

import math
import re
import textwrap
from collections.abc import Iterator, Sequence

from geneva_cli.errors import GenevaError, clean
from geneva_cli.geometry.cross_holes import CrossHole
from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.plates import Plate, Shell, Solid
from geneva_cli.geometry.shapes import Circle, Contour, Shape
from geneva_cli.output.inks import inks
from geneva_cli.output.mesh.plates import plate_mesh
from geneva_cli.output.mesh.polygons import DECIMALS, arc_chords, polygon
from geneva_cli.output.mesh.shells import shell_mesh
from geneva_cli.output.mesh.solids import Place, solid_kinds
from geneva_cli.output.mesh.surface import Surface
from geneva_cli.output.solid_part import plate_contours
from geneva_cli.table import in_decimals


def data(drawing: Drawing, units: str) -> Iterator[bytes]:
    """The file's bytes; chords keep the drawing's tolerance. Raises GenevaError as ``bodies``."""
    if not drawing.tolerance > 0.0:
        raise GenevaError(f"--tolerance {drawing.tolerance:g}: it must be above 0 mm")
    kinds = solid_kinds(drawing, units, "SCAD")
    colours = inks(tuple(dict.fromkeys(solid.layer for solid in kinds)))
    names = _names([solid.name for solid in kinds])
    yield f"// {clean(drawing.title).strip()}\n// millimetres\n\n".encode()
    for name, (solid, places) in zip(names, kinds.items(), strict=True):
        for place in places:
            yield f'{_moved(place)}color("{colours[solid.layer].rgb}") {name}();\n'.encode()
    for name, solid in zip(names, kinds, strict=True):
        yield f"\nmodule {name}() {{\n{_solid(solid, drawing.tolerance)}}}\n".encode()


def _names(words: Sequence[str]) -> list[str]:
    """Names of modules: letters, digits and underscores, each once.

    >>> _names(["wheel", "wheel's shaft", "wheel"])
    ['wheel', 'wheels_shaft', 'wheel_2']
    """
    names: list[str] = []
    for word in words:
        plain = re.sub(r"[^A-Za-z0-9]+", "_", word.replace("'", "")).strip("_")
        plain = plain if plain[:1].isalpha() else f"part_{plain}".rstrip("_")
        name, number = plain, 1
        while name in names:
            number += 1
            name = f"{plain}_{number}"
        names.append(name)
    return names


def _moved(place: Place) -> str:
    """What moves a solid to its position; nothing where it stands as drawn."""
    (xx, _, _), (yx, _, _), (_, _, zz) = place.turn.tolist()
    shift = place.shift.tolist()
    if zz < 1.0:
        rows = ([*turn, by] for turn, by in zip(place.turn.tolist(), shift, strict=True))
        return f"multmatrix([{', '.join(_list(row, 12) for row in rows)}]) "
    turn = in_decimals(math.degrees(math.atan2(yx, xx)), 9)
    moved = f"translate({_list(shift, DECIMALS)}) " if any(shift) else ""
    return moved + (f"rotate({turn}) " if turn != "0" else "")


def _solid(solid: Solid, tolerance: float) -> str:
    if isinstance(solid, Shell):
        return _polyhedron(shell_mesh(solid, tolerance))
    return "".join(_plate(plate, tolerance) for plate in solid.plates)


def _plate(plate: Plate, tolerance: float) -> str:
    if plate.edge.size:
        return _polyhedron(plate_mesh(plate, tolerance))
    outline, *holes = plate_contours(plate)
    flat = _flat(outline, True, tolerance)
    if holes:
        inside = [_flat(hole, False, tolerance) for hole in holes]
        flat = "\n".join(("difference() {", *(f"  {one}" for one in (flat, *inside)), "}"))
    low, high = in_decimals(plate.low, DECIMALS), in_decimals(plate.thickness, DECIMALS)
    above = "" if low == "0" else f"translate([0, 0, {low}]) "
    flat = flat.replace("\n", "\n    ")
    solid = f"  {above}linear_extrude(height = {high})\n    {flat}\n"
    if not plate.cross:
        return solid
    cut = "".join(_cross(hole, (outline, *holes), tolerance) for hole in plate.cross)
    return f"  difference() {{\n{textwrap.indent(solid + cut, '  ')}  }}\n"


def _cross(hole: CrossHole, shapes: Sequence[Shape], tolerance: float) -> str:
    """A cylinder that goes through both walls of a hole, and ends in the open."""
    low, high = hole.openings(shapes)
    ys = [hole.radius * math.sin(math.pi * (k / 16.0 - 0.5)) for k in range(17)]
    start, end = min(map(low.x, ys)), max(map(high.x, ys))
    more = 0.05 * (end - start)
    at = *hole.placed(start - more, 0.0), hole.height
    count = 2 * arc_chords(hole.radius, math.pi, tolerance)
    return (
        f"  translate({_list(at, DECIMALS)}) "
        f"rotate([0, 90, {in_decimals(math.degrees(hole.turn), 9)}])\n"
        f"    cylinder(h = {in_decimals(end - start + 2.0 * more, DECIMALS)}, "
        f"r = {in_decimals(hole.radius, DECIMALS)}, $fn = {count});\n"
    )


def _flat(shape: Contour | Circle, outside: bool, tolerance: float) -> str:
    if isinstance(shape, Circle):
        count = 2 * arc_chords(shape.radius, math.pi, tolerance)
        at = f"translate({_list(shape.centre, DECIMALS)}) " if any(shape.centre) else ""
        return f"{at}circle(r = {in_decimals(shape.radius, DECIMALS)}, $fn = {count});"
    corners = ",\n    ".join(_list(p, DECIMALS) for p in polygon(shape, outside, tolerance))
    return f"polygon([\n    {corners}]);"


def _polyhedron(surface: Surface) -> str:
    corners = ",\n    ".join(_list(corner, DECIMALS) for corner in surface.corners.tolist())
    # OpenSCAD wants them clockwise from outside
    faces = ",\n    ".join(f"[{a}, {c}, {b}]" for a, b, c in surface.triangles.tolist())
    return f"  polyhedron(points = [\n    {corners}],\n    faces = [\n    {faces}]);\n"


def _list(values: Sequence[float], decimals: int) -> str:
    return f"[{', '.join(in_decimals(value, decimals) for value in values)}]"
