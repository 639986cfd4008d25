"""The outlines of wheel and crank as they are cut: slots, rim, recesses, and a relief that clears.

Where gears drive between two rollers, a motion has two slots, half of the angle between them on
either side of its middle. A roller leaves the first on an epicycloid, which sweeps away the side
towards the other slot. So each keeps the wall on its recess's side, with an arc between the two.
"""

import math
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cache, lru_cache, partial
from itertools import chain
from operator import attrgetter

import numpy as np

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import ORIGIN, Arc, Contour, Line, Segment
from geneva_cli.kept import KEPT
from geneva_cli.loads.tolerance.locking import Lock, loosest
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.tolerances import SAME_ANGLE, SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines import crank_outline
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots import roller_paths as paths
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import Pose
from geneva_cli.parts.turn.turned_parts import CONTACT

SWEPT_DEG = 0.2  # of the input, between the positions of the wheel that a relief must clear


def drawn(assembly: Assembly, sizes: Sizes) -> Outlines:
    """Return the outlines of an assembly with known sizes, cached without what a load changes."""
    bare = sizes[: Sizes._fields.index("wheel_bore")]
    return _drawn(assembly, Sizes(*bare))._replace(sizes=sizes)  # type: ignore[arg-type]


@lru_cache(maxsize=KEPT)  # a sweep cuts the locks of its designs first, and then turns the parts
def _drawn(assembly: Assembly, sizes: Sizes) -> Outlines:
    """Return the outlines with the spec's relief, or else the first kind that clears the wheel.

    An arc leaves the most of the disc and is one cut. If it collides or leaves too little, the
    whole sector is cut down to where the wheel never comes.
    """
    walls, curved = turned_walls(assembly, sizes), map(attrgetter("slot.curved"), assembly.kinds)
    close = (CURVED if any(curved) else SAME_LENGTH) * assembly.L
    wheel, cut = wheel_contour(assembly, sizes, walls)
    bare = Gaps(assembly, sizes, wheel, [])
    if assembly.full.spec.wheel.stopped:
        wheel, cut = wheel_contour(assembly, sizes, walls, convex=True)
    unlocked = Outlines(assembly, sizes, walls, wheel, cut, [], "none", bare, close)
    if not sizes.lock:
        return unlocked
    requested = assembly.mechanism.spec.size.relief
    last, whole, spare = requested or "sector", crank_outline.is_whole(assembly, sizes), 0.0
    takes_arcs = not requested and crank_outline.takes_arcs(assembly, sizes)
    mouths, swept = horn_corners(assembly, sizes), cache(lambda i: bare.swept(i, SWEPT_DEG))
    for relief in (*(("arc",) if takes_arcs else ()), *[last] * 6):
        crank = crank_outline.crank_contours(assembly, sizes, relief, mouths, swept, spare)
        gaps, least = bare.with_crank(crank), 0.0
        if whole and relief == last:
            break
        # the greatest overlap of crank and wheel in all motions
        for engagement, mid in assembly.motions:
            count = 2 + int(engagement.motion_deg / SWEPT_DEG)
            at = np.linspace(engagement.entry_deg, engagement.exit_deg, count)
            at = mid + at + 0.3 * SWEPT_DEG
            # without the rollers, which lock nothing
            pose = Pose(assembly.wheel(at), assembly.crank(at), np.empty((len(at), 0, 2)))
            least = min(least, float(gaps.locking(pose, near=close).min()))
        if -least <= close:
            break
        # Between two of these positions the wheel comes nearer still: three times the overlap.
        spare += 10.0 * close - 3.0 * least
    return unlocked._replace(crank=crank, relief=relief, gaps=gaps)


