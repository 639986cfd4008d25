"""The outlines of wheel and crank as they are cut, and the relief that clears the wheel."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from contextlib import suppress
from functools import cache, lru_cache
from itertools import chain
from operator import attrgetter

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc, Contour
from geneva_cli.kept import KEPT
from geneva_cli.loads.tolerance.locking import Lock, loosest
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.crank_outline import (
    crank_contours,
    is_whole,
    reliefs,
    sectors,
    takes_arcs,
    widened,
)
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.wheel_outline import CURVED, turned_walls, wheel_contour
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.roller_paths import horn_corners
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import Pose

SWEPT_DEG = 0.2  # of the input, between the positions of the wheel that a relief must clear


def drawn(assembly: Assembly, sizes: Sizes) -> Outlines:
    """Return the outlines of an assembly with known sizes, cached without what a load changes."""
    return _drawn(assembly, sizes.outline)._replace(sizes=sizes)


@lru_cache(maxsize=KEPT)  # a sweep cuts the locks of its designs first, and then turns the parts
def _drawn(assembly: Assembly, sizes: Sizes) -> Outlines:
    """Return the outlines with the spec's relief, or else the first kind that clears the wheel.

    An arc leaves the most of the disc and is one cut. If it collides or leaves too little, the
    whole sector is cut down to where the wheel never comes.
    """
    walls, curved = turned_walls(assembly, sizes), map(attrgetter("slot.curved"), assembly.kinds)
    close = (CURVED if any(curved) else SAME_LENGTH) * assembly.L
    wheel = wheel_contour(assembly, sizes, walls)
    bare = Gaps(assembly, sizes, wheel, [])
    if assembly.full.spec.wheel.stopped:
        wheel = wheel_contour(assembly, sizes, walls, convex=True)
    unlocked = Outlines(assembly, sizes, walls, wheel, [], "none", bare, close)
    if not sizes.lock:
        return unlocked
    requested = assembly.mechanism.spec.size.relief
    swept = cache(lambda i: bare.swept(i, SWEPT_DEG))
    if not requested and takes_arcs(assembly, sizes):
        crank = crank_contours(assembly, sizes, "arc", swept)
        gaps = bare.with_crank(crank)
        if _overlap(gaps, close) <= close:
            return unlocked._replace(crank=crank, relief="arc", gaps=gaps)
    relief, whole, spare = requested or "sector", is_whole(assembly, sizes), 0.0
    for _ in range(6):
        crank = crank_contours(assembly, sizes, relief, swept, spare)
        gaps = bare.with_crank(crank)
        if whole:
            break
        overlap = _overlap(gaps, close)
        if overlap <= close:
            break
        # Between two of these positions the wheel comes nearer still: three times the overlap.
        spare += 3.0 * overlap + 10.0 * close
    return unlocked._replace(crank=crank, relief=relief, gaps=gaps)


def _overlap(gaps: Gaps, close: float) -> float:
    """Return the greatest overlap of crank and wheel in all motions, mm, 0 for none."""
    least = 0.0
    for engagement, mid in gaps.assembly.motions:
        count = 2 + int(engagement.motion_deg / SWEPT_DEG)
        at = mid + np.linspace(engagement.entry_deg, engagement.exit_deg, count) + 0.3 * SWEPT_DEG
        # without the rollers, which lock nothing
        pose = Pose(gaps.assembly.wheel(at), gaps.assembly.crank(at), np.empty((len(at), 0, 2)))
        least = min(least, float(gaps.locking(pose, near=close).min()))
    return -least


def cut_lock(assembly: Assembly, sizes: Sizes) -> Lock:
    """Return the lock: the narrowest arc of the crank, and the corner that leaves the most play.

    Beyond the crank's axis the wheel leaves less than a sector between two reliefs.
    """
    L, lock, recess, flat = assembly.L, sizes.lock, sizes.recess, sizes.horn_tip
    mouths = horn_corners(assembly, sizes.roller, sizes.half_width, recess, sizes.rim, flat)
    whole, halves = is_whole(assembly, sizes), list[float]()
    around = reliefs(assembly)
    # arcs end where the motions do
    if whole and assembly.mechanism.spec.size.relief != "arc":
        around = widened(assembly, sizes, mouths)
    for start, end in sectors(around):
        halves.append(0.5 * (end - start))
    if not whole:
        with suppress(GenevaError):  # the check of the parts reports the error
            for arc in cut_arcs(drawn(assembly, sizes).crank, lock, 0.0, SAME_LENGTH * L):
                halves.append(0.5 * abs(arc.sweep))
    edge, corners = assembly.full.spec.size.lock_edge_mm or 0.0, [*chain(*mouths.values())]
    first = corners[0] if flat else sizes.rim
    half = min(halves, default=math.nan)
    out = Lock(L, assembly.sign, lock, recess, first, half, edge)
    if max(corners) - min(corners) < SAME_LENGTH * L:
        return out
    near, far = abs(L - recess), L + recess
    tried = [out._replace(corner=r) for r in sorted(corners) if near < r < far]
    return loosest(tried) if tried else out


def cut_arcs(contours: Iterable[Contour], radius: float, away: float, near: float) -> Iterator[Arc]:
    """Yield the arcs of a radius whose centres are ``away`` from the axis, both within ``near``."""
    for contour in contours:
        for arc in contour.segments:
            if not isinstance(arc, Arc) or abs(arc.radius - radius) >= near:
                continue
            if abs(math.hypot(*arc.centre) - away) < near:
                yield arc
