"""The noncircular gears in front of a crank, in mesh at input angle 0, and their shafts.

The driven gear is on the crank's axis, the driver at the distance C from it. With
``gear_module_mm`` they have teeth. Without it they are blanks up to their pitch curves.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.gear_teeth import Writer
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Layer, Point, closed
from geneva_cli.motion.drive import Gears
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, array
from geneva_cli.numerics.preferred import bore_radius
from geneva_cli.parts.assembly import gear_plane, same
from geneva_cli.parts.gears.gear_curves import (
    SAMPLES,
    ToothedCurve,
    pair_teeth,
    radii,
    ratio_and_turn,
    required_gears,
    toothed_curve,
)
from geneva_cli.parts.links.link_sizes import link_sizes
from geneva_cli.parts.links.links import drawn_links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.bores import Bore, round_bore
from geneva_cli.parts.shafts.hub_and_shafts import ShaftBore, bore_at
from geneva_cli.parts.shafts.shaft import Ends, Seat, Shaft, shaft_ends

if TYPE_CHECKING:
    from numpy.typing import NDArray

NAMES = "driven gear", "driver gear"
THIN = 1e-6  # of the axes' distance: a pitch curve nearer to its axis encloses no shaft
# Of the axes' distance: coarsest tolerance of the fitted curves. Teeth are spaced along both
# curves, so their lengths must agree to better than 1e-9.
FINE = {"arcs": 8e-9, "cubics": 2e-9}


def gear_seats(mechanism: Mechanism, parts: Outlines | None) -> list[Seat]:
    """Return where driven gear and driver sit on their shafts, in a plane below all links."""
    ends = link_sizes(mechanism, [], parts).span(gear_plane(mechanism))
    return [Seat(name, *ends) for name in NAMES]


def gear_pair(
    mechanism: Mechanism,
    parts: Outlines | None,
    writer: Callable[[float], Writer],
    on_crank: float = 0.0,
) -> tuple[Member, ...]:
    """Return both gears, with teeth or up to their pitch curves; none without noncircular gears.

    ``parts`` are the outlines of wheel and crank, if they are drawn, and ``on_crank`` is the radius
    of the crank's shaft if it does not follow from them. ``writer`` returns a function that fits
    curves within a tolerance, mm. Raises GenevaError for a bore larger than its gear, and for teeth
    that do not fit.
    """
    pair = mechanism.spec.gears
    if pair is None:
        return ()
    # teeth are spaced along the pitch curves, whose lengths must agree better than the teeth
    fine = FINE["cubics"] if mechanism.spec.size.gear_module_mm is None else 1e-6
    write = writer(fine * pair.distance_mm)
    sense = mechanism.gear_shaft.sense
    layer: Layer = "LINK"
    outlines = [gear.outline(write) for gear in pair_with_teeth(mechanism)]
    if not outlines:
        both = driven_curve(pair, sense), driver_curve(pair, sense)
        layer, outlines = "PITCH", [list(write(curve, -np.pi, np.pi)) for curve in both]
    members = []
    seats, bores = gear_seats(mechanism, parts), gear_bores(mechanism, parts, on_crank)
    for seat, pieces, (at, on) in zip(seats, outlines, bores, strict=True):
        holes = (on.hole(),) if on.bore.radius else ()
        plate = Plate(seat.part, layer, closed(layer, pieces), holes, seat.low, seat.high)
        members.append(Member(plate, at))
    return tuple(members)


def pair_with_teeth(mechanism: Mechanism) -> list[ToothedCurve]:
    """Return the teeth of driven gear and driver; none without a module."""
    pair, sense = mechanism.spec.gears, mechanism.gear_shaft.sense
    teeth = pair_teeth(pair, mechanism.spec.size)
    if pair is None or teeth is None:
        return []
    return [
        toothed_curve(teeth, False, driven_curve(pair, sense), -sense),
        toothed_curve(teeth, True, driver_curve(pair, sense), sense),
    ]


def pitch_radii(pair: Gears) -> list[tuple[float, float]]:
    """Return least and greatest radius of the pitch curves of driven gear and driver, mm.

    Raises GenevaError where one is so near to its axis that it is no gear.
    """
    C = pair.distance_mm
    driver, driven = radii(pair, ratio_and_turn(pair, np.linspace(-np.pi, np.pi, SAMPLES))[0])
    for name, r in zip(NAMES, (driven, driver), strict=True):
        if r.min() < THIN * C:
            raise GenevaError(
                f"the pitch curve of the {name} comes within {r.min():.3g} mm of its axis: that is "
                f"no gear. A smaller change of the ratio keeps it at {THIN * C:.3g} mm",
                ("drive", "kind"),
            )
    return [(float(r.min()), float(r.max())) for r in (driven, driver)]


def gear_shafts(
    mechanism: Mechanism, parts: Outlines | None, ends: Ends, on_crank: float = 0.0
) -> Iterator[Shaft]:
    """Yield the shafts that carry only gears, from the frame's lower face up; none without gears.

    The driver's shaft goes through it, or ends below one that is too small for a bore. The crank's
    is included if neither arm, locking disc nor links have one.
    """
    if mechanism.spec.gears is None:
        return
    size = mechanism.spec.size
    (first, wide), (at, radius), bored = _shafts(mechanism, parts, on_crank)
    driven, driver = gear_seats(mechanism, parts)
    at_crank = same(first, mechanism.crank_shaft.at, mechanism.center_distance_mm)
    if at_crank and not (ends.crank_has_one or _on_links(mechanism, parts)):
        reach = shaft_ends(size, "crank", ends.lowest, driven.high)
        on = bore_at(mechanism, first, wide)
        shaft = Shaft("crank's shaft", "crank", on.bore, (driven,), *reach, first)
        yield shaft._replace(direction=on.direction)
    name, bore = driver.part, Bore(radius)
    seats, top = ((driver,), driver.high) if bored else ((), driver.low)  # or one piece with it
    yield Shaft(f"{name}'s shaft", name, bore, seats, ends.lowest, top, at)


def _shafts(
    mechanism: Mechanism, parts: Outlines | None, on_crank: float
) -> tuple[tuple[Point, float], tuple[Point, float], bool]:
    """Return position and radius of both gears' shafts, and whether the driver has a bore.

    The first is the crank's, or that of another drive. Otherwise driver and shaft are one piece.
    """
    pair, L = required_gears(mechanism), mechanism.center_distance_mm
    sizes, ((driven, _), (driver, _)) = link_sizes(mechanism, [], parts), pitch_radii(pair)
    usual, x = bore_radius(L / 20.0), mechanism.gear_shaft.x_mm
    wide = on_crank or _on_links(mechanism, parts) or sizes.crank_shaft
    wide = wide or sizes.bore(driven, L) or usual
    own = sizes.bore(driver, L)
    return ((x, 0.0), wide), ((x + pair.distance_mm, 0.0), own or usual), own > 0.0


def _on_links(mechanism: Mechanism, parts: Outlines | None) -> float:
    """Return the radius of the driven gear's shaft where links are on it; 0 without links."""
    L = mechanism.center_distance_mm
    return drawn_links(mechanism, parts).shaft(mechanism.gear_shaft.at, L)


