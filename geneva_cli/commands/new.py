"""``geneva new``."""

from __future__ import annotations

from typing import Annotated

import typer

from geneva_cli.commands.options import Output


def run(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="KIND",
            help="external, internal, spherical, rollers, curved or a kind of drive.",
        ),
    ],
    output: Output = "-",
) -> None:
    """Write a commented spec to start from."""
    from geneva_cli.output import show_text
    from geneva_cli.specfile.template import template

    show_text(template(kind), output)
