"""A design as a document: its verdict, and then everything about it, in a fixed order."""

from __future__ import annotations

from geneva_cli.design import Design
from geneva_cli.output.document.blocks import Document, Prose
from geneva_cli.study.document import facts, sections
from geneva_cli.study.document.facts import RemainingValues, capital
from geneva_cli.study.summary.load_lines import title_of
from geneva_cli.study.summary.report_summary import key_figures, machine_lines
from geneva_cli.verdict.headline import headline


def short_document(design: Design) -> Document:
    """The document of a design for a first reader, on two pages.

    It has the verdict, a picture, the machine in words, the motor, the greatest loads with their
    limits, the parts and the warnings. Raises GenevaError for a spec that makes no machine.
    """
    state, text = headline(design.checks, design.warnings)
    table = design.report.table
    blocks = (
        Prose(table.prose),
        *sections.drawn(design),
        sections.in_short(machine_lines(design)),
        *sections.greatest(design),
        *sections.parts_in_short(design),
        *sections.warnings(tuple(design.warnings)),
        Prose("All inputs, curves, sizes and checks: geneva report SPEC --full -o FILE."),
    )
    reasons = (*table["checks_failed"], *table["not_proved"])
    return Document(title_of(design), state, capital(text), reasons, blocks)


def document(design: Design) -> Document:
    """The whole document of a design. Raises GenevaError for a spec that makes no machine.

    Values of its report that no section takes stand at the end.

    >>> from geneva_cli.study.document import document
    >>> page = document(Design(External(6)))
    >>> page.title, page.state, page.verdict
    ('Geneva wheel of 6 slots', 'passes', 'All 16 checks pass')
    """
    table = design.report.table
    left = RemainingValues(dict(zip(table.names, next(table.rows()), strict=True)))
    # the document's title, its verdict and its key figures show them
    for name in ("spec", "title", "passes", "chosen"):
        left.one(name)
    left.take("inputs")  # all of them, and more, are in the spec
    state, text = headline(design.checks, design.warnings)
    reasons = (*left.one("checks_failed"), *left.one("not_proved"))
    blocks = (
        Prose(table.prose),
        *sections.drawn(design),
        sections.in_short(key_figures(design)),
        *sections.warnings(tuple(left.one("warnings"))),
        *facts.inputs(design.spec, design.with_units),
        *sections.timing(left, design.spec.drive.n_rpm, design.spec.output),
        *sections.curves(design),
        *sections.loads(design, left),
        *sections.special(left),
        *sections.sizes(left),
        *sections.strength(left),
        *sections.checks(design),
        *sections.swinging(left),
        *sections.parts(left),
        *sections.remarks(design, left),
        *facts.defaults(design.spec),
    )
    return Document(title_of(design), state, capital(text), reasons, blocks)
