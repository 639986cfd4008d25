"""Shafts and pivots, the arm that carries the rollers' pins, and the crank's hub.

Shafts end in the frame's lower face, and above with the part that they carry. A wheel with
``wheel_hub_mm = 0`` has its shaft only above it, unless that carries a gear below. The arm's
outline is the convex hull of a hub about the crank's shaft, and of eyes about pins and bolts. An
internal wheel's shaft ends in the arm, whose hub carries the locking sectors.
"""

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Member, Plate, least_wall
from geneva_cli.geometry.shapes import ORIGIN, Circle, Contour, Point, Shape, convex_hull, polar
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import value_or
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import assembly, links_at, same
from geneva_cli.parts.outlines import crank_outline as disc
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts import bores
from geneva_cli.parts.shafts.bores import Bore, bore_of, circles, has_shape, tapped
from geneva_cli.parts.sizes import hub_and_eye, lock_bolt_directions, pin_hole
from geneva_cli.parts.slots.roller_paths import roller_centres
from geneva_cli.spec.defaults import eye_about
from geneva_cli.spec.tables import Size


class Shaft(NamedTuple):
    """A shaft or pivot; heights are along its axis, and angles in radians."""

    name: str
    part: str  # whose keys of [size] set its ends
    bore: Bore  # of the parts on it
    low: float
    high: float
    at: Point
    turn: float = 0.0
    turns: bool = True  # in a bearing of the frame

    @property
    def member(self) -> Member:
        """The shaft in the machine."""
        key = f"{self.part}_shaft_low_mm"
        text = f"{key}: the {self.part}'s shaft would reach from {self.low:g} up to {self.high:g} "
        text += f"mm (0 is the wheel's lower face); reduce {key} or increase {self.part}_shaft_high"
        refuse_size(not self.low < self.high, key, f"{text}_mm")
        section = self.bore.shape("SHAFT", self.bore.direction, shaft=True)
        plate = Plate(self.name, "SHAFT", section, (), self.low, self.high, self.bore)
        return Member(plate, self.at, self.turn)


def shaft_ends(size: Size, part: str, low: float, high: float) -> tuple[float, float]:
    """Return the ends of a part's shaft: those of the spec, or else the heights low and high."""
    values = vars(size)
    lowest, highest = values.get(f"{part}_shaft_low_mm"), values.get(f"{part}_shaft_high_mm")
    return value_or(lowest, low), value_or(highest, high)


def crank_hub(parts: Outlines) -> Plate | None:
    """Return the crank's hub above the locking disc or the arm; None if omitted or not higher."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    if not (size.has_hub("crank") and sizes.crank_hub > sizes.crank_bore):
        return None
    low = 0.0 - size.allowances.pin_gap_mm  # no -0.0
    length = size.crank_hub_length_mm
    high = sizes.wheel_thickness if length is None else low + length
    if parts.crank and disc.is_whole(parts.assembly, sizes):
        low += sizes.lock_thickness
    else:
        key = "crank_hub_length_mm" if size.crank_hub_mm is None else "crank_hub_mm"
        text = f"{key}: a hub needs the locking disc or the crank arm to stand on, and there is "
        refuse_size(not parts.has_arm, key, f"{text}neither; remove it")
    if high <= low:
        return None
    bores, outline = disc.crank_bore(parts.assembly, sizes), Circle("HUB", ORIGIN, sizes.crank_hub)
    return Plate("crank's hub", "HUB", outline, bores, low, high)


def shafts(parts: Outlines, lowest: float, stop: float | None) -> Iterator[Shaft]:
    """Yield the shafts of wheels and cranks, from ``lowest`` up, or the cranks' from ``stop``."""
    assembly, sizes, machine = parts.assembly, parts.sizes, parts.assembly.full
    size = assembly.mechanism.spec.size
    if sizes.wheel_bore:
        bore = bore_of(size, "wheel", sizes.wheel_bore)._replace(direction=assembly.rests[0])
        ends = wheel_shaft_ends(parts, lowest)
        turn = 0.0 if bore.is_plain else float(assembly.wheel(np.zeros(1))[0])
        first = Shaft("wheel's shaft", "wheel", bore, *ends, ORIGIN, turn)
        yield first
        for place in machine.wheel_places[1:]:
            turn = first.turn + place.turn - machine.engagements[0].half_step
            yield first._replace(at=place.at, turn=turn)
    radius = sizes.arm_bore if parts.has_arm else sizes.crank_bore
    if radius:
        bore = bore_of(size, "crank", radius)._replace(direction=disc.keyway_direction(assembly))
        # what it carries ends in the arm, or in a bored locking disc or its hub
        top = 0.0 - size.allowances.pin_gap_mm  # no -0.0
        if sizes.crank_bore:
            on_disc = crank_hub(parts)
            top = on_disc.high if on_disc else top + sizes.lock_thickness
        ends = shaft_ends(size, "crank", lowest if stop is None else stop, top)
        for place in machine.crank_places:
            turn = place.turn + float(assembly.crank(np.array([-place.behind_deg]))[0])
            turn = 0.0 if bore.is_plain else turn  # a plain one has no direction
            yield Shaft("crank's shaft", "crank", bore, *ends, place.at, turn)


