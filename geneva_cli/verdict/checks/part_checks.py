"""Parts at rest: walls, gaps at shafts, hubs, arm and links, and what the process can cut."""

import math
from collections.abc import Collection, Iterator
from itertools import combinations, product

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import plate_wall
from geneva_cli.geometry.shapes import Arc, Line, Segment, backwards, closed, placed
from geneva_cli.loads.load_case import farthest_mm
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import opposites
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.outlines.crank_outline import is_whole
from geneva_cli.parts.outlines.outlines import Outlines, wheel_hub, wheel_plate
from geneva_cli.parts.parts import Parts
from geneva_cli.parts.shafts.arm_and_shafts import crank_hub
from geneva_cli.parts.shafts.arm_and_shafts import walls as arm_walls
from geneva_cli.parts.shafts.bores import has_shape
from geneva_cli.parts.slots.roller_paths import roller_centres
from geneva_cli.spec.workshops import WORKSHOPS
from geneva_cli.verdict.checks import Check, compared, measured, refused, unknown


def walls(names: Collection[str], parts: FlatParts) -> Iterator[Check]:
    """Walls of wheel and crank, which must not be thinner than the process makes them."""
    outlines, spec = parts.outlines, parts.mechanism.spec
    assembly, size, least = outlines.assembly, outlines.sizes, outlines.sizes.wall_min
    around_shaft = 0.5 * spec.size.allowances.shaft_fit_mm
    if "wall_between_slots_mm" in names:
        yield compared("wall_between_slots_mm", _between_slots(outlines), "at least", least)
    if outlines.crank:  # between a slot and the recess of the locking disc or sectors
        yield compared("horn_mm", size.horn, "at least", least)
    # the roller that starts the wheel and the one that stops it, on one crank
    if len(assembly.rollers) > len(assembly.motions):
        pairs = combinations(roller_centres(assembly), 2)
        apart_mm = min(math.dist(one, other) for one, other in pairs) - 2.0 * size.roller
        yield compared("rollers_apart_mm", apart_mm, "at least", 0.0)
    if size.wheel_bore:  # to the slots' ends, and around the bore in a drawn hub
        wall = size.slot_end - size.wheel_bore - around_shaft
        if wheel_hub(assembly, size):
            wall = min(wall, size.wheel_hub - size.wheel_reach)
        yield compared("wheel_bore_wall_mm", wall, "at least", least)
    if size.outer:  # of an internal wheel, outside slots or recesses
        deepest = max(size.slot_end, assembly.L + size.recess if size.lock else 0.0)
        yield compared("outer_wall_mm", size.outer - deepest, "at least", least)
    # around the bore with its keyway and around the dial's bolts
    if (has_shape(spec.size, "wheel") or spec.size.dial_bolts) and "dial_wall_mm" in names:
        wheel = wheel_plate(assembly, size, outlines.wheel)
        yield compared("dial_wall_mm", plate_wall(wheel), "at least", least)
    # to the bottom of the locking disc's relief, and around the bore in a drawn hub
    if size.crank_bore and outlines.crank and is_whole(assembly, size):
        wall = outlines.relief_depth - size.crank_bore - around_shaft
        if crank_hub(outlines):
            wall = min(wall, size.crank_hub - size.crank_reach)
        yield compared("crank_bore_wall_mm", wall, "at least", least)


def _between_slots(outlines: Outlines) -> float:
    """The wall between adjacent slots at its thinnest place; negative where they cut each other."""
    around, near, L = outlines.assembly.slots, math.inf, outlines.assembly.L
    for i, (engagement, direction) in enumerate(around):
        following, ahead = around[(i + 1) % len(around)]
        slot_walls = placed(outlines.slots[engagement], turn=direction)
        (u, v), (x, y) = slot_walls.segments[-1].end, slot_walls.segments[0].start
        mouth: Segment = Line((u, v), (x, y))
        if engagement.apart > 0.0:  # along the rim for a pair, which a chord might cut
            back = (math.atan2(v, u) - math.atan2(y, x)) % math.tau
            mouth = Arc((u, v), (x, y), -math.tan(0.25 * back))
        slot = closed(slot_walls.layer, [*slot_walls.segments, mouth])
        inside = Polyarc([backwards(slot) if outlines.assembly.sign > 0.0 else slot])
        points = Polyarc([placed(outlines.slots[following], turn=ahead)]).samples(
            1e-6 * L, 0.01 * L
        )
        near = min(near, float(inside.signed(points).min()))
        if len(outlines.slots) == 1:  # all are alike
            break
    return near


