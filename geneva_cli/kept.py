"""What an object computes once, and what is imported by its name at its first use."""

import importlib
from collections.abc import Callable
from functools import cached_property as cached_property  # exported
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from geneva_cli.extras import FOLDERS

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


K = TypeVar("K")
T = TypeVar("T")
KEPT = 16  # designs whose results are kept: those that a sweep computes together


class Known(Generic[K, T]):
    """A function of a design that keeps its last results, and may take them from a batch.

    Designs of one ``key`` have the same result.

    >>> square = Known(lambda x: x * x)
    >>> square.put(3, lambda: 9.0), square.put(4, lambda: None)
    (None, None)
    >>> square(3), square(4)
    (9.0, 16)
    """

    def __init__(self, compute: Callable[[K], T], key: Callable[[K], Any] | None = None) -> None:
        self.compute, self.key = compute, key
        self._later: dict[Any, Callable[[], T | None]] = {}
        self._kept: dict[Any, T] = {}  # the last used one stands last

    def __call__(self, of: K) -> T:
        """The result of the function, computed at the first call."""
        key = self.key(of) if self.key else of
        result = self._kept.pop(key, None)
        if result is None:
            later = self._later.pop(key, None)
            result = later() if later else None
        if result is None:
            result = self.compute(of)
        self._kept[key] = result
        for old in [*self._kept][:-KEPT]:  # another thread may have removed it
            self._kept.pop(old, None)
        return result

    def put(self, of: K, later: Callable[[], T | None]) -> None:
        """Let ``later`` compute the result of a design; if it returns None, the function does."""
        self._later[self.key(of) if self.key else of] = later
        for old in [*self._later][:-KEPT]:
            self._later.pop(old, None)


def load_named(path: str) -> Any:
    """Class or function that ``module:name`` names in this package."""
    module, _, name = path.partition(":")
    return vars(importlib.import_module(f"geneva_cli.{module}"))[name]


def load_extra(folder: str, answer: str) -> Any:
    """Function of a folder of ``extras`` for an answer. Raises GenevaError without the folder."""
    if folder not in FOLDERS:
        from geneva_cli.errors import GenevaError

        raise GenevaError(f"not computed: needs extras/{folder}, which is not installed")
    return load_named(load_named(f"extras.{folder}:ANSWERS")[answer])
