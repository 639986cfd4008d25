"""Drawings of a counter's driver, pinion and number wheel.

Three planes of one thickness lie above each other: the driver's rim, its two teeth, and the number
wheel. The pinion's wide teeth go through all of them, the narrow ones through the upper two.
"""

from __future__ import annotations

import math

from geneva_cli.curves.drawing import Annotations, Drawing, LevelDistance
from geneva_cli.curves.plates import Group, Member, Plate
from geneva_cli.curves.shapes import ORIGIN, Circle, Contour
from geneva_cli.errors import GenevaError
from geneva_cli.layout.plain_sizes import drawn_thicknesses
from geneva_cli.layout.projection import outlines_of, placed, titled
from geneva_cli.machine.least_wall import wall_min
from geneva_cli.numerics.preferred import bore_radius
from geneva_cli.outlines.counter import (
    CounterSizes,
    counter_sizes,
    driver_rim,
    driver_teeth,
    number_teeth,
    pinion_teeth,
)
from geneva_cli.parts.flat_parts import FlatParts


def wheel(parts: FlatParts) -> Drawing:
    """Return the pinion; a wide tooth points along x, to the driver at mid-motion."""
    return _drawn(parts, "pinion", _pinion(parts, counter_sizes(parts.mechanism)))


def crank(parts: FlatParts) -> Drawing:
    """Return the driver; x is from its axis to the middle between its two teeth."""
    return _drawn(parts, "driver", _driver(parts, counter_sizes(parts.mechanism)))


def number_wheel(parts: FlatParts) -> Drawing:
    """Return the gear of the next number wheel, which turns about the driver's axis."""
    return _drawn(parts, "number wheel", (_number(parts, counter_sizes(parts.mechanism)),))


def assembly(parts: FlatParts) -> Drawing:
    """Return driver, pinion and number wheel at input angle 0."""
    mechanism = parts.mechanism
    sizes, title = counter_sizes(mechanism), titled(mechanism)
    axis = sizes.distance, 0.0
    driver, pinion = Group("driver", _driver(parts, sizes)), Group("pinion", _pinion(parts, sizes))
    members = (
        Member(driver, axis, math.pi),
        _number(parts, sizes)._replace(at=axis, turn=math.pi),
        Member(pinion),
    )
    shapes = [placed(s, one.at, one.turn) for one in members for s in outlines_of(one.part)]
    look = Annotations((LevelDistance((0.0, 0.0), axis, "L"),))
    return Drawing(title, tuple(shapes), look, Group(title, members))


def _drawn(parts: FlatParts, name: str, plates: tuple[Member, ...]) -> Drawing:
    """Return the drawing of a part from its plates."""
    solid = Group(name, plates)
    return Drawing(titled(parts.mechanism, name), outlines_of(solid), solid=solid)


def _pinion(parts: FlatParts, sizes: CounterSizes) -> tuple[Member, ...]:
    write = parts.writer(_fine(parts))
    bore = _bore(parts, "wheel", sizes.pinion.root)
    return (
        _plate(parts, "wide teeth", pinion_teeth(sizes, True, write), bore, (0, 1)),
        _plate(parts, "all teeth", pinion_teeth(sizes, False, write), bore, (1, 3)),
    )


def _driver(parts: FlatParts, sizes: CounterSizes) -> tuple[Member, ...]:
    write = parts.writer(_fine(parts))
    bore = _bore(parts, "crank", sizes.driver.root)
    return (
        _plate(parts, "rim", driver_rim(sizes, write), bore, (0, 1)),
        _plate(parts, "two teeth", driver_teeth(sizes, write), bore, (1, 2)),
    )


def _number(parts: FlatParts, sizes: CounterSizes) -> Member:
    bore = _bore(parts, "crank", sizes.driver.root)
    outline = number_teeth(sizes, parts.writer(_fine(parts)))
    return _plate(parts, "number wheel", outline, bore, (2, 3))


def _plate(
    parts: FlatParts, name: str, outline: Contour, bore: float, planes: tuple[int, int]
) -> Member:
    """Return a plate with a bore, from one plane to another."""
    thick = drawn_thicknesses(parts.mechanism.spec.size, parts.mechanism.center_distance_mm).wheel
    hole = Circle("BORE", ORIGIN, bore)
    low, high = (plane * thick for plane in planes)
    return Member(Plate(name, outline.layer, outline, (hole,), low, high))


def _fine(parts: FlatParts) -> float:
    """Return the tolerance of curves where none is set, mm."""
    return 1e-9 * parts.mechanism.center_distance_mm


def _bore(parts: FlatParts, part: str, root: float) -> float:
    """Return the radius of a bore: of the spec, or of a standard bearing up to half the root's.

    Raises GenevaError, naming the key, for a bore that leaves too thin a wall.
    """
    size, key = parts.mechanism.spec.size, f"{part}_bore_mm"
    own, least = getattr(size, key), wall_min(size, parts.mechanism.center_distance_mm)
    bore = (bore_radius(0.5 * root) or 0.5 * root) if own is None else 0.5 * own
    if bore > root - least:
        raise GenevaError(
            f"{key} = {2.0 * bore:g}: the teeth begin at Ø {2.0 * root:.4g} mm, so that the bore "
            f"must be at most {2.0 * (root - least):.4g}",
            ("size", key),
        )
    return bore
