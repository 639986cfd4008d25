"""The walls of a curved slot: the outer boundary of all that its roller passes over.

The roller comes along its circle, while the wheel still rests; it runs through the slot and out
again, and leaves along its circle. Each of these ways has a wall on either side; where the roller
turns back, its own outline is a wall too. Of all these only what no other place of the roller
passes over is left, and of that only the chain from one corner of the mouth round the bottom to
the other: an island between the way in and the way out falls out of the wheel.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli import fit
from geneva_cli.drawing import Contour, Segment, about, joined
from geneva_cli.errors import GenevaError
from geneva_cli.pitch import Pitch, retraces
from geneva_cli.plane import Plane
from geneva_cli.profile import nodes, pitch_at
from geneva_cli.sizes import Sizes, rest
from geneva_cli.station import LawDriven

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.jet import Array

LAYER = "WHEEL"
FINE = 1e-7  # of the centre distance: how finely the roller's ways are sampled
COVERED = 1e-6  # of the centre distance: a wall passed over by less is not
STEPS = 97  # samples of the roller's circle, at least, and of its own outline
TURNS = 64  # walls a chain may have before it is lost
SHORT = 1e-7  # of the centre distance: a shorter piece is rounding
BACK = -0.999  # the cosine between two directions that are each other's reverse
WINDOW = 80  # samples among which the crossing of two walls is looked for
REACH = 3  # samples within which two walls meet
PARALLEL = 1e-7  # the sine below which two walls do not cross but run into each other


class Wall(NamedTuple):
    """One wall: points and tangents by a parameter, and its samples in the parameter's order."""

    curve: Callable[[Array], tuple[Array, Array]]
    t: Array
    points: Array
    free: NDArray[np.bool_]  # which samples no other place of the roller passes over
    centre: tuple[float, float] | None = None  # where the wall is an arc, by its angle
    radius: float = 0.0


class Place(NamedTuple):
    """A sample on a wall and the direction of travel, in which its index rises or falls."""

    wall: Wall
    i: int
    way: int


class Piece(NamedTuple):
    """A part of a wall, from one parameter to another, either way."""

    wall: Wall
    start: float
    end: float


def curved_walls(
    plane: Plane, sizes: Sizes, station: LawDriven, tolerance: float, curves: str = "arcs"
) -> Contour:
    """A curved slot from one corner of its mouth round the bottom to the other, counterclockwise
    about the wheel's axis; within ``tolerance`` mm of the true walls.

    ``curves`` is "arcs" or "cubics", what the walls become where they are no arcs. Raises
    GenevaError where the walls do not close.
    """
    pieces: list[Segment] = []
    for piece in chain(plane, sizes, station):
        pieces += _segments(piece, tolerance, curves)
    return Contour(LAYER, joined(pieces), closed=False)


def _segments(piece: Piece, tolerance: float, curves: str) -> list[Segment]:
    wall, a, b = piece
    if wall.centre is not None:
        return [about(wall.centre, wall.radius, a, b - a)]
    fitted = fit.cubics if curves == "cubics" else fit.arcs
    if a < b:
        return [*fitted(wall.curve, a, b, tolerance)]

    def back(t: Array) -> tuple[Array, Array]:
        points, tangents = wall.curve(-t)
        return points, -tangents

    return [*fitted(back, -a, -b, tolerance)]


def chain(plane: Plane, sizes: Sizes, station: LawDriven) -> list[Piece]:
    """The pieces of walls that bound a slot, from the mouth's lower corner to its upper one."""
    walls = _walls(plane, sizes, station)
    rim = _Rim(plane, sizes)
    crossings = [c for wall in walls for c in rim.crossings(wall)]
    if not crossings:
        raise _lost()
    place, t = min(crossings, key=lambda c: math.atan2(*_point(c[0].wall, c[1])[::-1]))
    found: list[Piece] = []
    for _ in range(TURNS):
        last, leaves = _run(rim, place)
        if leaves is not None:
            found.append(Piece(place.wall, t, leaves))
            return [piece for piece in found if _long(piece, SHORT * plane.L)]
        following = _next(walls, last)
        end, begin = _joint(last, following)
        found.append(Piece(place.wall, t, end))
        place, t = following, begin
    raise _lost()


