"""Objects of a batch, reduced to some of its designs or to one.

An object of a batch holds arrays (m, 1) along the design axis, at any depth.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import TypeAlias, TypeVar, cast

import numpy as np

from geneva_cli.numerics.arrays import Array, Batchable, Which, numbers_of, record_of
from geneva_cli.numerics.latest import Latest
from geneva_cli.spec.schema import Points, SpecTable

T = TypeVar("T")
Change: TypeAlias = "Callable[[Array], object]"


def taken(thing: T, which: Which) -> T:
    """Reduce an object of a batch to some designs; ``which`` is a mask or their numbers."""
    if isinstance(which, slice):
        return cast("T", _changed(thing, lambda array: array[which], {}))
    numbers = numbers_of(which)
    return cast("T", _changed(thing, lambda array: array.take(numbers, axis=0), {}))


def selection(thing: T) -> Callable[[Which], T]:
    """Return the function that reduces an object of a batch to some designs, as ``taken`` does.

    It looks for arrays once: an object without them is the same for all designs.
    """
    if taken(thing, slice(0)) is thing:
        return lambda _: thing
    return partial(taken, thing)


def alone(thing: T, i: int) -> T:
    """The i-th design of an object of a batch, with numbers in place of arrays."""
    return cast("T", _changed(thing, lambda array: array[i, 0].item(), {}))


def designs_in(thing: object) -> int:
    """Number of designs in an object; 1 without an array along a design axis."""
    lengths = {1}

    def note(array: Array) -> Array:
        lengths.add(len(array))
        return array

    _changed(thing, note, {})
    return max(lengths)


def _changed(thing: object, change: Change, done: dict[int, object]) -> object:
    """Copy an object and change every array (n, 1) in it; return it unchanged if it has none."""
    if isinstance(thing, np.ndarray):
        return change(thing) if thing.ndim == 2 and thing.shape[1] == 1 else thing
    kind: type = type(thing)
    if not _may_hold(kind):
        return thing
    if id(thing) not in done:
        done[id(thing)] = _anew(thing, change, done)
    return done[id(thing)]


def _anew(thing: object, change: Change, done: dict[int, object]) -> object:
    if isinstance(thing, (tuple, list)):
        parts = [_changed(part, change, done) for part in thing]
        if all(a is b for a, b in zip(parts, thing, strict=True)):
            return thing
        return parts if isinstance(thing, list) else record_of(thing, parts)
    old = vars(thing)
    values = {name: _changed(value, change, done) for name, value in old.items()}
    if all(values[name] is value for name, value in old.items()):
        return thing
    new: object = object.__new__(type(thing))
    for name, value in values.items():  # a stored result belongs to the old set of designs
        vars(new)[name] = Latest() if isinstance(value, Latest) else value
    return new


@cache  # by type: most of what a machine holds is None or a number
def _may_hold(kind: type) -> bool:
    """True for tables of a spec, for what is built from them, and for records of both."""
    holders = SpecTable, Batchable, tuple, list
    return issubclass(kind, holders) and not issubclass(kind, Points)