def clearances(names: Collection[str], parts: FlatParts) -> Iterator[Check]:
    """Gaps at shafts and hubs, and what is checked of arm and links if the spec sizes them."""
    outlines, size = parts.outlines, vars(parts.mechanism.spec.size)
    assembly, sizes, least = outlines.assembly, outlines.sizes, outlines.sizes.wall_min
    crank, wheel = parts.axle_radius("crank"), parts.axle_radius("wheel")
    if crank:
        # An internal wheel's horns sweep over the crank's axis, so there is no clearance at all.
        gap = assembly.L - sizes.rim - crank if assembly.sign > 0.0 else -crank
        yield compared("crank_shaft_mm", gap, "at least", 0.0)
        if outlines.crank and is_whole(assembly, sizes):  # to the bottom of the disc's relief
            yield compared("crank_hub_mm", outlines.relief_depth - crank, "at least", 0.0)
    if wheel and assembly.sign > 0.0:  # to a roller at the bottom of its slot
        yield compared("wheel_shaft_mm", sizes.slot_end - wheel, "at least", 0.0)
    # default sizes of hubs and shafts always pass, except for a first wheel's
    sized = bool(parts.mechanism.first_wheel)
    for key in product(("wheel", "crank"), ("hub", "hub_length", "shaft_low", "shaft_high")):
        sized = sized or size[f"{'_'.join(key)}_mm"] is not None
    geared = parts.mechanism.spec.gears is not None
    for name, is_there in (("beside_shafts_mm", sized), ("gear_gap_mm", geared)):
        if is_there and name in names:
            from geneva_cli.verdict.shaft_gap import shaft_gaps  # for few machines

            yield from least_gap(name, shaft_gaps(parts, name == "gear_gap_mm"), assembly.L)
    arm = "arm_bore_mm", "arm_hub_mm", "arm_eye_mm", "press_fit_mm", "lock_bolts"
    shaped = has_shape(parts.mechanism.spec.size, "crank")
    if shaped or any(map(size.get, arm)):
        yield from measured(
            "arm_wall_mm", least, lambda: parts.arm and arm_walls(parts.arm, outlines)
        )
        if assembly.sign > 0.0:  # the arm's end passes below the wheel
            yield from measured("arm_to_hub_mm", 0.0, lambda: parts.arm and parts.arm.hub_gap)
    links = "link_pin_mm", "link_bore_mm", "link_width_mm", "press_fit_mm", "pin_mm"
    if any(map(size.get, links)):
        yield from measured(
            "link_wall_mm", least, lambda: min(map(plate_wall, parts.links.plates), default=None)
        )
    if "link_gap_mm" in names:
        yield from _links_gap("link_gap_mm", parts)


def least_gap(name: str, gaps: Iterator[float], L: float) -> Iterator[Check]:
    """The least of the gaps, mm, if there is one; the check fails if parts cannot be built."""
    # a gap is rounded to 1e-12 of the centre distance, or of the sphere's radius
    return measured(name, 0.0, lambda: min(gaps, default=None), 1e-12 * L)


def _links_gap(name: str, parts: FlatParts) -> Iterator[Check]:
    """The gap in a whole turn between links and hub, shaft and pins through their planes."""
    mechanism = parts.mechanism
    try:
        if not parts.links.axes:
            return
        from geneva_cli.parts.links.link_shafts import planes

        spacers = parts.framed.spacers if mechanism.spec.drive_before else ()
        near, blocked = planes(parts.outlines, parts.links, spacers)
    except GenevaError as error:
        yield unknown(name, str(error), "at least", 0.0, True)
        return
    if blocked:
        at_deg = mechanism.shown_deg(blocked.input_deg)
        why = f"{blocked.passing} meets the {blocked.link}: it needs an eccentric in a hollow "
        why += "input shaft, or another path to its bearings"
        yield Check(name, blocked.gap, "at least", 0.0, False, why, at_deg)
    elif near:
        yield compared(name, near.gap, "at least", 0.0, mechanism.shown_deg(near.input_deg))


def places(names: Collection[str], parts: FlatParts) -> Iterator[Check]:
    """The two branches of a curved slot, several wheels, and several cranks."""
    engagement = parts.outlines.assembly.slots[0][0]
    if engagement.slot.curved:
        yield from _branches(parts.outlines)
    wheels = parts.mechanism.spec.drive.wheels_on_carrier
    if wheels > 1:  # between circles of adjacent wheels, each with all that it carries
        between = 2.0 * parts.mechanism.center_distance_mm * math.sin(math.pi / wheels)
        gap = between - 2.0 * reach_mm(parts.outlines)
        yield compared("wheels_apart_mm", gap, "at least", 0.0)
    if len(parts.mechanism.crank_places) > 1 and "cranks_apart_mm" in names:
        yield _cranks_apart("cranks_apart_mm", parts)


def reach_mm(outlines: Outlines) -> float:
    """Radius of the circle about a wheel's axis that contains it and its masses."""
    sizes = outlines.sizes
    return max(sizes.rim, sizes.outer, farthest_mm(outlines.assembly.mechanism.spec))