def gear_bores(
    mechanism: Mechanism, parts: Outlines | None, on_crank: float = 0.0
) -> list[tuple[Point, ShaftBore]]:
    """Return position and bore of driven gear and driver; of radius 0 for none."""
    pair, size = required_gears(mechanism), mechanism.spec.size
    (driven, _), (driver, _) = pitch_radii(pair)
    if teeth := pair_teeth(pair, size):
        driven, driver = driven - teeth.roots[0], driver - teeth.roots[1]
    (axis, wide), (other, radius), bored = _shafts(mechanism, parts, on_crank)
    bores = bore_at(mechanism, axis, wide), ShaftBore(round_bore(size, radius if bored else 0.0))
    for name, one, least, key in zip(
        NAMES, bores, (driven, driver), ("arm_bore_mm", "link_bore_mm"), strict=True
    ):
        reach = one.bore.reach
        if reach >= least:
            raise GenevaError(
                f"no blank of the {name} is left: its bore of {2.0 * reach:.6g} mm must be below "
                f"{2.0 * least:.6g}, twice its least radius; reduce {key}",
                ("size", key),
            )
    return [(axis, bores[0]), (other, bores[1])]


def driven_curve(gears: Gears, sense: float) -> Callable[[Array], tuple[Array, Array]]:
    """Return the pitch curve of the gear on the crank about its axis, mm, and its unit tangents.

    It is a function of the input's angle in radians. ``sense`` is the crank's, 1 for
    counterclockwise.
    """

    def curve(phi: Array) -> tuple[Array, Array]:
        ratio, turned = ratio_and_turn(gears, phi)
        i, slope = (array(c) for c in ratio.derivatives()[:2])
        C = gears.distance_mm
        r, change = C / (1.0 + i), -C * slope / (1.0 + i) ** 2
        direction = (turned.real - 1j * sense * turned.imag).astype(np.clongdouble)
        return _points(r * direction, (change - 1j * sense * i * r) * direction)

    return curve


def driver_curve(gears: Gears, sense: float) -> Callable[[Array], tuple[Array, Array]]:
    """Return the pitch curve of the driver, which turns against the crank, and its tangents."""

    def curve(phi: Array) -> tuple[Array, Array]:
        ratio, _ = ratio_and_turn(gears, phi)
        i, slope = (array(c) for c in ratio.derivatives()[:2])
        C = gears.distance_mm
        r, change = C * i / (1.0 + i), C * slope / (1.0 + i) ** 2
        direction: NDArray[np.clongdouble] = -np.exp(1j * sense * phi.astype(np.longdouble))
        return _points(r * direction, (change + 1j * sense * r) * direction)

    return curve


def _points(place: NDArray[np.clongdouble], speed: NDArray[np.clongdouble]) -> tuple[Array, Array]:
    """Points and unit tangents as doubles; processors differ in products of complex doubles."""
    tangent = speed / np.abs(speed)
    return (
        np.column_stack((place.real, place.imag)).astype(np.float64),
        np.column_stack((tangent.real, tangent.imag)).astype(np.float64),
    )