def _long(piece: Piece, least: float) -> bool:
    return math.dist(_point(piece.wall, piece.start), _point(piece.wall, piece.end)) > least


def _lost() -> GenevaError:
    return GenevaError(
        "the walls of this slot do not close: the roller is too large for its curve, or the rim "
        "too small",
        ("size", "roller_radius_mm"),
    )


class _Rim:
    """Which side of the wheel's rim a point is on; what lies on it counts as the wheel's."""

    def __init__(self, plane: Plane, sizes: Sizes) -> None:
        self.sign, self.radius, self.close = plane.sign, sizes.rim, 1e-9 * plane.L

    def depth(self, points: Array) -> Array:
        """How far points lie within the wheel."""
        out: Array = self.sign * (self.radius - np.hypot(points[..., 0], points[..., 1]))
        return out

    def crossings(self, wall: Wall) -> Iterator[tuple[Place, float]]:
        """Where a wall enters the wheel: the first sample inside, and the parameter itself."""
        depth = self.depth(wall.points)
        inside = (depth > -self.close) & wall.free
        for way in (1, -1):
            order = range(len(depth))[::way]
            for before, i in zip((-1, *order), order, strict=False):
                if not inside[i]:
                    continue
                at_end = before == -1
                if at_end and depth[i] < self.close < depth[i + way]:
                    yield Place(wall, i, way), float(wall.t[i])
                elif not at_end and depth[before] <= -self.close:
                    yield Place(wall, i, way), self.crossing(wall, wall.t[before], wall.t[i])

    def crossing(self, wall: Wall, outside: float, inside: float) -> float:
        """The parameter at which a wall crosses the rim, by halving."""
        for _ in range(60):
            t = 0.5 * (outside + inside)
            if self.depth(np.array(_point(wall, t))) > 0.0:
                inside = t
            else:
                outside = t
        return inside


def _run(rim: _Rim, place: Place) -> tuple[Place, float | None]:
    """Along a wall to its last free sample; the parameter at the rim where it leaves the wheel."""
    wall, i, way = place
    depth = rim.depth(wall.points)
    while True:
        after = i + way
        if not 0 <= after < len(wall.t):
            leaves = float(wall.t[i]) if depth[i] < rim.close and i != place.i else None
            return Place(wall, i, way), leaves
        if depth[after] <= -rim.close:
            return Place(wall, i, way), rim.crossing(wall, wall.t[after], wall.t[i])
        if not wall.free[after]:
            return Place(wall, i, way), None
        i = after


def _next(walls: list[Wall], last: Place) -> Place:
    """The wall that goes on where one ends: free, nearest, and not the one just run along."""
    here = last.wall.points[last.i]
    travel = last.way * last.wall.curve(last.wall.t[last.i : last.i + 1])[1][0]
    best: tuple[float, int] | None = None
    found = None
    for wall in walls:
        for start, end in _runs(wall):
            if wall is last.wall and start <= last.i <= end:
                continue
            away = np.hypot(*(wall.points[start : end + 1] - here).T)
            i = start + int(np.argmin(away))
            along = float(wall.curve(wall.t[i : i + 1])[1][0] @ travel)
            way = 1 if i == start else -1 if i == end else (1 if along > 0.0 else -1)
            rest_of_run = end - i if way > 0 else i - start
            score = (float(away[i - start]), -rest_of_run)
            # Not back where it came from: walls that run into each other end in one point.
            back = way * along < BACK
            if rest_of_run and not back and (best is None or score < best):
                best, found = score, Place(wall, i, way)
    if found is None:
        raise _lost()
    return found


