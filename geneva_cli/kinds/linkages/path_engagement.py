"""The engagement of the wheel that a linkage's path can drive, for one design or a batch."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, refuse
from geneva_cli.kinds.linkages.link_path import (
    LinkPath,
    LinkRate,
    LinkReactions,
    PointDisplacement,
)
from geneva_cli.kinds.linkages.path_wheels import chosen, solved_wheels
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.motion.path_and_slot import AnchoredPath, RadialSlot, StraightSlotMotion
from geneva_cli.motion.wheels.poses import HalfStep
from geneva_cli.numerics.arrays import Array, Complex, library, parameter
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
    none = entry != entry
    refuse(bool(none.any()) if single else none, lambda: _none_fits(step.q))
    with np.errstate(all="ignore"):
        return _engagement(path, step, entry, exit_, sense)


def _none_fits(z: int) -> GenevaError:
    """Error for a path that can drive no wheel of z slots."""
    return GenevaError(
        f"no wheel of z = {z} slots fits this path: change the linkage, or z. The path needs two "
        f"equally long tangents that meet at {360.0 / z:.6g} deg, with the roller nearer to that "
        "point only between them",
        ("drive", "kind"),
    )


def _engagement(
    path: LinkPath, step: HalfStep, entry: Array, exit_: Array, sense: Array
) -> tuple[Engagement, float]:
    """Engagement from crank angles at entry and exit in radians, and the centre distance."""
    angles = entry, 0.5 * (entry + exit_), exit_
    (p, t), (place, _), (q, u) = (_point(path, phi) for phi in angles)
    rho = np.abs(q - p) / np.abs(t + u)
    centre = 0.5 * ((p + rho * t) + (q - rho * u))
    rays = [at - centre for at in (p, place, q)]
    half_way = rays[0] / np.abs(rays[0]) + rays[2] / np.abs(rays[2])
    turn, ahead = (sense * np.angle(rays[1] * line.conj()) for line in (half_way, -centre))
    half_deg = np.degrees(0.5 * (exit_ - entry))
    numbers = [sense, angles[1], half_deg, turn, ahead, centre.real, centre.imag, np.abs(centre)]
    numbers += [*angles, *(part for ray in rays for part in (ray.real, ray.imag, np.abs(ray)))]
    single = not any(np.ndim(x) for x in (*path.numbers, step.b)) and len(entry) == 1
    s, middle, half, back, front, x, y, L, *rest = (
        parameter(n.item() if single else n) for n in numbers
    )
    anchors = []
    for i, (end, wheel) in enumerate(zip((-1.0, 0.0, 1.0), (-step.b, back, step.b), strict=True)):
        along_x, along_y, far = rest[3 + 3 * i : 6 + 3 * i]
        move = _along_ray(path.about(rest[i]), (along_x, along_y), s, L, end)
        anchors.append(Anchor(end * half, wheel, far / L, move))
    anchored = AnchoredPath(tuple(anchors), front)
    body = LinkRate(path, middle, s)
    reactions = LinkReactions(*body, L, -x / L, -y / L)
    motion = StraightSlotMotion(anchored, step.b, mirrored=False)
    return Engagement(0.0, anchored, RadialSlot(anchored), motion, body, reactions, -s), L


def _point(path: LinkPath, phi: Array) -> tuple[Complex, Complex]:
    """Position and unit tangent at crank angles (n, 1), as complex numbers."""
    x, y = path.at(phi, 1)
    (p, v) = (np.asarray(a) + 1j * np.asarray(b) for a, b in zip(x.c, y.c, strict=True))
    return p, v / np.abs(v)


class AlongRay(NamedTuple):
    """The pin's displacement along a ray (x, y) and across it, positive with the wheel."""

    displacement: PointDisplacement
    x: float
    y: float
    scale: float
    sense: float

    def __call__(self, tau: Number, order: int) -> tuple[Jet, Jet]:
        """Displacement after ``tau`` radians of crank rotation."""
        x, y = self.displacement(*sine_versine(Jet.variable(tau, order)))
        along = (x * self.x + y * self.y) * self.scale
        across = (y * self.x - x * self.y) * (self.sense * self.scale)
        return along, across


def _along_ray(
    displacement: PointDisplacement, ray: tuple[float, float], sense: float, L: float, end: float
) -> AlongRay:
    """Displacement along and across a ray; at an end (-1, 1) the ray is the pin's own direction.

    There the ray is the velocity of ``displacement`` itself, so that the velocity across it is
    exactly 0.
    """
    ux, uy = ray
    if end:
        x, y = displacement(*sine_versine(Jet.variable(0.0, 1)))
        ux, uy = end * parameter(x.c[1]), end * parameter(y.c[1])
    return AlongRay(displacement, ux, uy, 1.0 / (library(ux).hypot(ux, uy) * L), sense)
