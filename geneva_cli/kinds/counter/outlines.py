"""The gears of a counter: their teeth, their mesh, the locking rim, and their outlines.

Driver and pinion have involute teeth of one rack. The driver keeps two of its N. The pinion has
2 z, and every second one is wide: it also lies in the plane of the driver's rim. At input angle 0 a
wide tooth is on the line of centres, between the driver's two.

Profile shifts keep both from undercut, x = max(0, 1 - z sin² 20°) of the pinion, and more where a
backlash thins the teeth. Where their sum is above 0, the gears work at a larger pressure angle w,
and the module is smaller:

    inv w = inv 20° + 2 (x1 + x2) tan 20°/(N + 2 z),    m = 2 L cos w/((N + 2 z) cos 20°)

At rest a narrow tooth is on the line of centres, and the two wide ones next to it lie 180°/z to
either side. The rim is the largest circle about the driver's axis that they let pass, less
``lock_clearance_mm``. The driver's tips may not pass it either, as they go by the same teeth. The
number wheels are in a plane without a rim, and have the whole teeth.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.gear_teeth import Rack, RoundTeeth, Writer, circle, fillet, involute
from geneva_cli.geometry.measure import turned_pieces
from geneva_cli.geometry.shapes import ORIGIN, Contour, Segment, about, closed
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.roots import boundary
from geneva_cli.parts.gears.gear_mesh import GearMesh, ToothedGear, contact_ratio, with_tips


class CounterSizes(NamedTuple):
    """The teeth of driver and pinion about their axes, and the locking rim; mm and radians."""

    driver: RoundTeeth
    number: RoundTeeth  # of number wheels, whose tips the rim does not limit
    pinion: RoundTeeth
    distance: float  # of the axes
    shifts: tuple[float, float]  # of driver and pinion in modules, without backlash
    pressure_angle: float  # at work
    contact_ratio: float  # of number wheels and pinions
    rim: float  # radius

    @property
    def half_space(self) -> float:
        """Half the angle between the driver's two teeth."""
        return 0.5 * self.driver.step