def _runs(wall: Wall) -> Iterator[tuple[int, int]]:
    """First and last index of every stretch of free samples."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], wall.free, [False])).astype(int)))
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        yield int(start), int(end) - 1


def _joint(last: Place, following: Place) -> tuple[float, float]:
    """The parameters on both walls of the point where they meet."""
    a, b = float(last.wall.t[last.i]), float(following.wall.t[following.i])
    at_ends = all(p.i in (0, len(p.wall.t) - 1) for p in (last, following))
    p, q = _point(last.wall, a), _point(following.wall, b)
    if at_ends and math.dist(p, q) < 1e-6 * max(1.0, math.hypot(*p)):
        return a, b
    met = _crossing(last, following)
    if met is not None:
        return met
    # They run into each other: on from the point of the one to the nearest free one of the other.
    low, high = _free_run(following)
    for _ in range(8):
        q, v = _at(following.wall, b)
        step = (p[0] - q[0]) * v[0] + (p[1] - q[1]) * v[1]
        b = min(max(_within(following, b + step / _speed(following, b)), low), high)
    return a, b


def _free_run(place: Place) -> tuple[float, float]:
    """The parameters at both ends of the free stretch that a sample is in."""
    start, end = next((a, b) for a, b in _runs(place.wall) if a <= place.i <= b)
    return float(place.wall.t[start]), float(place.wall.t[end])


def _crossing(last: Place, following: Place) -> tuple[float, float] | None:
    """The parameters of the point where two walls cross near these samples, if they do."""
    start = _polylines_cross(last, following)
    if start is None:
        return None
    last, following = start
    a, b = float(last.wall.t[last.i]), float(following.wall.t[following.i])
    for _ in range(50):
        p, u = _at(last.wall, a)
        q, v = _at(following.wall, b)
        x, y = q[0] - p[0], q[1] - p[1]
        cross = u[0] * v[1] - u[1] * v[0]
        if math.hypot(x, y) < 1e-12 * math.hypot(*p) or abs(cross) < PARALLEL:
            break
        a = _within(last, a + (x * v[1] - y * v[0]) / cross / _speed(last, a))
        b = _within(following, b + (x * u[1] - y * u[0]) / cross / _speed(following, b))
    return (a, b) if math.hypot(x, y) < SHORT * math.hypot(*p) else None


def _polylines_cross(last: Place, following: Place) -> tuple[Place, Place] | None:
    """The samples before the crossing of two walls: the last on the one, the first on the other."""
    one = _window(last, -WINDOW, REACH)
    two = _window(following, -REACH, WINDOW)
    p, q = last.wall.points[one], following.wall.points[two]
    d, e = np.diff(p, axis=0), np.diff(q, axis=0)
    off = q[None, :-1] - p[:-1, None]
    cross = d[:, None, 0] * e[None, :, 1] - d[:, None, 1] * e[None, :, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        s = (off[..., 0] * e[None, :, 1] - off[..., 1] * e[None, :, 0]) / cross
        t = (off[..., 0] * d[:, None, 1] - off[..., 1] * d[:, None, 0]) / cross
    i, j = np.nonzero((s >= 0.0) & (s <= 1.0) & (t >= 0.0) & (t <= 1.0))
    if not len(i):
        return None
    best = int(np.argmax(i))
    return last._replace(i=int(one[i[best]])), following._replace(i=int(two[j[best]]))


def _window(place: Place, behind: int, ahead: int) -> NDArray[np.intp]:
    """Indices of samples around one, in the direction of travel."""
    indices = place.i + place.way * np.arange(behind, ahead + 1)
    out: NDArray[np.intp] = indices[(indices >= 0) & (indices < len(place.wall.t))]
    return out


def _within(place: Place, t: float) -> float:
    """A parameter kept to the neighbourhood of a sample."""
    grid, i = place.wall.t, place.i
    return min(max(t, float(grid[max(i - REACH, 0)])), float(grid[min(i + REACH, len(grid) - 1)]))


def _at(wall: Wall, t: float) -> tuple[tuple[float, float], tuple[float, float]]:
    points, tangents = wall.curve(np.array([t]))
    return tuple(points[0].tolist()), tuple(tangents[0].tolist())


def _point(wall: Wall, t: float) -> tuple[float, float]:
    return _at(wall, t)[0]


def _speed(place: Place, t: float) -> float:
    """How fast a wall's point moves with its parameter."""
    step = 1e-6 * float(place.wall.t[-1] - place.wall.t[0])
    low, high = _within(place, t - step), _within(place, t + step)
    moved = math.dist(_point(place.wall, low), _point(place.wall, high))
    return max(moved / (high - low), 1e-12)


