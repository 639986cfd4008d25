"""The crank's outline in the wheel's plane: the locking disc, its relief and its round holes.

Its axis is the origin, and x is through the first roller at mid-motion. If the wheel reaches beyond
the crank's axis, as internal ones do, only locking sectors are left.
"""

import math
from bisect import bisect_left
from collections.abc import Callable, Mapping, Sequence
from functools import cache, partial
from operator import attrgetter
from typing import TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry import shapes
from geneva_cli.geometry.shapes import ORIGIN, Arc, Contour, Line, Segment, Shape
from geneva_cli.motion.engagement import Engagement
from geneva_cli.numerics.arrays import Array, choose, larger, within_half_turn
from geneva_cli.numerics.tolerances import SAME_ANGLE, SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.parts.sizes import Sizes, reach_and_hub

# radii of the corners of each kind of slot's mouth at entry and exit, mm
Mouths: TypeAlias = Mapping[Engagement, tuple[float, float]]
# a relief of the disc: its directions on the crank, radians, from and to, counterclockwise; the
# number of the motion that needs it
Relief: TypeAlias = tuple[float, float, int]


def is_whole(assembly: Assembly, sizes: Sizes) -> bool:
    """Return True if some of the disc is left at the crank's axis."""
    return assembly.sign > 0.0 and assembly.L - sizes.rim > sizes.relief


def reliefs(assembly: Assembly) -> list[Relief]:
    """Return the reliefs around the crank: directions of the line of centres in motions."""
    out: list[Relief] = []
    first = 0.0
    ahead = math.pi if assembly.sign > 0.0 else 0.0  # of the crank at input 0
    for i, (engagement, mid) in enumerate(assembly.motions):
        at = mid + np.array([0.0, engagement.entry_deg, engagement.exit_deg])
        middle, one, other = (ahead - assembly.crank(at)).tolist()
        one = middle + math.remainder(one - middle, math.tau)
        other = middle + math.remainder(other - middle, math.tau)
        low, high = min(one, other), max(one, other)
        first = first if i else low
        start = first + (low - first + SAME_ANGLE) % math.tau - SAME_ANGLE
        out.append((start, start + high - low, i))
    return sorted(out)


def sectors(around: list[Relief]) -> list[tuple[float, float]]:
    """Return the sectors in which the disc locks: directions on the crank, radians, from and to."""
    starts, ends, _ = zip(*around, strict=True)
    out = []
    for end, after in zip(ends, (*starts[1:], starts[0] + math.tau), strict=True):
        if after - end > SAME_ANGLE:
            out.append((end, after))
    return out


def arc_floor(assembly: Assembly, lock: float) -> float:
    """Return the least distance from the axis of arcs that relieve the disc; 0 where none can.

    They meet the disc at right angles. If gears widen the reliefs, they must leave a bore.
    """
    starts, ends, _ = np.transpose(reliefs(assembly._replace(L=1.0)))  # directions
    half = 0.5 * float((ends - starts).max())
    if half > 0.5 * math.pi - SAME_ANGLE:
        return 0.0
    floor = lock * math.tan(0.25 * math.pi - 0.5 * half)
    # L/18 about the axis is enough for a bore
    narrow = floor < (1.0 / 18.0) * assembly.L
    wide = any(map(attrgetter("apart"), assembly.kinds))
    return choose(narrow & wide, 0.0, larger(floor, 0.0))


