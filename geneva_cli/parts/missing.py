"""Parts of a list, each built by itself; those that cannot be built are listed with the reason."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple, TypeAlias, TypeVar

from geneva_cli.errors import GenevaError

if TYPE_CHECKING:
    from geneva_cli.geometry.plates import Part

T = TypeVar("T")
NamedParts: TypeAlias = "tuple[str, Callable[[], Iterable[Part]]]"


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


def built_of(
    named: Iterable[tuple[str, Callable[[], Iterable[T]]]], missing: list[Missing]
) -> Iterator[T]:
    """Yield what can be built; add the others to ``missing``, once for each reason."""
    failed: dict[str, list[str]] = {}
    for name, build in named:
        try:
            some = list(build())
        except GenevaError as error:
            failed.setdefault(str(error), []).append(name)
            continue
        yield from some
    missing += [Missing(", ".join(names), why) for why, names in failed.items()]
