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
from functools import lru_cache
from typing import NamedTuple

from geneva_cli.analysis.undercut import depths_mm
from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.machine.spec import Spec
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.outlines import CONTACT
from geneva_cli.parts.sizes import sizes, wall_min
from geneva_cli.parts.sphere.sizes import ball
from geneva_cli.spec.tables import Size
from geneva_cli.study.synthesis.looks import PartsLook, gap_at_rest, look
from geneva_cli.verdict.cautions import SHOWN_UNDERCUT
from geneva_cli.verdict.checks.undercut import undercut_depth

USUAL = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)  # % of L
NEARLY = 0.98  # of the undercut that is let pass: more places tell more, seldom by two hundredths
SPARE = 1.001  # times the least roller, for what lies between the places that are compared
KEPT = 1024  # machines: those of more rollers are asked for twice

# Why parts cannot be built, in one word
ISLAND = "island"
UNDERCUT = "undercut"
WALLS = "walls"
ROLLERS = "rollers"
LOCK = "lock"
GAP = "gap"
SIZES = "sizes"

# What the table says of parts that were turned and pass, and of those that were not turned.
YES = "yes"
MAYBE = "maybe"


class Parts(NamedTuple):
    """A machine's spec with the roller that suits it, and what stands in the way of its parts.

    ``why`` is empty where nothing does, and None for a wheel whose parts are not drawn.
    """

    spec: Spec
    why: str | None

    @property
    def said(self) -> str | None:
        """What the table's column says of parts that nobody has turned."""
        if self.why is None:
            return None
        return f"no: {self.why}" if self.why else MAYBE


@lru_cache(maxsize=KEPT)
def suited(spec: Spec) -> tuple[Mechanism, Parts]:
    """The machine of a spec and its parts.

    Raises GenevaError for a spec that makes no machine.
    """
    mechanism = build(spec)
    return mechanism, parts(mechanism)


def nothing_in_the_way(spec: Spec) -> bool:
    """Whether it makes a machine whose parts are drawn, and nothing stands in their way."""
    try:
        return suited(spec)[1].why == ""
    except GenevaError:
        return False


def parts(mechanism: Mechanism) -> Parts:
    """The largest usual roller that does, up to L/20; a larger one where the slot needs it.

    Of a spec that gives its roller, whether that one does.
    """
    spec = mechanism.spec
    if not spec.has_parts:
        return Parts(spec, None)
    if not spec.is_flat:
        r, why = _of_shells(mechanism)
        return Parts(spec if r is None else with_roller(spec, r), why)
    at, m = look(spec), spec.drive.rollers
    if spec.drive.CRANKED and not mechanism.law:  # the same whatever turns the crank
        r, why = _of_crank(at.spec, m)
    else:
        r, why = _suiting(assembly(mechanism), at, m)
    return Parts(spec if r is None else with_roller(spec, r), why)


@lru_cache(maxsize=1024)
def _of_crank(spec: Spec, m: int) -> tuple[float | None, str]:
    return _suiting(assembly(build(spec)), look(spec), m)


def _suiting(where: Assembly, at: PartsLook, m: int) -> tuple[float | None, str]:
    """The radius of the roller that suits m rollers, mm, None for the one that the spec has; and
    what stands in the way.
    """
    mechanism, L = where.mechanism, where.L
    apart = math.inf if m == 1 else mechanism.ratio * L * math.sin(math.pi / m)

    def obstacle(r: float) -> str:
        if apart <= r:
            return ROLLERS
        if r not in at.tried:
            at.tried[r] = _obstacle(where, at, r)
        return at.tried[r]

    def of_share(percent: float) -> str:
        return obstacle(0.01 * percent * L)

    if mechanism.spec.size.roller_radius_mm is not None:
        r = mechanism.spec.size.roller_radius_mm
        return None, obstacle(r) or (ISLAND if r < at.least else "")
    radii = _radii(at.least / L)
    percent, why = _largest(radii, of_share)
    if why == LOCK:  # the horns of a small roller are thin, and those of a larger one may do
        percent, why = next(((r, "") for r in reversed(radii) if not of_share(r)), (None, LOCK))
    if percent is None and at.least > 0.01 * USUAL[-1] * L:
        percent, _ = _largest(_radii(0.0), of_share)  # the island apart, nothing is in the way
        why = ISLAND
    return (None if percent in (None, USUAL[0]) else exact(0.01 * percent * L)), why