def widened(assembly: Assembly, sizes: Sizes, mouths: Mouths) -> list[Relief]:
    """Return the reliefs as wide as the wheel's horns need, with those that touch joined.

    A horn's corner, p from the wheel's axis, is on the circle of the disc or of the recess where it
    is chi from the line of centres: p² + L² - 2 p L cos chi = k². In the motion it comes from the
    recess, passes the line and leaves the disc. It reaches farthest round the crank by then.
    """
    joined: list[Relief] = []
    L, lock, recess = assembly.L, sizes.lock, sizes.recess
    for first, after, motion in reliefs(assembly):
        engagement, behind = assembly.motions[motion]
        half_step, middle, half = engagement.half_step, 0.5 * (first + after), 0.5 * (after - first)
        # samples 1/2000 of the motion apart bring a greatest value to 1e-5 degrees
        at = np.linspace(engagement.entry_deg, engagement.exit_deg, 2001)
        turned = engagement.motion(at, 0).c[0]
        start, end, spare = first, after, sizes.relief / lock
        corners = mouths.get(engagement) or next(iter(mouths.values()))  # slots are equal
        for side, p in zip((1.0, -1.0), corners, strict=True):
            cosines = (L * L + p * p - np.square((lock, recess))) / (2.0 * L * p)
            if cosines.max() >= 1.0:  # the corner never comes into the disc
                continue
            leaves, rests = np.arccos(np.maximum(cosines, -1.0)).tolist()
            last = side * (leaves - half_step + rests)
            corner = side * (half_step - rests) + np.append(turned, last)
            x, y = p * np.cos(corner) - L, p * np.sin(corner)
            crank = assembly.crank(behind + np.append(at, np.interp(last, turned, at)))
            off = within_half_turn(np.arctan2(y, x) - crank - middle)
            off = off[np.hypot(x, y) < lock * (1.0 + SAME_LENGTH)]
            if off.min(initial=0.0) < -half - SAME_ANGLE:
                start = min(start, middle + float(off.min()) - spare)
            if off.max(initial=0.0) > half + SAME_ANGLE:
                end = max(end, middle + float(off.max()) + spare)
        if joined and start - joined[-1][1] <= SAME_ANGLE:
            start, last, motion = joined.pop()
            end = max(end, last)
        joined.append((start, end, motion))
    if len(joined) > 1 and joined[0][0] + math.tau - joined[-1][1] <= SAME_ANGLE:
        (_, end, motion), (start, *_) = joined[0], joined.pop()
        joined[0] = start - math.tau, end, motion
    return joined


def keyway_direction(assembly: Assembly) -> float:
    """Return the keyway's direction: the middle of a locking sector, away from reliefs."""
    (start, end), *_ = sectors(reliefs(assembly)) or [(math.pi, math.pi)]
    return 0.5 * (start + end)


# points of the wheel inside the disc in one motion: x and y in the crank's frame
Swept: TypeAlias = Callable[[int], tuple[Array, Array]]


def crank_contours(
    assembly: Assembly, sizes: Sizes, relief: str, mouths: Mouths, swept: Swept, spare: float
) -> list[Contour]:
    """Return the locking disc with one kind of relief: ``"arc"`` or ``"sector"``.

    ``swept(i)`` are points where the wheel enters the disc in the i-th motion; sectors keep
    ``spare`` mm more distance from them.
    """
    if not is_whole(assembly, sizes):
        return _rings(assembly, sizes, swept, spare)
    around = reliefs(assembly)
    if relief == "sector":
        around = widened(assembly, sizes, mouths)
    segments, locking = list[Segment](), dict(sectors(around))
    text = f"reliefs leave no locking disc: use fewer rollers, or below {sizes.roller:g} mm"
    refuse_size(not locking, "roller_radius_mm", text)
    for start, end, _ in around:
        middle, half = 0.5 * (start + end), 0.5 * (end - start)
        if relief == "sector":  # down to where the wheel never comes
            floor = assembly.L - sizes.rim - sizes.relief
            bottom = shapes.about(ORIGIN, floor, start, end - start)
            begin, last = (shapes.polar(ORIGIN, sizes.lock, turn) for turn in (start, end))
            segments += [Line(begin, bottom.start), bottom, Line(bottom.end, last)]
        elif half > 0.5 * math.pi - SAME_ANGLE:
            text = f"an arc relieves less than 180 deg, not {math.degrees(2.0 * half):.6g}"
            raise GenevaError(f'{text}: set relief = "sector"', ("size", "relief"))
        else:
            # The arc meets the disc at right angles. For a radial slot entered without shock it is
            # the triangle of wheel, crank and roller at entry, scaled down to the disc.
            centre = shapes.polar(ORIGIN, sizes.lock / math.cos(half), middle)
            off, radius = math.pi / 2.0 - half, sizes.lock * math.tan(half)
            segments.append(shapes.about(centre, radius, middle + math.pi + off, -2.0 * off))
        if end in locking:
            segments.append(shapes.about(ORIGIN, sizes.lock, end, locking[end] - end))
    return [shapes.closed("CRANK", segments)]