def _walls(plane: Plane, sizes: Sizes, station: LawDriven) -> list[Wall]:
    """Every wall of the roller's way, with what of it is free."""
    w, back = sizes.half_width, retraces(station)
    t = nodes(plane.mechanism, FINE * plane.L)
    middle = int(np.searchsorted(t, 0.0))
    circles = [_circle(plane, sizes, station, end) for end in (-1.0, 1.0)]
    ways = [circles[0][1][::-1], _pitch(plane, station, t), circles[1][1]]
    path = np.concatenate(ways)
    found: list[Wall] = []
    for centre, way in circles:
        radius = math.dist(centre, way[0])
        angles = np.unwrap(np.arctan2(way[:, 1] - centre[1], way[:, 0] - centre[0]))
        for side in (-w, w):
            found.append(_arc(path, w, plane.L, centre, radius + side, np.sort(angles)))
    flanks = [
        _flank(plane, station, path, part, side, back)
        for part in (t[: middle + 1], t[middle:])
        for side in (-w, w)
    ]
    if not back:
        return [*found, *flanks]
    x, y = _pitch(plane, station, np.zeros(1))[0]
    tangent = _tangent_in(station)
    ahead = math.atan2(tangent[1], tangent[0])
    turns = [_meets(flank, (float(x), float(y))) - ahead for flank in flanks]
    turns = [math.remainder(turn, math.tau) for turn in turns]
    low = max(turn for turn in turns if turn < 0.0)
    high = min(turn for turn in turns if turn > 0.0)
    round_ = ahead + np.linspace(low, high, STEPS)
    return [*found, *flanks, _arc(path, w, plane.L, (float(x), float(y)), w, round_)]


def _meets(flank: Wall, centre: tuple[float, float]) -> float:
    """The direction from the roller at mid-motion to where a flank leaves its outline."""
    end = flank.points[-1] if flank.t[-1] <= 0.0 else flank.points[0]
    return math.atan2(end[1] - centre[1], end[0] - centre[0])


def _circle(
    plane: Plane, sizes: Sizes, station: LawDriven, end: float
) -> tuple[tuple[float, float], Array]:
    """The roller's way before entry (-1) or after exit (1): its centre, and places from the slot
    outwards until it has left the wheel."""
    centre = rest(plane, station, end)
    t = station.entry_deg if end < 0.0 else station.exit_deg
    x, y = _pitch(plane, station, np.array([t]))[0]
    radius, start = math.dist((x, y), centre), math.atan2(y - centre[1], x - centre[0])
    # To the middle of the dwell: from there on the way is that of the next slot.
    ahead = math.atan2(-plane.sign * centre[1], -plane.sign * centre[0])
    rest_of_turn = math.pi - abs(math.remainder(start - ahead, math.tau))
    # Seen from the resting wheel the crank turns against it outside, with it inside.
    turn = -end * plane.sign * np.linspace(0.0, rest_of_turn, 4 * STEPS)
    way = np.column_stack(
        (centre[0] + radius * np.cos(start + turn), centre[1] + radius * np.sin(start + turn))
    )
    gone = plane.sign * (np.hypot(*way.T) - sizes.rim) > 2.0 * sizes.half_width
    count = int(np.argmax(gone)) + 1 if gone.any() else len(way)
    # As finely as the way in the slot: chords lie inside the circle, where one of its walls is.
    whole = float(turn[count - 1])
    fine = math.ceil(abs(whole) / math.sqrt(8.0 * FINE * plane.L / radius)) + 1
    turn = np.linspace(0.0, whole, max(STEPS, fine))
    way = np.column_stack(
        (centre[0] + radius * np.cos(start + turn), centre[1] + radius * np.sin(start + turn))
    )
    return centre, way


