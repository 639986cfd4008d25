"""The checks of a rack's parts at rest: shafts that pass it, and what the process cuts."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.measure import bounds
from geneva_cli.geometry.plates import plates
from geneva_cli.geometry.shapes import as_contour
from geneva_cli.kinds.linear.parts import RackParts
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.sizes import drawn_thicknesses
from geneva_cli.verdict.checks.check import Check, gap
from geneva_cli.verdict.checks.clearances import cut_width, plate_thickness
from geneva_cli.verdict.shaft_gap import Ring, gear_rings, ring_gaps, rings_of


def passing_shafts(name: str, parts: RackParts) -> Check | None:
    """The least gap between shafts and a rack, of a crank's shaft that ends above the arm.

    The rack slides along y, and covers everything up to its edge.
    """
    if not parts.mechanism.spec.has_parts:
        return None  # without a frame there are no shafts
    L = parts.mechanism.center_distance_mm

    def gaps() -> Iterator[float]:
        (rack,) = plates(parts.wheel.part)
        edge = bounds(rack.outline).x1
        for shaft in rings_of(parts.shafts):
            if shaft.high - rack.low > SAME_LENGTH * L:
                yield shaft.axis[0] - shaft.outer - edge

    return gap(name, gaps, L)


def passing_gears(name: str, parts: RackParts) -> Check | None:
    """The least gap of gears before a rack's crank to its guide and to shafts."""

    def gaps() -> Iterator[float]:
        rings = list(gear_rings(parts.mechanism, None))
        yield from ring_gaps(parts.mechanism, [], rings, parts.shafts)
        yield from _guide_gaps(parts, rings)

    return gap(name, gaps, parts.mechanism.center_distance_mm)


def thickest_plate(name: str, parts: RackParts) -> Check | None:
    """The thickest plate of a rack's machine, where the process has a limit.

    Bar, rail and wall of the guide are bars, which may be cut from stock.
    """
    thick = drawn_thicknesses(parts.mechanism.spec.size, parts.sizes.arm)
    return plate_thickness(name, parts.mechanism, max(thick.wheel, thick.lock, thick.arm))


def slot_width(name: str, parts: RackParts) -> Check | None:
    """The width of a rack's slots, where the process cuts none that is narrow for its plate."""
    thick = drawn_thicknesses(parts.mechanism.spec.size, parts.sizes.arm).wheel
    return cut_width(name, parts.mechanism, 2.0 * parts.sizes.half_width, thick)


def _guide_gaps(parts: RackParts, rings: list[Ring]) -> Iterator[float]:
    """Yield the gaps of rings to the plates of a rack's guide at their heights."""
    near = SAME_LENGTH * parts.mechanism.center_distance_mm
    for plate in (plate for one in parts.guide for plate in plates(one.part)):
        outline = Polyarc([as_contour(plate.outline)])
        for ring in rings:
            if min(ring.high, plate.high) - max(ring.low, plate.low) > near:
                away = float(outline.signed(np.array([ring.axis]))[0])
                yield away - ring.outer
