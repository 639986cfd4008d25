"""The smallest gaps of a whole turn: computed at a grid of positions, then refined."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, rising
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG
from geneva_cli.parts.turn.machine_parts import MachineParts, WorkLimit, rim_lever

POSITIONS = 10_000  # at most: about 0.1 s of the parts alone; a turn that needs more is not proved
DIP = 1e-9  # mm: gaps that differ by less count as equal
FINER = 9  # positions in each refinement,
HALF = FINER // 2  # of which the ends and the middle are mostly known

Earlier: TypeAlias = Callable[[float], float]


class Gap(NamedTuple):
    """The smallest gap between two parts, mm, negative where they overlap, and its position."""

    mm: float
    at_deg: float  # input angle
    parts: str


class SmallestGaps(NamedTuple):
    """The smallest gaps: of driving rollers, of idle rollers if there are any, of the lock."""

    driving: Gap
    idle: Gap | None
    lock: Gap

    @property
    def least(self) -> float:
        """The smallest gap of all, mm."""
        return min(gap.mm for gap in self if gap)


def smallest_gaps(parts: MachineParts, earlier: Earlier, refined: bool = True) -> SmallestGaps:
    """Return the smallest gaps of a whole turn, or of its first positions if not ``refined``."""
    gaps, at = parts.gaps, positions(parts)
    pose = gaps.pose(at)
    each = gaps.rollers(pose)

    def rollers(x: Array, idle: bool) -> Array:
        drives = _drives(parts, x)
        meanwhile = drives.any(axis=1, keepdims=True) & ~drives
        clearance = each if x is at else gaps.rollers(gaps.pose(x))
        return np.where(meanwhile == idle, clearance, np.inf).min(axis=1)

    def crank(x: Array) -> Array:
        return gaps.locking(pose if x is at else gaps.pose(x))

    def search(gap: Callable[[Array], Array], names: str) -> Gap:
        return _least(gap, at, parts.close, earlier, names, refined)

    several = len(parts.assembly.rollers) > 1
    return SmallestGaps(
        search(partial(rollers, idle=False), "roller and slot"),
        search(partial(rollers, idle=True), "idle roller and wheel") if several else None,
        search(crank, "locking disc and wheel"),
    )


def positions(parts: MachineParts) -> Array:
    """Return input angles of one turn, so dense that parts move less than the thinnest feature.

    Raises WorkLimit where that takes more than ``POSITIONS``.
    """
    assembly, sizes = parts.assembly, parts.sizes
    grid = np.linspace(assembly.start_deg, assembly.start_deg + assembly.span_deg, 721)
    crank = np.unwrap(assembly.crank(grid))
    wheel, rim = np.abs(np.diff(assembly.wheel(grid))), rim_lever(parts)
    travel = sizes.arm * np.abs(np.diff(crank)) + rim * wheel
    # between two positions parts move a quarter of the thinnest feature
    feature = min(sizes.roller, max(sizes.horn, 0.2 * sizes.roller)) * 0.25
    total = np.concatenate(([0.0], np.cumsum(travel)))
    count = math.ceil(total[-1] / feature)
    if count > POSITIONS:
        raise WorkLimit(
            f"the full turn is not proved: it takes {count:,} positions, more than {POSITIONS:,}; "
            "a larger roller or horn takes fewer"
        )
    grid_deg = np.interp(np.linspace(0.0, total[-1], count + 1), total, grid)
    # A rim that is too large collides for less than a degree about entry and exit.
    ends = np.array([b + e for s, b in assembly.motions for e in (s.entry_deg, s.exit_deg)])
    # 24 positions lie within 15 degrees of the input
    # on either side of entry and exit
    offsets = np.geomspace(0.01, 15.0, 24)
    near = (ends[:, None] + np.concatenate((-offsets, [0.0], offsets))).ravel()
    near = assembly.start_deg + (near - assembly.start_deg) % assembly.span_deg
    return rising(np.concatenate((grid_deg, near)))


def _drives(parts: MachineParts, x: Array) -> Mask:
    """Return a mask of the rollers that move the wheel at input angles, (n, m)."""
    assembly = parts.assembly
    columns = []
    for engagement, behind in assembly.rollers:
        away = assembly.from_mid(x, behind)
        columns.append(
            (away >= engagement.entry_deg - SAME_INPUT_DEG)
            & (away <= engagement.exit_deg + SAME_INPUT_DEG)
        )
    return np.column_stack(columns)


def _least(
    gap: Callable[[Array], Array],
    at: Array,
    close: float,
    earlier: Earlier,
    parts: str,
    refined: bool,
) -> Gap:
    """Return the smallest gap over the whole turn."""
    values = gap(at)
    inner = np.arange(1, len(at) - 1)
    dips = inner[
        (values[1:-1] < values[:-2] - DIP) & (values[1:-1] <= values[2:])
        | (values[1:-1] <= values[:-2]) & (values[1:-1] < values[2:] - DIP)
    ]
    # A smaller gap can only lie between positions whose gaps are already near to the smallest.
    # the 12 smallest gaps are refined
    dips = dips[np.argsort(values[dips])][: 12 if refined else 0]
    about = dips[:, None] + (-1, 0, 1)  # each minimum and its two neighbours
    known_at, known = at[about], values[about]
    closer: list[tuple[Array, Array]] = []
    for _ in range(6 if len(dips) else 0):
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
    size = min(float(v.min()) for v in (values, *(v for v, _ in closer)))
    # Where a gap stays equal for a while, its position is the first one.
    same = values <= size + close
    places = [at[same & ~np.append(False, same[:-1])]]
    places += [x[v <= size + close] for v, x in closer[-1:]]
    return Gap(size, min(np.concatenate(places).tolist(), key=earlier), parts)
