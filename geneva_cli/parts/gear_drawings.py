"""Drawings of the pitch curves of the gears in front of a crank, in mesh at input angle 0.

The axis of the driven gear, which is the crank's, is the origin; the driver's is at (C, 0). Teeth
are not drawn: their module and cutter are in no key of a spec.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves import fit
from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.measure import mapped
from geneva_cli.curves.plates import Group, Member, Plate
from geneva_cli.curves.shapes import Circle, Contour, Line, Point, Shape, closed
from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives.drive import Gears
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.arrays import array
from geneva_cli.parts.centre_marks import centre_marks
from geneva_cli.parts.gear_curves import SAMPLES, ratio_and_turn, required_gears
from geneva_cli.parts.link_drawings import once, shapes, titled
from geneva_cli.parts.link_shafts import Ends
from geneva_cli.parts.link_sizes import LinkSizes, link_sizes
from geneva_cli.parts.links import drawn_links
from geneva_cli.parts.model import PartsModel
from geneva_cli.parts.shafts import shaft, shaft_ends
from geneva_cli.parts.sizes import even

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

PITCH, BORE = "PITCH", "BORE"
NAMES = "driven gear", "driver gear"
THIN = 1e-6  # of the axes' distance: a pitch curve nearer to its axis encloses no shaft
# Of the axes' distance: coarsest tolerance of the fitted curves. Teeth are spaced along both
# curves, so their lengths must agree to better than 1e-9.
FINE = {"arcs": 8e-9, "cubics": 2e-9}


def gears(model: PartsModel, tolerance: float, curves: str) -> Drawing:
    """Return all pitch curves with bores and bolts, in mesh, and the line of their centres.

    Raises GenevaError for a machine without gears.
    """
    if model.mechanism.spec.drive.TOOTHED:
        return _round_gears(model)
    L, C = model.mechanism.center_distance_mm, required_gears(model.mechanism).distance_mm
    bores = [Circle(BORE, (x - L, y), r) for (x, y), r in gear_bores(model) if r]
    line = Contour(PITCH, (Line((0.0, 0.0), (C, 0.0)),), closed=False)
    pitch = pitch_curves(model.mechanism, min(tolerance, FINE[curves] * C), curves)
    drawn: tuple[Shape, ...] = (*pitch, *bores, line, *centre_marks(bores))
    title = f"{titled(model.mechanism)}: pitch curves of the gears"
    return Drawing(title, drawn, solid=Group(title, gear_members(model)))


def _round_gears(model: PartsModel) -> Drawing:
    """Return the blanks of gears with pitch circles, at their positions from the crank's axis."""
    mechanism, L = model.mechanism, model.mechanism.center_distance_mm
    bars = drawn_links(mechanism, model.outlines if mechanism.spec.is_flat else None)
    about = ((mapped(s, lambda p: (p[0] - L, p[1]))) for s in shapes(g.member for g in bars.gears))
    drawn = list(once(about))
    holes = [s for s in drawn if isinstance(s, Circle) and s.layer == BORE]
    ends = [(x - L, y) for (x, y), *_ in bars.gears]
    line = Contour(PITCH, (Line(min(ends), max(ends)),), closed=False)
    title = f"{titled(mechanism)}: gears"
    solid = Group(title, tuple(gear.member for gear in bars.gears))
    return Drawing(title, (*drawn, line, *centre_marks(holes)), solid=solid)


def pitch_curves(mechanism: Mechanism, tolerance: float, curves: str) -> tuple[Contour, Contour]:
    """Return the pitch curves of driven gear and driver in mesh at input angle 0, mm."""
    pair = required_gears(mechanism)
    pitch_radii(pair)  # raises if a curve is no gear
    sense = crank_sense(mechanism)
    driven, driver = (
        closed(PITCH, fit.KINDS[curves](curve, -np.pi, np.pi, tolerance))
        for curve in (driven_curve(pair, sense), driver_curve(pair, sense))
    )
    return driven, mapped(driver, lambda p: (p[0] + pair.distance_mm, p[1]))


def crank_sense(mechanism: Mechanism) -> float:
    """Return 1 if the crank turns counterclockwise (internal wheel), -1 if not (external)."""
    return -mechanism.spec.wheel.SIGN


def gear_shapes(model: PartsModel, tolerance: float, curves: str) -> list[Shape]:
    """Return pitch curves and bores in the machine; none without noncircular gears."""
    mechanism = model.mechanism
    if mechanism.spec.drive.gears is None:
        return []
    L = mechanism.center_distance_mm
    pitch = pitch_curves(mechanism, tolerance, curves)
    moved = [mapped(curve, lambda p: (p[0] + L, p[1])) for curve in pitch]
    return [*moved, *(Circle(BORE, at, r) for at, r in gear_bores(model) if r)]


