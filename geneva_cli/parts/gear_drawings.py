"""The pitch curves of the gears in front of a crank as a drawing: both, as they mesh at input 0.

The driven gear's axis, which is the crank's, is the origin, the driver's at (C, 0). Teeth are not
drawn: they belong to a module and a cutter that no key of a spec names.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.curves import fit
from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.measure import mapped
from geneva_cli.curves.shapes import Circle, Contour, Line, Point, Shape, closed
from geneva_cli.machine.drives.drive import Gears
from geneva_cli.numerics.arrays import array
from geneva_cli.parts.centre_marks import centre_marks
from geneva_cli.parts.gear_curves import SAMPLES, ratio_and_turn, required_gears
from geneva_cli.parts.link_drawings import titled
from geneva_cli.parts.link_sizes import link_sizes
from geneva_cli.parts.proof import Proof

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

PITCH, BORE = "PITCH", "BORE"
# Of the axes' distance: what the curves are fitted to at the coarsest. Teeth are spaced along both
# of them, and so their lengths must agree, better than to 1e-9.
FINE = {"arcs": 8e-9, "cubics": 2e-9}


def gears(proof: Proof, tolerance: float, curves: str) -> Drawing:
    """Both pitch curves with their bores, and the line of their centres.

    Raises GenevaError for a machine without noncircular gears.
    """
    mechanism = proof.mechanism
    pair, L = required_gears(mechanism), mechanism.center_distance_mm
    C = pair.distance_mm
    fine = min(tolerance, FINE[curves] * C)
    sense = -mechanism.spec.wheel.SIGN  # the crank runs against the wheel outside, with it inside
    driven, driver = (
        closed(PITCH, fit.KINDS[curves](curve, -np.pi, np.pi, fine))
        for curve in (driven_curve(pair, sense), driver_curve(pair, sense))
    )
    bores = [Circle(BORE, (x - L, y), r) for (x, y), r in gear_bores(proof) if r]
    line = Contour(PITCH, (Line((0.0, 0.0), (C, 0.0)),), closed=False)
    shapes: tuple[Shape, ...] = (
        driven,
        mapped(driver, lambda p: (p[0] + C, p[1])),
        *bores,
        line,
        *centre_marks(bores),
    )
    return Drawing(f"{titled(mechanism)}: pitch curves of the gears", shapes)


def gear_bores(proof: Proof) -> list[tuple[Point, float]]:
    """Place in the machine and radius of the bores of driven gear and driver; 0 for none.

    Raises GenevaError as ``gears`` does.
    """
    mechanism = proof.mechanism
    pair, L = required_gears(mechanism), mechanism.center_distance_mm
    sizes = link_sizes(mechanism, [], proof.found if mechanism.spec.is_flat else None)
    ratio = array(ratio_and_turn(pair, np.linspace(-np.pi, np.pi, SAMPLES))[0].c[0])
    C = pair.distance_mm
    driven, driver = float((C / (1.0 + ratio)).min()), float((C * ratio / (1.0 + ratio)).min())
    return [
        ((L, 0.0), sizes.bore(driven, L, on_crank=True)),
        ((L + C, 0.0), sizes.bore(driver, L, on_crank=False)),
    ]


def driven_curve(gears: Gears, sense: float) -> Callable[[Array], tuple[Array, Array]]:
    """The pitch curve of the gear on the crank about its axis, mm, and its unit tangents.

    By the input's angle in radians; ``sense`` is the crank's, 1 where it turns counterclockwise.
    """

    def curve(phi: Array) -> tuple[Array, Array]:
        ratio, turned = ratio_and_turn(gears, phi)
        i, slope = (array(c) for c in ratio.derivatives()[:2])
        C = gears.distance_mm
        r, change = C / (1.0 + i), -C * slope / (1.0 + i) ** 2
        way = turned.real - 1j * sense * turned.imag
        return _points(r * way, (change - 1j * sense * i * r) * way)

    return curve


def driver_curve(gears: Gears, sense: float) -> Callable[[Array], tuple[Array, Array]]:
    """The same of the driver, on the input shaft, which turns against the crank."""

    def curve(phi: Array) -> tuple[Array, Array]:
        ratio, _ = ratio_and_turn(gears, phi)
        i, slope = (array(c) for c in ratio.derivatives()[:2])
        C = gears.distance_mm
        r, change = C * i / (1.0 + i), C * slope / (1.0 + i) ** 2
        way = -np.exp(1j * sense * phi)
        return _points(r * way, (change + 1j * sense * r) * way)

    return curve


def _points(place: NDArray[np.complex128], speed: NDArray[np.complex128]) -> tuple[Array, Array]:
    tangent = speed / np.abs(speed)
    return (
        np.column_stack((place.real, place.imag)),
        np.column_stack((tangent.real, tangent.imag)),
    )
