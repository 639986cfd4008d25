"""Pitch curves of the noncircular gears in front of a crank, and a test whether they can be cut.

The ratio is i = crank speed / input speed, and the axes are C apart. The pitch curves meet on the
line of centres, at r1 = C i/(1+i) from the driver and r2 = C/(1+i) from the driven gear. Convex
curves can be hobbed. With derivatives by the driver's angle, the curves are convex where

    driver:  1 + 1/i + (1/i)'' > 0,    driven gear:  1 + i + (i i'' - i'²)/i³ > 0
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import chords
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Gears
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, array
from geneva_cli.numerics.jet import Jet
from geneva_cli.table import Table

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.geometry.fit.arcs import Curve

NAMES = (
    *("input_deg", "crank_deg", "ratio", "driver_radius_mm", "driver_x_mm", "driver_y_mm"),
    *("driven_radius_mm", "driven_x_mm", "driven_y_mm", "driver_convexity", "driven_convexity"),
)
GEARS = "driven gear", "driver gear"
SAMPLES = 721  # input angles of a turn at which ratio and radii are computed
THIN = 1e-6  # of the axes' distance: a pitch curve nearer to its axis encloses no shaft


def gears_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return both pitch curves: for a chord tolerance, or at ``samples`` even input angles.

    Each is in its own gear's frame, with x along the line of centres at input angle 0. A curve is
    listed as it is cut, so its angle runs against the gear's rotation.
    """
    gears = required_gears(mechanism)

    def points(phi: Array) -> tuple[Array, Array]:
        """Return the points (n, 2) at which driver and driven gear touch."""
        turn, ratio = _ratio(gears, phi)
        driver, driven = _radii(gears, ratio)
        return (
            np.column_stack((driver * np.cos(phi), -driver * np.sin(phi))),
            np.column_stack((-driven * np.cos(turn), -driven * np.sin(turn))),
        )

    # one turn; the curves' frames are at input angle 0
    phi = np.linspace(-np.pi, np.pi, samples or 3)
    if samples is None:
        phi = chords.nodes(points, (-np.pi, 0.0, np.pi), tolerance_mm)
    turn, ratio = _ratio(gears, phi)
    (r1, r2), both = _radii(gears, ratio), points(phi)
    columns = [np.degrees(phi), np.degrees(turn), ratio.c[0], r1, *both[0].T, r2, *both[1].T]
    return Table(NAMES, [*columns, *_convexities(ratio)])


def required_gears(mechanism: Mechanism) -> Gears:
    """Return the noncircular gears of a machine; raises GenevaError if it has none."""
    gears, kind = mechanism.spec.gears, mechanism.spec.drive.NAME
    if gears is None:
        geared = [*registry.drives_with("gears"), *registry.drives_with("round_gears")]
        raise GenevaError(
            f'--part gears: kind = "{kind}" has no gears with a table of their pitch curves; '
            f"{', '.join(geared)} have gears, of which the round ones are only drawn"
        )
    return gears


def convexity(gears: Gears) -> tuple[float, float]:
    """Return the least value of the convexity conditions of driver and driven gear in a turn.

    It is not above 0 for a hollow gear.
    """
    driver, driven = _convexities(_ratio(gears, np.linspace(-np.pi, np.pi, SAMPLES))[1])
    return float(driver.min()), float(driven.min())


def pitch_radii(pair: Gears) -> list[tuple[float, float]]:
    """Return least and greatest radius of the pitch curves of driven gear and driver, mm."""
    C = pair.distance_mm
    driver, driven = _radii(pair, ratio_and_turn(pair, np.linspace(-np.pi, np.pi, SAMPLES))[0])
    for name, r in zip(GEARS, (driven, driver), strict=True):
        if r.min() < THIN * C:
            raise GenevaError(
                f"the pitch curve of the {name} comes within {r.min():.3g} mm of its axis: that is "
                f"no gear. A smaller change of the ratio keeps it at {THIN * C:.3g} mm",
                ("drive", "kind"),
            )
    return [(float(r.min()), float(r.max())) for r in (driven, driver)]


def pitch_curves(gears: Gears, sense: float) -> tuple[Curve, Curve]:
    """Return the pitch curves of driven gear and driver, each about its own axis.

    They are functions of the input's angle in radians, which return points, mm, and unit tangents.
    ``sense`` is that of the crank, 1 for counterclockwise; the driver turns against it.
    """
    return partial(_pitch_curve, gears, sense, False), partial(_pitch_curve, gears, sense, True)


def _pitch_curve(gears: Gears, sense: float, driver: bool, phi: Array) -> tuple[Array, Array]:
    ratio, turned = ratio_and_turn(gears, phi)
    i, slope = (array(c) for c in ratio.derivatives()[:2])
    C = gears.distance_mm
    direction: NDArray[np.clongdouble]
    spin: NDArray[np.complexfloating] | complex
    if driver:
        r, change = C * i / (1.0 + i), C * slope / (1.0 + i) ** 2
        spin = 1j * sense
        direction = -np.exp(1j * sense * phi.astype(np.longdouble))
    else:
        r, change = C / (1.0 + i), -C * slope / (1.0 + i) ** 2
        spin = -1j * sense * i
        direction = (turned.real - 1j * sense * turned.imag).astype(np.clongdouble)
    place, speed = r * direction, (change + spin * r) * direction
    tangent = speed / np.abs(speed)
    # as doubles; processors differ in products of complex doubles
    return (
        np.column_stack((place.real, place.imag)).astype(np.float64),
        np.column_stack((tangent.real, tangent.imag)).astype(np.float64),
    )


def _radii(gears: Gears, ratio: Jet) -> tuple[Array, Array]:
    """Return the radii of driver and driven gear where they touch, mm."""
    C, i = gears.distance_mm, array(ratio.c[0])
    return C * i / (1.0 + i), C / (1.0 + i)


def _ratio(gears: Gears, phi: Array) -> tuple[Array, Jet]:
    """Return the crank's angle and the ratio with two derivatives, over a turn of the input."""
    ratio, turned = ratio_and_turn(gears, phi)
    # the crank's angle ahead of the input is 0 at input angle 0
    ahead = np.unwrap(np.angle(turned * np.exp(-1j * phi)))
    middle = float(ahead[np.argmin(np.abs(phi))])
    return phi + ahead - np.round(middle / (2.0 * np.pi)) * 2.0 * np.pi, ratio


def ratio_and_turn(gears: Gears, phi: np.ndarray) -> tuple[Jet, np.ndarray]:
    """Return the ratio with two derivatives by the input's angle, and the driven gear's turn."""
    sine, versine = gears.advance(phi, 3)
    cosine = 1.0 - versine
    ratio = sine.derivative() * cosine.lower + versine.derivative() * sine.lower
    return ratio, array(cosine.c[0]) + 1j * array(sine.c[0])


def _convexities(ratio: Jet) -> tuple[np.ndarray, np.ndarray]:
    i, i1, i2 = (array(c) for c in ratio.derivatives())
    inverse = [array(c) for c in (1.0 / ratio).derivatives()]
    return 1.0 + inverse[0] + inverse[2], 1.0 + i + (i * i2 - i1 * i1) / i**3