def wheel_shaft_ends(parts: Outlines, lowest: float) -> tuple[float, float]:
    """Return the ends of the wheel's shaft along the axis."""
    sizes, near = parts.sizes, SAME_LENGTH * parts.assembly.L
    geared = False
    for link in links_at(parts.assembly.full, np.zeros(1)):
        for x, y in link.joints if link.radius_mm else ():
            geared = geared or math.hypot(float(x[0]), float(y[0])) < near
    low = lowest if sizes.wheel_hub or geared else 0.0
    return shaft_ends(parts.assembly.mechanism.spec.size, "wheel", low, sizes.wheel_thickness)


def bore_at(mechanism: Mechanism, at: Point, radius: float) -> Bore:
    """Return the bore of what is on the shaft at a point: as in wheel or crank, or a round one."""
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    part = "crank" if same(at, (L, 0.0), L) else "wheel" if same(at, ORIGIN, L) else ""
    if not (part and has_shape(size, part)):
        return bores.round_bore(size, radius)
    own, still = assembly(mechanism, flat=False), np.zeros(1)
    if part == "wheel":
        direction, turn = own.rests[0], own.wheel(still)
    else:
        direction, turn = disc.keyway_direction(own), own.crank(still)
    return bore_of(size, part, radius)._replace(direction=direction + float(turn[0]))


class CrankArm(NamedTuple):
    """The arm as it is cut, and the radii of its hub and of the widest eye about a pin."""

    outline: Contour
    bore: Shape
    pins: list[Circle]
    bolts: list[Circle]  # tapped, for the screws of the locking disc
    hub: float
    eye: float
    hub_gap: float  # from the arm's end to the wheel's shaft or hub; infinite if internal


def crank_arm(parts: Outlines) -> CrankArm:
    """Return the arm of a machine."""
    assembly, sizes, drive = parts.assembly, parts.sizes, parts.assembly.full.spec.drive
    size, radius, wall = assembly.full.spec.size, sizes.arm_bore, sizes.wall_min
    if not drive.ONE_ARM:
        text = f'--part arm: kind = "{drive.NAME}" carries its roller on no crank arm; '
        raise GenevaError(f"{text}--part parts lists its links", ("drive", "kind"))
    centres, hole = roller_centres(assembly), pin_hole(size, sizes.pin)
    near, far = sizes.reaches
    # the wheel's hub stands on the roller's side, where the arm's end passes below the wheel
    passing = sizes.passing_eye(assembly.L - far)
    free = 0.0 if size.has_hub("wheel") else max(sizes.wheel_hub - sizes.wheel_bore, 0.0)
    standing = 0.0 if disc.is_whole(assembly, sizes) else sizes.lock  # the sectors stand on the hub
    form = bore_of(size, "crank", radius)
    hub, eye = hub_and_eye(size, wall, hole, radius, passing, standing)
    text = "the bore cuts the pin's hole; with its keyway it must be below "
    wrong, text = form.reach + hole >= near, f"{text}{2.0 * (near - hole):.6g}"
    refuse_size(wrong, "arm_bore_mm", text, 2.0 * radius)
    bolted = wall + 2.0 * size.edge_mm
    around = [Circle("ARM", ORIGIN, hub), *circles("ARM", centres, eye)]
    pins, screws = circles("BORE", centres, hole), bolts(parts)
    for screw in screws:
        around.append(Circle("ARM", screw.centre, eye_about(screw.radius, bolted)))
    outline, bore = convex_hull("ARM", around), form.shape("BORE", disc.keyway_direction(assembly))
    return CrankArm(outline, bore, pins, [*map(tapped, screws)], hub, eye, passing + free - eye)


