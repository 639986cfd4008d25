"""Numbers that are floats or arrays, and helpers for formulas that serve both.

In the whole program the numbers of a machine are floats, or arrays (n, 1) along a design axis.
Input angles are floats, or arrays (k,) or (n, k). Results are (k,) for one design, (n, k) for n
designs, and (n, 1) without an array of angles. To the type checker a machine's numbers are floats.
"""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Sequence
from operator import itemgetter, methodcaller
from types import ModuleType
from typing import TYPE_CHECKING, Any, ClassVar, NoReturn, Self, TypeAlias, TypeVar, cast

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


Array: TypeAlias = "NDArray[np.float64]"
Mask: TypeAlias = "NDArray[np.bool_]"
Whole: TypeAlias = "NDArray[np.intp]"
Which: TypeAlias = "slice | Mask | Whole"  # some designs of a batch
Complex: TypeAlias = "NDArray[np.complex128]"
Number: TypeAlias = "float | Array"
Truth: TypeAlias = "bool | Mask"
# One kind of number as argument, and the same kind as result.
N = TypeVar("N", float, "Array", "Number")
Either = TypeVar("Either", "Array", "Whole")
Real = TypeVar("Real", float, "Array", "Number")
T = TypeVar("T")
Record = TypeVar("Record", bound=tuple[object, ...])
Library: TypeAlias = ModuleType  # ``math``, ``numpy``, or an object with the like of enclosures
_PLAIN = (float, int)


class Enclosed:
    """A number that is known by two bounds: a ``balls.Ball`` or an ``intervals.Interval``.

    It never becomes a float, and never answers a comparison that it cannot decide.
    """

    __slots__ = ()
    __array_ufunc__ = None  # NumPy's numbers leave the arithmetic to the enclosure
    library: ClassVar[Any]

    # How far one may reach over the end of its piece of a formula, in the formula's own variable:
    # the ends are known to a few units in the last place of doubles (EDGE_DEG of enclosures).
    REACH: ClassVar[float] = 2.0**-39

    @classmethod
    def exact(cls, x: float) -> Self:
        """The enclosure of one double."""
        raise NotImplementedError

    def piece(self, cuts: Sequence[float]) -> int:
        """Number of the piece between ``cuts`` that holds it."""
        raise NotImplementedError

    def pieces(self, cuts: Sequence[float]) -> int | Whole:
        """Number of the piece that holds it; of several enclosures an array of each one's own."""
        return self.piece(cuts)

    def rising(self, f: Callable[[Number], Number]) -> Number:
        """Enclosure of the values of a function that rises: between those at both ends."""
        raise NotImplementedError

    def __float__(self) -> NoReturn:
        raise TypeError("an enclosure is no float")

    def __bool__(self) -> NoReturn:
        raise TypeError("an enclosure has no truth value")

    def __rsub__(self, other: float) -> Self:
        return cast("Self", -(self - other))  # type: ignore[operator]

    def __rtruediv__(self, other: float) -> Self:
        return cast("Self", self.exact(other) / self)  # type: ignore[operator]

    def __gt__(self, other: float) -> bool:
        return not self <= other  # type: ignore[operator]

    def __ge__(self, other: float) -> bool:
        return not self < other  # type: ignore[operator]

    __hash__ = None  # type: ignore[assignment]


SINGLE = (float, int, Enclosed)  # the kinds of a single number; any other is an array


def piece_of(x: Number, cuts: Sequence[float]) -> int:
    """Number of the piece that holds x: the i-th lies up to ``cuts[i]``, the end included."""
    return x.piece(cuts) if isinstance(x, Enclosed) else bisect_left(cuts, cast(float, x))


def pieces_of(x: Number, cuts: Sequence[float]) -> int | Whole:
    """Number of the piece that holds x, as ``piece_of``; of several enclosures an array."""
    return x.pieces(cuts) if isinstance(x, Enclosed) else bisect_left(cuts, cast(float, x))


def narrowed(value: Number, f: Callable[[Number], Number], x: Number) -> Number:
    """The value f(x) of a function that rises, as narrow as its ends if x is an enclosure."""
    return x.rising(f) if isinstance(x, Enclosed) else value


def enclosed(x: Number, numbers: Record) -> Record:
    """Numbers of a machine as enclosures of each alone, if x is an enclosure; else as they are."""
    if not isinstance(x, Enclosed):
        return numbers
    kept = (int, str, tuple, type(None), Enclosed)
    out = [one if isinstance(one, kept) else x.exact(cast("float", one)) for one in numbers]
    return record_of(numbers, out)


def library(x: Number, y: Number = 0.0, z: Number = 0.0) -> Library:
    """The module whose functions suit these numbers: ``numpy`` if one of them is an array."""
    if isinstance(x, _PLAIN) and isinstance(y, _PLAIN) and isinstance(z, _PLAIN):
        return math
    for one in (x, y, z):
        if isinstance(one, Enclosed):
            return one.library
    import numpy

    return numpy


def choose(condition: Truth, yes: Real, no: Real) -> Real:
    """One of two values, element by element for an array of conditions."""
    if isinstance(condition, bool):
        return yes if condition else no
    if yes is no:
        return yes
    import numpy

    both: tuple[Any, Any] = yes, no
    return cast("Real", numpy.where(condition, *both))


def value_or(value: float | None, default: float) -> float:
    """Return a value of the spec, or else the default."""
    return default if value is None else value


def half_or(diameter: float | None, default: float) -> float:
    """Return half of a diameter, or the default radius if that is None."""
    return default if diameter is None else 0.5 * diameter


