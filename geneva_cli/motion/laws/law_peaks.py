"""The greatest derivatives of a law, from which those of every motion by this law follow."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

from geneva_cli.motion.laws.law import Law
from geneva_cli.numerics.arrays import Array, Which

NAMES = ("velocity", "acceleration", "jerk", "power")


@lru_cache(maxsize=256)
def greatest(law: Law) -> dict[str, tuple[float, float]]:
    """Greatest size of each derivative of s(u) and of ds/du d²s/du² (power), and its first u."""
    # a list of the drives needs neither
    import numpy as np

    from geneva_cli.numerics.extremes import Smooth, search

    def derivatives(
        u: Array, _: Which, __: int, requested: Sequence[int]
    ) -> list[tuple[Array, Array, Array]]:
        d = law(u, 5).arrays()
        power = d[1] * d[2], d[2] ** 2 + d[1] * d[3], 3.0 * d[2] * d[3] + d[1] * d[4]
        curves = (d[1:4], d[2:5], d[3:6], power)
        return [curves[i] for i in requested]  # type: ignore[misc]

    # a break belongs to the piece before it
    ends = [np.array([[u]]) for u in sorted({0.0, 0.5, 1.0, *law.breaks})]
    starts = [ends[0], *(np.nextafter(end, 1.0) for end in ends[1:-1])]
    f = Smooth(derivatives, len(NAMES))
    most, u, _ = search(f, list(zip(starts, ends[1:], strict=True)), sized=True)
    places = zip(most[:, 0].tolist(), u[:, 0].tolist(), strict=True)
    return dict(zip(NAMES, places, strict=True))
