"""The heights of a counter's parts, its shafts, and the frame that holds them.

Pinions stand on one shaft and number wheels on the other, each pinion beside two number wheels. The
lower of the two is a gear in the plane of the pinion's narrow teeth. The upper one has two teeth
above this gear, and its rim on top, beside the pinion's wide teeth. The upmost is the driver, which
alone is fixed to its shaft. All others turn on their shaft, and so do more pinions than one.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Circle
from geneva_cli.kinds.counter.outlines import CounterSizes
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.preferred import bore_radius
from geneva_cli.parts.edged_parts import FrameAndShafts
from geneva_cli.parts.mounted_plate import corner_radius, mounted_plate, require_walls, shaft_holes
from geneva_cli.parts.shafts.bearings import shoulder_length
from geneva_cli.parts.shafts.bores import Bore, bore_of, has_shape
from geneva_cli.parts.shafts.built_shafts import built_shafts
from geneva_cli.parts.shafts.shaft import Seat, Shaft, shaft_ends
from geneva_cli.parts.sizes.plain_sizes import drawn_thicknesses
from geneva_cli.spec.least_wall import wall_min


class Heights(NamedTuple):
    """Heights along the axes, mm; 0 is the lower face of the lowest pinion and number wheel."""

    tooth: float  # thickness of gears, and of the two teeth
    gap: float  # between parts that pass each other
    pinions: int

    @property
    def pinion(self) -> float:
        """Height of a pinion."""
        return self.narrow + self.gap + self.tooth

    @property
    def narrow(self) -> float:
        """Height of a pinion's narrow teeth: a gear's, that of two teeth, and a gap between."""
        return 2.0 * self.tooth + self.gap

    @property
    def pitch(self) -> float:
        """Height from a pinion to the next; a wheel between them keeps a gap from both."""
        return self.pinion + 2.0 * self.gap

    @property
    def top(self) -> float:
        """Height of all parts."""
        return (self.pinions - 1) * self.pitch + self.pinion


def heights(mechanism: Mechanism) -> Heights:
    """Return the heights of a counter's parts."""
    size = mechanism.spec.size
    thick = drawn_thicknesses(size, mechanism.center_distance_mm).wheel
    return Heights(thick, size.allowances.pin_gap_mm, mechanism.spec.wheel.pinions)


def bore(mechanism: Mechanism, sizes: CounterSizes, part: str) -> Bore:
    """Return the bore of the pinion, "wheel", or of the driver, "crank".

    It is that of the spec, or of a standard bearing up to L/6 or half the root circle. Raises
    GenevaError, naming the key, for a bore that leaves too thin a wall, or whose shape several
    pinions share.
    """
    size, key = mechanism.spec.size, f"{part}_bore_mm"
    root, L = (sizes.pinion if part == "wheel" else sizes.driver).root, sizes.distance
    own, least = getattr(size, key), wall_min(size, L)
    most = min(0.5 * root, L / 12.0)
    radius = (bore_radius(most) or most) if own is None else 0.5 * own
    if not radius:
        raise GenevaError(f"{key} = 0: a counter's gears stand on shafts; remove it", ("size", key))
    form = bore_of(size, part, radius)
    if form.reach > root - least:
        raise GenevaError(
            f"{key} = {2.0 * radius:g}: the teeth begin at Ø {2.0 * root:.4g} mm, so that the bore "
            f"must be at most {2.0 * (root - least - form.reach + radius):.4g}",
            ("size", key),
        )
    if part == "wheel" and mechanism.spec.wheel.pinions > 1 and has_shape(size, part):
        shape = "wheel_bore" if size.wheel_keyway is None else "wheel_keyway"
        raise GenevaError(
            f"{shape}: of more than 2 number wheels each pinion turns by itself on the shaft; "
            f"remove {shape}",
            ("size", shape),
        )
    return form


def shafts_and_frame(mechanism: Mechanism, sizes: CounterSizes) -> FrameAndShafts:
    """Return both shafts, plain or turned, and the frame that holds them.

    Raises GenevaError, naming the key, where they do not fit.
    """
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    free = 0.0 - size.washer_mm  # no -0.0
    top = free - shoulder_length(size, L)
    lowest = top - drawn_thicknesses(size, L).arm
    own = list(_shafts(mechanism, sizes, lowest))
    axles, bottom = built_shafts(size, own, [], (lowest, top, free))
    holes = shaft_holes(size, axles, top)
    require_walls(holes, wall_min(size, L), axles)
    reach = [*holes, *(Circle("BORE", one.at, 0.0) for one in own)]
    frame = mounted_plate(holes, reach, corner_radius(size, L), (bottom, top))
    to_fix = tuple(name for one in own for name in one.to_fix(size))
    return FrameAndShafts(frame, tuple(axles), to_fix=to_fix)


def _shafts(mechanism: Mechanism, sizes: CounterSizes, lowest: float) -> Iterator[Shaft]:
    """Yield the shafts of pinions and of driver and number wheels."""
    size, tall = mechanism.spec.size, heights(mechanism)
    pinions = "pinions' shaft" if tall.pinions > 1 else "pinion's shaft"
    names = {"wheel": pinions, "crank": "driver's shaft"}
    ends_of = {"wheel": _pinions, "crank": _wheels}
    for part, at in (("wheel", (0.0, 0.0)), ("crank", (sizes.distance, 0.0))):
        low, high = shaft_ends(size, part, lowest, tall.top)
        form, seats = bore(mechanism, sizes, part), tuple(ends_of[part](tall))
        # the keyway is opposite the other shaft: under a tooth, and away from the driver's two
        turn = math.pi if part == "wheel" else 0.0
        one = Shaft(names[part], part, form, seats, low, high, at, turn)
        yield one._replace(ends_here=False)


def _pinions(tall: Heights) -> Iterator[Seat]:
    """Yield the places of the pinions on their shaft, from the lowest up."""
    for k in range(tall.pinions):
        low = k * tall.pitch
        yield Seat("pinion", low, low + tall.pinion, held=tall.pinions == 1)


def _wheels(tall: Heights) -> Iterator[Seat]:
    """Yield the places of the number wheels on their shaft, from the lowest up, and the driver."""
    low = 0.0
    for k in range(tall.pinions):
        high = k * tall.pitch + tall.tooth
        yield Seat("number wheel", low, high, held=False)
        low = high + tall.gap
    yield Seat("driver", low, tall.top)
