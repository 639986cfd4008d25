"""Caches of functions: of an angle, and of a design.

Motion, path, slot and guide of one roller depend on each other, and each is evaluated at the same
array of angles. The cache avoids computing their common parts again.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Generic, TypeVar

from geneva_cli.numerics.arrays import SINGLE, read_only
from geneva_cli.numerics.jet import Array, Jet, Number


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
        jets = of(x, order)
        if x.size > 1 << 16:  # larger arrays are not kept in memory
            self._kept = None
            return jets
        jets = tuple(Jet([read_only(c) for c in jet.c]) for jet in jets)
        self._kept = x, x.copy(order="K"), order, jets
        return jets


K = TypeVar("K")
T = TypeVar("T")
KEPT = 16  # designs whose results are kept: those that a sweep computes together


class Known(Generic[K, T]):
    """A function of a design that keeps its last results, and may take them from a batch.

    >>> square = Known(lambda x: x * x)
    >>> square.put(3, lambda: 9.0), square.put(4, lambda: None)
    (None, None)
    >>> square(3), square(4)
    (9.0, 16)
    """

    def __init__(self, compute: Callable[[K], T]) -> None:
        self.compute = compute
        self._later: dict[K, Callable[[], T | None]] = {}
        self._kept = lru_cache(maxsize=KEPT)(self._result)

    def __call__(self, of: K) -> T:
        """The result of the function, computed at the first call."""
        return self._kept(of)

    def put(self, of: K, later: Callable[[], T | None]) -> None:
        """Let ``later`` compute the result of a design; if it returns None, the function does."""
        self._later[of] = later
        while len(self._later) > KEPT:
            del self._later[next(iter(self._later))]

    def _result(self, of: K) -> T:
        later = self._later.pop(of, None)
        result = later() if later else None
        return self.compute(of) if result is None else result
