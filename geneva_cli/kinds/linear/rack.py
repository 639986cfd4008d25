"""The rack of a linear Geneva, and the locking sector of its crank.

In the rack's frame its slots run along x, and the roller is at the origin at mid-motion. The edge,
by default x = R, passes through the crank's axis. So no disc can lock the rack: a ring does, half
way round, opposite the roller. The recesses have the radius rho, and are R from the slots.
"""

import math
from operator import itemgetter
from typing import NamedTuple

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry.shapes import Circle, Contour, Line, Segment, about, closed, convex_hull
from geneva_cli.kinds.linear.guide import GuidePlace, guide_place
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import half_or, value_or
from geneva_cli.parts import sizes as rules
from geneva_cli.parts.machine_sizes import lock_between
from geneva_cli.parts.shafts.arm_and_shafts import CrankArm
from geneva_cli.parts.shafts.bores import bolt_radius, bore_of, tapped
from geneva_cli.parts.sizes import KeySizes
from geneva_cli.spec.defaults import wall_min
from geneva_cli.spec.tables import Size, Thicknesses


class RackSizes(NamedTuple):
    """Sizes of rack and locking sector, mm; radii are 0 without a lock."""

    arm: float  # R, the crank's radius
    roller: float
    half_width: float  # of the slot
    rim: float  # distance of the rack's edge from the deepest roller
    lock: float  # outer radius of the locking sector
    floor: float  # its inner radius
    recess: float
    relief: float  # clearance of the recess inside the locking sector
    guide: GuidePlace
    pin: float  # of the roller, 0 for none
    bore: float  # of the arm, in which the crank's shaft ends; 0 without a pin
    thick: Thicknesses

    @property
    def horn(self) -> float:
        """Thickness of the horn between slot and recess at its thinnest place."""
        below = min(self.rim - self.arm, 0.0)  # an edge below the crank's axis has wider horns
        half_recess = math.sqrt(max(self.recess**2 - below**2, 0.0))
        return self.arm - self.half_width - half_recess

    @property
    def behind(self) -> float:
        """The x of the rack's back: a tenth of the guide's bar stands out behind it."""
        return self.guide.back + 0.1 * self.guide.bar


def rack_sizes(mechanism: Mechanism) -> RackSizes:
    """Return the sizes of a machine's rack. Raises GenevaError, naming the key, if none fit."""
    size, r, arm = mechanism.spec.size, mechanism.roller_radius_mm, mechanism.center_distance_mm
    guide, allowed = guide_place(mechanism), size.allowances
    w = guide.slot
    text = f"the slots overlap; half a slot must be below {arm:.6g}, half the distance of the slots"
    refuse_size(w >= arm, "roller_radius_mm", text, r)
    relief, lock = value_or(size.relief_clearance_mm, arm / 200.0), size.lock_radius_mm
    # the locking sector must be wider than its inner radius
    least, limit = 0.5 * (arm + relief), arm - w - allowed.lock_clearance_mm
    text = f"the locking sector does not fit: roller and clearances limit it to {limit:.4g} mm "
    text += f"and it must reach {least:.4g}; use a smaller roller, or lock_radius_mm = 0"
    refuse_size(lock != 0.0 and limit <= least, "lock_radius_mm", text)
    if lock != 0.0:
        lock = lock_between(lock, least, limit, r)
    recess = lock + allowed.lock_clearance_mm if lock else 0.0
    floor = arm - recess + relief if lock else 0.0
    edge, pin = value_or(size.wheel_radius_mm, arm), rules.pin_radius(size, r)
    text = f"the rack's edge must meet its recesses, between {arm - recess:.6g} and "
    text += f"{arm + recess:.6g} mm"
    refuse_size(lock and abs(edge - arm) >= recess, "wheel_radius_mm", text, edge)
    # as if R were L/2, as for 6 slots
    space = arm - rules.hole_radius(size, pin)
    bore = rules.arm_bore(mechanism.spec, 0.0, 2.0 * arm, space) if pin else 0.0
    widths = arm, r, w, edge, lock, floor, recess, relief
    return RackSizes(*widths, guide, pin, bore, rules.drawn_thicknesses(size, arm))


def key_sizes(mechanism: Mechanism) -> KeySizes:
    """Return the sizes of a rack and its crank by the keys of the spec, without its load."""
    try:
        sizes = rack_sizes(mechanism)
        arm = crank_arm(mechanism.spec.size, sizes) if sizes.bore else None
    except GenevaError:  # reported by the check of the parts
        return {}, ()
    known = {"wheel_radius_mm": sizes.rim, "lock_radius_mm": sizes.lock, "pin_mm": 2.0 * sizes.pin}
    known |= {"slot_bottom_clearance_mm": sizes.guide.bottom, "relief_clearance_mm": sizes.relief}
    thick = sizes.thick._asdict()
    known |= {f"{part}_thickness_mm": thick[part] for part in ("wheel", "lock", "arm")}
    if arm:
        wide = {"bore": sizes.bore, "hub": arm.hub, "eye": arm.eye}
        known |= {f"arm_{name}_mm": 2.0 * radius for name, radius in wide.items()}
    return known, ()


