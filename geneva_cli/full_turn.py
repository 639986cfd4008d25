"""The proof that a machine turns: its outlines through a whole turn of the crank.

The wheel is turned as the mechanism says, and pushed back and on from there as far as slot and
lock let it: its play. No parts may overlap, in every dwell something must hold the wheel, and
where the roller comes to a wheel that stands off by its play, it must push it into line and not
against itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.outline import Outlines

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.jet import Array

SHARE = 0.25  # of the thinnest feature: parts move no farther between two positions
POSITIONS = 4000  # at most
NEAR = 1e-9  # degrees: positions nearer to each other are one
NO_PLAY = 1e-6  # degrees: a play as small as this is rounding
DIP = 1e-9  # mm: a gap that is less by less is not
DIPS = 12  # smallest gaps that are looked at more closely
FINER = 9  # positions put around each of them, each time
ROUNDS = 6
STEPS_DEG = (1e-4, 1e-3, 0.01, 0.03, 0.1, 0.3, 0.6, 1.2, 2.5, 4.0, 6.0)  # of the wheel
SEARCH_DEG = 6.0  # a play as large as this is none
HALVINGS = 20
CHANGE_DEG = 15.0  # of the input, on either side of entry and exit: lock and roller change over
ENDS = 24  # positions there,
DWELL = 4  # in the rest of a dwell, and
MOTION = 16  # in the rest of a motion


class Gap(NamedTuple):
    """The smallest gap between two parts, mm, negative where they overlap, and where it is."""

    mm: float
    at_deg: float  # input angle
    parts: str


class Play(NamedTuple):
    """How far the wheel can be turned from its place, back and on, degrees, at input angles."""

    input_deg: Array
    back: Array
    on: Array
    resting: NDArray[np.bool_]  # whether the wheel rests there


class FullTurn(NamedTuple):
    """What a whole turn shows.

    ``dwell_play_deg`` is the wheel's play, either way, where the lock holds it best, in the
    middle of a dwell; ``hand_over_deg`` the largest at rest, where the roller takes over;
    ``push_deg`` the largest pressure angle at which a roller pushes the wheel into line there.
    """

    driving: Gap
    idle: Gap | None
    lock: Gap | None
    dwell_play_deg: float
    hand_over_deg: float
    hand_over_at_deg: float
    push_deg: float
    push_at_deg: float
    play: Play

    @property
    def smallest(self) -> Gap:
        """The smallest gap of all."""
        return min((g for g in (self.driving, self.idle, self.lock) if g), key=lambda g: g.mm)


def full_turn(outlines: Outlines) -> FullTurn:
    """Turn the outlines of a machine through a whole turn of its crank."""
    at = positions(outlines)
    driving, idle, lock = _smallest(outlines, at)
    play = _play(outlines)
    resting = np.flatnonzero(play.resting)
    most = np.maximum(play.back, play.on)[resting]
    worst = resting[int(np.argmax(most))]
    middles = np.array([0.5 * (a + b) for a, b, rests in windows(outlines) if rests])
    dwell = float(np.degrees(np.maximum(*edges(outlines, middles)).max())) if len(middles) else 0.0
    push, push_at = _push(outlines, play)
    dwell = dwell if dwell > NO_PLAY else 0.0
    return FullTurn(
        driving,
        idle,
        lock if outlines.crank else None,
        dwell,
        float(most.max()),
        float(play.input_deg[worst]),
        push,
        push_at,
        play,
    )


def positions(outlines: Outlines) -> Array:
    """Input angles of one turn, between which no part moves by much of the thinnest feature."""
    plane, sizes = outlines.plane, outlines.sizes
    grid = np.linspace(plane.start_deg, plane.start_deg + plane.turn_deg, 721)
    crank = np.unwrap(plane.crank(grid))
    way = sizes.arm * np.abs(np.diff(crank)) + sizes.rim * np.abs(np.diff(plane.wheel(grid)))
    feature = min(sizes.roller, max(sizes.horn, 0.2 * sizes.roller)) * SHARE
    total = np.concatenate(([0.0], np.cumsum(way)))
    count = min(math.ceil(total[-1] / feature), POSITIONS)
    found = np.interp(np.linspace(0.0, total[-1], count + 1), total, grid)
    # A rim that is too large is fouled for less than a degree about entry and exit.
    ends = np.array([b + e for s, b in plane.rollers for e in (s.entry_deg, s.exit_deg)])
    beside = np.geomspace(0.01, CHANGE_DEG, ENDS)
    near = (ends[:, None] + np.concatenate((-beside, [0.0], beside))).ravel()
    near = plane.start_deg + (near - plane.start_deg) % plane.turn_deg
    return np.unique(np.concatenate((found, near)))


def _smallest(outlines: Outlines, at: Array) -> tuple[Gap, Gap | None, Gap]:
    """The smallest gaps: of rollers at their own slots, of others meanwhile, of the crank."""
    clash = outlines.clash

    def rollers(x: Array, idle: bool) -> Array:
        drives = _drives(outlines, x)
        meanwhile = drives.any(axis=1, keepdims=True) & ~drives
        out: Array = np.where(meanwhile == idle, clash.rollers(x), np.inf).min(axis=1)
        return out

    own, others = partial(rollers, idle=False), partial(rollers, idle=True)

    several = len(outlines.plane.rollers) > 1
    return (
        _least(own, at, outlines.close, "roller and slot"),
        _least(others, at, outlines.close, "idle roller and wheel") if several else None,
        _least(clash.locking, at, outlines.close, "locking disc and wheel"),
    )


def _drives(outlines: Outlines, x: Array) -> NDArray[np.bool_]:
    """Which rollers move the wheel at input angles, (n, m)."""
    plane = outlines.plane
    half = 0.5 * plane.turn_deg
    columns = []
    for station, behind in plane.rollers:
        away = (x - behind + half) % plane.turn_deg - half
        columns.append((away >= station.entry_deg - NEAR) & (away <= station.exit_deg + NEAR))
    return np.column_stack(columns)


def _least(gap: Callable[[Array], Array], at: Array, close: float, parts: str) -> Gap:
    """The smallest gap over a turn: around each place where it is smallest, ever closer."""
    values = gap(at)
    best = int(np.argmin(values))
    found = float(values[best]), float(at[best])
    inner = np.arange(1, len(at) - 1)
    dips = inner[
        (values[1:-1] < values[:-2] - DIP) & (values[1:-1] <= values[2:])
        | (values[1:-1] <= values[:-2]) & (values[1:-1] < values[2:] - DIP)
    ]
    # Only where it comes near to the smallest can a smaller one lie between.
    dips = dips[np.argsort(values[dips])][:DIPS]
    low, high = at[dips - 1], at[dips + 1]
    for _ in range(ROUNDS if len(dips) else 0):
        x = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, FINER)
        v = gap(x.ravel()).reshape(x.shape)
        i = np.argmin(v, axis=1)
        rows = np.arange(len(x))
        if v[rows, i].min() < found[0]:
            row = int(np.argmin(v[rows, i]))
            found = float(v[row, i[row]]), float(x[row, i[row]])
        low, high = x[rows, np.maximum(i - 1, 0)], x[rows, np.minimum(i + 1, FINER - 1)]
    # A gap that stays the same for a while is said to be where it begins.
    early = np.flatnonzero(values <= found[0] + close)
    return Gap(found[0], float(at[early[0]]) if len(early) else found[1], parts)


def _play(outlines: Outlines) -> Play:
    """The wheel's play over a turn, closely where lock and roller change over."""
    # In degrees of the input; the changes over take place within some degrees of the ends.
    close = np.concatenate(([0.0], np.geomspace(0.01, 1.0, ENDS)))
    found, resting = [], []
    for a, b, rests in windows(outlines):
        near = close * min(CHANGE_DEG, 0.5 * (b - a))
        inside = np.linspace(a, b, (DWELL if rests else MOTION) + 2)[1:-1]
        points = np.unique(np.concatenate((a + near, inside, b - near)))
        found.append(points)
        resting.append(np.full(len(points), rests))
    at = np.concatenate(found)
    back, on = edges(outlines, at)
    return Play(at, np.degrees(back), np.degrees(on), np.concatenate(resting))


