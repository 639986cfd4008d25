"""The wheel that a linkage's path can drive, and its engagement, for one design or a batch.

From entry to exit the roller must turn the wheel one way, nearer to its centre than at both ends,
and be farther away on the way back. Shorter excursions than samples show are left to the gaps.
"""

from __future__ import annotations

import math
from typing import NamedTuple, cast

import numpy as np

from geneva_cli.errors import refuse_text
from geneva_cli.kinds.linkages import tangent_pairs as tangents
from geneva_cli.kinds.linkages.link_path import LinkPath, LinkRate, LinkReactions
from geneva_cli.motion.engagement import Anchor, Engagement
from geneva_cli.motion.path_and_slot import AnchoredPath, RadialSlot, StraightSlotMotion
from geneva_cli.motion.wheels.classic import HalfStep
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array, Complex, blocks, library, parameter, record_taken

SAME_PEAK = 1e-8  # fraction by which two wheels' peak velocities may differ and count as equal
EVEN = 96  # samples of a motion, and twice as many of the way back


class PathWheels(NamedTuple):
    """Wheels of designs, (m,) each."""

    pair: tangents.Pairs
    centre: Complex  # mm, on the path's axes
    distance: Array  # from the centre to entry and exit, mm


def driven(path: LinkPath, found: tangents.Pairs) -> tuple[PathWheels, Array]:
    """The wheels of pairs that the roller turns one way within its slot; their peak velocities."""
    some, (entry, exit_) = path.of(found.which), found.phi
    ends = tangents.points_at(some, found.phi)
    wheels = PathWheels(found, *centre_of(ends))
    place, velocity = tangents.points(some, _even(entry, exit_ - entry, EVEN), 1)
    ray = place - wheels.centre
    far, turns = np.abs(ray), found.sense * (ray.conj() * velocity).imag
    moves = (far < wheels.distance) & (turns > 0.0)
    # next to both ends: the tangent turns against the wheel, or not at all in a double root
    leads = found.sense * tangents.turning_rate(ends) < 1e-9
    kept = np.logical_and(moves.all(axis=0), leads.all(axis=0))
    return record_taken(wheels, kept), top((turns / far**2).T)[kept]


def passed(path: LinkPath, wheels: PathWheels) -> tangents.Pairs:
    """The pairs of wheels that the roller does not reach on its way back."""
    entry, exit_ = wheels.pair.phi
    back = _even(exit_, math.tau - (exit_ - entry), 2 * EVEN)
    *_, place = path.of(wheels.pair.which).joints(back)
    return record_taken(wheels.pair, (np.abs(place - wheels.centre) > wheels.distance).all(axis=0))


def _even(phi: Array, turn: Array, count: int) -> Complex:
    """Unit vectors at even crank angles within a turn from ``phi`` on, (count - 1, m)."""
    factors = np.empty((count - 1, len(phi)), dtype=complex)
    factors[0], factors[1:] = np.exp(1j * (phi + turn / count)), np.exp(1j * turn / count)
    np.cumprod(factors, axis=0, out=factors)
    return factors


def centre_of(ends: Complex) -> tuple[Complex, Array]:
    """The wheel's centre, and its distance from entry and exit (m,), from points (3, 2, m)."""
    (p, q), (t, u) = ends[0], ends[1] / np.abs(ends[1])
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
    return np.asarray(np.where(inside, vertex, values.max(axis=1)))


def chosen(path: LinkPath, b: Array, wanted: Array | None = None) -> Array:
    """Crank angles at entry and exit, and the sense, of one wheel of each design: (3, n), or NaN.

    It has the least peak velocity, or the entry nearest to that ``wanted``, radians (n,). Among
    equal wheels, as on a symmetric path, it is the one with the first entry.
    """
    wheels, cost = driven(path, tangents.pairs(path, tangents.sampled(path, len(b)), b))
    which, (entry, _), _ = wheels.pair
    if wanted is not None:
        off = entry - wanted[which]
        cost = np.abs(off - math.tau * np.round(off / math.tau))
    left = np.lexsort((entry, np.round(np.log(cost) / SAME_PEAK), which))
    out = np.full((3, len(b)), np.nan)
    while len(left):
        first = np.diff(which[left], prepend=-1) != 0
        best = passed(path, record_taken(wheels, left[first]))
        out[:, best.which] = *best.phi, best.sense
        left = left[~first & np.isnan(out[0, which[left]])]
    return out


