"""Options of several commands."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from geneva_cli.commands import completion
from geneva_cli.errors import Notice, clean
from geneva_cli.output.formats import FORMATS

if TYPE_CHECKING:
    from geneva_cli.design import Design


def one_of(names: Iterable[str]) -> str:
    """The allowed words of an option, for its help."""
    *others, last = names
    return f"{', '.join(others)} or {last}."


SpecPath: TypeAlias = Annotated[
    str, typer.Argument(metavar="SPEC", help="The spec, a TOML file; - reads standard input.")
]
Settings: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Set a key over the file's, as drive.n_rpm=90.",
        autocompletion=completion.keys,
    ),
]
Reverse: TypeAlias = Annotated[
    bool, typer.Option("--reverse", help="Turn the input the other way.")
]
AlsoReverse: TypeAlias = Annotated[
    bool, typer.Option("--reverse", help="Also each design turning the other way.")
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
    """Print the warnings about the motion on standard error."""
    say(design.spec.path, design.motion_warnings)


def say(path: str, warnings: Iterable[str]) -> None:
    """Print warnings about a spec on standard error, one a line."""
    for warning in warnings:
        print(clean(f"{path}: warning: {with_name(warning)}"), file=sys.stderr)


def with_name(warning: str) -> str:
    """A warning with its name for ``geneva explain``."""
    return f"{warning} [{warning.name}]" if isinstance(warning, Notice) else warning


def require_written(design: Design, verdict: tuple[str, list[str]], force: bool) -> None:
    """Exit with status 1 for parts that overlap or cannot be built, unless forced; else warn."""
    path = design.spec.path
    refused, warned = verdict
    if refused and not force:
        text = f"not written: {refused}; --force writes it anyway"
        print(clean(f"{path}: {text}"), file=sys.stderr)
        raise typer.Exit(1)
    for text in [refused, *warned] if refused else warned:
        print(clean(f"{path}: warning: {text}"), file=sys.stderr)
