"""The wheel that a linkage's path can drive, and its engagement, for one design or a batch.

From entry to exit the roller must turn the wheel one way, nearer to its centre than at both ends,
and be farther away on the way back. Shorter excursions than samples show are left to the gaps.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import refuse_text
from geneva_cli.kinds.linkages.link_path import LinkPath, LinkRate, LinkReactions, PointDisplacement
from geneva_cli.kinds.linkages.tangent_pairs import (
    SAME_ENTRY,
    Pairs,
    complex_of,
    pairs,
    points,
    residual,
    sampled,
)
from geneva_cli.motion.engagement import Anchor, Engagement, Vector
from geneva_cli.motion.path_and_slot import AnchoredPath, RadialSlot, StraightSlotMotion
from geneva_cli.motion.wheels.classic import HalfStep
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Complex, Mask, Whole, library, mapped, parameter
from geneva_cli.numerics.jet import Jet, Number, sine_versine

SAME_PEAK = 1e-8  # fraction by which two wheels' peak velocities may differ and count as equal
EVEN = 96  # samples of a motion, and twice as many of the way back


class PathWheels(NamedTuple):
    """Wheels of designs: (wheels,), and columns (wheels, 1) of centre and distance."""

    which: Whole
    phi: Array  # crank angles at entry and exit, in two columns
    sense: Array  # 1 if the wheel turns counterclockwise on the path's axes, or -1
    centre: Complex  # mm, on the path's axes
    distance: Array  # from the centre to entry and exit, mm
    peak: Array  # greatest velocity

    def velocity(self, p: Complex, v: Complex) -> tuple[Array, Mask]:
        """The velocity at places (wheels, n), and where the roller is nearer than at both ends."""
        ray = p - self.centre
        near = np.abs(ray)
        return self.sense[:, None] * (ray.conj() * v).imag / near**2, near < self.distance


def solved_wheels(path: LinkPath, b: Array) -> PathWheels:
    """All wheels of designs with half index angles b, (n, 1)."""
    with np.errstate(all="ignore"):
        samples = sampled(path, len(b))
        return driven(path, pairs(path, samples, b), samples)


def driven(path: LinkPath, found: Pairs, samples: tuple[Array, Complex]) -> PathWheels:
    """The wheels of pairs whose roller stays in its slot, at samples of the path and even ones."""
    which, phi, sense = found
    wheels = PathWheels(*found, *_centre(points(path.of(which), phi)), sense)
    motion, since = np.diff(phi), (samples[0][which] - phi[:, :1]) % math.tau
    end = np.minimum(np.abs(since - motion), math.pi - np.abs(since - math.pi)) < SAME_ENTRY
    velocity, near = wheels.velocity(*samples[1][:2, which])
    good = np.where(since < motion, near & (velocity > 0.0), ~near) | end
    inside = good.all(axis=1)
    wheels = mapped(lambda column: column[inside], wheels)
    (some, phi), even = (path.of(wheels.which), wheels.phi), np.arange(1, 2 * EVEN) / (2 * EVEN)
    motion = np.diff(phi)
    velocity, near = wheels.velocity(*points(some, phi[:, :1] + motion * even[1::2], 1))
    back = points(some, phi[:, 1:] + (math.tau - motion) * even, 0)[0]
    good = near & (velocity > 0.0)
    kept = good.all(axis=1) & (np.abs(back - wheels.centre) > wheels.distance).all(axis=1)
    return mapped(lambda column: column[kept], wheels._replace(peak=top(velocity)))


def _centre(ends: Complex) -> tuple[Complex, Array]:
    """The wheel's centre, and its distance from entry and exit, (n, 1) each."""
    (p, q), (v, w) = (np.hsplit(each, 2) for each in ends[:2])
    t, u = v / np.abs(v), w / np.abs(w)
    rho = np.abs(q - p) / np.abs(t + u)
    return 0.5 * ((p + rho * t) + (q - rho * u)), rho


def top(values: Array) -> Array:
    """The greatest of each row, from the parabola through it and its neighbours."""
    rows = np.arange(len(values))
    at = np.clip(values.argmax(axis=1), 1, values.shape[1] - 2)
    low, middle, high = (values[rows, at + i] for i in (-1, 0, 1))
    bend, slope = low - 2.0 * middle + high, 0.5 * (high - low)
    inside = (bend < 0.0) & (middle >= low) & (middle >= high)
    vertex = middle - slope * slope / np.where(inside, 2.0 * bend, 1.0)
    peaks: Array = np.where(inside, vertex, values.max(axis=1))
    return peaks