@lru_cache(maxsize=KEPT)
def cut_lock(assembly: Assembly, sizes: Sizes) -> Lock:
    """Return the lock: the narrowest arc of the crank, and the corner that leaves the most play.

    Beyond the crank's axis the wheel leaves less than a sector between two reliefs.
    """
    L, lock, recess, flat = assembly.L, sizes.lock, sizes.recess, sizes.horn_tip
    mouths = horn_corners(assembly, sizes)
    whole, halves = crank_outline.is_whole(assembly, sizes), list[float]()
    around = crank_outline.reliefs(assembly)
    # arcs end where the motions do
    if whole and assembly.mechanism.spec.size.relief != "arc":
        around = crank_outline.widened(assembly, sizes, mouths)
    for start, end in crank_outline.sectors(around):
        halves.append(0.5 * (end - start))
    if not whole:
        with suppress(GenevaError):  # the check of the parts reports the error
            for arc in cut_arcs(drawn(assembly, sizes).crank, lock, 0.0, SAME_LENGTH * L):
                halves.append(0.5 * abs(arc.sweep))
    edge, corners = assembly.full.spec.size.lock_edge_mm or 0.0, [*chain(*mouths.values())]
    first = corners[0] if flat else sizes.rim
    out = Lock(L, assembly.sign, lock, recess, first, min(halves, default=math.nan), edge)
    if max(corners) - min(corners) < SAME_LENGTH * L:
        return out
    near, far = abs(L - recess), L + recess
    tried = [out._replace(corner=r) for r in sorted(corners) if near < r < far]
    return loosest(tried) if tried else out


def cut_arcs(contours: Iterable[Contour], radius: float, away: float, near: float) -> Iterator[Arc]:
    """Yield the arcs of a radius whose centres are ``away`` from the axis, both within ``near``."""
    for contour in contours:
        for arc in contour.segments:
            if not isinstance(arc, Arc) or abs(arc.radius - radius) >= near:
                continue
            if abs(math.hypot(*arc.centre) - away) < near:
                yield arc


CURVED = CONTACT  # of the centre distance: accuracy of curved walls for the full turn


def turned_walls(assembly: Assembly, sizes: Sizes) -> dict[Engagement, Contour]:
    """Return the walls of each kind of slot, as accurate as the full turn needs them."""
    fine = 0.5 * CURVED * assembly.L
    walls = map(partial(slot_walls, assembly, sizes, tolerance=fine), assembly.kinds)
    return dict(zip(assembly.kinds, walls, strict=True))


def slot_walls(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, tolerance: float, curves: str = "arcs"
) -> Contour:
    """Return a slot's walls, counterclockwise from one corner of its mouth to the other.

    Those of a curved slot are "arcs" or "cubics" within a tolerance, mm. A pair of slots has the
    arc between them too. The wall that faces the crank's axis at entry ends where the roller
    enters, the other where it leaves: at different radii if slots are offset.
    """
    if engagement.slot.curved:
        from geneva_cli.parts.outlines.curved_walls import curved_walls

        return curved_walls(assembly, sizes, engagement, tolerance, curves)
    apart, engagement = engagement.apart, engagement.through
    L, w, out = assembly.L, sizes.half_width, assembly.sign
    # direction of the slot's axis, and its distance from the wheel's centre
    x, y = engagement.slot(engagement.entry_deg, 0)
    u, v = engagement.slot(0.0, 0)
    angle = math.atan2(out * (y.c[0] - v.c[0]), out * (x.c[0] - u.c[0]))
    c, s = math.cos(angle), math.sin(angle)
    level = float(L * y.c[0] * c - L * x.c[0] * s)
    level = level if abs(level) > 1e-12 * L else 0.0
    # the deepest position of the roller's centre along it
    x, y = engagement.slot(np.linspace(engagement.entry_deg, engagement.exit_deg, 721), 0)
    along = array(L * (x.c[0] * c + y.c[0] * s))
    bottom = float(along.min() if out > 0.0 else along.max()) - out * sizes.slot_bottom
    # if the spec sets the rim, it moves all mouths by as much as the widest one
    widest, starts = max(map(partial(paths.mouth, assembly, r=sizes.roller), assembly.kinds)), []
    for side in (-1.0, 1.0):
        rim, across = paths.mouth(assembly, engagement, sizes.roller), level + side * w
        if level:
            x0, y0 = paths.rest(assembly, engagement, -1.0)
            end = -1.0 if (y0 * c - x0 * s > level) == (side > 0.0) else 1.0
            rim = math.hypot(*paths.corner(assembly, engagement, end, sizes.roller))
        start = math.sqrt(max((rim + (sizes.rim - widest)) ** 2 - across * across, 0.0))
        text = f"the slots' ends lie at {bottom:.6g} mm"
        refuse_size(not out * (start - bottom) > 0.0, "wheel_radius_mm", text, sizes.rim)
        starts.append(start)
    first = Line((starts[0], level - w), (bottom, level - w))
    last = Line((bottom, level + w), (starts[1], level + w))
    if abs(apart) < SAME_ANGLE:
        pieces: tuple[Segment, ...] = (first, Arc(first.end, last.start, -out), last)
    else:
        middle = (bottom - w, 0.0)
        quarter = math.tan(math.pi / 8.0)  # the bulge of a quarter of a circle
        inwards, outwards = Arc(first.end, middle, -quarter), Arc(middle, last.start, -quarter)
        begin = shapes.placed(Contour("", (first, inwards)), turn=-apart).segments
        between = shapes.about(ORIGIN, middle[0], -apart, 2.0 * apart)
        after = shapes.placed(Contour("", (outwards, last)), turn=apart).segments
        pieces = (*begin, between, *after)
    return shapes.placed(Contour("WHEEL", shapes.joined(pieces), closed=False), turn=angle)


