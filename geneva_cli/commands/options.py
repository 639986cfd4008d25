"""The options that several commands share."""

from __future__ import annotations

from typing import Annotated, TypeAlias

import typer

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