def chosen(wheels: PathWheels, wanted: Array | None = None) -> Whole:
    """Numbers of one wheel of each design that has any, in the order of the designs.

    It has the least peak velocity, or the entry nearest to that ``wanted``, radians (n, 1). Among
    equal wheels, as on a symmetric path, it is the one with the first entry.
    """
    which, entry, cost = wheels.which, wheels.phi[:, 0], wheels.peak
    if wanted is not None:
        off = entry - wanted[which, 0]
        cost = np.abs(off - math.tau * np.round(off / math.tau))
    least = np.full(int(which.max(initial=-1)) + 1, np.inf)
    np.minimum.at(least, which, cost)
    tied = np.flatnonzero(cost <= least[which] * (1.0 + SAME_PEAK))
    order = tied[np.lexsort((entry[tied] % math.tau, which[tied]))]
    return order[np.append(True, np.diff(which[order]) != 0)[: len(order)]]


def solve(path: LinkPath, step: HalfStep, wanted: float | None) -> tuple[Engagement, float]:
    """Return the engagement of a path's wheel, and the centre distance in mm."""
    numbers = step.b, 0.0 if wanted is None else wanted, *path.numbers
    single = not any(np.ndim(x) for x in numbers)
    half, goal, *_ = np.broadcast_arrays(*numbers, np.zeros((1, 1)))
    found = np.full((3, *half.shape), np.nan)
    for start in range(0, len(half), 256):  # designs searched together, in the processor's cache
        part = np.arange(start, min(start + 256, len(half)))
        wheels = solved_wheels(path.of(part), half[part])
        best = chosen(wheels, None if wanted is None else goal[part])
        found[:, part[wheels.which[best]], 0] = *wheels.phi[best].T, wheels.sense[best]
    entry, exit_, sense = found
    none = entry != entry
    text = "no wheel of z = {z} slots fits this path, which needs two equally long tangents that "
    text += "meet at {angle:.6g} deg: change the linkage, or z"
    where, key = bool(none.any()) if single else none, ("drive", "kind")
    refuse_text(where, key, text, z=step.q, angle=360.0 / step.q)
    with np.errstate(all="ignore"):
        return _engagement(path, step, np.hstack((entry, exit_)), sense, single)


def _engagement(
    path: LinkPath, step: HalfStep, ends: Array, sense: Array, single: bool
) -> tuple[Engagement, float]:
    """Engagement from crank angles at entry and exit in radians, and the centre distance."""

    def plain(x: Array) -> float:
        return parameter(x.item() if single else x)

    # A slow roller's place has few digits at a crank angle, and so has the angle in a short motion.
    # The displacement from the place in the middle of the motion has them all.
    middle = 0.5 * (ends[:, :1] + ends[:, 1:])
    ends, b = ends - middle, np.broadcast_to(step.b, sense.shape)[:, 0]
    move = path.about(parameter(middle))
    for _ in range(2):
        rest = residual(complex_of(*move(*sine_versine(Jet.variable(ends, 2)))), b, sense[:, 0])
        ends = ends + np.where(rest.double[:, None], 0.0, rest.step)
    moved = middle + 0.5 * (ends[:, :1] + ends[:, 1:])
    middle, ends = moved, ends - (moved - middle)
    half, late = (plain(0.5 * (ends[:, 1:] + k * ends[:, :1])) for k in (-1.0, 1.0))
    # from the roller's place in the middle: the roller at both ends, and the centre
    at = complex_of(*path.about(parameter(middle))(*sine_versine(Jet.variable(ends, 2))))
    centre, _ = _centre(at)
    x, y = path.at(middle, 0)
    axis = -(x.c[0] + 1j * y.c[0] + centre)  # from the wheel's centre to the crank's axis
    L, s, rays = plain(np.abs(axis)), plain(sense), at[0] - centre
    half_way = (rays / np.abs(rays)).sum(axis=1, keepdims=True)
    turn, ahead = (plain(sense * np.angle(line.conj() * -centre)) for line in (half_way, axis))
    anchors = []
    for end, wheel, angle, ray in (
        (-1.0, -step.b, middle + ends[:, :1], rays[:, :1]),
        (0.0, turn, middle, -centre),
        (1.0, step.b, middle + ends[:, 1:], rays[:, 1:]),
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
