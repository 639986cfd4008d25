"""``geneva check``."""

from __future__ import annotations

from typing import Annotated

import typer

from geneva_cli.commands.options import Format, Output, warn


def run(
    specs: Annotated[list[str], typer.Argument(metavar="SPEC...", help="Specs, TOML files.")],
    output: Output = "-",
    format: Format = "",
) -> None:
    """Does the design work? One line a check; exit status 1 where one fails.

    The motion and the spec's own [limits]; where a check fails, the nearest change that passes.
    """
    from geneva_cli.checks import NAMES, checks_table
    from geneva_cli.output import show
    from geneva_cli.spec import load

    mechanisms = [load(spec) for spec in specs]
    table = checks_table(mechanisms)
    show(table, output, format, [file for m in mechanisms for file in m.spec.files])
    for mechanism in mechanisms:
        warn(mechanism)
    if not all(table.columns[NAMES.index("passes")]):
        raise typer.Exit(1)