def record_of(like: Record, parts: Sequence[object]) -> Record:
    """A record of the type of ``like``."""
    make: Callable[..., object] = type(like)
    return cast("Record", tuple(parts) if make is tuple else make(*parts))


def mapped(f: Callable[..., object], *records: Record) -> Record:
    """A record of what ``f`` makes of the members of records of one shape, tuples in them alike."""
    out: list[object] = []
    for members in zip(*records, strict=True):
        out.append(mapped(f, *members) if isinstance(members[0], tuple) else f(*members))
    return record_of(records[0], out)


def choose_record(condition: Truth, yes: Record, no: Record) -> Record:
    """One of two tuples of the same shape; element by element for an array of conditions."""
    if isinstance(condition, bool):
        return yes if condition else no
    return mapped(lambda a, b: a if a is b else choose(condition, a, b), yes, no)


def picked(index: Whole, records: Sequence[Record]) -> Record:
    """The record of each index, (k,) or (n, k), its numbers as arrays where they differ.

    Records are tuples of the same shape; what they hold besides numbers is the same in all. Numbers
    are floats, or arrays: (n, 1) of n designs, or (1, 1) of a number that the designs share.
    """
    import numpy

    out: list[object] = []
    for members in zip(*records, strict=True):
        first, kinds = members[0], {*map(type, members)}
        if isinstance(first, tuple):
            out.append(picked(index, members))
        elif numpy.ndarray in kinds:
            columns = numpy.broadcast_arrays(*members)
            designs = numpy.arange(columns[0].size)[:, None] if columns[0].size > 1 else 0
            out.append(numpy.concatenate(columns, axis=1)[designs, index])
        else:
            same = members.count(first) == len(members)
            out.append(first if same else numpy.array(members)[index])
    return record_of(records[0], out)


def joined(records: Sequence[Record], axis: int = -1) -> Record:
    """Several records of arrays, or of such records, as one: each array joined along an axis."""
    import numpy

    return mapped(lambda *parts: numpy.concatenate(parts, axis), *records)


def record_taken(record: Record, which: Which) -> Record:
    """A record of arrays (..., m), or of such records, with some of their columns."""
    # NumPy's own indexing puts each column's values side by side in memory; reductions over them
    # then take fifty times as long.
    if isinstance(which, slice):
        return mapped(itemgetter((..., which)), record)
    # numbers are a third faster to take by than a mask
    numbers = which.nonzero()[0] if which.dtype == bool else which
    return mapped(methodcaller("take", numbers, axis=-1), record)


def blocks(count: int, size: int) -> list[slice]:
    """Adjacent slices of at most ``size`` numbers that divide ``count`` numbers."""
    ends = *range(size, count, size), count
    return [*map(slice, range(0, count, size), ends)] or [slice(0, 0)]


def keep_memory() -> None:
    """Let this process keep up to 32 MB that it frees, for the arrays of its next batch.

    Linux takes freed memory back and returns it page by page: up to two fifths of the time of a
    batch's peaks. Once 16 MB were freed, which are never written, it does so no more.
    """
    import numpy

    numpy.empty(1 << 21)


def within_half_turn(angle: Array) -> Array:
    """Angles in radians, at least -pi and below pi."""
    import numpy as np

    out: Array = np.remainder(angle + np.pi, 2.0 * np.pi) - np.pi
    return out


def all_true(condition: Truth) -> bool:
    """Return True if a condition, or each element of it, is true."""
    return condition if isinstance(condition, bool) else bool(condition.all())


def ascending(places: Sequence[float]) -> list[float]:
    """Numbers in ascending order, without repeats; for batches sorted along each design."""
    if all(isinstance(x, float) for x in places):
        return sorted(set(places))
    import numpy

    each = numpy.concatenate(numpy.broadcast_arrays(*places), axis=-1)
    columns = numpy.hsplit(numpy.sort(each, axis=-1), each.shape[-1])
    return cast("list[float]", columns)


def size(x: N) -> N:
    """The absolute value."""
    return x.__abs__()


def parameter(x: Number) -> float:
    """A machine's number that was computed by a jet, with the type that all of them have: float."""
    return cast(float, x)


def matrix_product(values: Array, matrix: Array) -> Array:
    """``values @ matrix`` with its sums in one order on every processor."""
    import numpy

    out: Array = numpy.einsum(
        "...n,n->..." if matrix.ndim == 1 else "...n,nk->...k", values, matrix
    )
    return out


def array(x: Number) -> Array:
    """A number as an array."""
    import numpy

    return numpy.asarray(x)


def larger(a: N, b: N) -> N:
    """The larger of two numbers, element by element for arrays."""
    return choose(b > a, b, a)


def smaller(a: N, b: N) -> N:
    """The smaller of two numbers, element by element for arrays."""
    return choose(b < a, b, a)


def rising(x: Either) -> Either:
    """Numbers (n,) in rising order, each once: ``numpy.unique``, which would import numpy.ma."""
    import numpy

    ordered = numpy.sort(x, axis=None)
    once = numpy.ones(len(ordered), dtype=bool)
    once[1:] = ordered[1:] != ordered[:-1]
    distinct: Either = ordered[once]
    return distinct


class Batchable:
    """An object whose attributes are floats, arrays (n, 1) of n designs, or objects with such.

    Paths, slots, motions and engagements are. ``motion.batch`` reduces a batch of them to some of
    its designs; an object without this base keeps its numbers, whatever they are.
    """

    __slots__ = ()