def horn_corners(assembly: Assembly, sizes: Sizes) -> dict[Engagement, tuple[float, float]]:
    """Return the distances from the axis of each slot's horns, mm, before and after a motion.

    They are those of its mouth's corners where the roller comes and goes, or of tips cut to flats.
    """
    mouths = [*map(partial(paths.mouth, assembly, r=sizes.roller), assembly.kinds)]
    least = paths.least_mouth(assembly, sizes) if assembly.sign > 0.0 else 0.0
    out = {}
    for kind, rim in zip(assembly.kinds, mouths, strict=True):
        if kind.slot.curved:
            out[kind] = (max(rim + sizes.rim - max(mouths), least),) * 2
            continue
        first, *_, last = slot_walls(assembly, sizes, kind, 0.0).segments
        ends = []
        for end in (-1.0, 1.0):
            centre = paths.rest(assembly, kind, end)
            nearer = math.dist(first.start, centre) < math.dist(last.end, centre)
            wall = Line(first.end, first.start) if nearer else Line(last.start, last.end)
            recess, width = sizes.recess, sizes.horn_tip
            flat = paths.tip(wall, centre, recess, width) if recess and width else None
            ends.append(math.hypot(*flat.end) if flat else max(math.hypot(*wall.end), least))
        out[kind] = ends[0], ends[1]
    return out


def wheel_contour(
    assembly: Assembly, sizes: Sizes, slots: dict[Engagement, Contour], convex: bool = False
) -> tuple[Contour, tuple[Contour, ...]]:
    """Return the wheel's contour, counterclockwise; an internal wheel's is its opening.

    With it go the walls of each slot in their places, as they are cut.

    With ``convex`` the recess opposite the first slot is a convex face at the rim, which stops the
    crank at both ends. ``slots`` has the walls of each kind of slot, in the wheel's frame, with
    that slot ahead.
    """
    around, walls, rims = assembly.slots, list[list[Segment]](), list[list[Segment]]()
    for engagement, direction in around:
        walls.append([*shapes.placed(slots[engagement], turn=direction).segments])
    for i, (_, start) in enumerate(around):
        following = (i + 1) % len(around)
        before, after = walls[i], walls[following]
        if convex and i == len(around) // 2:
            rims.append([paths.arc_about(ORIGIN, before[-1].end, after[0].start, 1.0)])
            continue
        span = (around[following][1] - start) % math.tau
        for at in assembly.rests:  # the first between the two is the recess
            off = (at - start) % math.tau
            if off < span or span == 0.0:
                break
        rims.append(_rim(assembly, sizes, before, after, start + off))
    for i, rim in enumerate(rims if sizes.mouth_radius else ()):
        after = walls[(i + 1) % len(walls)]
        ring = [walls[i][-1], *rim, after[0]]
        # a mouth that is extended has its corner at the rim
        for k in (len(ring) - 2 - _is_extension(rim[-1]), _is_extension(rim[0]) + 0):
            ring[k : k + 2] = paths.rounded(ring[k], ring[k + 1], sizes.mouth_radius, assembly.sign)
        walls[i][-1], *rim[:], after[0] = ring
    cut = tuple(map(partial(Contour, "WHEEL", closed=False), map(tuple, walls)))
    pieces = chain.from_iterable(chain(*zip(walls, rims, strict=True)))
    return shapes.closed("WHEEL", pieces), cut


