"""Options of several commands."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

import typer

from geneva_cli.errors import Notice, clean
from geneva_cli.output.formats import FORMATS

if TYPE_CHECKING:
    from geneva_cli.design import Design


def one_of(names: Iterable[str]) -> str:
    """The allowed words of an option, for its help."""
    *others, last = names
    return f"{', '.join(others)} or {last}."


def option(
    metavar: str,
    help: str,
    heading: str | None = None,
    *,
    name: str = "",
    default: str | bool = True,
) -> Any:
    """An option with a value, below a heading of the help.

    ``name`` is its name where the parameter's is another, and ``default`` is shown as the default.
    """
    return typer.Option(
        *([name] if name else []),
        metavar=metavar,
        help=help,
        rich_help_panel=heading,
        show_default=default,
    )


def flag(name: str, help: str, heading: str | None = None) -> Any:
    """An option without a value, below a heading of the help."""
    return typer.Option(name, help=help, rich_help_panel=heading)


def output_option(metavar: str, help: str, default: bool = False) -> Any:
    """The option ``-o`` of a file or folder to write; ``default`` shows its default."""
    return typer.Option("-o", "--output", metavar=metavar, help=help, show_default=default)


SpecPath: TypeAlias = Annotated[
    str, typer.Argument(metavar="SPEC", help="The spec, a TOML file; - reads standard input.")
]
Settings: TypeAlias = Annotated[
    list[str] | None,
    option(
        "KEY=VALUE",
        "Set a key over the file's, as drive.n_rpm=90.",
        name="--set",
    ),
]
Reverse: TypeAlias = Annotated[bool, flag("--reverse", "Turn the input the other way.")]
AlsoReverse: TypeAlias = Annotated[
    bool, flag("--reverse", "Also each design turning the other way.")
]
Output: TypeAlias = Annotated[str, output_option("FILE", "Write to this file; - prints.")]
Format: TypeAlias = Annotated[str, option("FORMAT", one_of(FORMATS), name="--format")]


def outline_settings(wheel: str | None, crank: str | None, slack: float | None) -> list[str]:
    """The settings of ``[outline]`` that options stand for; files are those of this folder."""
    files = (("wheel", wheel), ("crank", crank))
    out = [f"outline.{name}={os.path.abspath(path)}" for name, path in files if path is not None]
    return out if slack is None else [*out, f"outline.slack_mm={slack}"]


def warn(design: Design) -> None:
    """Print the warnings about the motion on standard error."""
    say(design.spec.path, design.motion_warnings)


def say(path: str, warnings: Iterable[str]) -> None:
    """Print warnings about a spec on standard error, one a line, with names for `explain`."""
    for text in warnings:
        named, kind = text, "warning"
        if isinstance(text, Notice):
            named = f"{text.plain} [{text.name}]"
            kind = f"warning, accepted ({text.accepted})" if text.accepted else kind
        print(clean(f"{path}: {kind}: {named}"), file=sys.stderr)


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