def counter_sizes(mechanism: Mechanism) -> CounterSizes:
    """Return the sizes of a counter. Raises GenevaError, naming the key, if none fit."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    z = spec.wheel.z
    large = round(2 * z * mechanism.ratio / (1.0 - mechanism.ratio))
    counts, backlash_mm = (large, 2 * z), spec.size.allowances.gear_backlash_mm
    number, pinion, shifts, angle, contact = _meshing(counts, L, backlash_mm)
    rim = _touching_circle(pinion, L) - spec.size.allowances.lock_clearance_mm
    driver = number._replace(tip=min(number.tip, rim))
    if driver.tip <= driver.base or rim <= L - pinion.tip:
        raise GenevaError(
            f"z = {z}: the rim that locks {z} wide teeth, of radius {rim:.4g} mm, leaves the "
            f"driver no teeth, which begin at {driver.base:.4g} mm; use more teeth, or a smaller "
            "lock_clearance_mm",
            ("wheel", "z"),
        )
    return CounterSizes(driver, number, pinion, L, shifts, angle, contact, rim)


def counter_mesh(sizes: CounterSizes) -> GearMesh:
    """Return driver, pinion and number wheel; of the driver's teeth two are left.

    The driver's teeth lie to either side of the x axis, and so does a space of the number wheel. A
    wide tooth of the pinion is on the x axis.
    """
    driver, pinion = sizes.driver, sizes.pinion
    count, half = round(math.tau / driver.step), sizes.half_space
    ahead = tuple(half + k * driver.step for k in range(count))
    around = tuple(k * pinion.step for k in range(round(math.tau / pinion.step)))
    gears = {
        "driver": ToothedGear(driver, count, sizes.shifts[0], ((-half, half),)),
        "pinion": ToothedGear(pinion, len(around), sizes.shifts[1], (around,)),
        "number wheel": ToothedGear(sizes.number, count, sizes.shifts[0], (ahead,)),
    }
    return GearMesh(gears, sizes.pressure_angle, sizes.contact_ratio)


def _meshing(
    counts: tuple[int, int], L: float, backlash_mm: float
) -> tuple[RoundTeeth, RoundTeeth, tuple[float, float], float, float]:
    """Return the teeth of number wheel and pinion by their numbers, and how they mesh.

    That is their shifts in modules without backlash, the pressure angle at work, radians, and the
    contact ratio. Raises GenevaError, naming the key, for teeth that lose contact.
    """
    plain, total = Rack(1.0), sum(counts)
    # modules by which a backlash along the pitch circles at work thins both, a half each
    thinner = backlash_mm * total / (8.0 * L * math.tan(plain.angle))
    # no undercut: the rack's straight flank ends above the base circle's tangent
    least = [1.0 - 0.5 * n * math.sin(plain.angle) ** 2 + thinner for n in counts]
    own = max(0.0, least[1])
    shifts = max(-own, least[0]), own
    rolled = involute(plain.angle) + 2.0 * sum(shifts) * math.tan(plain.angle) / total
    angle = boundary(lambda w: involute(w) <= rolled, plain.angle, 1.2)
    m = 2.0 * L * math.cos(angle) / (total * math.cos(plain.angle))
    number, pinion = (
        RoundTeeth(Rack(m, x - thinner), 0.5 * m * count, 0.0)
        for x, count in zip(shifts, counts, strict=True)
    )
    number, pinion = with_tips(number, pinion, shifts, L, angle)
    contact = 0.0
    if number.tip > number.base and pinion.tip > pinion.base:
        number, pinion = _blunt(number), _blunt(pinion)
        contact = contact_ratio(number, pinion, L, angle)
    if contact < 1.0:
        raise _lost_contact(backlash_mm, counts[0], max(0.0, contact))
    return number, pinion, shifts, angle, contact


def _lost_contact(backlash_mm: float, teeth: int, contact: float) -> GenevaError:
    """Return the error for teeth of number wheel and pinion that lose contact."""
    key, value, other = ("wheel", "driver_teeth"), float(teeth), "more teeth"
    if backlash_mm:
        key, value = ("size", "gear_backlash_mm"), backlash_mm
        other = "a smaller one, or more driver_teeth"
    return GenevaError(
        f"{key[1]} = {value:g}: teeth of number wheel and pinion lose contact, as their contact "
        f"ratio is {contact:.3g}; use {other}",
        key,
    )


def _blunt(teeth: RoundTeeth) -> RoundTeeth:
    """Return teeth that end where they still have the least thickness."""
    least = teeth.rack.least_tip
    tip = boundary(lambda r: teeth.thickness(r) >= least, teeth.radius, teeth.tip)
    return teeth._replace(tip=tip)


def _touching_circle(pinion: RoundTeeth, L: float) -> float:
    """Return the radius of the circle about the driver's axis that touches the wide teeth at rest.

    Its normal at the touching point of a flank is a tangent of the base circle, through the
    driver's axis. The tangent's length down to the flank, from the base circle, is the arc from
    the flank's beginning. A flank that ends before is touched at its end. A fillet is concave, so
    its nearest point is one of its ends. The circle keeps a tenth of a module from the root circle.
    """
    rack, base = pinion.rack, pinion.base
    begins = pinion.step - pinion.half_angle(base)
    along = base * (math.acos(base / L) - begins)
    along = min(max(along, pinion.flank_end), pinion.tangent(pinion.tip))
    r = math.hypot(base, along)
    least = math.sqrt(L * L + r * r - 2.0 * L * r * math.cos(pinion.step - pinion.half_angle(r)))
    return min(least, L - pinion.root - 0.1 * rack.module)


def half_angles(teeth: RoundTeeth) -> Callable[[Array], Array]:
    """Return the angle between middle and side of a tooth as a function of radii up to the tip.

    It is the flank's, and the fillet's below it. A thousand chords of a fillet, which is about a
    module long, miss it by 1e-7 modules.
    """
    rack = teeth.rack
    u = np.linspace(-rack.end, -rack.corner[0], 1001)
    points, _ = fillet(circle(teeth.radius), rack, 0.0, 1)(u)
    below, side = np.hypot(*points.T), np.arctan2(points[:, 1], points[:, 0])
    start, ascending = below[0], below[::-1]

    def at_radii(r: Array) -> Array:
        cosine = np.minimum(teeth.base / np.maximum(r, max(start, teeth.base)), 1.0)
        at = np.arccos(cosine)
        on_flank = rack.half / teeth.radius + involute(rack.angle) - (np.tan(at) - at)
        return np.where(r >= start, on_flank, np.interp(r, ascending, side[::-1]))

    return at_radii


def driver_teeth(sizes: CounterSizes, write: Writer) -> Contour:
    """Return the driver's two teeth on its root circle, to either side of the x axis."""
    teeth, half = sizes.driver, sizes.half_space
    one = teeth.one(write)
    pieces = *turned_pieces([*one, teeth.between()], -half), *turned_pieces(one, half)
    start = half + teeth.rack.corner[0] / teeth.radius
    return closed("CRANK", [*pieces, about(ORIGIN, teeth.root, start, math.tau - 2.0 * start)])


def driver_rim(sizes: CounterSizes, write: Writer) -> Contour:
    """Return the locking rim, whose gap is the space between the driver's two teeth."""
    teeth, half = sizes.driver._replace(tip=sizes.rim), sizes.half_space
    before, after = teeth.sides(write)
    pieces = *turned_pieces([*after, teeth.between()], -half), *turned_pieces(before, half)
    start = half - teeth.half_angle(sizes.rim)
    return closed("CRANK", [*pieces, about(ORIGIN, sizes.rim, start, math.tau - 2.0 * start)])


def pinion_teeth(sizes: CounterSizes, write: Writer) -> tuple[Contour, Contour]:
    """Return the pinion in the plane of all its teeth, and in that of its wide teeth alone."""
    tooth = sizes.pinion.one(write)
    every, wide = (closed("WHEEL", _all_round(sizes.pinion, tooth, 0.0, each)) for each in (1, 2))
    return every, wide


def number_teeth(sizes: CounterSizes, write: Writer) -> Contour:
    """Return the gear of the number wheel, whose space is about the x axis, as the driver's."""
    return closed("CRANK", _all_round(sizes.number, sizes.number.one(write), sizes.half_space))


def _all_round(
    teeth: RoundTeeth, tooth: list[Segment], first: float, each: int = 1
) -> list[Segment]:
    """Return the outline of a gear from its first tooth on, with every ``each``-th tooth.

    ``tooth`` is a tooth about the x axis.
    """
    pieces = [*tooth, teeth.between((each - 1) * teeth.step)]
    turns = [first + k * teeth.step for k in range(0, round(math.tau / teeth.step), each)]
    return [piece for turn in turns for piece in turned_pieces(pieces, turn)]
