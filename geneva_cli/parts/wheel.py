"""The wheel as a solid: its outline extruded along the axis from z = 0, with its hub."""

from __future__ import annotations

from geneva_cli.geometry.plates import Group, Member, Plate
from geneva_cli.geometry.shapes import Contour
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.wheel_circles import wheel_circles
from geneva_cli.parts.outlines.wheel_hub import wheel_hub
from geneva_cli.parts.sizes import Sizes


def wheel_plate(assembly: Assembly, sizes: Sizes, contour: Contour) -> Plate:
    """Return the wheel as a plate; an internal wheel's contour is the opening in its disc."""
    circles = wheel_circles(assembly, sizes)
    bores = [circle for circle in circles if circle.layer == "BORE"]
    outside = [circle for circle in circles if circle.layer != "BORE"]
    outline, *openings = [*outside, contour]
    return Plate("wheel", contour.layer, outline, (*openings, *bores), 0.0, sizes.wheel_thickness)


def wheel_part(assembly: Assembly, sizes: Sizes, contour: Contour) -> Plate | Group:
    """Return the wheel, with its hub below it if the spec has one."""
    plate, hub = wheel_plate(assembly, sizes, contour), wheel_hub(assembly, sizes)
    return Group(plate.name, (Member(plate), Member(hub))) if hub else plate