def gear_span(model: PartsModel) -> tuple[float, float]:
    """Return lower and upper end of the gears along the axis: the plane below the arm is theirs."""
    return _sizes(model).span(2)


def gear_members(model: PartsModel) -> tuple[Member, ...]:
    """Return both gears as blanks up to their pitch curves; none without noncircular gears.

    Raises GenevaError for a bore larger than its gear.
    """
    mechanism = model.mechanism
    pair = mechanism.spec.drive.gears
    if pair is None:
        return ()
    low, high = gear_span(model)
    sense, tolerance = crank_sense(mechanism), FINE["cubics"] * pair.distance_mm
    members = []
    both = (driven_curve(pair, sense), driver_curve(pair, sense))
    for name, curve, (at, bore) in zip(NAMES, both, gear_bores(model), strict=True):
        outline = closed(PITCH, fit.KINDS["cubics"](curve, -np.pi, np.pi, tolerance))
        holes = (Circle(BORE, (0.0, 0.0), bore),) if bore else ()
        members.append(Member(Plate(name, PITCH, outline, holes, low, high), at))
    return tuple(members)


def pitch_radii(pair: Gears) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return least and greatest radius of the pitch curves of driven gear and driver, mm.

    Raises GenevaError where one is so near to its axis that it is no gear.
    """
    ratio = array(ratio_and_turn(pair, np.linspace(-np.pi, np.pi, SAMPLES))[0].c[0])
    C = pair.distance_mm
    driven, driver = C / (1.0 + ratio), C * ratio / (1.0 + ratio)
    for name, r in zip(NAMES, (driven, driver), strict=True):
        if r.min() < THIN * C:
            raise GenevaError(
                f"the pitch curve of the {name} comes within {r.min():.3g} mm of its axis: that is "
                f"no gear; a smaller change of the ratio keeps it at {THIN * C:.3g} mm",
                ("drive", "kind"),
            )
    return (
        (float(driven.min()), float(driven.max())),
        (float(driver.min()), float(driver.max())),
    )


def gear_shafts(model: PartsModel, ends: Ends) -> Iterator[Member]:
    """Yield the shafts that carry only gears, from the frame's lower face up; none without gears.

    The driver's shaft goes through it, or ends below one that is too small for a bore. The crank's
    is included if neither arm nor locking disc has one.
    """
    mechanism = model.mechanism
    if mechanism.spec.drive.gears is None:
        return
    (on_crank, wide), (at, radius) = _shafts(model)
    low, high = gear_span(model)
    if not ends.crank_has_one:
        reach = shaft_ends(mechanism.spec.size, "crank", ends.lowest, high)
        yield Member(shaft("crank", wide, reach), on_crank)
    top = high if _driver_bore(model) else low
    yield Member(shaft("driver gear", radius, (ends.lowest, top)), at)


def _shafts(model: PartsModel) -> list[tuple[Point, float]]:
    """Return position and radius of the shafts of driven gear and driver.

    The first is the crank's. Raises GenevaError where a pitch curve is no gear.
    """
    mechanism = model.mechanism
    pair, L = required_gears(mechanism), mechanism.center_distance_mm
    sizes, ((driven, _), _) = _sizes(model), pitch_radii(pair)
    usual = even(L / 20.0)
    on_crank = sizes.crank_shaft or sizes.bore(driven, L) or usual
    ends = (L, 0.0), (L + pair.distance_mm, 0.0)
    return list(zip(ends, (on_crank, _driver_bore(model) or usual), strict=True))


def _driver_bore(model: PartsModel) -> float:
    """Return the radius of the driver's bore; 0 where driver and shaft are one piece."""
    pair = required_gears(model.mechanism)
    return _sizes(model).bore(pitch_radii(pair)[1][0], model.mechanism.center_distance_mm)


def _sizes(model: PartsModel) -> LinkSizes:
    mechanism = model.mechanism
    return link_sizes(mechanism, [], model.outlines if mechanism.spec.is_flat else None)


def gear_bores(model: PartsModel) -> list[tuple[Point, float]]:
    """Return position and radius of the bores of driven gear and driver; 0 for none.

    Raises GenevaError, naming the key, for a bore larger than its gear, and where a pitch curve is
    no gear.
    """
    (driven, _), (driver, _) = pitch_radii(required_gears(model.mechanism))
    (axis, on_crank), (other, _) = _shafts(model)
    bores = on_crank, _driver_bore(model)
    for name, bore, least, key in zip(
        NAMES, bores, (driven, driver), ("arm_bore_mm", "link_bore_mm"), strict=True
    ):
        if bore >= least:
            raise GenevaError(
                f"no blank of the {name} is left: its bore, {2.0 * bore:.6g} as its shaft, must be "
                f"below {2.0 * least:.6g}, twice its pitch curve's least radius; reduce {key}",
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
