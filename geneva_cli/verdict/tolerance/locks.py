"""The locks of parts as they are cut, whose play the tolerances change."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

from geneva_cli.kinds.spherical.locking import SphereLock
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.kinds.spherical.shells import Shells
from geneva_cli.loads.tolerance.locking import Lock
from geneva_cli.parts.outlines.cut_lock import cut_arcs
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.parts import Parts

if TYPE_CHECKING:
    from geneva_cli.kinds.spherical.ball import Ball

CutLock: TypeAlias = Lock | SphereLock
SAME = 1e-6  # fraction of the centre distance, or radians: nearer radii and angles are equal


def ball_of(parts: Parts) -> Ball | None:
    """The sizes of shells of a sphere; None for plates."""
    return parts.ball if isinstance(parts, SphereParts) else None


def locks_of(parts: Parts) -> Sequence[CutLock]:
    """The locks of plates or shells, one for each shape; none without a locking disc."""
    if isinstance(parts, SphereParts):
        return sphere_locks(parts.shells)
    return flat_locks(parts.outlines)


def flat_locks(outlines: Outlines) -> list[Lock]:
    """Each corner of a recess with each locking arc of the crank; none without a locking disc."""
    size, assembly = outlines.sizes, outlines.assembly
    if not outlines.crank:
        return []
    near = SAME * assembly.L
    radii = {
        round(math.hypot(*end) / near): math.hypot(*end)
        for arc in cut_arcs([outlines.wheel], size.recess, assembly.L, near)
        for end in (arc.start, arc.end)
    }
    halves = {
        round(arc.sweep / SAME): 0.5 * abs(arc.sweep)
        for arc in cut_arcs(outlines.crank, size.lock, 0.0, near)
    }
    return [
        Lock(assembly.L, assembly.sign, size.lock, size.recess, radius, half)
        for radius in radii.values()
        for half in halves.values()
        if half > SAME
    ]


def sphere_locks(shells: Shells) -> list[SphereLock]:
    """A recess with each locking sector of a spherical crank; empty without one."""
    ball = shells.ball
    halves = {
        round(edge.sweep / SAME): 0.5 * edge.sweep
        for region in shells.crank
        for edge in region.boundary[:1]  # it begins with the locking edge
    }
    return [
        SphereLock(ball.radius_mm, ball.axes, ball.lock, ball.recess, ball.rim, half)
        for half in halves.values()
    ]
