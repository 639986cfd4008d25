"""``python -m bench`` in the tests' folder: run time against error, as ``make bench`` does."""

import os
import sys
from typing import Annotated

import typer

from bench.plot import require, svg
from bench.run import bench_table, measure, names
from geneva_cli.cli.options import Format, Output, flag, option
from geneva_cli.errors import GenevaError, cut
from geneva_cli.output import show
from geneva_cli.output.files import write
from geneva_cli.output.formats import is_for_people

app = typer.Typer(add_completion=False)


@app.command()
def run(
    subject: Annotated[
        str,
        typer.Argument(
            metavar="[SUBJECT]",
            help="peaks, cranks, many, sweep, motion, loads, slot, tolerance, vibration, turn, "
            "synth, start, export, growth or all.",
        ),
    ] = "all",
    plots: Annotated[str, option("FOLDER", "Draw each subject there, as SVG.")] = "",
    quick: Annotated[bool, flag("--quick", "Small sizes, seconds in all.")] = False,
    output: Output = "-",
    format: Format = "",
) -> None:
    """Run time against error, compared with other tools.

    Errors are against 50 digits. Times are ratios of processor time to a baseline of the same run,
    which has a row.
    """
    try:
        _print(subject, plots, quick, output, format)
    except GenevaError as error:
        print(error, file=sys.stderr)
        raise typer.Exit(2) from None


def _print(subject: str, plots: str, quick: bool, output: str, format: str) -> None:
    if plots:
        require()
        if not os.path.isdir(plots):
            raise GenevaError(f"--plots {cut(plots, 300)}: no such folder")
    people = is_for_people(output, format)
    rows, absent = [], {}
    for name in names(subject):
        about, results = measure(name, quick)
        rows += results
        absent[name] = ", ".join(about.absent)
        if plots:
            write(os.path.join(plots, f"{name}.svg"), [svg(about, results)])
    show(bench_table(rows, people), output, format)
    for name, libraries in absent.items():
        if libraries:
            note = f"{name}: {libraries} not measured, as not installed"
            print(f"{note}; pip install --group bench", file=sys.stderr)


if __name__ == "__main__":
    app()