def windows(outlines: Outlines) -> Iterator[tuple[float, float, bool]]:
    """The motions and dwells of a turn: input angles at both ends, and whether the wheel rests."""
    plane, rollers = outlines.plane, outlines.plane.rollers
    for i, (station, behind) in enumerate(rollers):
        after, later = rollers[(i + 1) % len(rollers)]
        turns = plane.turn_deg if i + 1 == len(rollers) else 0.0
        entry, exit_ = behind + station.entry_deg, behind + station.exit_deg
        following = later + turns + after.entry_deg
        yield entry, exit_, False
        if following - exit_ > NEAR:
            yield exit_, following, True


def edges(outlines: Outlines, at: Array) -> tuple[Array, Array]:
    """How far the wheel can be turned back and on at input angles, radians, until parts touch."""
    ways = [_edge(outlines, at, way) for way in (-1.0, 1.0)]
    return ways[0], ways[1]


def _edge(outlines: Outlines, at: Array, way: float) -> Array:
    def free(lead: Array, which: NDArray[np.intp]) -> NDArray[np.bool_]:
        out: NDArray[np.bool_] = ~outlines.clash.collides(at[which], way * lead, outlines.close)
        return out

    # The first of ever wider steps that collides, then halving.
    low, high = np.zeros(len(at)), np.full(len(at), math.radians(SEARCH_DEG))
    open_ = np.ones(len(at), dtype=bool)
    for step in np.radians(STEPS_DEG):
        here = np.flatnonzero(open_)
        if not len(here):
            break
        fine = free(np.full(len(here), step), here)
        low[here[fine]], high[here[~fine]] = step, step
        open_[here[~fine]] = False
    here = np.flatnonzero(~open_)
    for _ in range(HALVINGS if len(here) else 0):
        middle = 0.5 * (low[here] + high[here])
        fine = free(middle, here)
        low[here[fine]], high[here[~fine]] = middle[fine], middle[~fine]
    return low


def _push(outlines: Outlines, play: Play) -> tuple[float, float]:
    """The steepest that a roller pushes the wheel into line, as a pressure angle, and where.

    While the wheel's play becomes less as the crank turns, something pushes it: at the rim by
    rim * d(play), the roller moving by arm * d(crank).
    """
    plane, sizes = outlines.plane, outlines.sizes
    crank = np.unwrap(plane.crank(play.input_deg))
    moved = sizes.arm * np.abs(np.diff(crank))
    closing = [-np.diff(edge) for edge in (play.back, play.on)]
    push = sizes.rim * np.radians(np.maximum(*closing))
    angle = np.degrees(np.arctan2(np.maximum(push, 0.0), np.maximum(moved, 1e-12)))
    # Slots hold the wheel from their flanks in the motion; only what rests is pushed into line.
    angle = np.where(play.resting[:-1] & play.resting[1:], angle, 0.0)
    worst = int(np.argmax(angle))
    return float(angle[worst]), float(play.input_deg[worst])
