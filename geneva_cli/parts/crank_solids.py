"""The crank as solids: its outlines extruded along the axis.

The wheel stands on the plane z = 0. The arm is below it, and carries the locking disc and the pins.
"""

from __future__ import annotations

from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle
from geneva_cli.parts.arm import CrankArm, bolts
from geneva_cli.parts.outlines.crank_circles import crank_circles
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.reliefs import is_whole


def arm_plate(parts: Outlines, arm: CrankArm) -> Plate:
    """Return the crank arm below the wheel, at a distance of ``pin_gap_mm``."""
    high = -parts.assembly.mechanism.spec.size.allowances.pin_gap_mm
    holes = (arm.bore, *arm.pins, *arm.bolts)
    low = high - parts.sizes.arm_thickness
    return Plate("arm", arm.outline.layer, arm.outline, holes, low, high)


def locking_plates(parts: Outlines) -> list[Plate]:
    """Return the crank's locking disc, or its sectors, with bolts and bore.

    A bore is omitted where the disc has nothing left about the axis: the arm has it.
    """
    assembly, sizes = parts.assembly, parts.sizes
    low = -assembly.mechanism.spec.size.allowances.pin_gap_mm  # the disc stands on the arm
    high = low + sizes.lock_thickness
    whole = is_whole(assembly, sizes)
    bores = [c for c in crank_circles(assembly, sizes) if c.layer == "BORE" and whole]
    screwed = bolts(parts)
    each = len(screwed) // max(1, len(parts.crank))
    name = "locking disc" if whole else "locking sector"
    return [
        Plate(
            name, contour.layer, contour, (*bores, *screwed[k * each : (k + 1) * each]), low, high
        )
        for k, contour in enumerate(parts.crank)
    ]


def roller_plates(
    radius: float, pin_radius: float, low: float, high: float, fit: float
) -> list[Plate]:
    """Return a roller in the wheel's plane, up to ``high``, and its pin from ``low`` to there.

    The roller's bore is wider than the pin by ``fit`` mm of the diameter.
    """
    outline = Circle("ROLLER", ORIGIN, radius)
    if not pin_radius:
        return [Plate("roller", "ROLLER", outline, (), 0.0, high)]
    pin, bore = (Circle("ROLLER", ORIGIN, r) for r in (pin_radius, pin_radius + 0.5 * fit))
    return [
        Plate("roller", "ROLLER", outline, (bore,), 0.0, high),
        Plate("pin", "ROLLER", pin, (), low, high),
    ]
