"""The teeth of two noncircular gears: one rack rolls along both of their pitch curves.

The pitch curves are equally long, so that both gears have the same number of teeth. That number
must fit their length, which is proportional to the distance of the axes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.gear_teeth import Rack, Writer, curvatures, teeth_along, thinnest_tip
from geneva_cli.geometry.shapes import Segment
from geneva_cli.motion.drive import Gears
from geneva_cli.motion.pivots import Dimension
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.gears.gear_curves import CurveLength, curve_length
from geneva_cli.spec.tables import Size

if TYPE_CHECKING:
    from geneva_cli.geometry.fit.path import Curve


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
    """Return the teeth of the driver or the driven gear.

    ``curve`` is its pitch curve by the input's angle, and ``sense`` is 1 if it runs
    counterclockwise. At input angle 0 a tooth of the driver is on the line of centres.

    Raises GenevaError, naming the key, where the pitch curve bends too much for its teeth.
    """

    def pitch(s: Array) -> tuple[Array, Array]:
        points, tangents = curve(teeth.length.angle(sense * s))
        return points, sense * tangents

    rack, tip = (teeth.driver, teeth.tips[1]) if driver else (teeth.driven, teeth.tips[0])
    _refuse(curvatures(pitch, teeth.length.whole, 4096), rack, tip)
    middles = rack.pitch * (np.arange(float(teeth.z)) + (0.0 if driver else 0.5))
    if thinnest_tip(pitch, rack, middles, tip) < rack.least_tip:
        raise GenevaError(
            f"gear_module_mm = {rack.module:g}: teeth would be pointed; use a smaller module, or "
            "gear_shift nearer to 0",
            ("size", "gear_module_mm"),
        )
    return ToothedCurve(pitch, rack, middles, tip)


def _refuse(bends: tuple[float, float], rack: Rack, tip: float) -> None:
    """Raise GenevaError where a pitch curve, of some curvatures, is too narrow for its teeth.

    On a convex bend the rack undercuts the flank below it, on a hollow one the flank above it.
    """
    most = max(bends[1] * rack.straight, -bends[0] * tip) / math.sin(rack.angle) ** 2
    if most > 1.0:
        raise GenevaError(
            f"gear_module_mm = {rack.module:g}: teeth would be undercut where the pitch curve "
            f"bends most; at most {rack.module / most:.4g} fits",
            ("size", "gear_module_mm"),
        )
