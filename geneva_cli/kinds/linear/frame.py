"""The frame of a rack's machine: the crank's shaft in it, and the guide along the rack on it.

A bar is bolted under the rack's back, and reaches a little beyond it. It slides between a rail, on
which the rack lies, and a wall. A cover on the wall keeps the rack from lifting. All of them lie
beyond the sweep of the crank's arm, and are screwed to the frame.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Circle
from geneva_cli.geometry.sheet import rectangle
from geneva_cli.kinds.linear.rack import RackSizes, crank_arm, rack_bore, rack_sizes, slot_places
from geneva_cli.loads.strength.pin_arm_key import NO_ARM, NO_KEY, ArmDimensions
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import value_or
from geneva_cli.parts.frame import hole_without_shaft, mounted_plate, shaft_holes
from geneva_cli.parts.gears.gear_pair import gear_shafts, gear_span
from geneva_cli.parts.parts import FrameAndShafts
from geneva_cli.parts.shafts.arm_and_shafts import Shaft, shaft_ends
from geneva_cli.parts.shafts.bores import bolt_radius, bore_of, reach_or_bore, tapped
from geneva_cli.parts.sized_by_load import ShaftSize, Stressed, key_of, shaft_of
from geneva_cli.parts.sizes import drawn_thicknesses, pin_radius
from geneva_cli.spec.defaults import wall_min


class RackFrame(NamedTuple):
    """The heights of a rack's parts along the crank's axis, mm; 0 is the rack's lower face."""

    plain: float  # lower face of a frame of plain shafts
    top: float  # upper face of the frame
    low: float  # lower face of what is on the crank's shaft: the arm, or gears below it
    arm: float  # lower face of the arm
    stands: float  # its upper face
    rack: float  # upper face of the rack
    cover: float  # thickness of the guide's cover


def rack_frame(mechanism: Mechanism) -> RackFrame:
    """Return the heights of a machine's parts."""
    size, R = mechanism.spec.size, mechanism.center_distance_mm
    thick, gap = drawn_thicknesses(size, R), size.allowances.pin_gap_mm
    arm = -gap - thick.arm
    low = gear_span(mechanism, None)[0] if mechanism.spec.gears else arm
    top = low - size.washer_mm
    stands = 0.0 - gap  # no -0.0
    return RackFrame(top - thick.arm, top, low, arm, stands, thick.wheel, thick.arm)


def shafts_and_frame(mechanism: Mechanism) -> FrameAndShafts:
    """Return the shafts and the frame, with holes for them and guide's screws."""
    size, sizes, heights = mechanism.spec.size, rack_sizes(mechanism), rack_frame(mechanism)
    axis, radius = mechanism.crank_shaft.at, rack_bore(mechanism)
    L = 2.0 * sizes.arm  # as a wheel of 6 slots has it
    own: list[Shaft] = []
    if radius:  # the crank's shaft, up to the arm's upper face
        low, high = shaft_ends(size, "crank", heights.plain, heights.stands)
        # the keyway is on the side of the locking sector, as in the arm
        bore = bore_of(size, "crank", radius)._replace(direction=math.pi)
        crank = Shaft("crank's shaft", "crank", bore, low, high, axis, math.pi)
        own.append(crank)
    if mechanism.spec.gears:
        own += gear_shafts(mechanism, None, heights.plain, True, radius)
    axles = tuple(one.member for one in own)
    bored = shaft_holes(size, axles, heights.top)
    if not radius:
        bored.insert(0, hole_without_shaft(mechanism.spec.shaft.crank_diameter_mm, axis, L))
    rows = zip(("guide rail", "guide wall"), _screws(sizes), strict=True)
    screwed = tuple((hole, name) for name, row in rows for hole in row)
    within = [*bored, *(tapped(hole) for hole, _ in screwed)]
    holes = [one for one in within if one.radius]
    eye = max(L / 20.0, 3.0 * wall_min(size, L))  # it leaves walls around mounting holes
    frame = mounted_plate(holes, within, eye, (heights.plain, heights.top))
    return FrameAndShafts(frame, axles, screwed=screwed if _bolt(sizes) else ())


