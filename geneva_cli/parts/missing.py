"""Entries that a list omits because they cannot be built, with the reason."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import NamedTuple, TypeVar

from geneva_cli.errors import GenevaError

T = TypeVar("T")


class Missing(NamedTuple):
    """An omitted entry of a list: its name and the reason."""

    name: str
    why: str


def or_missing(name: str, listed: Callable[[], Iterable[T]]) -> Iterator[T | Missing]:
    """Yield the listed rows; if they cannot be built, the name and the reason instead."""
    try:
        rows = list(listed())
    except GenevaError as error:
        yield Missing(name, str(error))
        return
    yield from rows
