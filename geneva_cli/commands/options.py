"""The options that several commands share."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from geneva_cli.commands import completion
from geneva_cli.errors import Caution, clean
from geneva_cli.output.formats import FORMATS

if TYPE_CHECKING:
    from geneva_cli.design import Design


def one_of(names: Iterable[str]) -> str:
    """The words that an option may be, for its help."""
    *others, last = names
    return f"{', '.join(others)} or {last}."


SpecPath: TypeAlias = Annotated[
    str, typer.Argument(metavar="SPEC", help="The spec, a TOML file; - reads standard input.")
]
Given: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="A key over the file's, as drive.n_rpm=90.",
        autocompletion=completion.keys,
    ),
]
Output: TypeAlias = Annotated[
    str,
    typer.Option(
        "-o",
        "--output",
        metavar="FILE",
        help="Write to this file; - prints.",
        show_default=False,
    ),
]
Format: TypeAlias = Annotated[
    str,
    typer.Option(
        "--format",
        metavar="FORMAT",
        help=one_of(FORMATS),
        autocompletion=completion.words(lambda: FORMATS),
    ),
]


def warn(design: Design) -> None:
    """Say on standard error what a number alone would hide."""
    say(design.spec.path, design.warnings)


def say(path: str, cautions: Iterable[str]) -> None:
    """Cautions about a spec, a line each."""
    for caution in cautions:
        print(clean(f"{path}: warning: {with_name(caution)}"), file=sys.stderr)


def with_name(caution: str) -> str:
    """A caution with the name by which ``geneva explain`` has it."""
    return f"{caution} [{caution.name}]" if isinstance(caution, Caution) else caution
