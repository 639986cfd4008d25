"""What a curved slot takes from its wheel, ring by ring about the wheel's axis.

On the circle of a radius r the roller at the polar coordinates (rho, theta), w being half the
slot's width, covers the angles theta -+ delta, sin²(delta/2) = (w² - (r - rho)²)/(4 r rho). The pin
runs on a circle about the crank's axis, so rho falls on the way in and rises on the way out, and
each way covers one stretch of the circle. What is left between the two is an island, which falls
out of the wheel: the slot is from the least angle that any place of the roller covers to the
greatest. No wall is traced, and none needs to close.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.curves.moments import Moments
from geneva_cli.numerics.arrays import array
from geneva_cli.numerics.quadrature import rule
from geneva_cli.parts.roller_paths import rest

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.machine.engagement import Engagement
    from geneva_cli.numerics.jet import Array
    from geneva_cli.parts.assembly import Assembly
    from geneva_cli.parts.sizes import Sizes

    Complex: TypeAlias = NDArray[np.complex128]

FINE = 12.0  # places of the roller to half a slot's width
FIRST = 64  # and of the motion, before it is looked where they are too far apart
HALVINGS = 64
PANELS, NODES = 8, 6  # of radii at first, crowding towards the slot's bottom
# Of the slot: by how much halves of a panel may differ from it. Walls cross where their panels are
# halved, time and again.
AGREED = 1e-6
DEEPEST = 16


class Taken(NamedTuple):
    """A slot's face within the rim, and the angles between which it opens the rim."""

    face: Moments
    low: float
    high: float


def taken(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> Taken:
    """What the slot ahead, of an engagement's roller, takes from the wheel."""
    rho, theta = _places(assembly, sizes, engagement)
    rim, w = sizes.rim, sizes.half_width
    bottom = float(assembly.sign * np.min(assembly.sign * rho)) - assembly.sign * w
    at_rim = _covered(np.array([rim]), rho, theta, w)

    def rings(low: Array, high: Array) -> Array:
        """The moments between two radii, a row a pair; u² of the way to the rim."""
        node, weight = rule(NODES)
        half = 0.5 * (high - low)[:, None]
        u = 0.5 * (low + high)[:, None] + half * node
        r = bottom + (rim - bottom) * u * u
        a, b = (x.reshape(r.shape) for x in _covered(r.ravel(), rho, theta, w))
        share = half * weight * 2.0 * u * abs(rim - bottom) * r
        parts = (b - a, r * (np.sin(b) - np.sin(a)), r * (np.cos(a) - np.cos(b)), r * r * (b - a))
        return np.stack([(share * part).sum(axis=1) for part in parts], axis=1)

    face = Moments(*_sum(rings).tolist())
    return Taken(face, float(at_rim[0][0]), float(at_rim[1][0]))


def _sum(of: Callable[[Array, Array], Array]) -> Array:
    """The integrals from 0 to 1, a panel halved until its halves agree with it."""
    ends = np.linspace(0.0, 1.0, PANELS + 1)
    low, high = ends[:-1], ends[1:]
    whole = of(low, high)
    # the polar moment tells: it is of the same sign everywhere
    size, total = abs(whole[:, -1]).sum(), 0.0 * whole[0]
    for _ in range(DEEPEST):
        middle = 0.5 * (low + high)
        halves = of(np.append(low, middle), np.append(middle, high))
        left, right = halves[: len(low)], halves[len(low) :]
        open_ = abs(left + right - whole)[:, -1] > AGREED * size
        total = total + (left + right)[~open_].sum(axis=0)
        low, high = np.append(low[open_], middle[open_]), np.append(middle[open_], high[open_])
        whole = np.concatenate((left[open_], right[open_]))
        if not len(low):
            break
    out: Array = total + whole.sum(axis=0)
    return out


def _places(assembly: Assembly, sizes: Sizes, engagement: Engagement) -> tuple[Array, Array]:
    """Where the roller is on its way, in polar coordinates, from rim to rim: rho and theta."""
    near = sizes.half_width / FINE

    def pin(t: Array) -> Complex:
        x, y = engagement.slot(t, 0)
        return array(assembly.L * x.c[0]) + array(assembly.L * y.c[0]) * 1j

    first, last = engagement.entry_deg, engagement.exit_deg
    t = np.append(np.linspace(first, 0.0, FIRST // 2, endpoint=False), np.linspace(0.0, last, 33))
    z = pin(t)
    for _ in range(HALVINGS):
        far = np.flatnonzero(np.abs(np.diff(z)) > near)
        middle = 0.5 * (t[far] + t[far + 1])
        far = far[(middle > t[far]) & (middle < t[far + 1])]
        if not len(far):
            break
        middle = 0.5 * (t[far] + t[far + 1])
        t, z = np.insert(t, far + 1, middle), np.insert(z, far + 1, pin(middle))
    ways = [
        _before(assembly, sizes, engagement, end, complex(at), near)
        for end, at in ((-1.0, z[0]), (1.0, z[-1]))
    ]
    z = np.concatenate((ways[0][::-1], z, ways[1]))
    return np.abs(z), np.angle(z)


def _before(
    assembly: Assembly,
    sizes: Sizes,
    engagement: Engagement,
    end: float,
    start: complex,
    near: float,
) -> Complex:
    """Places on the roller's circle before entry (-1) or after exit (1), outwards from the slot."""
    axis = complex(*rest(assembly, engagement, end))
    # to the middle of the dwell, from where on the way is that of the next slot
    ahead = abs(np.angle(-(start - axis) / (assembly.sign * axis)))
    step = near / abs(start - axis)
    turn = -end * assembly.sign * np.arange(step, math.pi - ahead, step)
    z = axis + (start - axis) * np.exp(1j * turn)
    gone = assembly.sign * (abs(z) - sizes.rim) > sizes.half_width
    count = int(np.argmax(gone)) + 1 if gone.any() else len(z)
    way: Complex = z[:count]
    return way


def _covered(r: Array, rho: Array, theta: Array, w: float) -> tuple[Array, Array]:
    """The least and the greatest angle that the roller covers on circles of radii r."""
    off = r[:, None] - rho
    square = (w - off) * (w + off) / (4.0 * r[:, None] * rho)
    reach = 2.0 * np.arcsin(np.sqrt(np.clip(square, 0.0, 1.0)))
    reach[square < 0.0] = -np.inf
    # how far along its way the roller is
    s = np.append(0.0, np.cumsum(abs(np.diff(rho * np.exp(1j * theta)))))
    return -_most(s, reach - theta), _most(s, reach + theta)


def _most(s: Array, values: Array) -> Array:
    """The greatest value of each row, on the parabola through the greatest sample's neighbours."""
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
    out: Array = top + np.where(inner, gain, 0.0)
    return out
