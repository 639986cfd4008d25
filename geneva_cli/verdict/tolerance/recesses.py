"""The locks of a wheel, from its parts: corners of its recesses, and arcs of its disc."""

from __future__ import annotations

import math

from geneva_cli.analysis.locking import Lock
from geneva_cli.analysis.sphere_locking import SphereLock
from geneva_cli.curves.shapes import Arc, Contour
from geneva_cli.outlines.outlines import Outlines
from geneva_cli.parts.sphere.shells import Shells

SAME = 1e-6  # fraction of the centre distance, or radians: nearer radii and angles are equal


def locks(outlines: Outlines) -> list[Lock]:
    """Each corner of a recess with each locking arc of the crank; none without a locking disc."""
    size, assembly = outlines.sizes, outlines.assembly
    if not outlines.crank:
        return []
    near = SAME * assembly.L
    corners = {
        round(math.hypot(*end) / near): math.hypot(*end)
        for arc in _arcs(outlines.wheel)
        if abs(math.hypot(*arc.centre) - assembly.L) < near and abs(arc.radius - size.recess) < near
        for end in (arc.start, arc.end)
    }
    halves = {
        round(arc.sweep / SAME): 0.5 * abs(arc.sweep)
        for part in outlines.crank
        for arc in _arcs(part)
        if math.hypot(*arc.centre) < near and abs(arc.radius - size.lock) < near
    }
    return [
        Lock(assembly.L, assembly.sign, size.lock, size.recess, corner, half)
        for corner in corners.values()
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


def _arcs(contour: Contour) -> list[Arc]:
    return [one for one in contour.segments if isinstance(one, Arc)]
