"""A cache of one entry for functions of an angle.

Motion, path, slot and guide of one roller depend on each other, and each is evaluated at the same
array of angles. The cache avoids computing their common parts again. What it computes is counted:
most of the time of loads, outlines and turns is spent there.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geneva_cli.numerics.arrays import SINGLE, read_only
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.work import count

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class Latest:
    """The jets of a function at the array of angles of its last call.

    A call with the same array object, equal values and no higher order is served from the cache. A
    jet of lower order is the beginning of the cached one. The cache is not pickled. Its arrays are
    read-only, so that no caller can change the next result.
    """

    def __init__(self) -> None:
        self._kept: tuple[Array, Array, int, tuple[Jet, ...]] | None = None

    def __reduce__(self) -> tuple[type[Latest], tuple[()]]:
        return Latest, ()

    def __call__(
        self, of: Callable[[Number, int], tuple[Jet, ...]], x: Number, order: int
    ) -> tuple[Jet, ...]:
        """``of(x, order)``, from the cache if possible."""
        if isinstance(x, SINGLE):
            return of(x, order)
        kept = self._kept
        if kept and kept[0] is x and kept[2] >= order and bool((kept[1] == x).all()):
            return tuple(Jet(jet.c[: order + 1]) for jet in kept[3])
        count()
        jets = of(x, order)
        if x.size > 1 << 16:  # larger arrays are not kept in memory
            self._kept = None
            return jets
        jets = tuple(Jet([read_only(c) for c in jet.c]) for jet in jets)
        self._kept = x, x.copy(order="K"), order, jets
        return jets
