"""Pitch curves of the gears in front of a crank, a test whether they can be cut, and their teeth.

The ratio is i = crank speed / input speed, and the axes are C apart. The pitch curves meet on the
line of centres, at r1 = C i/(1+i) from the driver and r2 = C/(1+i) from the driven gear. Convex
curves can be hobbed. With derivatives by the driver's angle, the curves are convex where

    driver:  1 + 1/i + (1/i)'' > 0,    driven gear:  1 + i + (i i'' - i'²)/i³ > 0

One rack rolls along both curves and cuts the teeth. The curves are equally long, so that both gears
have the same number of teeth, which must fit that length.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import chords
from geneva_cli.geometry.gear_teeth import Rack, Writer, curvatures, teeth_along, thinnest_tip
from geneva_cli.geometry.shapes import Segment
from geneva_cli.motion import registry
from geneva_cli.motion.drive import Gears
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension
from geneva_cli.numerics.arrays import Array, array
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.quadrature import rule
from geneva_cli.numerics.spline import PiecewisePolynomial, periodic
from geneva_cli.spec.tables import Size
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.geometry.fit.arcs import Curve


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


def gears_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return both pitch curves: for a chord tolerance, or at ``samples`` even input angles.

    Each is in its own gear's frame, with x along the line of centres at input angle 0. A curve is
    listed as it is cut, so its angle runs against the gear's rotation.
    """
    gears = required_gears(mechanism)

    def points(phi: Array) -> tuple[Array, Array]:
        """Return the points (n, 2) at which driver and driven gear touch."""
        turn, ratio = _ratio(gears, phi)
        driver, driven = radii(gears, ratio)
        return (
            np.column_stack((driver * np.cos(phi), -driver * np.sin(phi))),
            np.column_stack((-driven * np.cos(turn), -driven * np.sin(turn))),
        )

    # one turn; the curves' frames are at input angle 0
    phi = np.linspace(-np.pi, np.pi, samples or 3)
    if samples is None:
        phi = chords.nodes(points, (-np.pi, 0.0, np.pi), tolerance_mm)
    turn, ratio = _ratio(gears, phi)
    (r1, r2), both = radii(gears, ratio), points(phi)
    columns = [np.degrees(phi), np.degrees(turn), ratio.c[0], r1, *both[0].T, r2, *both[1].T]
    return Table(NAMES, [*columns, *_convexities(ratio)])


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


def convexity(gears: Gears) -> tuple[float, float]:
    """Return the least value of the convexity conditions of driver and driven gear in a turn.

    It is not above 0 for a hollow gear.
    """
    _, ratio = _ratio(gears, np.linspace(-np.pi, np.pi, SAMPLES))
    driver, driven = _convexities(ratio)
    return float(driver.min()), float(driven.min())


def radii(gears: Gears, ratio: Jet) -> tuple[Array, Array]:
    """Return the radii of driver and driven gear where they touch, mm."""
    C, i = gears.distance_mm, array(ratio.c[0])
    return C * i / (1.0 + i), C / (1.0 + i)


def _ratio(gears: Gears, phi: Array) -> tuple[Array, Jet]:
    """Return the crank's angle and the ratio with two derivatives, over a turn of the input."""
    ratio, turned = ratio_and_turn(gears, phi)
    # Angle of the crank ahead of the input, which is 0 at input angle 0.
    ahead = np.unwrap(np.angle(turned * np.exp(-1j * phi)))
    middle = float(ahead[np.argmin(np.abs(phi))])
    return phi + ahead - np.round(middle / (2.0 * np.pi)) * 2.0 * np.pi, ratio


def ratio_and_turn(gears: Gears, phi: np.ndarray) -> tuple[Jet, np.ndarray]:
    """Return the ratio with two derivatives by the input's angle, and the driven gear's turn."""
    sine, versine = gears.advance(phi, 3)
    cosine = 1.0 - versine
    low_cosine, low_sine = cosine.lower, sine.lower
    ratio = sine.derivative() * low_cosine + versine.derivative() * low_sine
    return ratio, array(cosine.c[0]) + 1j * array(sine.c[0])


def _convexities(ratio: Jet) -> tuple[np.ndarray, np.ndarray]:
    i, i1, i2 = (array(c) for c in ratio.derivatives())
    inverse = [array(c) for c in (1.0 / ratio).derivatives()]
    return 1.0 + inverse[0] + inverse[2], 1.0 + i + (i * i2 - i1 * i1) / i**3


