"""``geneva plot``."""

from geneva_cli.cli.command import say, words_in
from geneva_cli.errors import GenevaError, cut


def run(
    specs: tuple[str, ...],
    pick: str = "",
    x: str = "",
    y: str = "",
    vary: tuple[str, ...] = (),
    reverse: bool = False,
    settings: tuple[str, ...] = (),
    output: str = "-",
    format: str = "",
) -> None:
    """Plot curves over a cycle, exact at peaks and jumps; or columns of a csv, such as a sweep's.

    Without -o it prints points. png needs the extra geneva-cli[plot]. `geneva help plots`.

    Arguments:
      SPEC...  Specs, TOML files; or one .csv, as of a sweep.

    Options:
      --pick QUANTITY,...  Only these, as velocity,pin_force_N.
      --x COLUMN           Column of a csv for the x axis.
      --y COLUMN,...       Columns of a csv for the y axis.
      --vary KEY=VALUES    One spec with several values: wheel.z=4,6,8.
      --reverse            Also each design turning the other way.
      --format FORMAT      svg, png, pdf, or of the points table, csv, json or md.

    Examples:
      geneva plot spec.toml --pick velocity
      geneva plot spec.toml -o motion.svg
      geneva plot spec.toml --vary wheel.z=6,8,10 --pick acceleration -o several.svg
    """
    from geneva_cli.output import FORMATS, PLOTTED, chosen, show_figure
    from geneva_cli.study.compare import designs_of, of_designs, of_table

    chosen(output, format, (*PLOTTED, *FORMATS))  # refuse a wrong format before any computation
    tables = [path for path in specs if path.lower().endswith(".csv")]
    if tables:
        name = cut(tables[0], 300)
        if len(specs) > 1:
            raise GenevaError(f"{name}: a csv is plotted by itself, without other files")
        if pick or settings or vary:
            raise GenevaError(f"--pick, --set, --vary: for specs; for {name} give --x and --y")
        show_figure(of_table(tables[0], x, words_in(y)), output, format, tables)
        return
    if x or y:
        raise GenevaError(f"--x and --y are for a .csv; for {cut(specs[0], 300)} give --pick")
    designs = designs_of(specs, settings, vary, reverse)
    figure, left_out = of_designs(designs, words_in(pick))
    show_figure(figure, output, format, [x for d in designs.values() for x in d.spec.files])
    for design in designs.values():
        say(design.spec.path, design.motion_warnings)
        say(design.spec.path, design.ideal_notes)
    for path, text in left_out:
        say(path, [text])
