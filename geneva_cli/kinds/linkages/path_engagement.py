"""The engagement of the wheel that a linkage's path can drive, for one design or a batch."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.kinds.linkages.link_path import LinkPath, LinkRate, LinkReactions, PointDisplacement
from geneva_cli.kinds.linkages.path_wheels import chosen, solved_wheels
from geneva_cli.kinds.linkages.tangent_pairs import DOUBLE_ROOT_SLOPE, displaced, newton, residual
from geneva_cli.motion.engagement import Anchor, Engagement, Vector
from geneva_cli.motion.path_and_slot import AnchoredPath, RadialSlot, StraightSlotMotion
from geneva_cli.motion.wheels.poses import HalfStep
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, library, parameter
from geneva_cli.numerics.jet import Jet, Number, sine_versine


def solve(path: LinkPath, step: HalfStep, wanted: float | None) -> tuple[Engagement, float]:
    """Return the engagement of a path's wheel, and the centre distance in mm.

    It is the gentlest wheel, or the one whose entry is nearest to the crank angle ``wanted``
    (radians). Designs without a wheel are refused.
    """
    numbers = (*path.numbers, step.b, 0.0 if wanted is None else wanted)
    shape = np.broadcast_shapes((1, 1), *(np.shape(x) for x in numbers))
    half = np.broadcast_to(np.asarray(step.b, dtype=float), shape)
    goal = None if wanted is None else np.broadcast_to(np.asarray(wanted, dtype=float), shape)
    single = not any(np.ndim(x) for x in numbers)
    found = np.full((3, *shape), np.nan)
    for start in range(0, len(half), 8192):  # designs searched together: each takes 10 kB
        part = np.arange(start, min(start + 8192, len(half)))
        some = path.of(part)
        best = chosen(some, solved_wheels(some, half[part]), goal if goal is None else goal[part])
        found[:, part[best.which], 0] = *best.phi.T, best.sense
    entry, exit_, sense = found
    none, z = entry != entry, step.q
    refuse(
        bool(none.any()) if single else none,
        lambda: GenevaError(
            f"no wheel of z = {z} slots fits this path: change the linkage, or z. The path needs "
            f"two equally long tangents that meet at {360.0 / z:.6g} deg, with the roller nearer "
            "to that point only between them",
            ("drive", "kind"),
        ),
    )
    with np.errstate(all="ignore"):
        return _engagement(path, step, entry, exit_, sense)


def _engagement(
    path: LinkPath, step: HalfStep, entry: Array, exit_: Array, sense: Array
) -> tuple[Engagement, float]:
    """Engagement from crank angles at entry and exit in radians, and the centre distance."""
    single = not any(np.ndim(x) for x in (*path.numbers, step.b)) and len(entry) == 1

    def plain(x: Array) -> float:
        return parameter(x.item() if single else x)

    middle, ends = _polished(path, step.b, np.hstack((entry, exit_)), sense)
    half, late = (plain(0.5 * (ends[:, 1:] + k * ends[:, :1])) for k in (-1.0, 1.0))
    # from the roller's place in the middle: the roller at both ends, its tangents, and the centre
    at = displaced(path, middle, ends)
    (p, q), (t, u) = (np.hsplit(z, 2) for z in (at.p, at.t))
    rho = np.abs(q - p) / np.abs(t + u)
    centre = 0.5 * ((p + rho * t) + (q - rho * u))
    x, y = path.at(middle, 0)
    axis = -(x.c[0] + 1j * y.c[0] + centre)  # from the wheel's centre to the crank's axis
    L, s = plain(np.abs(axis)), plain(sense)
    half_way = (p - centre) / np.abs(p - centre) + (q - centre) / np.abs(q - centre)
    turn, ahead = (plain(sense * np.angle(line.conj() * -centre)) for line in (half_way, axis))
    anchors = []
    for end, wheel, angle, ray in (
        (-1.0, -step.b, middle + ends[:, :1], p - centre),
        (0.0, turn, middle, -centre),
        (1.0, step.b, middle + ends[:, 1:], q - centre),
    ):
        move, input_deg = path.about(plain(angle)), 0.0 - late / DEGREE
        ux, uy = plain(ray.real), plain(ray.imag)
        if end:  # the ray is the pin's velocity, so that none of it is across the ray
            input_deg = end * half / DEGREE
            ux, uy = (end * parameter(v.c[1]) for v in move(*sine_versine(Jet.variable(0.0, 1))))
        along_ray = _AlongRay(move, ux, uy, 1.0 / (library(ux).hypot(ux, uy) * L), s)
        anchors.append(Anchor(input_deg, wheel, plain(np.abs(ray)) / L, along_ray))
    anchored = AnchoredPath(tuple(anchors), ahead)
    body = LinkRate(path, plain(middle), s)
    reactions = LinkReactions(*body, L, plain(axis.real) / L, plain(axis.imag) / L)
    motion = StraightSlotMotion(anchored, step.b, mirrored=False)
    return Engagement(0.0, anchored, RadialSlot(anchored), motion, body, reactions, -s), L


def _polished(path: LinkPath, b: float, ends: Array, sense: Array) -> tuple[Array, Array]:
    """Crank angle in the middle of a motion, (n, 1), and of entry and exit from there, (n, 2).

    A roller that moves much more slowly than its links has few digits in its place at a crank
    angle, and in a short motion the angle itself has few. Its displacement has them all.
    """
    middle = 0.5 * (ends[:, :1] + ends[:, 1:])
    ends, half = ends - middle, np.broadcast_to(b, sense.shape)[:, 0]
    for _ in range(2):
        at = displaced(path, middle, ends)
        rest = residual(at, half, sense[:, 0])
        # a step towards a double root would only be rounding
        steep = np.abs(rest.det) >= DOUBLE_ROOT_SLOPE * np.abs(rest.by_exit)
        ends = ends + np.where(steep[:, None], newton(at, rest), 0.0)
    moved = middle + 0.5 * (ends[:, :1] + ends[:, 1:])
    return moved, ends - (moved - middle)


class _AlongRay(NamedTuple):
    """The pin's displacement along a ray (x, y) and across it, positive with the wheel."""

    displacement: PointDisplacement
    x: float
    y: float
    scale: float
    sense: float

    def __call__(self, tau: Number, order: int) -> Vector:
        x, y = self.displacement(*sine_versine(Jet.variable(tau, order)))
        along = (x * self.x + y * self.y) * self.scale
        across = (y * self.x - x * self.y) * (self.sense * self.scale)
        return along, across
