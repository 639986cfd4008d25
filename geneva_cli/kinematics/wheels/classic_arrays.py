"""The classic wheels over whole arrays: closed forms in tan(a/2), in place, block by block.

With t = tan(a/2), T = t², and (p, q) = (1-l, 1+l) outside, (1+l, 1-l) inside, both gearings are

    P    = p² + q² T
    psi  = atan(2 l t / (p + q T))
    psi1 = l (p - q T) / P
    psi2 = - 2 l (1-l²) t (1+T) / P²
    psi3 = l (1-l²) (1+T) (q² T² +- 12 l T - p²) / P³

Nothing cancels here as l nears 1, and one tangent is the only trigonometric function. A block stays
in the processor's cache between the steps. On whole arrays the steps take 1.5 times as long
(`geneva bench motion` measures it).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Array


class ClassicArrays(NamedTuple):
    """A classic wheel: sign +1 external, -1 internal; l = sin b; rest = 1 - l."""

    sign: float
    l: float
    rest: float

    def derivatives(
        self, input_deg: Array, orders: Sequence[int], mirrored: bool = False
    ) -> list[Array]:
        """Wheel angle (order 0) and its derivatives (1 to 3) at input angles in degrees.

        Each is accurate to a few units in the last place of its peak. Only the requested orders are
        computed. If the angles lie symmetrically about mid-motion (``mirrored``), only half of them
        is computed.
        """
        n = len(input_deg)
        count = (n + 1) // 2 if mirrored else n
        out = [np.empty(n) for _ in orders]
        size = 8192  # angles in a block
        work = np.empty((4, min(size, count)))
        for start in range(0, count, size):
            stop = min(start + size, count)
            done = [o[start:stop] for o in out]
            self._block(input_deg[start:stop], orders, done, work[:, : stop - start])
            if mirrored:
                for order, o, values in zip(orders, out, done, strict=True):
                    image = o[n - stop : n - start][::-1]
                    if order % 2:
                        image[:] = values
                    else:
                        np.negative(values, out=image)
        return out

    def _block(self, x: Array, orders: Sequence[int], out: list[Array], work: Array) -> None:
        sign, l, rest = self
        tan, square, inverse, spare = work
        p, q = (rest, 1.0 + l) if sign > 0.0 else (1.0 + l, rest)
        scale = l * rest * (1.0 + l)
        np.multiply(x, 0.5 * DEGREE, out=tan)
        np.tan(tan, out=tan)
        np.multiply(tan, tan, out=square)
        np.multiply(square, q * q, out=inverse)
        inverse += p * p
        np.reciprocal(inverse, out=inverse)
        for order, to in zip(orders, out, strict=True):
            if order == 0:
                np.multiply(square, q, out=spare)
                spare += p
                np.divide(tan, spare, out=to)
                to *= 2.0 * l
                np.arctan(to, out=to)
            elif order == 1:
                np.multiply(square, -l * q, out=to)
                to += l * p
                to *= inverse
            elif order == 2:
                np.add(square, 1.0, out=to)
                to *= tan
                to *= inverse
                to *= inverse
                to *= -2.0 * scale
            else:
                np.multiply(square, q * q, out=to)
                to += sign * 12.0 * l
                to *= square
                to -= p * p
                np.add(square, 1.0, out=spare)
                to *= spare
                to *= inverse
                to *= inverse
                to *= inverse
                to *= scale
