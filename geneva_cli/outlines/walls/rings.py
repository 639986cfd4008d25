"""The area that a curved slot removes from its wheel, ring by ring about the wheel's axis.

Let the roller be at the polar coordinates (rho, theta), and w half the slot's width. On the circle
of radius r it covers the angles theta -+ delta, with sin²(delta/2) = (w² - (r - rho)²)/(4 r rho).
The pin moves on a circle about the crank's axis. So rho falls before mid-motion and rises after it,
and each half of the path covers one stretch of the circle. An island between the two falls out of
the wheel. So the slot extends from the least to the greatest angle that any position of the roller
covers. No wall is traced, and none needs to close.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.curves.moments import Moments
from geneva_cli.kinematics.engagement import Engagement
from geneva_cli.layout.assembly import Assembly
from geneva_cli.layout.roller_paths import rest
from geneva_cli.numerics.arrays import Array, array
from geneva_cli.numerics.quadrature import rule

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.layout.plain_sizes import Sizes

    Complex: TypeAlias = NDArray[np.complex128]

PANELS, NODES = 8, 6  # intervals of the radius at first, denser towards the slot's bottom


class RemovedFace(NamedTuple):
    """The face that a slot removes inside the rim, and the angles where it opens the rim."""

    face: Moments
    low: float
    high: float


def removed_face(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> RemovedFace:
    """Return what the slot of an engagement's roller, ahead of it, removes from the wheel."""
    rho, theta = _places(assembly, sizes, engagement)
    rim, w = sizes.rim, sizes.half_width
    bottom = float(assembly.sign * np.min(assembly.sign * rho)) - assembly.sign * w
    at_rim = _covered(np.array([rim]), rho, theta, w)

    def rings(low: Array, high: Array) -> Array:
        """Return the moments between two radii, one row for each pair; u² is along the radius."""
        node, weight = rule(NODES)
        half = 0.5 * (high - low)[:, None]
        u = 0.5 * (low + high)[:, None] + half * node
        r = bottom + (rim - bottom) * u * u
        a, b = (x.reshape(r.shape) for x in _covered(r.ravel(), rho, theta, w))
        weights = half * weight * 2.0 * u * abs(rim - bottom) * r
        parts = (b - a, r * (np.sin(b) - np.sin(a)), r * (np.cos(a) - np.cos(b)), r * r * (b - a))
        return np.stack([(weights * part).sum(axis=1) for part in parts], axis=1)

    face = Moments(*_sum(rings).tolist())
    return RemovedFace(face, float(at_rim[0][0]), float(at_rim[1][0]))


def _sum(of: Callable[[Array, Array], Array]) -> Array:
    """Return the integrals from 0 to 1; panels are halved until their halves agree."""
    ends = np.linspace(0.0, 1.0, PANELS + 1)
    low, high = ends[:-1], ends[1:]
    whole = of(low, high)
    # the polar moment decides: it has the same sign everywhere
    size, total = abs(whole[:, -1]).sum(), 0.0 * whole[0]
    for _ in range(16):  # panels with crossing walls are halved many times
        middle = 0.5 * (low + high)
        halves = of(np.append(low, middle), np.append(middle, high))
        left, right = halves[: len(low)], halves[len(low) :]
        open_ = abs(left + right - whole)[:, -1] > 1e-6 * size
        total = total + (left + right)[~open_].sum(axis=0)
        low, high = np.append(low[open_], middle[open_]), np.append(middle[open_], high[open_])
        whole = np.concatenate((left[open_], right[open_]))
        if not len(low):
            break
    return total + whole.sum(axis=0)


def _places(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> tuple[Array, Array]:
    """Return the roller's polar coordinates on its path from rim to rim: rho and theta."""
    near = sizes.half_width / 12.0  # greatest distance of adjacent positions

    def pin(t: Array) -> Complex:
        x, y = engagement.slot(t, 0)
        return array(assembly.L * x.c[0]) + array(assembly.L * y.c[0]) * 1j

    first, last = engagement.entry_deg, engagement.exit_deg
    # 65 positions, before intervals that are too long are halved
    t = np.append(np.linspace(first, 0.0, 32, endpoint=False), np.linspace(0.0, last, 33))
    z = pin(t)
    for _ in range(64):
        far = np.flatnonzero(np.abs(np.diff(z)) > near)
        middle = 0.5 * (t[far] + t[far + 1])
        far = far[(middle > t[far]) & (middle < t[far + 1])]
        if not len(far):
            break
        middle = 0.5 * (t[far] + t[far + 1])
        t, z = np.insert(t, far + 1, middle), np.insert(z, far + 1, pin(middle))
    arcs = [
        _before(assembly, sizes, engagement, end, complex(at), near)
        for end, at in ((-1.0, z[0]), (1.0, z[-1]))
    ]
    z = np.concatenate((arcs[0][::-1], z, arcs[1]))
    return np.abs(z), np.angle(z)


def _before(
    assembly: Assembly,
    sizes: Sizes,
    engagement: Engagement,
    end: float,
    start: complex,
    near: float,
) -> Complex:
    """Return positions on the roller's circle before entry (-1) or after exit (1), outwards."""
    axis = complex(*rest(assembly, engagement, end))
    # as far as the middle of the dwell, where the path of the next slot begins
    ahead = abs(np.angle(-(start - axis) / (assembly.sign * axis)))
    step = near / abs(start - axis)
    turn = -end * assembly.sign * np.arange(step, math.pi - ahead, step)
    z = axis + (start - axis) * np.exp(1j * turn)
    outside = assembly.sign * (abs(z) - sizes.rim) > sizes.half_width
    count = int(np.argmax(outside)) + 1 if outside.any() else len(z)
    return z[:count]


def _covered(r: Array, rho: Array, theta: Array, w: float) -> tuple[Array, Array]:
    """Return the least and greatest angle that the roller covers on circles of radii r."""
    off = r[:, None] - rho
    square = (w - off) * (w + off) / (4.0 * r[:, None] * rho)
    reach = 2.0 * np.arcsin(np.sqrt(np.clip(square, 0.0, 1.0)))
    reach[square < 0.0] = -np.inf
    # path length of the roller
    s = np.append(0.0, np.cumsum(abs(np.diff(rho * np.exp(1j * theta)))))
    return -_most(s, reach - theta), _most(s, reach + theta)


def _most(s: Array, values: Array) -> Array:
    """Return the greatest value of each row, on a parabola through the greatest sample."""
    row = np.arange(len(values))
    i = np.clip(np.argmax(values, axis=1), 1, len(s) - 2)
    top = values.max(axis=1)
    with np.errstate(all="ignore"):
        here = values[row, i]
        ahead, back = s[i + 1] - s[i], s[i - 1] - s[i]
        first, last = (values[row, i + 1] - here) / ahead, (values[row, i - 1] - here) / back
        bend = (first - last) / (ahead - back)
        slope = first - bend * ahead
        gain = -slope * slope / (4.0 * bend)
    inner = np.isfinite(gain) & (bend < 0.0) & (here == top)
    return top + np.where(inner, gain, 0.0)
