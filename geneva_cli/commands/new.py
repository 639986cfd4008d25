"""``geneva new``."""

import os
from typing import Annotated

import typer

from geneva_cli.commands import completion
from geneva_cli.commands.options import Output
from geneva_cli.errors import GenevaError

EXAMPLES = (
    "geneva new curved -o curved.toml",
    "geneva new --list",
    "geneva new --from-design turret -o turret.toml",
)


def run(
    kind: Annotated[
        str,
        typer.Argument(
            metavar="[KIND]",
            help="curved, turret, a kind of drive, ...: see --list.",
            autocompletion=completion.words(completion.kinds),
        ),
    ] = "",
    from_design: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="A copy of one of the designs, as it is.",
            autocompletion=completion.words(completion.designs),
        ),
    ] = "",
    list_: Annotated[
        bool, typer.Option("--list", help="All kinds and designs, and what they are.")
    ] = False,
    output: Output = "-",
) -> None:
    """Write a commented spec to start from."""
    from geneva_cli.output import show, show_text
    from geneva_cli.specfile.template import KINDS, example, template
    from geneva_cli.table import rows_table

    if bool(kind) + bool(from_design) + list_ != 1:
        raise GenevaError("KIND, --from-design NAME or --list: give one of them")
    if list_:
        from geneva_cli.specfile.designs import titles

        kinds = [(name, "new", example(name).about) for name in KINDS]
        designs = [(name, "new --from-design", title) for name, title in titles().items()]
        show(rows_table(("name", "command", "about"), kinds + designs), output)
    elif kind:
        show_text(template(kind), output)
    else:
        _copy(from_design, output)


def _copy(name: str, output: str) -> None:
    """A design's spec, and beside it the files that it names."""
    from geneva_cli.output import show_text
    from geneva_cli.specfile.designs import design

    text, files = design(name)
    if files and output == "-":
        raise GenevaError(
            f"--from-design {name}: it needs {', '.join(files)} beside it; give -o FILE"
        )
    for file, content in files.items():
        place = os.path.join(os.path.dirname(output), file)
        if os.path.exists(place) and not _holds(place, content):
            raise GenevaError(f"{place}: another file is there; choose another folder")
        show_text(content, place)
    show_text(text, output)


def _holds(place: str, content: str) -> bool:
    with open(place, encoding="utf-8", errors="replace") as file:
        return file.read() == content