def solve(path: LinkPath, step: HalfStep, wanted: float | None) -> tuple[Engagement, float]:
    """Return the engagement of a path's wheel, and the centre distance in mm."""
    numbers = step.b, 0.0 if wanted is None else wanted, *path.numbers
    single = not any(np.ndim(x) for x in numbers)
    half, goal, *_ = (x[:, 0] for x in np.broadcast_arrays(*numbers, np.zeros((1, 1))))
    found = np.empty((3, len(half)))
    with np.errstate(all="ignore"):
        for part in blocks(len(half), 512):  # designs searched together, in the processor's cache
            near = None if wanted is None else goal[part]
            found[:, part] = chosen(path.of((part, 0)), half[part], near)
    none = np.isnan(found[2:].T)
    text = "no wheel of z = {z} slots fits this path, which needs two equally long tangents that "
    text += "meet at {angle:.6g} deg: change the linkage, or z"
    where, key = bool(none.any()) if single else none, ("drive", "kind")
    refuse_text(where, key, text, z=step.q, angle=360.0 / step.q)
    with np.errstate(all="ignore"):
        return _engagement(path, step, found[:2], found[2], single)


def _engagement(
    path: LinkPath, step: HalfStep, ends: Array, sense: Array, single: bool
) -> tuple[Engagement, float]:
    """Engagement from crank angles at entry and exit (2, n), radians, and the centre distance."""

    def plain(x: Array | Complex) -> float:
        return cast("float", x.item() if single else x[:, None])

    # The roller may be much slower than its links: displacements from one place keep its digits.
    flat, middle, index = path.of((slice(None), 0)), ends.mean(axis=0), np.ravel(step.b)
    ends, crank = ends - middle, np.exp(1j * middle)
    move = flat.about(crank)
    x, y = (np.array(one.derivatives()) for one in move(ends, 2))
    at = x + 1j * y
    rest = tangents.residual(at, np.exp(2j * sense * index))
    last = np.where(rest.double, 0.0, rest.step)
    ends, at[:2] = ends + last, at[:2] + last * at[1:]
    half, late = (plain(0.5 * (ends[1] + k * ends[0])) for k in (-1.0, 1.0))
    # from the roller's place in the middle: the roller at both ends, and the centre
    centre, _ = centre_of(at)
    axis = -(tangents.points_at(flat, middle)[0] + centre)  # from the wheel's to the crank's
    L, s, rays = plain(np.abs(axis)), plain(sense), at[0] - centre
    half_way = (rays / np.abs(rays)).sum(axis=0)
    turn, ahead = (plain(sense * np.angle(line.conj() * -centre)) for line in (half_way, axis))
    anchors = []
    for end, wheel, tau, v, ray in (
        (-1.0, -step.b, ends[0], at[1, 0], rays[0]),
        (0.0, turn, 0.0 * middle, move.velocity, -centre),
        (1.0, step.b, ends[1], at[1, 1], rays[1]),
    ):
        moved = path.about(plain(crank * np.exp(1j * tau)), plain(v))
        ux, uy, input_deg = plain(ray.real), plain(ray.imag), 0.0 - late / DEGREE
        if end:  # the ray is the pin's velocity, so that none of it is across the ray
            input_deg = end * half / DEGREE
            ux, uy = (end * parameter(v.c[1]) for v in moved(0.0, 1))
        along_ray = moved.along(ux, uy, 1.0 / (library(ux).hypot(ux, uy) * L), s)
        anchors.append(Anchor(input_deg, wheel, plain(np.abs(ray)) / L, along_ray))
    anchored = AnchoredPath(tuple(anchors), ahead)
    body = LinkRate(path, plain(middle) + late, s)
    reactions = LinkReactions(*body, L, plain(axis.real) / L, plain(axis.imag) / L)
    motion = StraightSlotMotion(anchored, step.b, mirrored=False)
    return Engagement(0.0, anchored, RadialSlot(anchored), motion, body, reactions, -s), L
