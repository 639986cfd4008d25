"""``geneva export``."""

import os

from geneva_cli.cli import command
from geneva_cli.errors import GenevaError, below


def run(
    design: command.Design, output: str = "", for_: str | None = None, force: bool = False
) -> None:
    """Write every file that a shop needs into a folder, and list them.

    Each part has its count and thickness in its name, as wheel-1x-18mm.dxf. Besides there are the
    drawing sheet, assembly, list of parts, report, page and spec; contents.csv lists all.

    All files are written or none. In a folder that exists, this command replaces and removes only
    files that it wrote and nobody changed since; all others stay. For a machine that jams nothing
    is written, and the exit status is 1.

    Options:
      -o, --output FOLDER  Write into this folder (required).
      --for TRADE          What laser, mill or print needs.  [default: all files]
      --force              Write a machine that jams; replace changed files.

    Examples:
      geneva export spec.toml -o turret
      geneva export spec.toml --set size.process=laser --for laser -o to-cut
      geneva export spec.toml --set size.process=print --for print -o to-print
    """
    from geneva_cli.output import show
    from geneva_cli.output.folder import Row, filling_folder
    from geneva_cli.study.export import export_files, shop_warnings, trade_of
    from geneva_cli.table import rows_table

    needed = trade_of(for_)
    if not output:
        raise GenevaError("the files need a folder: give -o FOLDER")
    if design.spec.is_turned:
        command.require_written(design, design.judge(), force)
    files, missing = export_files(design, needed)
    entries = [Row(file.name, file.content) for file in files]
    with filling_folder(output, entries, design.spec.files, force) as (folder, kept):
        for file in files:
            file.write(os.path.join(folder, file.name))
    path = design.spec.path
    rows = [(below(output, one.file), one.content) for one in entries]
    show(rows_table(("file", "content"), rows, design.spec.title))
    for one in missing:
        command.tell(f"{path}: warning: {one.name}: not written: {one.why}")
    for name in kept:
        text = "no file of this design now, but somebody changed it: it stays"
        command.tell(f"{below(output, name)}: warning: {text}")
    process = design.spec.size.process
    if for_ and process != for_:
        command.tell(
            f"{path}: warning: size.process is {process or 'not set'}, so clearances are not "
            f"those of {for_}; --set size.process={for_} sets them"
        )
    command.say(path, shop_warnings(design))