def bolts(parts: Outlines) -> list[Circle]:
    """Return the holes of bolts that fix the locking disc to the arm, evenly in each sector.

    By default there are as many as leave walls in disc and arm, up to two in each sector, where the
    arm passes the wheel's hub, unless a key, a flat or a hexagon holds both.
    """
    assembly, sizes, size = parts.assembly, parts.sizes, parts.assembly.mechanism.spec.size
    if size.lock_bolts is not None:
        return _bolts(parts, size.lock_bolts)
    held = has_shape(size, "crank") and sizes.crank_bore > 0.0
    if held or not (parts.crank and parts.has_arm):
        return []
    wall = sizes.wall_min + 2.0 * size.edge_mm
    holes = [Circle("BORE", ORIGIN, bore_of(size, "crank", sizes.arm_bore).reach)]
    holes += circles("BORE", roller_centres(assembly), pin_hole(size, sizes.pin))
    space = sizes.passing_eye(assembly.L)
    for count in (2, 1):
        screwed, reach = _bolts(parts, count), 0.0
        for one in screwed:
            reach = max(reach, math.hypot(*one.centre) + eye_about(one.radius, wall))
        apart = bool(screwed) and least_wall([*holes, *screwed]) >= wall
        if reach <= space and apart and least_wall(screwed, parts.crank) >= wall:
            return screwed
    return []


def _bolts(parts: Outlines, count: int) -> list[Circle]:
    """Return the holes of so many equal bolts in each sector, where the disc's walls are widest."""
    size, sizes = parts.assembly.mechanism.spec.size, parts.sizes
    locking = disc.sectors(disc.reliefs(parts.assembly)) if parts.crank and count else []
    starts, ends = np.reshape(locking, (-1, 2)).T
    directions = lock_bolt_directions(zip(starts, ends - starts, strict=True), count)
    if not directions:
        return []
    # 400 radii: their spacing is far below a wall
    circle = size.lock_bolt_circle_mm
    radii = np.linspace(0.0, sizes.lock, 400) if circle is None else np.array([0.5 * circle])
    inner = sizes.arm_bore if parts.has_arm else sizes.crank_bore
    edge, half, places = Polyarc(parts.crank), math.inf, list[Point]()
    for turns in directions:
        x, y = np.outer(radii, np.cos(turns)).ravel(), np.outer(radii, np.sin(turns)).ravel()
        walls = -edge.signed(np.column_stack((x, y))).reshape(len(radii), len(turns))
        nearest = np.minimum(walls, radii[:, None] - inner).min(axis=1)
        best = int(nearest.argmax())
        half = min(half, max(0.0, float(nearest[best])))
        for turn in turns:
            places.append(polar(ORIGIN, float(radii[best]), turn))
    r = bores.bolt_radius(size.lock_bolt_mm, parts.assembly.L, half, "lock_bolt", size.lock_bolts)
    return circles("BORE", places, r) if r else []


def walls(arm: CrankArm, parts: Outlines) -> float:
    """Return the least wall around the arm's holes, and around the disc's bolts and keyway."""
    in_disc: list[Shape] = [*bolts(parts)]
    if parts.sizes.crank_bore and disc.is_whole(parts.assembly, parts.sizes):
        in_disc += disc.crank_bore(parts.assembly, parts.sizes)
    in_arm = least_wall([arm.bore, *arm.pins, *arm.bolts], [arm.outline])
    return min(in_arm, least_wall(in_disc, parts.crank))


def rollers(
    mechanism: Mechanism, centres: Iterable[Point], pin: float, low: float, high: float
) -> tuple[Member, ...]:
    """Return a machine's rollers from 0 up to ``high``, and their pins from ``low``."""
    wide = pin + 0.5 * mechanism.spec.size.allowances.shaft_fit_mm
    bored = (Circle("ROLLER", ORIGIN, wide),) if pin else ()
    outline = Circle("ROLLER", ORIGIN, mechanism.roller_radius_mm)
    roller = Plate("roller", "ROLLER", outline, bored, 0.0, high)
    within, out = Plate("pin", "ROLLER", Circle("ROLLER", ORIGIN, pin), (), low, high), []
    for centre in centres:
        out.append(Member(roller, centre))
        out += [Member(within, centre)] if pin else []
    return tuple(out)
