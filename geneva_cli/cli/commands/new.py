"""``geneva new``."""

import os

from geneva_cli.errors import GenevaError, below


def run(
    kind: str = "",
    from_design: str = "",
    list_: bool = False,
    all_: bool = False,
    force: bool = False,
    output: str = "-",
) -> None:
    """Write a short commented spec to start from; --all for every key.

    `geneva check` judges it, and `geneva size` writes the sizes that it leaves out, so that they
    stay. An existing file is kept, unless --force is given. For editors: `geneva help spec`.

    Arguments:
      [KIND]  curved, turret, a kind of drive, ...: see --list.

    Options:
      --from-design NAME  A copy of one of the designs, as it is.
      --list              All kinds and designs, and what they are.
      --all               Every key that the kind can have, with its default.
      --force             Replace files that exist.

    Examples:
      geneva new external -o wheel.toml
      geneva new --list
      geneva new --from-design turret -o turret.toml
    """
    from geneva_cli.output import show
    from geneva_cli.specfile.keys import FILE
    from geneva_cli.specfile.template import KINDS, design, example, template, titles
    from geneva_cli.table import Reading, rows_table

    if bool(kind) + bool(from_design) + list_ != 1:
        raise GenevaError("KIND, --from-design NAME or --list: give one of them")
    if all_ and not kind:
        raise GenevaError("--all goes with KIND")
    if list_:
        kinds = [(name, "new", example(name)[0]) for name in KINDS]
        designs = [(name, "new --from-design", title) for name, title in titles().items()]
        names, first = ("name", "command", "about"), Reading(("name", "about"))
        show(rows_table(names, kinds + designs, reading=first), output)
    elif kind:
        # the spec names the JSON Schema only if that is in its folder
        is_beside = output != "-" and os.path.isfile(os.path.join(os.path.dirname(output), FILE))
        _write(template(kind, is_beside, all_), output, {}, force)
    else:
        text, files = design(from_design)
        if files and output == "-":
            raise GenevaError(
                f"--from-design {from_design}: it needs {', '.join(files)} in its folder; "
                "give -o FILE"
            )
        _write(text, output, files, force)


def _write(text: str, output: str, files: dict[str, str], force: bool) -> None:
    """Write a spec, and the files that it names into its folder."""
    from geneva_cli.output import refuse_existing, show_text

    places = {below(os.path.dirname(output), name): content for name, content in files.items()}
    for place in () if force else (output, *places):
        refuse_existing(place)
    for place, content in places.items():
        show_text(content, place)
    show_text(text, output)
