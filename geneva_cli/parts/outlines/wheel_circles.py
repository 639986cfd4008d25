"""The wheel's circles, its hub, and the wheel as a solid."""

from __future__ import annotations

import math
from collections.abc import Iterable

from geneva_cli.geometry.plates import Group, Member, Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Contour, Shape
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.shafts.bores import bore_of, has_shape
from geneva_cli.parts.shafts.screws import BoltCircle, bolt_circle
from geneva_cli.parts.sizes import Sizes
from geneva_cli.spec.tables import Size


def wheel_circles(assembly: Assembly, sizes: Sizes) -> list[Shape]:
    """Return the outside of an internal wheel, the bore in its shape, and the dial's bolts."""
    circles: list[Shape] = [Circle("WHEEL", (0.0, 0.0), sizes.outer)] if sizes.outer else []
    size = assembly.mechanism.spec.size
    if sizes.wheel_bore or has_shape(size, "wheel"):
        own = bore_of(size, "wheel", sizes.wheel_bore)
        circles.append(own.shape("BORE", assembly.rests[0]))
    return [*circles, *dial_circle(assembly, sizes).holes]


def dial_circle(assembly: Assembly, sizes: Sizes) -> BoltCircle:
    """Return the bolts of the dial, by default midway between bore and slots or recesses."""
    size = assembly.mechanism.spec.size
    ring = sizes.wheel_reach, sizes.slot_end
    if sizes.outer:
        ring = max(sizes.slot_end, assembly.L + sizes.recess), sizes.outer
    return bolt_circle(size, "dial", assembly.L, ring, assembly.rests[0])


def wheel_hub(assembly: Assembly, sizes: Sizes) -> Plate | None:
    """Return the hub below the wheel; None unless the spec has its diameter or its length."""
    size = assembly.mechanism.spec.size
    if not (size.has_hub("wheel") and sizes.wheel_hub > sizes.wheel_bore):
        return None
    bores = about_axis(wheel_circles(assembly, sizes) if sizes.wheel_bore else [])
    outline, low = Circle("HUB", ORIGIN, sizes.wheel_hub), -wheel_hub_length(size, sizes)
    return Plate("wheel's hub", "HUB", outline, bores, low, 0.0)


def wheel_hub_length(size: Size, sizes: Sizes) -> float:
    """Return the length of the wheel's hub: by default as far down as the crank arm."""
    if size.wheel_hub_length_mm is not None:
        return size.wheel_hub_length_mm
    return size.allowances.pin_gap_mm + sizes.arm_thickness


def about_axis(circles: Iterable[Shape]) -> tuple[Shape, ...]:
    """Return the bore among some shapes: the one about the axis."""
    bores = (shape for shape in circles if shape.layer == "BORE")
    return tuple(
        shape
        for shape in bores
        if not isinstance(shape, Circle) or math.hypot(*shape.centre) == 0.0
    )


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
