"""Results that an object computes once."""

from __future__ import annotations

from functools import cached_property as cached_property  # exported
from typing import TYPE_CHECKING, Any

if not TYPE_CHECKING:  # to a checker of types it is the one of Python

    class cached_property(cached_property):
        """A property that is computed at its first use, without a lock, in any Python.

        Python 3.11 holds a lock for all objects of a class while one of them computes. A process
        that is forked meanwhile waits for it for ever. A lock for each object would let two threads
        wait for each other, as motion, slot and path ask one another. Threads that ask at the same
        time compute a result each, and the results are equal.
        """

        def __get__(self, instance: Any, owner: type | None = None) -> Any:
            if instance is None:
                return self
            kept = vars(instance)
            if self.attrname not in kept:
                kept[self.attrname] = self.func(instance)
            return kept[self.attrname]