def _arc(
    path: Array, w: float, L: float, centre: tuple[float, float], radius: float, angles: Array
) -> Wall:
    def curve(t: Array) -> tuple[Array, Array]:
        c, s = np.cos(t), np.sin(t)
        points = np.column_stack((centre[0] + radius * c, centre[1] + radius * s))
        return points, np.column_stack((-s, c))

    points = curve(angles)[0]
    return Wall(curve, angles, points, _free(points, path, w, L), centre, radius)


def _flank(
    plane: Plane, station: LawDriven, path: Array, t: Array, side: float, back: bool
) -> Wall:
    """One side of the way in, or of the way out; ``side`` is the offset to the left."""
    outward = t[-1] > 0.0

    def curve(t: Array) -> tuple[Array, Array]:
        at = pitch_at(station, t, back)
        # At mid-motion the limit is that of the way in.
        turned = np.where(back & outward & (t == 0.0), -1.0, 1.0)
        tangent = np.column_stack((at.tangent_x * turned, at.tangent_y * turned))
        normal = np.column_stack((-tangent[:, 1], tangent[:, 0]))
        points = plane.L * np.column_stack((at.x, at.y)) + side * normal
        return points, tangent

    if back:
        t = _unfolded(curve, t, pitch_at(station, t, back), plane.L, side)
    points = curve(t)[0]
    return Wall(curve, t, points, _free(points, path, abs(side), plane.L))


def _unfolded(
    curve: Callable[[Array], tuple[Array, Array]], t: Array, at: Pitch, L: float, side: float
) -> Array:
    """A flank's samples without the fold at mid-motion.

    The roller stops there, and its way turns so sharply that the flank on the inner side of the
    turn folds back into the roller's own outline. It is cut where it comes out of that.
    """
    order = np.argsort(np.abs(t))
    folded = (L * at.speed < side * at.turning - SHORT * L)[order]
    if not folded[0]:
        return t
    first = int(np.argmin(folded))
    centre = L * np.array((at.x[order[0]], at.y[order[0]]))

    def out(x: float) -> float:
        return math.dist(curve(np.array([x]))[0][0], centre) - abs(side)

    while first < len(t) - 1 and out(float(t[order[first]])) <= 0.0:
        first += 1
    a, b = float(t[order[first - 1]]), float(t[order[first]])
    for _ in range(60):
        middle = 0.5 * (a + b)
        a, b = (a, middle) if out(middle) > 0.0 else (middle, b)
    kept = np.sort(t[order[first:]])
    return np.append(kept, b) if b < 0.0 else np.insert(kept, 0, b)


def _pitch(plane: Plane, station: LawDriven, t: Array) -> Array:
    x, y = station.pitch(t, 0)
    return plane.L * np.column_stack((x.c[0], y.c[0]))


def _tangent_in(station: LawDriven) -> tuple[float, float]:
    """The roller's direction where it comes to a stop in the wheel at mid-motion."""
    at = pitch_at(station, np.zeros(1), True)
    return float(at.tangent_x[0]), float(at.tangent_y[0])


def _free(points: Array, path: Array, w: float, L: float) -> NDArray[np.bool_]:
    """Which points the roller passes over nowhere: none of its places is nearer than w."""
    out = np.empty(len(points), dtype=bool)
    start, way = path[:-1], np.diff(path, axis=0)
    square = np.maximum((way * way).sum(axis=1), 1e-300)
    for block in range(0, len(points), 256):
        here = points[block : block + 256]
        off = here[:, None, :] - start
        share = np.clip((off * way).sum(axis=2) / square, 0.0, 1.0)
        off = off - share[..., None] * way
        nearest = (off * off).sum(axis=2).min(axis=1)
        out[block : block + 256] = nearest > (w - COVERED * L) ** 2
    return out
