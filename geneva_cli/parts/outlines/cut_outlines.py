"""The outlines of wheel and crank as they are cut, and the relief that clears the wheel."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from functools import cache, lru_cache

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc, Contour
from geneva_cli.kept import KEPT
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.crank_outline import crank_contours, is_whole, lock_of, takes_arcs
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.wheel_outline import CURVED, turned_walls, wheel_contour
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import Pose

SWEPT_DEG = 0.2  # of the input, between the positions of the wheel that a relief must clear


def drawn(assembly: Assembly, sizes: Sizes) -> Outlines:
    """Return the outlines of an assembly with known sizes, cached without what a load changes."""
    return _drawn(assembly, sizes.outline)._replace(sizes=sizes)


@lru_cache(maxsize=KEPT)  # a sweep cuts the locks of its designs first, and then turns the parts
def _drawn(assembly: Assembly, sizes: Sizes) -> Outlines:
    kinds, L = assembly.kinds, assembly.L
    walls = turned_walls(assembly, sizes)
    close = (CURVED if any(engagement.slot.curved for engagement in kinds) else SAME_LENGTH) * L
    wheel = wheel_contour(assembly, sizes, walls)
    crank, relief, gaps = _relieved(Gaps(assembly, sizes, wheel, []), sizes, close)
    if assembly.full.spec.wheel.stopped:
        wheel = wheel_contour(assembly, sizes, walls, convex=True)
    return Outlines(assembly, sizes, walls, wheel, crank, relief, gaps, close)


def cut_lock(assembly: Assembly, sizes: Sizes) -> Lock:
    """Return the lock: the narrowest arc of the crank, and the corner that leaves the most play.

    Beyond the crank's axis the wheel leaves less than a sector between two reliefs.
    """
    lock = lock_of(assembly, sizes)
    if is_whole(assembly, sizes):
        return lock
    try:
        parts = drawn(assembly, sizes)
    except GenevaError:  # the check of the parts reports the error
        return lock
    locking = cut_arcs(parts.crank, lock.lock, 0.0, SAME_LENGTH * assembly.L)
    return lock_of(assembly, sizes, [0.5 * abs(arc.sweep) for arc in locking])


def cut_arcs(contours: Iterable[Contour], radius: float, away: float, near: float) -> Iterator[Arc]:
    """Yield the arcs of a radius whose centres are ``away`` from the axis, both within ``near``."""
    for arc in (piece for contour in contours for piece in contour.segments):
        if (
            isinstance(arc, Arc)
            and max(abs(arc.radius - radius), abs(math.hypot(*arc.centre) - away)) < near
        ):
            yield arc


def _relieved(bare: Gaps, sizes: Sizes, close: float) -> tuple[list[Contour], str, Gaps]:
    """Return the crank with the spec's relief, or else the first kind that clears the wheel.

    An arc leaves the most of the disc and is one cut. If it collides or leaves too little, the
    whole sector is cut down to where the wheel never comes.
    """
    assembly = bare.assembly
    if not sizes.lock:
        return [], "none", bare
    requested = assembly.mechanism.spec.size.relief
    whole = is_whole(assembly, sizes)
    swept = cache(lambda i: bare.swept(i, SWEPT_DEG))
    if not requested and takes_arcs(assembly, sizes):
        crank = crank_contours(assembly, sizes, "arc", swept)
        gaps = bare.with_crank(crank)
        if _overlap(gaps, close) <= close:
            return crank, "arc", gaps
    kind, spare = requested or "sector", 0.0
    for _ in range(6):
        crank = crank_contours(assembly, sizes, kind, swept, spare)
        gaps = bare.with_crank(crank)
        if whole or (overlap := _overlap(gaps, close)) <= close:
            break
        # Between two of these positions the wheel comes nearer still: three times the overlap.
        spare += 3.0 * overlap + 10.0 * close
    return crank, kind, gaps


def _overlap(gaps: Gaps, close: float) -> float:
    """Return the greatest overlap of crank and wheel in all motions, mm, 0 for none."""
    least = 0.0
    for engagement, behind in gaps.assembly.motions:
        count = 2 + int(engagement.motion_deg / SWEPT_DEG)
        at = np.linspace(engagement.entry_deg, engagement.exit_deg, count)
        at = behind + at + 0.3 * SWEPT_DEG
        # without the rollers, which lock nothing
        pose = Pose(gaps.assembly.wheel(at), gaps.assembly.crank(at), np.empty((len(at), 0, 2)))
        least = min(least, float(gaps.locking(pose, near=close).min()))
    return -least
