"""The base of objects that hold the numbers of a machine, or of a batch of machines."""

from __future__ import annotations


class Batchable:
    """An object whose attributes are floats, arrays (n, 1) of n designs, or objects with such.

    Paths, slots, motions and engagements are. ``machine.many`` reduces a batch of them to some of
    its designs; an object without this base keeps its numbers, whatever they are.
    """

    __slots__ = ()
