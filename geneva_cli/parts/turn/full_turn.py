"""The proof that a machine turns: its parts through a whole turn of the crank.

The wheel is turned as the mechanism says, and pushed back and on from there as far as slot and
lock let it: its play. No parts may overlap, in every dwell something must hold the wheel, and
where the roller comes to a wheel that stands off by its play, it must push it into line and not
against itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, TypeVar

import numpy as np

from geneva_cli.numerics.arrays import rising
from geneva_cli.parts.turn.freedom import EXACT, free_angles, search_deg
from geneva_cli.parts.turn.play import NEAR, Play, play_of, push_deg, windows
from geneva_cli.parts.turn.turned import Pose, Turned

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

SHARE = 0.25  # of the thinnest feature: parts move no farther between two positions
POSITIONS = 4000  # at most
NO_PLAY = 1e-6  # degrees: a play as small as this is rounding
SAME = 1e-7  # of a play: how nearly it is known
DIP = 1e-9  # mm: a gap that is less by less is not
DIPS = 12  # smallest gaps that are looked at more closely
FINER = 9  # positions put around each of them, each time
ROUNDS = 6
CHANGE_DEG = 15.0  # of the input, on either side of entry and exit,
ENDS = 24  # there are that many positions


class Gap(NamedTuple):
    """The smallest gap between two parts, mm, negative where they overlap, and where it is."""

    mm: float
    at_deg: float  # input angle
    parts: str


class Most(NamedTuple):
    """The greatest of an angle, degrees, and the input angle where it is."""

    deg: float
    at_deg: float


Place = TypeVar("Place", Gap, Most)
Earlier: TypeAlias = Callable[[float], float]


class FullTurn(NamedTuple):
    """What a whole turn shows; input angles as ``Mechanism.shown_deg`` says.

    ``dwell`` is the wheel's play, either way, in the middle of a dwell, where the lock holds it
    best; ``hand_over`` the largest where no roller is in its slot; ``motion`` where one is, and
    both ways: a slot that drives from one wall alone is not held to be loose. There ``ahead`` and
    ``behind`` are what the wheel is free one way, whatever the other. ``push`` is the
    largest pressure angle at which a roller pushes the wheel into line. A play as large as
    ``free_deg``, half a step, is none: nothing holds the wheel.
    """

    driving: Gap
    idle: Gap | None
    lock: Gap | None
    dwell: Most
    hand_over: Most
    motion: Most
    ahead: Most
    behind: Most
    push: Most
    free_deg: float
    play: Play

    @property
    def smallest(self) -> Gap:
        """The smallest gap of all."""
        return min((g for g in (self.driving, self.idle, self.lock) if g), key=lambda g: g.mm)

    @property
    def holds(self) -> bool:
        """Whether crank and rollers hold the wheel in the middle of every dwell."""
        return self.dwell.deg < self.free_deg * (1.0 - SAME)


def full_turn(parts: Turned) -> FullTurn:
    """Turn the parts of a machine through a whole turn of its crank.

    Raises NotProved where that takes more than ``gaps.WORK``.
    """
    parts.gaps.begin()
    earlier = _earlier(parts)
    driving, idle, lock = _smallest(parts, positions(parts), earlier)
    fits = all(found.mm >= -parts.close for found in (driving, idle, lock) if found)
    play = play_of(parts, fits)
    most = search_deg(parts)
    middles = np.array([0.5 * (w.start + w.end) for w in windows(parts) if w.rests])
    dwell = (
        np.degrees(np.maximum(*free_angles(parts, middles, fits))) if len(middles) else np.zeros(0)
    )
    push = push_deg(parts, play)

    def shown(found: Place) -> Place:
        return found._replace(at_deg=parts.assembly.shown_deg(found.at_deg))

    def most_of(values: Array, at: Array) -> Most:
        return shown(_most(values, at, earlier))

    led = play.input_deg[play.guided]
    return FullTurn(
        shown(driving),
        shown(idle) if idle else None,
        shown(lock) if parts.crank else None,
        most_of(dwell, middles),
        most_of(play.either[~play.guided], play.input_deg[~play.guided]),
        most_of(play.both[play.guided], led),
        most_of(play.on[play.guided], led),
        most_of(play.back[play.guided], led),
        most_of(push, play.input_deg[:-1]),
        most,
        play,
    )


def _earlier(parts: Turned) -> Earlier:
    """What tells which of two input angles of a turn is the earlier, as they are shown.

    A turn of the input is shown from half a turn before mid-motion on, so that the second half of
    the last dwell comes first; a period of several turns from the first entry.
    """
    *_, last = windows(parts)
    turn, several = parts.assembly.turn_deg, parts.assembly.given.spec.drive.turns > 1
    middle = 0.5 * (last.start + last.end) if last.rests and not several else last.end
    return lambda input_deg: input_deg - turn if input_deg > middle else input_deg


def _most(values: Array, at: Array, earlier: Earlier) -> Most:
    """The greatest and its place: the middle of the first, where it stays as great for a while."""
    size = float(values.max(initial=0.0))
    if not size > NO_PLAY:
        return Most(0.0, 0.0)
    same = values >= size - max(SAME * size, math.degrees(EXACT))
    first = np.flatnonzero(same & ~np.append(False, same[:-1]))
    last = np.flatnonzero(same & ~np.append(same[1:], False))
    return Most(size, min(at[(first + last) // 2].tolist(), key=earlier))


def positions(parts: Turned) -> Array:
    """Input angles of one turn, between which no part moves by much of the thinnest feature."""
    assembly, sizes = parts.assembly, parts.sizes
    grid = np.linspace(assembly.start_deg, assembly.start_deg + assembly.turn_deg, 721)
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
    near = assembly.start_deg + (near - assembly.start_deg) % assembly.turn_deg
    return rising(np.concatenate((found, near)))


def _smallest(parts: Turned, at: Array, earlier: Earlier) -> tuple[Gap, Gap | None, Gap]:
    """The smallest gaps: of rollers at their own slots, of others meanwhile, of the crank."""
    gaps = parts.gaps
    first = gaps.pose(at)

    def pose(x: Array) -> Pose:
        return first if x is at else gaps.pose(x)

    def rollers(x: Array, idle: bool) -> Array:
        drives = _drives(parts, x)
        meanwhile = drives.any(axis=1, keepdims=True) & ~drives
        out: Array = np.where(meanwhile == idle, gaps.rollers(pose(x)), np.inf).min(axis=1)
        return out

    def crank(x: Array) -> Array:
        return gaps.locking(pose(x))

    own, others = partial(rollers, idle=False), partial(rollers, idle=True)
    several = len(parts.assembly.rollers) > 1
    return (
        _least(own, at, parts.close, earlier, "roller and slot"),
        _least(others, at, parts.close, earlier, "idle roller and wheel") if several else None,
        _least(crank, at, parts.close, earlier, "locking disc and wheel"),
    )


def _drives(parts: Turned, x: Array) -> NDArray[np.bool_]:
    """Which rollers move the wheel at input angles, (n, m)."""
    assembly = parts.assembly
    half = 0.5 * assembly.turn_deg
    columns = []
    for engagement, behind in assembly.rollers:
        away = (x - behind + half) % assembly.turn_deg - half
        columns.append((away >= engagement.entry_deg - NEAR) & (away <= engagement.exit_deg + NEAR))
    return np.column_stack(columns)


def _least(
    gap: Callable[[Array], Array], at: Array, close: float, earlier: Earlier, parts: str
) -> Gap:
    """The smallest gap over a turn: around each place where it is smallest, ever closer."""
    values = gap(at)
    inner = np.arange(1, len(at) - 1)
    dips = inner[
        (values[1:-1] < values[:-2] - DIP) & (values[1:-1] <= values[2:])
        | (values[1:-1] <= values[:-2]) & (values[1:-1] < values[2:] - DIP)
    ]
    # Only where it comes near to the smallest can a smaller one lie between.
    dips = dips[np.argsort(values[dips])][:DIPS]
    low, high = at[dips - 1], at[dips + 1]
    closer: list[tuple[Array, Array]] = []
    for _ in range(ROUNDS if len(dips) else 0):
        x = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, FINER)
        v = gap(x.ravel()).reshape(x.shape)
        i = np.argmin(v, axis=1)
        rows = np.arange(len(x))
        closer.append((v[rows, i], x[rows, i]))
        low, high = x[rows, np.maximum(i - 1, 0)], x[rows, np.minimum(i + 1, FINER - 1)]
    size = min(float(v.min()) for v in (values, *(v for v, _ in closer)))
    # A gap that stays the same for a while is said to be where it begins.
    same = values <= size + close
    places = [at[same & ~np.append(False, same[:-1])]]
    places += [x[v <= size + close] for v, x in closer[-1:]]
    return Gap(size, min(np.concatenate(places).tolist(), key=earlier), parts)