def _of_shells(mechanism: Mechanism) -> tuple[float | None, str]:
    """The same of a machine on a sphere."""
    L, given = mechanism.center_distance_mm, mechanism.spec.size
    least = wall_min(given, L) / L

    def obstacle(percent: float) -> str:
        try:
            found = ball(mechanism, 0.01 * percent * L)
        except GenevaError as error:
            return LOCK if error.key == ("size", "lock_radius_mm") else SIZES
        return LOCK if found.lock and found.arm - found.half_width - found.recess < least else ""

    if given.roller_radius_mm is not None:
        return None, obstacle(100.0 * given.roller_radius_mm / L)
    percent, why = _largest(_radii(0.0), obstacle)
    return (None if percent in (None, USUAL[0]) else exact(0.01 * percent * L)), why


def with_roller(spec: Spec, radius_mm: float | None) -> Spec:
    """The spec with another roller; None for the usual one."""
    return spec.replace(size=_size_with(spec.size, radius_mm))


@lru_cache(maxsize=1024)
def _size_with(size: Size, radius_mm: float | None) -> Size:
    return size.replace(roller_radius_mm=radius_mm)


def exact(x: float) -> float:
    """A product of short decimals, without what rounding added to it."""
    return float(f"{x:.12g}")


def _radii(least: float) -> list[float]:
    """Radii to try, rising, in % of L: the usual ones, from a least one on."""
    percent = 100.0 * least * SPARE
    usual = [r for r in reversed(USUAL) if r >= percent]
    step = 10.0 ** (math.floor(math.log10(percent)) - 1) if percent > USUAL[-1] else USUAL[-1]
    first = step * math.ceil(percent / step)
    return usual if first <= USUAL[-1] else [exact(first), *usual]


def _largest(radii: list[float], obstacle: Callable[[float], str]) -> tuple[float | None, str]:
    """The largest radius that nothing stands in the way of, or what does so of the smallest.

    What stands in the way of a roller does so of a larger one too, but for a lock's thin horns.
    """
    if not obstacle(radii[-1]):
        return radii[-1], ""
    count = bisect_left(radii, True, key=lambda r: bool(obstacle(r)))  # that nothing stops
    return (radii[count - 1], "") if count else (None, obstacle(radii[0]))


def _obstacle(where: Assembly, at: PartsLook, r: float) -> str:
    """What stands in the way of a roller; nothing if it does."""
    mechanism = where.mechanism
    mechanism = mechanism._replace(spec=with_roller(mechanism.spec, r))
    try:
        found = sizes(where._replace(mechanism=mechanism), at.paths)
    except GenevaError as error:
        return LOCK if error.key == ("size", "lock_radius_mm") else SIZES
    if at.between - 2.0 * found.half_width < found.wall_min:
        return WALLS
    if found.lock and found.horn < found.wall_min:
        return LOCK
    w, L = found.half_width, where.L
    if at.back and gap_at_rest(at.back, found.rim, w, found.roller) < -CONTACT * L:
        return GAP
    bent = [wall for wall in at.walls or () if not wall.bend.max() * w <= L]
    cut = max((float(depths_mm(wall, w, L)[0]) for wall in bent), default=0.0)
    if NEARLY * SHOWN_UNDERCUT < cut <= SHOWN_UNDERCUT:
        check = undercut_depth(UNDERCUT, mechanism)
        return UNDERCUT if check and check.passes is False else ""
    return UNDERCUT if cut > SHOWN_UNDERCUT else ""
