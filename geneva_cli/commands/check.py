"""``geneva check``."""

import sys
from typing import Annotated

import typer

from geneva_cli.commands.options import Format, Given, Output, with_name
from geneva_cli.errors import clean

EXAMPLES = (
    "geneva check spec.toml",
    "geneva check spec.toml --set size.slot_clearance_mm=0.05",
)


def run(
    specs: Annotated[list[str], typer.Argument(metavar="SPEC...", help="Specs, TOML files.")],
    given: Given = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Does the design work? One line a check; exit status 1 where one fails.

    The motion, the parts and the spec's own [limits]; where a check fails, the nearest change that
    passes. Every spec is checked, also beside one that cannot be read.
    """
    from geneva_cli.output import show
    from geneva_cli.study.batch import checks_table, verdicts

    found = list(verdicts(specs, given or ()))
    judged = [v for v in found if not v.error]
    if judged:
        show(checks_table(judged), output, format, [file for v in judged for file in v.files])
    for v in found:
        for said in (
            [v.error] if v.error else [f"{v.path}: warning: {with_name(c)}" for c in v.cautions]
        ):
            print(clean(said), file=sys.stderr)
    if not all(v.passes for v in found):
        raise typer.Exit(2 if len(judged) < len(found) else 1)