def _is_extension(piece: Segment) -> bool:
    """Return True for an arc that is not about the wheel's axis."""
    return isinstance(piece, Arc) and math.hypot(*piece.centre) > 0.1 * piece.radius


def _rim(
    assembly: Assembly, sizes: Sizes, before: list[Segment], after: list[Segment], at: float
) -> list[Segment]:
    """Return the rim from one slot's corner, through the recess, to the next slot's corner."""
    start, end = before[-1].end, after[0].start
    first, last = math.atan2(start[1], start[0]), math.atan2(end[1], end[0])
    text = f"the mouths of adjacent slots overlap: reduce roller_radius_mm = {sizes.roller:g}"
    refuse_size(math.remainder(last - first, math.tau) <= 0.0, "roller_radius_mm", text)
    least = max(math.hypot(*start), math.hypot(*end))
    if sizes.lock:
        least = paths.least_mouth(assembly, sizes)
    mirror = [*shapes.mirrored(after[:1])]
    rising = _beside(assembly, sizes, before, at, least)
    falling = shapes.mirrored(_beside(assembly, sizes, mirror, -at, least))
    after[:1] = shapes.mirrored(mirror)
    ends = (before + rising)[-1].end, falling[0].start if falling else end
    middle = paths.arc_about(ORIGIN, *ends, 1.0)
    if sizes.lock:
        middle = paths.arc_about(shapes.polar(ORIGIN, assembly.L, at), *ends, -assembly.sign)
    return [*rising, middle, *falling]


def _beside(
    assembly: Assembly, sizes: Sizes, wall: list[Segment], at: float, least: float
) -> list[Segment]:
    """Return the rim from a slot's wall to the recess, in the direction ``at`` of its axis.

    A mouth that the recess does not reach is extended along the roller's circle about the crank's
    axis, up to ``least``. Without a locking disc there is only this. A horn thinner than
    ``horn_tip_mm`` is cut back to a flat, at which the wall then ends.
    """
    L, axis, line, corner = assembly.L, shapes.polar(ORIGIN, assembly.L, at), wall[-1], wall[-1].end
    rim, away, out = math.hypot(*corner), math.dist(corner, axis), list[Segment]()
    if sizes.lock and sizes.horn_tip and isinstance(line, Line):
        flat = paths.tip(line, axis, sizes.recess, sizes.horn_tip)
        if flat:
            wall[-1] = line._replace(end=flat.start)
            return [flat]
    turn = at - (at - math.atan2(corner[1], corner[0])) % math.tau
    text = f"no horn is left between slot and recess: lock_radius_mm = {sizes.lock:.6g} must be"
    text += f" below {sizes.lock + away - sizes.recess:.6g}, or the roller smaller"
    refuse_size(sizes.lock and away <= sizes.recess, "lock_radius_mm", text)
    if assembly.sign > 0.0 and least > rim + SAME_LENGTH * L:
        rim, turn = least, at - _opening(L, least, away)
        out.append(paths.arc_about(axis, corner, shapes.polar(ORIGIN, least, turn), 1.0))
    if sizes.lock:
        low = at - _opening(L, rim, sizes.recess)
        out.append(shapes.about(ORIGIN, rim, turn, low - turn))
    return out


def _opening(L: float, rim: float, radius: float) -> float:
    """Return half the angle over which a circle about the crank's axis opens the rim."""
    cosine = (L * L + rim * rim - radius * radius) / (2.0 * L * rim)
    text = f"a rim of {rim:.6g} mm does not meet the recess's circle: wheel_radius_mm must be"
    text += f" between {abs(L - radius):.6g} and {L + radius:.6g}"
    refuse_size(not abs(cosine) < 1.0, "wheel_radius_mm", text)
    return math.acos(cosine)
