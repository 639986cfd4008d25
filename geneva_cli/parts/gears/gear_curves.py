"""Pitch curves of the gears in front of a crank, and a test whether they can be cut.

The ratio is i = crank speed / input speed, and the axes are C apart. The pitch curves meet on the
line of centres, at r1 = C i/(1+i) from the driver and r2 = C/(1+i) from the driven gear. Convex
curves can be hobbed. With derivatives by the driver's angle, the curves are convex where

    driver:  1 + 1/i + (1/i)'' > 0,    driven gear:  1 + i + (i i'' - i'²)/i³ > 0
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import chords
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Gears
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.quadrature import rule
from geneva_cli.numerics.spline import PiecewisePolynomial, periodic
from geneva_cli.table import Table

NAMES = (
    "input_deg",
    "crank_deg",
    "ratio",
    "driver_radius_mm",
    "driver_x_mm",
    "driver_y_mm",
    "driven_radius_mm",
    "driven_x_mm",
    "driven_y_mm",
    "driver_convexity",
    "driven_convexity",
)
SAMPLES = 721  # input angles of a turn at which ratio and radii are computed


class Convexity(NamedTuple):
    """The least value of both convexity conditions in a turn; not above 0 for a hollow gear."""

    driver: float
    driven: float


def gears_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return both pitch curves: for a chord tolerance, or at ``samples`` even input angles.

    Each is in its own gear's frame, with x along the line of centres at input angle 0. A curve is
    listed as it is cut, so its angle runs against the gear's rotation.
    """
    gears = required_gears(mechanism)
    if samples is None:
        ends = (-np.pi, 0.0, np.pi)  # one turn; the curves' frames are at input angle 0
        phi = chords.nodes(
            lambda at: _pitch_points(gears, *_ratio(gears, at), at), ends, tolerance_mm
        )
    else:
        phi = np.linspace(-np.pi, np.pi, samples)
    turn, ratio = _ratio(gears, phi)
    r1, r2 = radii(gears, ratio)
    (x1, y1), (x2, y2) = (p.T for p in _pitch_points(gears, turn, ratio, phi))
    driver, driven = _convexities(ratio)
    columns = [
        np.degrees(phi),
        np.degrees(turn),
        ratio.c[0],
        r1,
        x1,
        y1,
        r2,
        x2,
        y2,
        driver,
        driven,
    ]
    return Table(NAMES, columns)


def required_gears(mechanism: Mechanism) -> Gears:
    """Return the noncircular gears of a machine; raises GenevaError if it has none."""
    drive, gears = mechanism.spec.drive, mechanism.spec.gears
    if gears is None and mechanism.spec.drive_before:
        raise GenevaError(f"--part gears: {mechanism.spec.no_parts}")
    if gears is None:
        if drive.round_gears:
            raise GenevaError(
                f'--part gears: the pitch curves of kind = "{drive.NAME}" are circles and have no '
                "table; write .dxf or .svg, or --part parts for their radii"
            )
        geared = [*registry.drives_with("gears"), *registry.drives_with("round_gears")]
        raise GenevaError(
            f'--part gears: kind = "{drive.NAME}" has no gears; {", ".join(geared)} have some'
        )
    return gears


class CurveLength(NamedTuple):
    """The length of both pitch curves, mm: they roll on each other, so that it is one."""

    whole: float
    ahead: PiecewisePolynomial  # of the input's angle, less its mean along the curve, radians

    def angle(self, s: np.ndarray) -> np.ndarray:
        """Return the input's angles, radians, at lengths of the curve from input angle 0 on."""
        first = self.ahead.origins[0]
        ahead: np.ndarray = self.ahead(first + np.mod(s - first, self.whole), 0)[0]
        return math.tau * s / self.whole + ahead


def curve_length(gears: Gears) -> CurveLength:
    """Return the length of the pitch curves, and the input's angle along them."""
    nodes, weights = rule(8)
    ends = np.linspace(-np.pi, np.pi, SAMPLES)
    half = 0.5 * np.diff(ends)[:, None]
    at = ends[:-1, None] + half * (1.0 + nodes)
    ratio, _ = ratio_and_turn(gears, at.ravel())
    i, slope = (array(c) for c in ratio.derivatives()[:2])
    speed = gears.distance_mm * np.hypot(slope, i * (1.0 + i)) / (1.0 + i) ** 2
    s = np.concatenate(([0.0], np.cumsum((speed.reshape(at.shape) * weights * half).sum(axis=1))))
    whole, s = float(s[-1]), s - s[SAMPLES // 2]
    return CurveLength(whole, periodic(s.tolist(), (ends - math.tau * s / whole).tolist()))


def convexity(gears: Gears) -> Convexity:
    """Return the least convexity of both gears over a turn."""
    _, ratio = _ratio(gears, np.linspace(-np.pi, np.pi, SAMPLES))
    driver, driven = _convexities(ratio)
    return Convexity(float(driver.min()), float(driven.min()))


def radii(gears: Gears, ratio: Jet) -> tuple[np.ndarray, np.ndarray]:
    """Return the radii of driver and driven gear where they touch, mm."""
    C, i = gears.distance_mm, array(ratio.c[0])
    return C * i / (1.0 + i), C / (1.0 + i)


def _pitch_points(
    gears: Gears, turn: np.ndarray, ratio: Jet, phi: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return the points (n, 2) at which driver and driven gear touch, each in its gear's frame."""
    driver, driven = radii(gears, ratio)
    return (
        np.column_stack((driver * np.cos(phi), -driver * np.sin(phi))),
        np.column_stack((-driven * np.cos(turn), -driven * np.sin(turn))),
    )


def _ratio(gears: Gears, phi: np.ndarray) -> tuple[np.ndarray, Jet]:
    """Return the crank's angle and the ratio with two derivatives, over a turn of the input."""
    ratio, turned = ratio_and_turn(gears, phi)
    # Angle of the crank ahead of the input, which is 0 at input angle 0.
    ahead = np.unwrap(np.angle(turned * np.exp(-1j * phi)))
    middle = float(ahead[np.argmin(np.abs(phi))])
    return phi + ahead - np.round(middle / (2.0 * np.pi)) * 2.0 * np.pi, ratio


def ratio_and_turn(gears: Gears, phi: np.ndarray) -> tuple[Jet, np.ndarray]:
    """Return the ratio with two derivatives by the input's angle, and the driven gear's turn.

    The turn is a unit complex number, counted from input angle 0. Angles are in radians.
    """
    sine, versine = gears.advance(phi, 3)
    cosine = 1.0 - versine
    low_cosine, low_sine = cosine.lower, sine.lower
    ratio = sine.derivative() * low_cosine + versine.derivative() * low_sine
    return ratio, array(cosine.c[0]) + 1j * array(sine.c[0])


def _convexities(ratio: Jet) -> tuple[np.ndarray, np.ndarray]:
    i, i1, i2 = (array(c) for c in ratio.derivatives())
    inverse = [array(c) for c in (1.0 / ratio).derivatives()]
    return 1.0 + inverse[0] + inverse[2], 1.0 + i + (i * i2 - i1 * i1) / i**3
