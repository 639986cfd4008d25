"""Values that the shell offers for options, with `geneva --install-completion`.

Each function takes the text typed so far. Where none offers a word, the shell offers files.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

Offer = tuple[str, str]  # a word, and its description


def words(names: Callable[[], Iterable[str]]) -> Callable[[str], list[str]]:
    """Offer words that begin with the typed text."""

    def offer(typed: str) -> list[str]:
        return [name for name in names() if name.startswith(typed)]

    return offer


def listed(names: Callable[[], Iterable[str]]) -> Callable[[str], list[str]]:
    """Offer one more word of a list separated by commas."""

    def offer(typed: str) -> list[str]:
        before, comma, begun = typed.rpartition(",")
        offered = words(names)(begun)
        return [f"{before}{comma}{name}" for name in offered if name not in before.split(",")]

    return offer


def keys(typed: str) -> list[Offer]:
    """The keys of a spec as ``table.key=``; behind the sign, the words that the key may be."""
    from geneva_cli.specfile.keys import full_names, words_of

    key, sign, begun = typed.partition("=")
    if sign:
        return [(f"{key}={word}", "") for word in words_of(key) if word.startswith(begun)]
    return [(f"{name}=", about) for name, about in full_names().items() if name.startswith(typed)]


def tables_and_keys() -> Iterable[str]:
    """The arguments of ``geneva keys``."""
    from geneva_cli.specfile.keys import full_names

    names = full_names()
    return [*dict.fromkeys(name.rpartition(".")[0] for name in names), *names]


def laws() -> Iterable[str]:
    """The motion laws."""
    from geneva_cli.specfile.keys import words_of

    return words_of("motion.law")


def kinds() -> Iterable[str]:
    """The kinds that ``geneva new`` writes."""
    from geneva_cli.specfile.template import KINDS

    return KINDS


def designs() -> Iterable[str]:
    """The designs in the package."""
    from geneva_cli.specfile.designs import titles

    return titles()


def topics() -> Iterable[str]:
    """The pages of the manual."""
    from geneva_cli.manual import TOPICS

    return TOPICS


def explained() -> Iterable[str]:
    """The words that ``geneva explain`` explains."""
    from geneva_cli.specfile.meanings import names

    return names()


def fields() -> Iterable[str]:
    """The quantities of a design."""
    from geneva_cli.verdict.quantities.quantity_names import group_of

    return group_of()


def quantities() -> Iterable[str]:
    """The quantities that ``geneva plot`` draws."""
    from geneva_cli.study.figures import QUANTITIES

    return QUANTITIES
