"""Records of many designs that differ in numbers only, stacked for picking with one index."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Generic, cast

from geneva_cli.numerics.arrays import Array, Record, Whole, are_alike, record_of


def can_stack(records: Sequence[object]) -> bool:
    """Return True if records differ in numbers only, some of which are arrays (n, 1)."""
    alike = are_alike(records, lambda one: isinstance(one, float) or _is_column(one))
    return alike and any(True for _ in _columns(tuple(records)))


def _columns(record: object) -> Iterator[Array]:
    """The arrays (n, 1) in a record."""
    if isinstance(record, tuple):
        for part in record:
            yield from _columns(part)
    elif _is_column(record):
        yield cast("Array", record)


def _is_column(number: object) -> bool:
    import numpy as np

    return isinstance(number, np.ndarray) and number.shape[1:] == (1,)


class Stack(Generic[Record]):
    """k records of floats and arrays (n, 1), for which ``can_stack`` is true.

    ``rows`` are the numbers (m, 1) of the requested designs.

    >>> import numpy as np
    >>> one, other = (1.0, np.array([[5.0], [7.0]])), (1.0, np.array([[6.0], [8.0]]))
    >>> stack = Stack((one, other))
    >>> stack.one(-1, stack.rows)
    (1.0, array([[6.],
           [8.]]))
    >>> stack.picked(np.array([[0, 1]]), stack.rows[1:])
    (1.0, array([[7., 8.]]))
    """

    def __init__(self, records: Sequence[Record]) -> None:
        import numpy as np

        self.records, self.record, self.count = tuple(records), _stacked(records), len(records)
        shapes = (x.shape for x in _columns(tuple(records)))
        self.rows: Whole = np.arange(next(shapes)[0])[:, None]

    def __len__(self) -> int:
        return self.count

    def one(self, i: int, rows: Whole) -> Record:
        """The i-th record, from the end if i is negative; its floats stay floats."""
        row = rows[:, 0]

        def taken(number: object) -> object:
            if isinstance(number, tuple):
                return record_of(number, [taken(one) for one in number])
            return cast("Array", number)[row] if _is_column(number) else number

        return cast("Record", taken(self.records[i]))

    def picked(self, index: Whole, rows: Whole) -> Record:
        """The record of each index (m, j): numbers that differ are (m, j) too."""
        import numpy as np

        flat = np.ascontiguousarray((rows * self.count + index).T)  # designs lie side by side

        def taken(number: object) -> object:
            if isinstance(number, tuple):
                return record_of(number, [taken(one) for one in number])
            if not isinstance(number, np.ndarray):
                return number
            return number[index] if number.ndim == 1 else number.reshape(-1).take(flat).T

        return cast("Record", taken(self.record))


def _stacked(records: Sequence[Record]) -> Record:
    """One record of all, whose numbers are equal in all, or arrays (n, k) or (k,)."""
    return record_of(records[0], [_members(one) for one in zip(*records, strict=True)])


def _members(members: Sequence[object]) -> object:
    import numpy as np

    first = members[0]
    if isinstance(first, tuple):
        return _stacked(cast("Sequence[tuple[object, ...]]", members))
    if all(one is first for one in members) and not _is_column(first):
        return first
    if all(isinstance(one, float) for one in members):
        return first if all(one == first for one in members) else np.array(members)
    return np.hstack(np.broadcast_arrays(*cast("Sequence[Array]", members)))
