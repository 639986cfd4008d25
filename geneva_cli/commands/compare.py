"""``geneva compare``."""

from typing import Annotated

import typer

from geneva_cli.commands import completion
from geneva_cli.commands.options import Format, Output, Settings

EXAMPLES = ("geneva compare spec.toml --vary wheel.z=4,6,8 --pick dwell_s,acceleration.max",)


def run(
    specs: Annotated[list[str], typer.Argument(metavar="SPEC...", help="Specs, TOML files.")],
    vary: Annotated[
        list[str] | None,
        typer.Option(
            metavar="KEY=VALUES",
            help="One spec with several values: drive.A=0,0.3,0.6.",
            autocompletion=completion.keys,
        ),
    ] = None,
    pick: Annotated[
        str,
        typer.Option(
            metavar="FIELD,...",
            help="Only these, as acceleration.max,dwell_s.",
            autocompletion=completion.listed(completion.fields),
        ),
    ] = "",
    ratio: Annotated[
        bool, typer.Option("--ratio", help="Numbers over the first design's.")
    ] = False,
    differing: Annotated[bool, typer.Option("--differing", help="Only what differs.")] = False,
    settings: Settings = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Designs side by side: a column for each design, a row for each quantity."""
    from geneva_cli.output import refuse_inches, show
    from geneva_cli.study.compare import compare

    if ratio:
        refuse_inches("ratios have no unit")
    picks = [name.strip() for name in pick.split(",")] if pick else []
    table = compare(specs, settings or (), vary or (), picks, ratio, not differing)
    show(table, output, format, specs)
