"""Numbers that are floats or arrays: what a formula needs to be written once for both.

One convention holds for arrays, in the whole program. The numbers of a machine (its ratio, its
offset, ...) are floats, or arrays (n, 1) along a design axis; input angles are floats, or arrays
(k,) or (n, k). What comes out is (k,) of one design, (n, k) of n designs, and (n, 1) where no array
of angles went in. To the type checker the numbers of a machine are floats.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

_PLAIN = (float, int)


def library(x: Any, y: Any = 0.0, z: Any = 0.0) -> Any:
    """The module whose sin and cos suit numbers: ``numpy`` where one of them is an array."""
    if isinstance(x, _PLAIN) and isinstance(y, _PLAIN) and isinstance(z, _PLAIN):
        return math
    import numpy

    return numpy


def choose(condition: Any, yes: Any, no: Any) -> Any:
    """One of two values, for a truth value, or element by element for an array of them.

    Of two records (tuples of the same shape) each number is chosen for itself.
    """
    if isinstance(condition, bool):
        return yes if condition else no
    if yes is no:
        return yes
    if isinstance(yes, tuple):
        parts = [choose(condition, a, b) for a, b in zip(yes, no, strict=True)]
        return type(yes)(*parts) if type(yes) is not tuple else tuple(parts)
    import numpy

    return numpy.where(condition, yes, no)


def chosen(x: Any, cuts: Sequence[Any], records: Sequence[Any]) -> Any:
    """``records[i]`` for x between ``cuts[i-1]`` and ``cuts[i]``, the upper end included.

    x or the cuts are arrays of designs; the record's numbers are chosen for each x.
    """
    out = records[0]
    for cut, record in zip(cuts, records[1:], strict=True):
        past = x > cut
        if all_true(past):
            out = record
        elif not isinstance(past, bool) and past.any():
            out = choose(past, record, out)
        else:
            break
    return out


def picked(index: Any, records: Sequence[Any]) -> Any:
    """The record of each index, its numbers as arrays of the index's shape where they differ.

    Records are tuples of the same shape; what they hold besides numbers is the same in all.

    >>> import numpy as np
    >>> picked(np.array([1, 0, 1]), ((1.0, 5.0), (2.0, 5.0)))
    (array([2., 1., 2.]), 5.0)
    """
    first = records[0]
    if all(one is first for one in records):
        return first
    if isinstance(first, tuple):
        parts = [picked(index, part) for part in zip(*records, strict=True)]
        return type(first)(*parts) if type(first) is not tuple else tuple(parts)
    if all(one == first for one in records):
        return first
    import numpy

    return numpy.array(records)[index]


def are_alike(records: Sequence[Any]) -> bool:
    """Whether records differ in numbers alone, so that ``picked`` can pick of them.

    >>> are_alike(((1.0, len), (2.0, len))), are_alike(((1.0, len), (2.0, max)))
    (True, False)
    """
    first = records[0]
    if all(one is first for one in records):
        return True
    if isinstance(first, tuple):
        return all(map(are_alike, zip(*records, strict=True)))
    return all(isinstance(one, _PLAIN) for one in records)


def are_designs(x: Any, *numbers: Any) -> bool:
    """Whether angles are (n, k), or one of some numbers differs from design to design."""
    plain = isinstance(x, float) or x.ndim < 2
    return not (plain and all(isinstance(one, float) for one in numbers))


def all_true(condition: Any) -> bool:
    """Whether a truth value, or each of an array of them, is true."""
    return condition if isinstance(condition, bool) else bool(condition.all())


def ascending(places: Sequence[Any]) -> list[Any]:
    """Numbers in order, each once; of designs each one's in its own order, equal ones too."""
    if all(isinstance(x, float) for x in places):
        return sorted(set(places))
    import numpy

    each = numpy.concatenate(numpy.broadcast_arrays(*places), axis=-1)
    return list(numpy.hsplit(numpy.sort(each, axis=-1), each.shape[-1]))


def larger(a: Any, b: Any) -> Any:
    """The larger of two numbers, element by element for arrays."""
    return choose(b > a, b, a)


def smaller(a: Any, b: Any) -> Any:
    """The smaller of two numbers, element by element for arrays."""
    return choose(b < a, b, a)
