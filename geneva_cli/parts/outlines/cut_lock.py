"""The lock of a machine as its wheel and crank are cut."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.shapes import Arc, Contour
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.outlines.reliefs import is_whole
from geneva_cli.parts.sizes.plain_sizes import Sizes
from geneva_cli.parts.sizes.stressed import lock_of


def cut_lock(assembly: Assembly, sizes: Sizes) -> Lock:
    """Return the lock: the narrowest arc of the crank, and the corner that leaves the most play.

    Beyond the crank's axis, as an internal wheel reaches, the wheel leaves less than a sector
    between two reliefs.
    """
    lock = lock_of(assembly, sizes)
    if is_whole(assembly, sizes):
        return lock
    from geneva_cli.parts.outlines.cut_outlines import drawn  # which few locks need

    try:
        parts = drawn(assembly, sizes)
    except GenevaError:  # the check of the parts reports the error
        return lock
    locking = cut_arcs(parts.crank, lock.lock, 0.0, SAME_LENGTH * assembly.L)
    return lock_of(assembly, sizes, [0.5 * abs(arc.sweep) for arc in locking])


def cut_arcs(contours: Iterable[Contour], radius: float, away: float, near: float) -> Iterator[Arc]:
    """Yield the arcs of a radius whose centres are ``away`` from the axis, both within ``near``."""
    pieces = (piece for contour in contours for piece in contour.segments)
    for arc in (piece for piece in pieces if isinstance(piece, Arc)):
        if abs(arc.radius - radius) < near and abs(math.hypot(*arc.centre) - away) < near:
            yield arc
