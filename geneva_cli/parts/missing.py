"""What a list leaves out because it cannot be built, and why."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple, TypeVar

from geneva_cli.errors import GenevaError

T = TypeVar("T")


class Missing(NamedTuple):
    """Something that is not listed, by name, and the reason."""

    name: str
    why: str


def or_missing(name: str, listed: Callable[[], Iterable[T]]) -> Iterator[T | Missing]:
    """Yield what is listed; where it cannot be built, its name and the reason instead."""
    try:
        rows = list(listed())
    except GenevaError as error:
        yield Missing(name, str(error))
        return
    yield from rows
