"""The options that several commands share."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated, TypeAlias

import typer

from geneva_cli.errors import clean

if TYPE_CHECKING:
    from geneva_cli.mechanism import Mechanism

SpecPath: TypeAlias = Annotated[
    str, typer.Argument(metavar="SPEC", help="The spec, a TOML file; - reads standard input.")
]
Output: TypeAlias = Annotated[
    str,
    typer.Option("-o", "--output", metavar="FILE", help="Write to this file; - prints."),
]
Format: TypeAlias = Annotated[
    str,
    typer.Option("--format", metavar="FORMAT", help="table, csv, json or md."),
]


def warn(mechanism: Mechanism) -> None:
    """Say on standard error what a number alone would hide."""
    from geneva_cli.cautions import cautions

    for caution in cautions(mechanism):
        print(clean(f"{mechanism.spec.path}: warning: {caution}"), file=sys.stderr)
