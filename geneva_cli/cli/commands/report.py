"""``geneva report``."""

import typer

from geneva_cli.cli.command import Design, say
from geneva_cli.output import DOCUMENTS, FORMATS, choice, chosen, show_answer, show_document


def run(design: Design, full: bool = False, output: str = "-", format: str = "") -> None:
    """Report on a design on two pages: verdict, motor, greatest loads and limits, parts, warnings.

    As html or pdf it has a picture of the machine too. With --full it is a document of all inputs
    with their defaults, curves, sizes and every check. It lists what is not known, and the key that
    would give it. As csv and json it has all values alone.

    The exit status is 1 if a check fails, as with `check`.

    Options:
      --full           All inputs, curves, sizes, checks too.
      --format FORMAT  table, csv, json, md, html or pdf.

    Examples:
      geneva report spec.toml
      geneva report spec.toml -o report.pdf
      geneva report spec.toml --full -o report.html
      geneva report spec.toml -o report.json
    """
    from geneva_cli.study.summary.report_summary import of_report

    if chosen(output, format, FORMATS | DOCUMENTS) in DOCUMENTS:
        from geneva_cli.study.document import document, short_document

        made = document(design) if full else short_document(design)
        show_document(made, output, format, design.spec.files)
    else:
        answer = of_report(design, full or bool(choice.columns))
        show_answer(answer, output, format, design.spec.files)
    if output != "-":
        say(design.spec.path, design.warnings)
    if not design.passes:
        raise typer.Exit(1)