def bar_bolts(sizes: RackSizes, count: int) -> tuple[Circle, ...]:
    """Return the holes that fix the guide's bar to a rack, behind each of its slots."""
    places = slot_places(sizes, count) if _bolt(sizes) else ()
    return tuple(Circle("BORE", (sizes.guide.middle, y), _bolt(sizes)) for y in places)


def guide(mechanism: Mechanism) -> tuple[Plate, ...]:
    """Return rail, wall and cover of the guide."""
    sizes, heights = rack_sizes(mechanism), rack_frame(mechanism)
    place = sizes.guide
    x, bar, slide, half = place.back, place.bar, place.slide, place.half
    if half < bar:
        raise GenevaError(
            f"roller_radius_mm = {sizes.roller:g}: a guide that the rack always covers would be "
            f"{2.0 * half:.4g} mm long, and its screws need {2.0 * bar:.4g}: use a smaller roller",
            ("size", "roller_radius_mm"),
        )
    over = heights.rack + mechanism.spec.size.allowances.pin_gap_mm
    on_rail, on_wall = (tuple(one for one in row if one.radius) for row in _screws(sizes))
    rail = rectangle("FRAME", x + bar + slide, -half, x + 2.0 * bar + slide, half)
    wall = rectangle("FRAME", x - slide - 2.0 * bar, -half, x - slide, half)
    # the cover ends a tenth of a bar inside the edges of wall and bar
    cover = rectangle("FRAME", x - slide - 1.9 * bar, -half, x + 0.9 * bar, half)
    return (
        Plate("guide rail", "FRAME", rail, on_rail, heights.top, 0.0),
        Plate("guide wall", "FRAME", wall, on_wall, heights.top, over),
        Plate("guide cover", "FRAME", cover, on_wall, over, over + heights.cover),
    )


def _screws(sizes: RackSizes) -> list[tuple[Circle, ...]]:
    """Return three screws' holes in rail and in wall; of no width where no screw is so thin."""
    place, r = sizes.guide, _bolt(sizes)
    far = place.half - 0.5 * place.bar  # half a bar's width from the ends
    rows = place.back + 1.5 * place.bar + place.slide, place.back - place.slide - place.bar
    return [tuple(Circle("BORE", (x, y), r) for y in (-far, 0.0, far)) for x in rows]


def _bolt(sizes: RackSizes) -> float:
    return bolt_radius(None, 2.0 * sizes.arm, 0.5 * sizes.guide.bar)


def rack_stressed(mechanism: Mechanism) -> Stressed:
    """Return the dimensions of the parts of a machine that their strength depends on."""
    spec, heights, bore = mechanism.spec, rack_frame(mechanism), rack_bore(mechanism)
    size, R = spec.size, mechanism.center_distance_mm
    contact, thick = value_or(size.face_width_mm, heights.rack), heights.stands - heights.arm
    bend = NO_ARM
    if bore:
        arm, bored = crank_arm(mechanism), reach_or_bore(size, "crank", bore)
        offset = 0.5 * (contact + thick) - heights.stands
        bend = ArmDimensions(R, arm.hub, arm.eye, bored, arm.pins[0].radius, thick, offset)
    to_frame = 0.5 * heights.rack - (heights.low - size.washer_mm)
    return Stressed(
        contact,
        2.0 * pin_radius(size, mechanism.roller_radius_mm),
        ShaftSize(math.nan, math.nan),
        shaft_of(spec, "crank", bore, to_frame, thick),
        bend,
        NO_KEY,
        key_of(size.crank_keyway, bore, thick),
    )


def horn_sizes(mechanism: Mechanism) -> tuple[float, float]:
    """Return half the slot's width and the recess's radius, NaN for a rack that cannot be cut."""
    try:
        sizes = rack_sizes(mechanism)
    except GenevaError:  # the check of the parts reports the error
        return math.nan, math.nan
    return sizes.half_width, sizes.recess
