"""A fast test whether the parts of a machine can be built, and the roller that suits them.

A curved slot needs a roller between two limits. Where its entry and exit paths differ, a small
roller leaves an island of the wheel between them, which falls out. A large roller undercuts the
outer walls. Adjacent slots and the locking disc limit the roller too. Collisions in a whole turn
are left to ``geneva check``.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from functools import cache, lru_cache
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.records import thing
from geneva_cli.motion.undercut import depths_mm
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.parts.assembly import Assembly, assembly
from geneva_cli.parts.machine_sizes import sizes
from geneva_cli.parts.turn.pairs import CONTACT
from geneva_cli.spec.least_wall import wall_min
from geneva_cli.study.synth.parts_data import PartsData, distances_at_rest, parts_data
from geneva_cli.verdict.checks.motion_checks import undercut_depth
from geneva_cli.verdict.motion_warnings import SHOWN_UNDERCUT

USUAL = (5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.8, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1)  # % of L
SPARE = 1.001  # times the least roller, for what lies between the samples

# Reasons why parts cannot be built.
ISLAND, UNDERCUT, LOCK, SIZES, WALLS = "island", "undercut", "lock", "sizes", "walls"
HORN = "horn"  # shown as that of the lock

# Entries of the table for parts that pass a full turn, and for parts that were not turned.
YES = "yes"
MAYBE = "maybe"


class Parts(NamedTuple):
    """A machine's spec with the roller that suits it, and the obstacle to its parts.

    ``why`` is empty without an obstacle, and None for a wheel whose parts are not drawn.
    """

    spec: Spec
    why: str | None

    @property
    def entry(self) -> str | None:
        """The entry in the table for parts that were not turned."""
        return f"no: {self.why}" if self.why else None if self.why is None else MAYBE


@lru_cache(maxsize=1024)  # machines with more rollers are requested twice
def machine_and_parts(spec: Spec) -> tuple[Mechanism, Parts]:
    """The machine of a spec, and its parts.

    Raises GenevaError for a spec that makes no machine.
    """
    mechanism = build(spec)
    return mechanism, parts(mechanism)


def has_no_obstacle(spec: Spec) -> bool:
    """Return True if the spec makes a machine whose parts can be drawn without an obstacle."""
    try:
        if spec.motion and spec.is_flat:  # most of those without walls need not be built
            at, L = parts_data(spec), spec.given_distance_mm
            least = spec.size.roller_radius_mm or 0.01 * L * radii_from(at.least / L)[0]
            if _thin(spec, at, L, least):
                return False
        return machine_and_parts(spec)[1].why == ""
    except GenevaError:
        return False


def parts(mechanism: Mechanism) -> Parts:
    """The machine's parts with the largest usual roller up to L/20, or a larger one if needed.

    If the spec gives its roller, only that one is tested.
    """
    spec = mechanism.spec
    if not spec.is_turned:
        return Parts(spec, None)
    if suiting := thing(spec.wheel.NAME, "roller"):
        r, why = suiting(mechanism)
    elif spec.drive.crank and not mechanism.law:  # whatever turns the crank
        r, why = _of_crank(parts_data(spec).spec, spec.drive.rollers)
    else:
        r, why = _suiting(assembly(mechanism), parts_data(spec), spec.drive.rollers)
    return Parts(spec if r is None else with_roller(spec, r), why)


@lru_cache(maxsize=1024)
def _of_crank(spec: Spec, m: int) -> tuple[float | None, str]:
    return _suiting(assembly(build(spec)), parts_data(spec), m)


def _suiting(where: Assembly, at: PartsData, m: int) -> tuple[float | None, str]:
    """The radius in mm of the roller that suits m rollers, and the obstacle to the parts."""
    mechanism, L = where.mechanism, where.L
    own = mechanism.spec.size.roller_radius_mm
    apart = math.inf if m == 1 else mechanism.ratio * L * math.sin(math.pi / m)

    @cache
    def obstacle(percent: float) -> str:
        r = own or 0.01 * percent * L
        return "rollers" if apart <= r else _obstacle(where, at, r)

    def quick(percent: float) -> str:  # for all but the reason
        thin = _thin(mechanism.spec, at, L, 0.01 * percent * L)
        return WALLS if thin else obstacle(percent)

    if own is not None:
        return None, _shown(obstacle(0.0)) or (ISLAND if own < at.least else "")
    radii = radii_from(at.least / L)
    percent, why = None if quick(radii[-1]) else radii[-1], ""
    if percent is None:
        why = obstacle(radii[0])
        if why == HORN:  # that of a larger roller may be thick enough: it is no thicker than it
            wall = (1.0 - 1e-9) * wall_min(mechanism.spec.size, L)
            thick = (r for r in reversed(radii) if 0.01 * r * L >= wall)
            percent = next((r for r in thick if not quick(r)), None)
        elif why in ("", SIZES):
            percent, _ = largest(radii, quick)
        why = "" if percent else why
    if percent is None and at.least > 0.01 * USUAL[-1] * L:
        percent, _ = largest(radii_from(0.0), quick)  # there is no obstacle except the island
        why = ISLAND
    return radius_mm(percent, L), _shown(why)


def _shown(why: str) -> str:
    return LOCK if why == HORN else why


def radius_mm(percent: float | None, L: float) -> float | None:
    """The radius of a roller in % of L; None for the usual one, or for none."""
    return None if percent in (None, USUAL[0]) else exact(0.01 * percent * L)


def with_roller(spec: Spec, radius_mm: float | None) -> Spec:
    """The spec with another roller; None means the usual one."""
    return spec.replace(size=spec.size.replace(roller_radius_mm=radius_mm))


def exact(x: float) -> float:
    """A product of short decimals, without its rounding error."""
    return float(f"{x:.12g}")


def radii_from(least: float) -> list[float]:
    """Radii to try in ascending order, in % of L: the usual ones from a least one on."""
    percent = 100.0 * least * SPARE
    usual = [r for r in reversed(USUAL) if r >= percent]
    return usual if percent <= USUAL[-1] else [to_digits(percent, 2, math.ceil), *usual]


def largest(radii: Sequence[float], obstacle: Callable[[float], str]) -> tuple[float | None, str]:
    """The largest radius without an obstacle, or else the obstacle of the smallest.

    An obstacle to a roller is one to larger rollers too, except for the thin horns of a lock.
    """
    if not obstacle(radii[-1]):
        return radii[-1], ""
    # number of radii without an obstacle
    count = bisect_left(radii, True, key=lambda r: bool(obstacle(r)))
    return (radii[count - 1], "") if count else (None, obstacle(radii[0]))


def _thin(spec: Spec, at: PartsData, L: float, r: float) -> bool:
    w = r + spec.size.allowances.slot_clearance_mm
    return at.between - 2.0 * w < wall_min(spec.size, L)


def _obstacle(where: Assembly, at: PartsData, r: float) -> str:
    mechanism = where.mechanism
    mechanism = mechanism._replace(spec=with_roller(mechanism.spec, r))
    try:
        lengths = sizes(where._replace(mechanism=mechanism), at.paths)
    except GenevaError as error:
        return LOCK if error.key == ("size", "lock_radius_mm") else SIZES
    if _thin(mechanism.spec, at, where.L, r):
        return WALLS
    if lengths.lock and lengths.horn < lengths.wall_min:
        return HORN
    w, L = lengths.half_width, where.L
    if at.back:
        gap = distances_at_rest(*at.back, lengths.rim, w).min() - lengths.roller
        if gap < -CONTACT * L:
            return "gap"
    bent = [wall for wall in at.walls or () if not wall.bend.max() * w <= L]
    cut = max((float(depths_mm(wall, w, L)[0]) for wall in bent), default=0.0)
    if 0.98 * SHOWN_UNDERCUT < cut <= SHOWN_UNDERCUT:  # samples rarely miss more than 2 %
        check = undercut_depth(UNDERCUT, mechanism)
        return UNDERCUT if check and check.passes is False else ""
    return UNDERCUT if cut > SHOWN_UNDERCUT else ""