def takes_arcs(assembly: Assembly, sizes: Sizes) -> bool:
    """Return True if arcs may relieve the disc, if they clear the wheel.

    They leave some of the disc at the crank's axis and between two motions, and a wall to the
    spec's bore and hub, unless a sector is no deeper.
    """
    size, floor = assembly.full.spec.size, arc_floor(assembly, sizes.lock)
    dwells = len(sectors(reliefs(assembly))) == len(assembly.motions)
    if not (is_whole(assembly, sizes) and dwells and floor > 0.0):
        return False
    bore = 0.5 * (size.crank_bore_mm or 0.0)
    _, hub = reach_and_hub(size, "crank", bore, sizes.wall_min)
    wall = 0.5 * size.allowances.shaft_fit_mm + sizes.wall_min
    needed = max(bore + wall if bore else 0.0, hub if size.has_hub("crank") else 0.0)
    return floor >= min(needed, assembly.L - sizes.rim - sizes.relief)


def crank_bore(assembly: Assembly, sizes: Sizes) -> tuple[Shape, ...]:
    """Return the crank's bore in its shape; none without one."""
    if not sizes.crank_bore:
        return ()
    own = bore_of(assembly.mechanism.spec.size, "crank", sizes.crank_bore)
    return (own.shape("BORE", keyway_direction(assembly)),)


def _rings(assembly: Assembly, sizes: Sizes, swept: Swept, spare: float) -> list[Contour]:
    """Return the sectors between reliefs, each as wide as the wheel leaves it clear."""
    x, y = map(np.concatenate, zip(*map(swept, range(len(assembly.motions))), strict=True))
    away = np.sqrt(x * x + y * y)

    def ring(start: float, end: float) -> Contour:
        middle, whole = 0.5 * (end + start), 0.5 * (end - start)
        # only points about the sector's direction: this takes less time than all their directions
        along = x * math.cos(middle) + y * math.sin(middle)
        near = np.flatnonzero(along >= (math.cos(whole) - SAME_ANGLE) * away)
        off = within_half_turn(np.arctan2(y[near], x[near]) - middle)
        inner = cache(partial(_inner, sizes, (np.hypot(x[near], y[near]), off), spare))
        # the least thickness of a sector is a tenth of the disc's radius
        half = widest(whole, lambda half: max(inner(half)) < 0.9 * sizes.lock)
        if half is None:
            text = "the wheel sweeps over a whole locking sector: use a smaller roller, or another"
            text = f"{text} lock_radius_mm than {sizes.lock:.6g}; 0 omits it"
            raise GenevaError(text, ("size", "lock_radius_mm"))
        edge, floor = inner(half)
        low, high = middle - half, middle + half
        outer = shapes.about(ORIGIN, sizes.lock, low, 2.0 * half)
        begin, last = shapes.polar(ORIGIN, edge, high), shapes.polar(ORIGIN, edge, low)
        bulge = (edge * math.cos(half) - floor) / (edge * math.sin(half))
        inwards, outwards = Line(outer.end, begin), Line(last, outer.start)
        return shapes.closed("CRANK", [outer, inwards, Arc(begin, last, bulge), outwards])

    return [ring(*span) for span in sectors(reliefs(assembly))]


def widest(whole: float, clears: Callable[[float], bool]) -> float | None:
    """Return half the width of the widest locking sector that clears the wheel, up to ``whole``.

    Steps are a fiftieth of ``whole``. None if none of at least a fifth of it clears the wheel.
    """
    if clears(whole):  # as most do
        return whole
    halves = [(1.0 - 0.02 * k) * whole for k in range(1, 40)]
    first = bisect_left(halves, True, key=clears)
    return halves[first] if first < len(halves) else None


def _inner(sizes: Sizes, points: Sequence[Array], more: float, half: float) -> tuple[float, float]:
    """Return the inner arc of a locking sector: its distance at the edges and in the middle.

    ``points`` of the wheel are radii, and directions from the sector's middle. Of the circles
    through a point and both edges' ends, that which is farthest out in the middle clears all.
    """
    inside = np.abs(points[1]) < half
    radius, off = (each[inside] for each in points)
    at_edge = float(radius[np.abs(off) > half - 0.035].max(initial=0.0))  # within two degrees
    spare = min(sizes.relief, (sizes.lock - at_edge) / 3.0) + more
    edge = max(at_edge + spare, 0.01 * sizes.lock)  # no sector is pointed down to the axis
    ex, ey = edge * math.cos(half), edge * math.sin(half)
    x, y = radius * np.cos(off), radius * np.sin(off)
    off_edge = np.abs(x - ex) > SAME_LENGTH * edge
    x, y = x[off_edge], y[off_edge]
    centre = (x * x + y * y - edge * edge) / (2.0 * (x - ex))
    reach = np.copysign(np.hypot(ex - centre, ey), x - ex)
    return edge, float((centre + reach).max(initial=0.0)) + spare
