"""The circles of the wheel's outline: its outside, its bore, and the bolts of a dial."""

from __future__ import annotations

from geneva_cli.geometry.shapes import Circle, Shape
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.shafts.bores import bore_of, has_shape
from geneva_cli.parts.sizes import Sizes


def wheel_circles(assembly: Assembly, sizes: Sizes) -> list[Shape]:
    """Return the outside of an internal wheel, the bore in its shape, and the dial's bolts.

    Raises GenevaError for a shape or keyway that the bore cannot have.
    """
    circles: list[Shape] = [Circle("WHEEL", (0.0, 0.0), sizes.outer)] if sizes.outer else []
    size = assembly.mechanism.spec.size
    if sizes.wheel_bore or has_shape(size, "wheel"):
        own = bore_of(size, "wheel", sizes.wheel_bore)
        circles.append(own.shape("BORE", assembly.rests[0]))
    return [*circles, *dial_bolts(assembly, sizes)]


def dial_bolts(assembly: Assembly, sizes: Sizes) -> list[Circle]:
    """Return the holes for the dial on the wheel, evenly spaced, the first between two slots.

    By default their circle is in the middle between the bore and the slots and recesses.
    """
    from geneva_cli.parts.shafts.screws import bolt_circle

    size = assembly.mechanism.spec.size
    ring = sizes.wheel_reach, sizes.slot_end
    if sizes.outer:
        ring = max(sizes.slot_end, assembly.L + sizes.recess), sizes.outer
    return bolt_circle(size, "dial", assembly.L, ring, assembly.rests[0]).holes
