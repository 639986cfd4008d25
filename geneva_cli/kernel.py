"""The classic wheels over whole arrays: closed forms, in place, a block at a time.

With g = |1 -+ l| the pin's least distance from the wheel's centre on the far side of the crank's
axis, both gearings are one formula: s = 1 - cos a outside and 1 + cos a inside, sign + and -,

    D    = (1-l)² + 2 l s
    psi  = atan2(l sin a, (1-l) + l s)
    psi1 = sign l ((1-l) - s) / D
    psi2 = - l (1-l²) sin a / D²
    psi3 = sign l (1-l²) (s (1 + 4 l + l² - 2 l s) - (1-l)²) / D³

in which nothing cancels as l nears 1. A block stays in the processor's cache between the steps;
on whole arrays the same steps take half as long again (`make bench` reprints it).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.units import DEGREE

if TYPE_CHECKING:
    from geneva_cli.jet import Array

BLOCK = 8192


class Kernel(NamedTuple):
    """A classic wheel: sign +1 external, -1 internal; l = sin b; rest = 1 - l."""

    sign: float
    l: float
    rest: float

    def derivatives(
        self, input_deg: Array, orders: Sequence[int], mirrored: bool = False
    ) -> list[Array]:
        """The wheel's angle (order 0) and its derivatives (1 to 3) at input angles in degrees.

        Each within a few units in the last place of its peak. Only what is asked for is computed;
        where the angles lie symmetrically about mid-motion (``mirrored``), only half of it.
        """
        n = len(input_deg)
        count = (n + 1) // 2 if mirrored else n
        out = [np.empty(n) for _ in orders]
        work = np.empty((5, min(BLOCK, count)))
        for start in range(0, count, BLOCK):
            stop = min(start + BLOCK, count)
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
        sine, cosine, versine, inverse, spare = work
        np.multiply(x, 0.5 * DEGREE, out=spare)
        np.sin(spare, out=sine)
        np.cos(spare, out=cosine)
        half = sine if sign > 0 else cosine
        np.multiply(half, half, out=versine)  # s / 2
        np.multiply(sine, cosine, out=sine)  # sin(a) / 2
        np.multiply(versine, 4.0 * l, out=inverse)
        inverse += rest * rest
        np.reciprocal(inverse, out=inverse)
        scale = l * rest * (1.0 + l)
        for order, to in zip(orders, out, strict=True):
            if order == 0:
                np.multiply(versine, 2.0 * l, out=spare)
                spare += rest
                np.multiply(sine, 2.0 * l, out=to)
                np.arctan2(to, spare, out=to)
            elif order == 1:
                np.multiply(versine, -2.0 * l * sign, out=to)
                to += l * rest * sign
                to *= inverse
            elif order == 2:
                np.multiply(inverse, inverse, out=to)
                to *= sine
                to *= -2.0 * scale
            else:
                np.multiply(versine, -4.0 * l, out=to)
                to += 1.0 + 4.0 * l + l * l
                to *= versine
                to *= 2.0
                to -= rest * rest
                to *= inverse
                to *= inverse
                to *= inverse
                to *= scale * sign
