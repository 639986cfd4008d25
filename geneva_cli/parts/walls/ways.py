"""The walls on both sides of a roller's way through a curved slot, and which of them are free.

The way is the roller's circle while the wheel rests before entry, the way in, the way out and the
circle again; where the roller turns back its own outline is a wall too.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.pitch_curve import Pitch, retraces
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.roller_paths import rest
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slot_profile import pitch_at, way_at
from geneva_cli.parts.slot_sampling import nodes

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

Curve: TypeAlias = "Callable[[Array], tuple[Array, Array]]"  # parameters -> points and tangents

FINE = 1e-7  # of the centre distance: how finely the roller's ways are sampled
COVERED = 1e-6  # of the centre distance: a wall passed over by less is not
STEPS = 97  # samples of the roller's circle, at least, and of its own outline
BLOCK = 64  # samples that are looked at together
ROUNDING = 1e-7  # of the centre distance: a fold as small as this is none


class Wall(NamedTuple):
    """One wall: points and tangents by a parameter, and its samples in the parameter's order."""

    curve: Curve
    t: Array
    points: Array
    free: NDArray[np.bool_]  # which samples no other place of the roller passes over
    centre: tuple[float, float] | None = None  # where the wall is an arc, by its angle
    radius: float = 0.0


def walls(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> list[Wall]:
    """Every wall of the roller's way, with what of it is free."""
    w, back = sizes.half_width, retraces(engagement)
    t = nodes(assembly.mechanism, FINE * assembly.L, fewest=False)
    near = w - COVERED * assembly.L
    middle = int(np.searchsorted(t, 0.0))
    circles = [_circle(assembly, sizes, engagement, end) for end in (-1.0, 1.0)]
    ways = [circles[0][1][::-1], _pitch(assembly, engagement, t), circles[1][1]]
    path = np.concatenate(ways)
    found: list[Wall] = []
    for centre, way in circles:
        radius = math.dist(centre, way[0])
        angles = np.unwrap(np.arctan2(way[:, 1] - centre[1], way[:, 0] - centre[0]))
        for side in (-w, w):
            found.append(_arc(path, near, centre, radius + side, np.sort(angles)))
    flanks = []
    for part in (t[: middle + 1], t[middle:]):
        at, outward = pitch_at(engagement, part, back) if back else None, bool(part[-1] > 0.0)
        for side in (-w, w):
            curve = beside(assembly, engagement, side, outward)
            t = part if at is None else _unfolded(curve, part, at, assembly.L, side)
            points = curve(t)[0]
            flanks.append(Wall(curve, t, points, _free(points, path, near)))
    if not back:
        return [*found, *flanks]
    x, y = _pitch(assembly, engagement, np.zeros(1))[0]
    tangent = _tangent_in(engagement)
    ahead = math.atan2(tangent[1], tangent[0])
    turns = [_meets(flank, (float(x), float(y))) - ahead for flank in flanks]
    turns = [math.remainder(turn, math.tau) for turn in turns]
    low = max(turn for turn in turns if turn < 0.0)
    high = min(turn for turn in turns if turn > 0.0)
    round_ = ahead + np.linspace(low, high, STEPS)
    return [*found, *flanks, _arc(path, near, (float(x), float(y)), w, round_)]


def _meets(flank: Wall, centre: tuple[float, float]) -> float:
    """The direction from the roller at mid-motion to where a flank leaves its outline."""
    end = flank.points[-1] if flank.t[-1] <= 0.0 else flank.points[0]
    return math.atan2(end[1] - centre[1], end[0] - centre[0])


def _circle(
    assembly: Assembly, sizes: Sizes, engagement: Engagement, end: float
) -> tuple[tuple[float, float], Array]:
    """The roller's way before entry (-1) or after exit (1): its centre, and places from the slot
    outwards until it has left the wheel."""
    centre = rest(assembly, engagement, end)
    t = engagement.entry_deg if end < 0.0 else engagement.exit_deg
    x, y = _pitch(assembly, engagement, np.array([t]))[0]
    radius, start = math.dist((x, y), centre), math.atan2(y - centre[1], x - centre[0])
    # To the middle of the dwell: from there on the way is that of the next slot.
    ahead = math.atan2(-assembly.sign * centre[1], -assembly.sign * centre[0])
    rest_of_turn = math.pi - abs(math.remainder(start - ahead, math.tau))
    # Seen from the resting wheel the crank turns against it outside, with it inside.
    turn = -end * assembly.sign * np.linspace(0.0, rest_of_turn, 4 * STEPS)
    way = np.column_stack(
        (centre[0] + radius * np.cos(start + turn), centre[1] + radius * np.sin(start + turn))
    )
    gone = assembly.sign * (np.hypot(*way.T) - sizes.rim) > 2.0 * sizes.half_width
    count = int(np.argmax(gone)) + 1 if gone.any() else len(way)
    # As finely as the way in the slot: chords lie inside the circle, where one of its walls is.
    whole = float(turn[count - 1])
    many = math.ceil(abs(whole) / math.sqrt(8.0 * FINE * assembly.L / radius)) + 1
    turn = np.linspace(0.0, whole, max(STEPS, many))
    way = np.column_stack(
        (centre[0] + radius * np.cos(start + turn), centre[1] + radius * np.sin(start + turn))
    )
    return centre, way


def _arc(
    path: Array, near: float, centre: tuple[float, float], radius: float, angles: Array
) -> Wall:
    def curve(t: Array) -> tuple[Array, Array]:
        c, s = np.cos(t), np.sin(t)
        points = np.column_stack((centre[0] + radius * c, centre[1] + radius * s))
        return points, np.column_stack((-s, c))

    points = curve(angles)[0]
    return Wall(curve, angles, points, _free(points, path, near), centre, radius)


def beside(assembly: Assembly, engagement: Engagement, side: float, outward: bool) -> Curve:
    """The curve ``side`` mm to the left of the roller's way in, or out: points and tangents."""
    back = retraces(engagement)

    def curve(t: Array) -> tuple[Array, Array]:
        at = way_at(engagement, t, back)
        # At mid-motion the limit is that of the way in.
        turned = np.where(back & outward & (t == 0.0), -1.0, 1.0)
        tangent = np.column_stack((at.tangent_x * turned, at.tangent_y * turned))
        normal = np.column_stack((-tangent[:, 1], tangent[:, 0]))
        return assembly.L * np.column_stack((at.x, at.y)) + side * normal, tangent

    return curve


def _unfolded(curve: Curve, t: Array, at: Pitch, L: float, side: float) -> Array:
    """A flank's samples without the fold at mid-motion.

    The roller stops there, and its way turns so sharply that the flank on the inner side of the
    turn folds back into the roller's own outline. It is cut where it comes out of that.
    """
    order = np.argsort(np.abs(t))
    folded = L * array(at.speed)[order] < side * array(at.turning)[order] - ROUNDING * L
    if not folded[0]:
        return t
    first = int(np.argmin(folded))
    centre = L * np.array((array(at.x)[order[0]], array(at.y)[order[0]]))

    def out(x: Array) -> NDArray[np.bool_]:
        found: NDArray[np.bool_] = np.hypot(*(curve(x)[0] - centre).T) > abs(side)
        return found

    while first < len(t) - 1 and not out(t[order[first : first + 1]])[0]:
        first += 1
    b = boundary_by_sections(out, float(t[order[first]]), float(t[order[first - 1]]))
    kept = np.sort(t[order[first:]])
    return np.append(kept, b) if b < 0.0 else np.insert(kept, 0, b)


def _pitch(assembly: Assembly, engagement: Engagement, t: Array) -> Array:
    x, y = engagement.slot(t, 0)
    return assembly.L * np.column_stack((x.c[0], y.c[0]))


def _tangent_in(engagement: Engagement) -> tuple[float, float]:
    """The roller's direction where it comes to a stop in the wheel at mid-motion."""
    at = way_at(engagement, np.zeros(1), True)
    return float(array(at.tangent_x)[0]), float(array(at.tangent_y)[0])


def _free(points: Array, path: Array, least: float) -> NDArray[np.bool_]:
    """Which points the roller passes over nowhere: none of its places is nearer.

    A block of neighbouring points looks only at the part of the way that comes near its circle.
    """
    out = np.ones(len(points), dtype=bool)
    start, way = path[:-1], np.diff(path, axis=0)
    square = np.maximum((way * way).sum(axis=1), 1e-300)
    half, middle = 0.5 * np.sqrt(square), start + 0.5 * way
    for block in range(0, len(points), BLOCK):
        here = points[block : block + BLOCK]
        centre = 0.5 * (here.min(axis=0) + here.max(axis=0))
        reach = least + float(np.hypot(*(here - centre).T).max())
        near = np.flatnonzero(np.hypot(*(middle - centre).T) <= reach + half)
        if not len(near):
            continue
        x, y = way[near].T
        off_x, off_y = here[:, :1] - start[near, 0], here[:, 1:] - start[near, 1]
        share = np.clip((off_x * x + off_y * y) / square[near], 0.0, 1.0)
        off_x -= share * x
        off_y -= share * y
        nearest = (off_x * off_x + off_y * off_y).min(axis=1)
        out[block : block + BLOCK] = nearest > least * least
    return out
