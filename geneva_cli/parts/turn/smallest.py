"""The smallest gaps of a whole turn: first at places near enough to each other, then closer."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import partial
from itertools import repeat
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import rising
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG
from geneva_cli.parts.turn.turned import Turned

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

SHARE = 0.25  # of the thinnest feature: parts move no farther between two positions
POSITIONS = 4000  # at most
DIP = 1e-9  # mm: a gap that is less by less is not
DIPS = 12  # smallest gaps that are looked at more closely
FINER = 9  # positions put around each of them, each time,
HALF = FINER // 2  # of which those at both ends and amid are mostly known
ROUNDS = 6
CHANGE_DEG = 15.0  # of the input, on either side of entry and exit,
ENDS = 24  # there are that many positions

Earlier: TypeAlias = Callable[[float], float]


class Gap(NamedTuple):
    """The smallest gap between two parts, mm, negative where they overlap, and where it is."""

    mm: float
    at_deg: float  # input angle
    parts: str


class SmallestGaps(NamedTuple):
    """Of rollers at their own slots, of others meanwhile, if there are any, and of the crank."""

    driving: Gap
    idle: Gap | None
    lock: Gap

    @property
    def least(self) -> float:
        """The smallest of all, mm."""
        return min(gap.mm for gap in self if gap)


def smallest_gaps(parts: Turned, earlier: Earlier) -> Iterator[SmallestGaps]:
    """The smallest gaps at the places looked at first, and then those of the whole turn."""
    gaps, at = parts.gaps, positions(parts)
    pose = gaps.pose(at)
    each = gaps.rollers(pose)

    def rollers(x: Array, idle: bool) -> Array:
        drives = _drives(parts, x)
        meanwhile = drives.any(axis=1, keepdims=True) & ~drives
        found = each if x is at else gaps.rollers(gaps.pose(x))
        out: Array = np.where(meanwhile == idle, found, np.inf).min(axis=1)
        return out

    def crank(x: Array) -> Array:
        return gaps.locking(pose if x is at else gaps.pose(x))

    def search(gap: Callable[[Array], Array], names: str) -> Iterator[Gap]:
        return _least(gap, at, parts.close, earlier, names)

    several = len(parts.assembly.rollers) > 1
    own = search(partial(rollers, idle=False), "roller and slot")
    others = search(partial(rollers, idle=True), "idle roller and wheel")
    lock = search(crank, "locking disc and wheel")
    yield from map(SmallestGaps, own, others if several else repeat(None), lock)


def positions(parts: Turned) -> Array:
    """Input angles of one turn, between which no part moves by much of the thinnest feature."""
    assembly, sizes = parts.assembly, parts.sizes
    grid = np.linspace(assembly.start_deg, assembly.start_deg + assembly.span_deg, 721)
    crank = np.unwrap(assembly.crank(grid))
    way = sizes.arm * np.abs(np.diff(crank)) + sizes.rim * np.abs(np.diff(assembly.wheel(grid)))
    feature = min(sizes.roller, max(sizes.horn, 0.2 * sizes.roller)) * SHARE
    total = np.concatenate(([0.0], np.cumsum(way)))
    count = min(math.ceil(total[-1] / feature), POSITIONS)
    found = np.interp(np.linspace(0.0, total[-1], count + 1), total, grid)
    # A rim that is too large is fouled for less than a degree about entry and exit.
    ends = np.array([b + e for s, b in assembly.motions for e in (s.entry_deg, s.exit_deg)])
    beside = np.geomspace(0.01, CHANGE_DEG, ENDS)
    near = (ends[:, None] + np.concatenate((-beside, [0.0], beside))).ravel()
    near = assembly.start_deg + (near - assembly.start_deg) % assembly.span_deg
    return rising(np.concatenate((found, near)))


def _drives(parts: Turned, x: Array) -> NDArray[np.bool_]:
    """Which rollers move the wheel at input angles, (n, m)."""
    assembly = parts.assembly
    half = 0.5 * assembly.turn_deg
    columns = []
    for engagement, behind in assembly.rollers:
        away = (x - behind + half) % assembly.turn_deg - half
        columns.append(
            (away >= engagement.entry_deg - SAME_INPUT_DEG)
            & (away <= engagement.exit_deg + SAME_INPUT_DEG)
        )
    return np.column_stack(columns)


def _least(
    gap: Callable[[Array], Array], at: Array, close: float, earlier: Earlier, parts: str
) -> Iterator[Gap]:
    """The smallest gap at some places, and over a turn: around each place where it is smallest,
    ever closer.
    """
    values = gap(at)
    yield _earliest(at, values, [], close, earlier, parts)
    inner = np.arange(1, len(at) - 1)
    dips = inner[
        (values[1:-1] < values[:-2] - DIP) & (values[1:-1] <= values[2:])
        | (values[1:-1] <= values[:-2]) & (values[1:-1] < values[2:] - DIP)
    ]
    # Only where it comes near to the smallest can a smaller one lie between.
    dips = dips[np.argsort(values[dips])][:DIPS]
    about = dips[:, None] + (-1, 0, 1)  # the place, and those beside it
    known_at, known = at[about], values[about]
    closer: list[tuple[Array, Array]] = []
    for _ in range(ROUNDS if len(dips) else 0):
        low, high = known_at[:, :1], known_at[:, -1:]
        x = low + (high - low) * np.linspace(0.0, 1.0, FINER)
        v, fresh = np.empty(x.shape), np.ones(x.shape, dtype=bool)
        v[:, ::HALF], fresh[:, ::HALF] = known, x[:, ::HALF] != known_at
        v[fresh] = gap(x[fresh])
        i = np.argmin(v, axis=1)
        rows = np.arange(len(x))
        closer.append((v[rows, i], x[rows, i]))
        about = np.clip(i[:, None] + (-1, 0, 1), 0, FINER - 1)
        known_at, known = x[rows[:, None], about], v[rows[:, None], about]
    yield _earliest(at, values, closer, close, earlier, parts)


def _earliest(
    at: Array,
    values: Array,
    closer: list[tuple[Array, Array]],
    close: float,
    earlier: Earlier,
    parts: str,
) -> Gap:
    """The smallest of gaps, and of those that were looked at closer, with their places."""
    size = min(float(v.min()) for v in (values, *(v for v, _ in closer)))
    # A gap that stays the same for a while is said to be where it begins.
    same = values <= size + close
    places = [at[same & ~np.append(False, same[:-1])]]
    places += [x[v <= size + close] for v, x in closer[-1:]]
    return Gap(size, min(np.concatenate(places).tolist(), key=earlier), parts)
