"""Can the parts of a machine be built, and with which roller? Told in some milliseconds.

A curved slot asks for a roller between two bounds. Where its way in and its way out are apart, a
small roller leaves an island of the wheel between them, which falls out; a large one undercuts the
outer walls. Neighbouring slots and the locking disc leave room for a roller up to some size. What
only a whole turn of the parts can tell is left to ``geneva check``.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable
from functools import cache, lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.undercut import undercut
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Engagement
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.roller_paths import RollerPaths, roller_paths
from geneva_cli.parts.sizes import sizes
from geneva_cli.verdict.cautions import SHOWN_UNDERCUT

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

USUAL = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)  # % of L
LOOKS = 120  # places of a slot that are compared, and then of half a motion, for the undercut
SPARE = 1.001  # times the least roller, for what lies between the places that are compared
NEARLY = 0.8  # of the undercut that is let pass, for the same reason

# Why parts cannot be built, in one word
ISLAND = "island"
UNDERCUT = "undercut"
WALLS = "walls"
ROLLERS = "rollers"
LOCK = "lock"
SIZES = "sizes"

# What the table says of parts that were turned and pass, and of those that were not turned.
YES = "yes"
MAYBE = "maybe"


class Parts(NamedTuple):
    """A machine's spec with the roller that suits it, and what stands in the way of its parts.

    ``why`` is empty where nothing does, and None for parts that are no flat outlines and were not
    looked at.
    """

    spec: Spec
    why: str | None

    @property
    def said(self) -> str | None:
        """What the table's column says of parts that nobody has turned."""
        if self.why is None:
            return None
        return f"no: {self.why}" if self.why else MAYBE


@lru_cache(maxsize=1024)
def suited(spec: Spec) -> tuple[Mechanism, Parts]:
    """The machine of a spec and its parts, which several steps of a search look at.

    Raises GenevaError for a spec that makes no machine.
    """
    mechanism = build(spec)
    return mechanism, parts(mechanism)


def parts(mechanism: Mechanism) -> Parts:
    """The largest usual roller that does, up to L/20; a larger one where the slot needs it.

    Of a spec that gives its roller, whether that one does.
    """
    spec = mechanism.spec
    if not spec.is_flat:
        return Parts(spec, None)
    where = assembly(mechanism)
    known = roller_paths(where)
    points = _slot(where, where.kinds[0])
    L, curved = where.L, where.kinds[0].slot.curved
    least = 0.5 * float(np.hypot(*(points - points[::-1]).T).max()) if curved else 0.0
    wall = _between(points, spec.wheel.z)
    if spec.size.roller_radius_mm is not None:
        r = spec.size.roller_radius_mm
        return Parts(spec, _obstacle(where, known, r, wall) or (ISLAND if r < least else ""))

    @cache
    def obstacle(percent: float) -> str:
        return _obstacle(where, known, 0.01 * percent * L, wall)

    percent, why = _largest(_radii(least / L), obstacle)
    if percent is None and least > 0.01 * USUAL[-1] * L:
        percent, _ = _largest(_radii(0.0), obstacle)  # the island apart, nothing is in the way
        why = ISLAND
    if percent is None or percent == USUAL[0]:
        return Parts(spec, why)
    return Parts(with_roller(spec, exact(0.01 * percent * L)), why)


def with_roller(spec: Spec, radius_mm: float | None) -> Spec:
    """The spec with another roller; None for the usual one."""
    return spec.replace(size=spec.size.replace(roller_radius_mm=radius_mm))


def exact(x: float) -> float:
    """A product of short decimals, without what rounding added to it."""
    return float(f"{x:.12g}")


def _slot(where: Assembly, engagement: Engagement) -> Array:
    """Places of a slot's pitch curve, (n, 2), mm."""
    at = np.linspace(engagement.entry_deg, engagement.exit_deg, 2 * LOOKS + 1)
    x, y = engagement.slot(at, 0)
    return where.L * np.column_stack((x.c[0], y.c[0]))


def _between(points: Array, z: int) -> float:
    """The least distance between the pitch curves of neighbouring slots, mm."""
    b = math.tau / z
    x, y = points[::2].T
    u, v = math.cos(b) * x - math.sin(b) * y, math.sin(b) * x + math.cos(b) * y
    return float(np.hypot(x[:, None] - u, y[:, None] - v).min())


def _radii(least: float) -> list[float]:
    """Radii to try, rising, in % of L: the usual ones, from a least one on."""
    percent = 100.0 * least * SPARE
    usual = [r for r in reversed(USUAL) if r >= percent]
    step = 10.0 ** (math.floor(math.log10(percent)) - 1) if percent > USUAL[-1] else USUAL[-1]
    first = step * math.ceil(percent / step)
    return usual if first <= USUAL[-1] else [exact(first), *usual]


def _largest(radii: list[float], obstacle: Callable[[float], str]) -> tuple[float | None, str]:
    """The largest radius that nothing stands in the way of, or what does so of the smallest.

    What stands in the way of a roller does so of a larger one too.
    """
    if not obstacle(radii[-1]):
        return radii[-1], ""
    count = bisect_left(radii, True, key=lambda r: bool(obstacle(r)))  # that nothing stops
    return (radii[count - 1], "") if count else (None, obstacle(radii[0]))


def _obstacle(where: Assembly, known: RollerPaths, r: float, between: float) -> str:
    """What stands in the way of a roller; nothing if it does."""
    mechanism = where.mechanism
    mechanism = mechanism._replace(spec=with_roller(mechanism.spec, r))
    m = mechanism.spec.drive.rollers
    if m > 1 and mechanism.ratio * where.L * math.sin(math.pi / m) <= r:
        return ROLLERS
    try:
        found = sizes(where._replace(mechanism=mechanism), known)
    except GenevaError as error:
        return LOCK if error.key == ("size", "lock_radius_mm") else SIZES
    if between - 2.0 * found.half_width < found.wall_min:
        return WALLS
    if found.lock and found.horn < found.wall_min:
        return LOCK
    cut = undercut(mechanism, LOOKS)
    return UNDERCUT if cut is not None and cut.depth_mm > NEARLY * SHOWN_UNDERCUT else ""
