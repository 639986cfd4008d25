"""Outlines that contain the true ones, drawn without tracing the wall of a curved slot.

Play of the wheel in these outlines is play in the true parts, which have less material. It is
computed in a fraction of the time. A curved slot lacks here only what the roller removes before
entry, while the wheel still rests. The locking sectors lack only what the recesses' corners remove
from their edges; no slot moves these corners.
"""

from __future__ import annotations

import math
from cmath import phase

import numpy as np

from geneva_cli.collisions.gaps import Gaps, swept_deg
from geneva_cli.curves.shapes import (
    Contour,
    Line,
    Point,
    Segment,
    about,
    backwards,
    closed,
    joined,
)
from geneva_cli.errors import GenevaError
from geneva_cli.kinematics.engagement import Engagement
from geneva_cli.layout.assembly import Assembly
from geneva_cli.layout.plain_sizes import Sizes
from geneva_cli.layout.reliefs import sectors
from geneva_cli.layout.roller_paths import rest
from geneva_cli.numerics.arrays import scalar
from geneva_cli.numerics.tolerances import CLEARLY, SAME_LENGTH
from geneva_cli.outlines.crank import is_whole
from geneva_cli.outlines.locking_rings import LAYER as DISC
from geneva_cli.outlines.locking_rings import beyond, polar_points, widest
from geneva_cli.outlines.outlines import CURVED, SWEPT_DEG, Outlines, slot_walls
from geneva_cli.outlines.relief_overlap import corners
from geneva_cli.outlines.walls.curved import mirrored
from geneva_cli.outlines.wheel import LAYER, opening, wheel_contour


def bounding_outlines(assembly: Assembly, sizes: Sizes) -> Outlines | None:
    """Return the bounding outlines; None for machines to which they do not apply.

    They apply to external wheels with a law whose rim extends beyond the crank's axis, so that
    sectors are left of the locking disc. Raises GenevaError where the sizes leave no parts.
    """
    lawful = assembly.mechanism.law is not None and sizes.lock and sizes.horn > 0.0
    if not lawful or assembly.sign < 0.0 or is_whole(assembly, sizes):
        return None
    walls = {one: _walls(assembly, sizes, one) for one in assembly.kinds}
    wheel, crank = wheel_contour(assembly, sizes, walls), _sectors(assembly, sizes)
    gaps = Gaps(assembly, sizes, wheel, crank)
    close = SAME_LENGTH * assembly.L  # no more than that of the true parts
    return Outlines(assembly, sizes, walls, wheel, crank, "sector", gaps, close, close)


def _walls(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> Contour:
    """Return the walls of a slot, from one corner of its mouth to the other.

    A straight slot has its own. A curved one has those of the area that the roller removes from the
    resting wheel.
    """
    if not engagement.slot.curved:
        return slot_walls(assembly, sizes, engagement, CURVED * assembly.L)
    x, y = (assembly.L * scalar(c.c[0]) for c in engagement.slot(engagement.entry_deg, 0))
    place, axis, w = complex(x, y), complex(*rest(assembly, engagement, -1.0)), sizes.half_width
    radius, start, ahead = abs(place - axis), phase(place - axis), phase(-axis)
    turned = math.remainder(start - ahead, math.tau)
    out = math.copysign(1.0, turned)  # sense from the slot outwards, about the crank's axis
    inwards, half = start - out * 0.5 * math.pi, opening(abs(place), w, sizes.rim)
    ends, arcs = [], []
    for side in (-1.0, 1.0):  # the wall that faces the crank's axis, and the other
        far = radius + side * w
        cosine = (assembly.L**2 + far**2 - sizes.rim**2) / (2.0 * assembly.L * far)
        if -1.0 < cosine < math.cos(turned):  # the roller comes over the rim on its circle
            arcs.append((far, ahead + out * math.acos(cosine)))
            ends.append(side * out * 0.5 * math.pi)
        else:
            side_end = phase(-place) + side * out * half - inwards
            arcs.append((far, start))
            ends.append(math.remainder(side_end, math.tau))
    (near, begin), (far, end) = arcs
    coming = about((axis.real, axis.imag), near, begin, start - begin)
    cap = about((x, y), w, inwards + ends[0], ends[1] - ends[0])
    going = about((axis.real, axis.imag), far, start, end - start)
    pieces: list[Segment] = [coming, cap, going]
    if engagement.mirrored:  # the roller removes the mirror image as it leaves
        other = _direction(going.end)
        if other * axis.imag > 0.0:
            between = about((0.0, 0.0), sizes.rim, other, -2.0 * other)
            pieces = [*pieces, between, *map(mirrored, reversed(pieces))]
        elif abs(y) < w:  # up to the slot's axis, where the two cross
            cut = phase(complex(-math.sqrt(w * w - y * y), -y)) - inwards
            cap = about((x, y), w, inwards + ends[0], math.remainder(cut, math.tau) - ends[0])
            pieces = [coming, cap, mirrored(cap), mirrored(coming)]
    walls = Contour(
        LAYER, joined(piece for piece in pieces if piece.start != piece.end), closed=False
    )
    rises = _direction(walls.segments[0].start) < _direction(walls.segments[-1].end)
    return walls if rises else backwards(walls)


def _direction(p: Point) -> float:
    return math.atan2(p[1], p[0])


def _sectors(assembly: Assembly, sizes: Sizes) -> list[Contour]:
    """Return the locking sectors down to the crank's axis, at least as wide as those of ``rings``.

    Raises GenevaError where nothing is left of one.
    """
    at = [swept_deg(assembly, i, SWEPT_DEG) for i in range(len(assembly.motions))]
    x, y = np.concatenate([corners(assembly, sizes, each) for each in at], axis=1)
    within = CLEARLY * np.hypot(x, y) < sizes.lock
    x, y = x[within], y[within]

    def sector(start: float, end: float) -> Contour:
        middle = 0.5 * (end + start)
        wheel = polar_points(x, y, middle)
        half = widest(0.5 * (end - start), lambda half: not beyond(sizes, wheel, half))
        if half is None:
            raise GenevaError("nothing is left of a locking sector", ("size", "lock_radius_mm"))
        outer = about((0.0, 0.0), sizes.lock, middle - half, 2.0 * half)
        edges = Line(outer.end, (0.0, 0.0)), Line((0.0, 0.0), outer.start)
        return closed(DISC, [outer, *edges])

    return [sector(*span) for span in sectors(assembly)]