def _branches(outlines: Outlines) -> Iterator[Check]:
    """The greatest distance of entry and exit branch of a curved slot, apart or where they crossed.

    If it exceeds the slot's width where both are on their own sides, an island falls out.
    """
    engagement, L, samples = outlines.assembly.slots[0][0], outlines.assembly.L, 400
    t = engagement.entry_deg * (1.0 - np.arange(samples) / samples)
    (x, y), (u, v) = (engagement.slot(at, 0) for at in (t, opposites(engagement, t)))
    turn = np.remainder(
        np.arctan2(y.c[0], x.c[0]) - np.arctan2(v.c[0], u.c[0]) + np.pi, 2.0 * np.pi
    )
    apart_mm = 2.0 * L * np.hypot(x.c[0], y.c[0]) * np.sin(0.5 * (turn - np.pi))
    for name, gap in (("branches_apart_mm", apart_mm), ("branches_crossed_mm", -apart_mm)):
        i = int(np.nanargmax(gap))  # NaN where the longer branch has no opposite
        at_deg = outlines.assembly.shown_deg(engagement.mid_deg + float(t[i]))
        most = 2.0 * outlines.sizes.half_width
        yield compared(name, max(0.0, float(gap[i])), "at most", most, at_deg)


def _cranks_apart(name: str, parts: FlatParts) -> Check:
    """The least gap between two cranks, and where it is.

    All cranks turn at one rate. So seen from one of them, another one does not turn: it moves on a
    circle, whose radius is the distance of their axes. Both are taken as their convex hulls, seen
    along the shafts. Their gap is the greatest over all directions of what separates them there.
    """
    outlines = parts.outlines
    # points of a crank in its own frame, and how far it reaches about each, mm
    near = 1e-5 * outlines.assembly.L  # chords of arcs miss the outline by less
    contours = [*outlines.crank, *([parts.arm.outline] if parts.arm else [])]
    edge = Polyarc(contours).samples(near, outlines.assembly.L) if contours else np.empty((0, 2))
    centres = [(0.0, 0.0), *roller_centres(outlines.assembly)]
    points = np.concatenate((edge, centres))
    rollers = [outlines.sizes.roller] * (len(centres) - 1)
    about = np.array([*[near] * len(edge), parts.axle_radius("crank"), *rollers])
    # directions: the bound is less than a thousandth of the axes' distance below the gap
    count = 3600
    step = math.tau / count
    around = step * np.arange(count, dtype=np.float64)

    def reach(directions: Array) -> Array:
        """How far a crank reaches from its axis in directions of its own frame, mm."""
        some = np.split(np.stack((np.cos(directions), np.sin(directions)), axis=1), count // 100)
        return np.concatenate([(way @ points.T + about).max(axis=1) for way in some])

    found = []
    ahead = reach(around)
    for one, other in combinations(parts.cranks, 2):
        between = complex(*other.at) - complex(*one.at)
        taken = ahead + reach(around - (other.turn - one.turn) + math.pi)
        # in each interval of the direction of the other's axis, from its middle to both ends
        gap = np.full(count, -math.inf)
        for off in range(-(count // 4), count // 4 + 1):
            least = abs(between) * math.cos((abs(off) + 0.5) * step)
            gap = np.maximum(gap, least - np.roll(taken, -off))
        i = int(np.argmin(gap))
        seen = math.atan2(between.imag, between.real) - one.turn  # at input angle 0
        # rounded far below the step of the directions
        at_deg = round(math.degrees(math.remainder(around[i] - seen, math.tau)), 6)
        found.append((float(gap[i]), at_deg))
    least_mm, at_deg = min(found)
    return compared(name, least_mm, "at least", 0.0, parts.mechanism.shown_deg(at_deg))


def process(names: Collection[str], parts: FlatParts) -> Iterator[Check]:
    """The thickest plate of wheel, disc and arm, and the slots' width, as the process cuts."""
    sizes = parts.outlines.sizes
    thick = max(sizes.wheel_thickness, sizes.lock_thickness, sizes.arm_thickness)
    yield from cuts(parts.mechanism, thick, 2.0 * sizes.half_width, sizes.wheel_thickness)


def cuts(mechanism: Mechanism, thickest: float, wide: float, thick: float) -> Iterator[Check]:
    """What a process can cut: the thickest plate, and slots so wide in a plate so ``thick``."""
    shop = WORKSHOPS[mechanism.spec.size.process]
    if shop.plate_mm != math.inf:
        yield compared("cut_plate_mm", thickest, "at most", shop.plate_mm)
    if shop.hole:  # it cuts no slot that is narrow for its plate
        yield compared("cut_slot_mm", wide, "at least", shop.hole * thick)


def built(names: Collection[str], parts: Parts) -> Iterator[Check]:
    """The check that fails if a part of a machine cannot be built."""
    try:
        _ = parts.required
    except GenevaError as error:
        yield refused("parts", error)
