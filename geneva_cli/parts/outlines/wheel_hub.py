"""The wheel's hub, which stands below the wheel, about its axis.

It is drawn if the spec has one of its sizes; otherwise only its space is kept free.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Shape
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.wheel_circles import wheel_circles
from geneva_cli.parts.shafts.held_hubs import held_hub
from geneva_cli.parts.sizes import Sizes
from geneva_cli.spec.tables import Size


def wheel_hub(assembly: Assembly, sizes: Sizes) -> Plate | None:
    """Return the hub below the wheel; None unless the spec has its diameter or its length.

    Raises GenevaError for a set screw that it does not hold.
    """
    hub = _plate(assembly, sizes)
    return held_hub(assembly.mechanism.spec.size, "wheel", hub, assembly.rests[0])


def _plate(assembly: Assembly, sizes: Sizes) -> Plate | None:
    size = assembly.mechanism.spec.size
    if not size.has_hub("wheel") or sizes.wheel_hub <= sizes.wheel_bore:
        return None
    bores = about_axis(wheel_circles(assembly, sizes) if sizes.wheel_bore else [])
    outline = Circle("HUB", ORIGIN, sizes.wheel_hub)
    return Plate("wheel's hub", "HUB", outline, bores, -wheel_hub_length(size, sizes), 0.0)


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
