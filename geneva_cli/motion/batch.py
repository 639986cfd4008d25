"""Objects of a batch, with arrays (m, 1) at any depth, reduced to some of its designs or to one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache
from typing import Any, TypeAlias, TypeVar, cast

import numpy as np

from geneva_cli.numerics.arrays import Array, Batchable, Which, record_of
from geneva_cli.spec.schema import Points, SpecTable

T = TypeVar("T")
Change: TypeAlias = "Callable[[Array], object]"


def taken(thing: T, which: Which | int) -> T:
    """Reduce an object of a batch to some designs: a mask, their numbers, or a slice."""

    some: Any = which
    if isinstance(which, np.ndarray) and which.dtype == bool:
        some = which.nonzero()[0]

    def change(array: Array) -> object:
        if isinstance(some, int):
            return array[some, 0].item()
        return array[some] if isinstance(some, slice) else array.take(some, axis=0)

    return cast("T", _changed(thing, change, {}))


def selection(thing: T) -> Callable[[Which], T]:
    """Return the function that reduces an object of a batch to some designs, as ``taken`` does."""
    varies = taken(thing, slice(0)) is not thing
    return lambda which: taken(thing, which) if varies else thing


def designs_in(thing: object) -> int:
    """Number of designs in an object; 1 without an array along a design axis."""
    lengths = [1]
    _changed(thing, lambda array: lengths.append(len(array)), {})
    return max(lengths)


def _changed(thing: object, change: Change, done: dict[int, object]) -> object:
    """Copy a record and change the columns in it; the record itself if it has none."""
    kind: type = type(thing)
    if isinstance(thing, np.ndarray):
        return change(thing) if thing.ndim == 2 and thing.shape[1] == 1 else thing
    if not _is_record(kind) or id(thing) in done:
        return done.get(id(thing), thing)
    own = None if isinstance(thing, (tuple, list)) else vars(thing).copy()
    old = cast("Iterable[object]", thing) if own is None else own.values()
    new, copy, varies = [], thing, False
    for part in old:
        other = _changed(part, change, done)
        varies |= other is not part
        new.append(other)
    if varies:
        if own is not None:
            fresh: object = object.__new__(kind)
            vars(fresh).update(zip(own, new, strict=True))
            copy = fresh
        else:
            copy = record_of(thing, new) if isinstance(thing, tuple) else new
    done[id(thing)] = copy
    return copy


@cache  # by type: most of what a machine holds is None or a number
def _is_record(kind: type) -> bool:
    """True for tables of a spec, for what is built from them, and for records of both."""
    return issubclass(kind, (SpecTable, Batchable, tuple, list)) and not issubclass(kind, Points)
