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

    def complete(typed: str) -> list[str]:  # Typer reads the annotation
        return _begun(typed, words)

    return complete


def listed(words: Offer | Iterable[str]) -> Offer:
    """Offer one more word of a list separated by commas."""

    def complete(typed: str) -> list[str]:
        before, comma, begun = typed.rpartition(",")
        offered = map(str, offer(words)(begun))
        return [f"{before}{comma}{name}" for name in offered if name not in before.split(",")]

    return complete


def _begun(typed: str, words: Iterable[str]) -> list[str]:
    return [word for word in words if word.startswith(typed)]


def keys(typed: str) -> list[tuple[str, str]]:
    """The keys of a spec as ``table.key=``; behind the sign, the words that the key may be."""
    from geneva_cli.specfile.keys import full_names, words_of

    key, sign, begun = typed.partition("=")
    if sign:
        return [(f"{key}={word}", "") for word in _begun(begun, words_of(key))]
    return [(f"{name}=", about) for name, about in full_names().items() if name.startswith(typed)]


def tables_and_keys(typed: str) -> list[str]:
    """The arguments of ``geneva keys``."""
    from geneva_cli.specfile.keys import full_names

    names = full_names()
    return _begun(typed, [*dict.fromkeys(name.rpartition(".")[0] for name in names), *names])


def laws(typed: str) -> list[str]:
    """The motion laws."""
    from geneva_cli.specfile.keys import words_of

    return _begun(typed, words_of("motion.law"))


def kinds(typed: str) -> list[str]:
    """The kinds that ``geneva new`` writes."""
    from geneva_cli.specfile.template import KINDS

    return _begun(typed, KINDS)


def designs(typed: str) -> list[str]:
    """The designs in the package."""
    from geneva_cli.specfile.designs import titles

    return _begun(typed, titles())


def topics(typed: str) -> list[str]:
    """The pages of the manual."""
    from geneva_cli.manual import TOPICS

    return _begun(typed, TOPICS)


def explained(typed: str) -> list[str]:
    """The words that ``geneva explain`` explains."""
    from geneva_cli.specfile.meanings import names

    return _begun(typed, names())


def fields(typed: str) -> list[str]:
    """The quantities of a design."""
    from geneva_cli.verdict.quantities.quantity_names import group_of

    return _begun(typed, group_of())


def quantities(typed: str) -> list[str]:
    """The quantities that ``geneva plot`` draws."""
    from geneva_cli.study.figures import QUANTITIES

    return _begun(typed, QUANTITIES)