class PairTeeth(NamedTuple):
    """The teeth of both gears; the profile shift of one is minus that of the other."""

    length: CurveLength
    z: int  # teeth of each gear
    driver: Rack
    driven: Rack
    shift: float  # of the driver, in modules, before the backlash is taken off

    @property
    def tips(self) -> tuple[float, float]:
        """Heights of the teeth of driven gear and driver above their pitch curves, mm."""
        module = self.driver.module
        return module * (1.0 - self.shift), module * (1.0 + self.shift)

    @property
    def roots(self) -> tuple[float, float]:
        """Depths of the teeth of driven gear and driver below their pitch curves, mm."""
        driven, driver = (r.module * (r.dedendum - r.shift) for r in (self.driven, self.driver))
        return driven, driver

    @property
    def layout(self) -> tuple[Dimension, ...]:
        """Dimensions of the teeth."""
        return (
            Dimension("teeth of each gear", self.z),
            Dimension("gears' module", self.driver.module, "mm"),
            Dimension("gears' pressure angle", math.degrees(self.driver.angle), "deg"),
            Dimension("driver gear: profile shift x", self.shift),
            Dimension("driven gear: profile shift x", -self.shift),
        )


def pair_teeth(gears: Gears | None, size: Size) -> PairTeeth | None:
    """Return the teeth of a pair of gears; None without a pair, or without a module.

    Raises GenevaError, naming the key, if no whole number of teeth fits the pitch curves.
    """
    module = size.gear_module_mm
    if gears is None or module is None:
        return None
    length = curve_length(gears)
    whole = length.whole
    real = whole / (math.pi * module)
    count = max(round(real), 3) if size.gear_teeth is None else size.gear_teeth
    if count > 1000:
        raise GenevaError(
            f"gear_module_mm = {module:g}: {count} teeth are more than the 1000 of a gear; "
            f"at least {whole / (1000.0 * math.pi):.4g} fits",
            ("size", "gear_module_mm"),
        )
    # a thousandth is a tooth's error that files and cutters do not show; the teeth stay even
    if abs(real / count - 1.0) > 1e-3:
        raise GenevaError(
            f"gear_module_mm = {module:g}: the pitch curves are {whole:.6g} mm long, {real:.4g} "
            f"teeth; for {count} teeth set gear_distance_mm = "
            f"{gears.distance_mm * count / real:.6g}, or gear_module_mm = "
            f"{whole / (math.pi * count):.6g}",
            ("size", "gear_module_mm"),
        )
    even = Rack(whole / (math.pi * count))
    shift = size.gear_shift or 0.0
    off = 0.25 * size.allowances.gear_backlash_mm / (even.module * math.tan(even.angle))
    driver, driven = (even._replace(shift=x - off) for x in (shift, -shift))
    return PairTeeth(length, count, driver, driven, shift)


class ToothedCurve(NamedTuple):
    """A pitch curve by its length, with the rack that cuts its teeth, their middles and height."""

    pitch: Curve
    rack: Rack
    middles: Array
    tip: float

    def outline(self, write: Writer) -> list[Segment]:
        """Return the gear's outline; ``write`` fits curves."""
        return list(teeth_along(self.pitch, self.rack, self.middles, self.tip, write))


def toothed_curve(teeth: PairTeeth, driver: bool, curve: Curve, sense: float) -> ToothedCurve:
    """Return the teeth of the driver or the driven gear."""

    def pitch(s: Array) -> tuple[Array, Array]:
        points, tangents = curve(teeth.length.angle(sense * s))
        return points, sense * tangents

    rack, tip = (teeth.driver, teeth.tips[1]) if driver else (teeth.driven, teeth.tips[0])
    # on a convex bend the rack undercuts the flank below it, on a hollow one that above it
    hollow, convex = curvatures(pitch, teeth.length.whole, 4096)
    most = max(convex * rack.straight, -hollow * tip) / math.sin(rack.angle) ** 2
    if most > 1.0:
        raise GenevaError(
            f"gear_module_mm = {rack.module:g}: teeth would be undercut where the pitch curve "
            f"bends most; at most {rack.module / most:.4g} fits",
            ("size", "gear_module_mm"),
        )
    middles = rack.pitch * (np.arange(float(teeth.z)) + (0.0 if driver else 0.5))
    if thinnest_tip(pitch, rack, middles, tip) < rack.least_tip:
        raise GenevaError(
            f"gear_module_mm = {rack.module:g}: teeth would be pointed; use a smaller module, or "
            "gear_shift nearer to 0",
            ("size", "gear_module_mm"),
        )
    return ToothedCurve(pitch, rack, middles, tip)
