"""``geneva explain``."""

from typing import Annotated

import typer

from geneva_cli.cli.completion import explained
from geneva_cli.cli.options import Format, Output

EXAMPLES = (
    "geneva explain",
    "geneva explain pin stress",
    "geneva explain turns-back",
    "geneva explain loads.pin_force_N.max --format json",
)


def run(
    words: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[CHECK|QUANTITY|KIND]",
            help="horn_mm, acceleration.max, side-crank, a warning, a part, ...; without one: all.",
            autocompletion=explained,
        ),
    ] = None,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Explain a word of the output: meaning, formula, unit, source, what to do, manual page."""
    from geneva_cli.output import show, show_markdown, show_text
    from geneva_cli.output.formats import is_for_people
    from geneva_cli.specfile.meanings import Meaning, as_markdown, listed, meanings
    from geneva_cli.table import Reading, rows_table

    word = " ".join(words or ())
    if not word:
        reading = Reading(("name", "about"))
        table = rows_table(("group", "name", "about"), listed()).replaced(reading=reading)
        show(table, output, format)
        return
    entries = meanings(word)
    if not is_for_people(output, format):
        show(rows_table(Meaning._fields, entries), output, format)
    elif output == "-":
        show_markdown(as_markdown(entries))
    else:
        show_text(as_markdown(entries), output)
