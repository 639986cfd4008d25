"""The greatest derivatives of a law, from which those of every motion by this law follow.

A greatest size is at a root of the next derivative, at an end, or where a derivative jumps. A law
is one design: it is searched on floats, without NumPy. Only a spline has too many pieces for that.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import TypeAlias

from geneva_cli.motion.laws.law import Law
from geneva_cli.numerics.arrays import Array, N, Which
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.roots import greatest_at, root
from geneva_cli.numerics.tolerances import TIE

Curves: TypeAlias = dict[str, tuple[float, float, float]]  # values with two derivatives
Size: TypeAlias = tuple[float, float, bool]  # with its place, and whether the quantity turns there


@lru_cache(maxsize=256)
def greatest(law: Law) -> dict[str, tuple[float, float]]:
    """Greatest size of each derivative of s(u) and of ds/du d²s/du² (power), and its first u.

    For a law whose keys are numbers.

    >>> from geneva_cli import Cycloidal
    >>> greatest(Cycloidal())["velocity"]
    (2.0, 0.5)
    """
    if not law.ANALYTIC:
        return _of_spline(law)
    places = _half(law.first, [*(u for u in law.breaks if u < 0.5), 0.5])
    if not law.symmetric:
        after = [*(1.0 - u for u in reversed(law.breaks) if u > 0.5), 0.5]
        for name, later in _half(law.second, after).items():
            places[name] += [(size, 1.0 - w, turns) for size, w, turns in reversed(later)]
    return {name: _first_top(sizes) for name, sizes in places.items()}


def _first_top(sizes: list[Size]) -> tuple[float, float]:
    """The greatest of some sizes, and its first place.

    An end just before an equally high turn is part of its flat top, as its rounding is no place.
    """
    most, first = greatest_at([(size, u) for size, u, _ in sizes])
    tops = (u for size, u, turns in sizes if turns and size >= most - TIE * most)
    top = min(tops, default=first)
    return most, top if 1e-12 < top - first < 1e-6 else first


def _of_spline(law: Law) -> dict[str, tuple[float, float]]:
    """Greatest sizes of a law that is analytic only between its many knots, and their places."""
    import numpy as np

    from geneva_cli.numerics.extremes import Smooth, search

    names = list(_curves((0.0,) * 6))

    def derivatives(
        u: Array, _: Which, __: int, requested: Sequence[int]
    ) -> list[tuple[Array, Array, Array]]:
        curves = _curves(law(u, 5).arrays())
        return [curves[names[i]] for i in requested]

    ends = [np.array([[u]]) for u in sorted({0.0, 0.5, 1.0, *law.breaks})]
    starts = [ends[0], *(np.nextafter(end, 1.0) for end in ends[1:-1])]
    f = Smooth(derivatives, len(names))
    most, u, _ = search(f, list(zip(starts, ends[1:], strict=True)), sized=True)
    places = zip(most[:, 0].tolist(), u[:, 0].tolist(), strict=True)
    return dict(zip(names, places, strict=True))


def _half(half: Callable[[Number, int], Jet], ends: list[float]) -> dict[str, list[Size]]:
    """Sizes and places, in order, where each quantity of one half may be greatest."""

    def curves(x: float) -> Curves:
        return _curves(half(x, 5).scalars())

    sizes: dict[str, list[Size]] = {}
    start = 0.0
    for end in ends:
        # half a motion has a few waves of each derivative, not a dozen
        samples = [*(start + (end - start) * i / 16 for i in range(16)), end]
        each = [curves(x) for x in samples]
        for name in each[0]:
            sizes.setdefault(name, []).extend(_turns(name, curves, samples, each))
        # A break belongs to the piece before it. Those of a law are exact: they are its own cuts,
        # and no law with breaks has unequal halves.
        start = math.nextafter(end, 1.0)
    return sizes


def _curves(d: tuple[N, ...]) -> dict[str, tuple[N, N, N]]:
    """Each quantity with its first two derivatives, from the derivatives of s."""
    return {
        "velocity": (d[1], d[2], d[3]),
        "acceleration": (d[2], d[3], d[4]),
        "jerk": (d[3], d[4], d[5]),
        "power": (d[1] * d[2], d[2] ** 2 + d[1] * d[3], 3.0 * d[2] * d[3] + d[1] * d[4]),
    }


def _turns(
    name: str, curves: Callable[[float], Curves], samples: list[float], each: list[Curves]
) -> Iterator[Size]:
    """Sizes at the samples of a smooth piece, and at the stationary places between them."""
    yield abs(each[0][name][0]), samples[0], False
    for (a, left), (b, right) in pairwise(zip(samples, each, strict=True)):
        if left[name][1] * right[name][1] < 0.0:
            x = root(lambda x: curves(x)[name][1:], a, b, left[name][1])
            yield abs(curves(x)[name][0]), x, True
        yield abs(right[name][0]), b, False