def rack_contour(sizes: RackSizes, count: int) -> Contour:
    """Return a rack of ``count`` slots, counterclockwise; the slot in the middle is at y = 0."""
    low, high = rack_ends(sizes, count)
    back, places = sizes.behind, slot_places(sizes, count)
    cuts = [(y, slot_walls(sizes, y)) for y in places]
    if sizes.recess:
        beyond = math.asin((sizes.rim - sizes.arm) / sizes.recess)
        start, sweep = beyond - 0.5 * math.pi, -math.pi - 2.0 * beyond
        for y in (places[0] - sizes.arm, *(y + sizes.arm for y in places)):  # between slots
            cuts.append((y, [about((sizes.arm, y), sizes.recess, start, sweep)]))
    edge: list[Segment] = []
    at = (sizes.rim, low)
    for _, cut in sorted(cuts, key=itemgetter(0)):
        edge += [Line(at, cut[0].start), *cut]
        at = cut[-1].end
    for corner in ((sizes.rim, high), (back, high), (back, low), (sizes.rim, low)):
        edge.append(Line(at, corner))
        at = corner
    return closed("WHEEL", edge)


def slot_places(sizes: RackSizes, count: int) -> list[float]:
    """Return the y of the slots of a rack, from below; that in the middle is at 0."""
    first = -2.0 * sizes.arm * ((count - 1) // 2)
    return [first + 2.0 * sizes.arm * k for k in range(count)]


def rack_ends(sizes: RackSizes, count: int) -> tuple[float, float]:
    """Return the y of both ends of a rack of ``count`` slots."""
    beyond = 2.0 * sizes.arm - sizes.half_width  # the axes of the slots at both ends
    first, *_, last = slot_places(sizes, count)
    return first - beyond, last + beyond


def slot_walls(sizes: RackSizes, y: float) -> list[Segment]:
    """Return the walls of a slot at y, from the lower corner of its mouth to the upper one."""
    edge, w, bottom = sizes.rim, sizes.half_width, -sizes.guide.bottom
    end = about((bottom, y), w, -0.5 * math.pi, -math.pi)
    return [Line((edge, y - w), end.start), end, Line(end.end, (edge, y + w))]


def locking_sector(sizes: RackSizes) -> Contour | None:
    """Return the ring opposite the roller, whose direction is x from the axis; None without one."""
    if not sizes.lock:
        return None
    outer = about((0.0, 0.0), sizes.lock, 0.5 * math.pi, math.pi)
    inner = about((0.0, 0.0), sizes.floor, 1.5 * math.pi, -math.pi)
    inwards, outwards = Line(outer.end, inner.start), Line(inner.end, outer.start)
    return closed("CRANK", [outer, inwards, inner, outwards])


def crank_arm(size: Size, sizes: RackSizes) -> CrankArm:
    """Return the arm: its outline about hub and eye, and the holes of shaft, pin and bolts."""
    R, hole = sizes.arm, rules.pin_hole(size, sizes.pin)
    hub, eye = rules.hub_and_eye(size, wall_min(size, R), hole, sizes.bore, math.inf, sizes.lock)
    outline = convex_hull("ARM", [Circle("ARM", (0.0, 0.0), hub), Circle("ARM", (R, 0.0), eye)])
    bored = bore_of(size, "crank", sizes.bore).shape("BORE", math.pi)
    threads = [tapped(hole) for hole in lock_bolts(size, sizes)]
    return CrankArm(outline, bored, [Circle("BORE", (R, 0.0), hole)], threads, hub, eye, math.inf)


def lock_bolts(size: Size, sizes: RackSizes) -> list[Circle]:
    """Return the holes of the bolts that fix the locking sector to the arm, 2 by default."""
    usual = 2 if sizes.lock else 0
    count = usual if size.lock_bolts is None else size.lock_bolts
    half_turn = [(0.5 * math.pi, math.pi)] if sizes.lock else []
    away = half_or(size.lock_bolt_circle_mm, 0.5 * (sizes.floor + sizes.lock))
    half_width = min(away - sizes.floor, sizes.lock - away)
    r = bolt_radius(size.lock_bolt_mm, 2.0 * sizes.arm, half_width, "lock_bolt", size.lock_bolts)
    turns = [turn for some in rules.lock_bolt_directions(half_turn, count) for turn in some if r]
    return [Circle("BORE", (away * math.cos(x), away * math.sin(x)), r) for x in turns]
