"""Values that the shell offers for options, with `geneva --install-completion`.

Each function takes the text typed so far. Where none offers a word, the shell offers files.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeAlias

Offer: TypeAlias = "Callable[[str], Sequence[str | tuple[str, str]]]"  # also with descriptions


def offer(words: Offer | Iterable[str]) -> Offer:
    """Offer those of some words that begin with the typed text; a function offers its own."""
    if callable(words):
        return words

    def complete(typed: str) -> list[str]:
        return [word for word in words if word.startswith(typed)]

    return complete


def listed(words: Offer | Iterable[str]) -> Offer:
    """Offer one more word of a list separated by commas."""

    def complete(typed: str) -> list[str]:
        before, comma, begun = typed.rpartition(",")
        offered = map(str, offer(words)(begun))
        return [f"{before}{comma}{name}" for name in offered if name not in before.split(",")]

    return complete


def _words(names: Callable[[], Iterable[str]]) -> Offer:
    """Offer words, which are found when the shell asks."""

    def complete(typed: str) -> Sequence[str | tuple[str, str]]:
        return offer(names())(typed)

    return complete


def keys(typed: str) -> list[tuple[str, str]]:
    """The keys of a spec as ``table.key=``; behind the sign, the words that the key may be."""
    from geneva_cli.specfile.keys import full_names, words_of

    key, sign, begun = typed.partition("=")
    if sign:
        return [(f"{key}={word}", "") for word in words_of(key) if word.startswith(begun)]
    return [(f"{name}=", about) for name, about in full_names().items() if name.startswith(typed)]


@_words
def tables_and_keys() -> Iterable[str]:
    """The arguments of ``geneva keys``."""
    from geneva_cli.specfile.keys import full_names

    names = full_names()
    return [*dict.fromkeys(name.rpartition(".")[0] for name in names), *names]


@_words
def laws() -> Iterable[str]:
    """The motion laws."""
    from geneva_cli.specfile.keys import words_of

    return words_of("motion.law")


@_words
def kinds() -> Iterable[str]:
    """The kinds that ``geneva new`` writes."""
    from geneva_cli.specfile.template import KINDS

    return KINDS


@_words
def designs() -> Iterable[str]:
    """The designs in the package."""
    from geneva_cli.specfile.designs import titles

    return titles()


@_words
def topics() -> Iterable[str]:
    """The pages of the manual."""
    from geneva_cli.manual import TOPICS

    return TOPICS


@_words
def explained() -> Iterable[str]:
    """The words that ``geneva explain`` explains."""
    from geneva_cli.specfile.meanings import names

    return names()


@_words
def fields() -> Iterable[str]:
    """The quantities of a design."""
    from geneva_cli.verdict.quantities.quantity_names import group_of

    return group_of()


@_words
def quantities() -> Iterable[str]:
    """The quantities that ``geneva plot`` draws."""
    from geneva_cli.study.figures import QUANTITIES

    return QUANTITIES
