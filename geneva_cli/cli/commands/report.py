"""``geneva report``."""

from typing import Annotated

import typer

from geneva_cli.cli.options import Output, Settings, SpecPath, one_of, option, say
from geneva_cli.output.formats import DOCUMENTS, FORMATS

EXAMPLES = (
    "geneva report spec.toml",
    "geneva report spec.toml -o report.html",
    "geneva report spec.toml -o report.pdf",
    "geneva report spec.toml -o report.json",
)
WRITTEN = tuple(dict.fromkeys((*FORMATS, *DOCUMENTS)))


def run(
    spec: SpecPath,
    settings: Settings = None,
    output: Output = "-",
    format: Annotated[str, option("FORMAT", one_of(WRITTEN), complete=WRITTEN)] = "",
) -> None:
    """Report on a design for people: checks that fail, timing, peaks, loads, sizes.

    As html, pdf or md it is a document to hand over: the verdict, drawings, all inputs with their
    defaults, curves and every check. It lists what is not known, and the key that would give it.
    As table, csv and json it has the values alone.

    The exit status is 1 if a check fails, as with `check`.
    """
    from geneva_cli.design import load
    from geneva_cli.output import show_answer, show_document
    from geneva_cli.output.formats import is_document
    from geneva_cli.study.summary.report_summary import of_report

    is_whole = is_document(output, format)
    design = load(spec, settings or ())
    if is_whole:
        from geneva_cli.study.document import document

        show_document(document(design), output, format, design.spec.files)
    else:
        show_answer(of_report(design), output, format, design.spec.files)
    if output != "-":
        say(design.spec.path, design.warnings)
    if not design.passes:
        raise typer.Exit(1)
