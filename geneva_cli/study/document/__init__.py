"""A design as a document: its verdict, and then everything about it, in a fixed order.

Every value is a result of the Design. Values of its report that no section takes stand at the end.
"""

from __future__ import annotations

from geneva_cli.design import Design
from geneva_cli.output.document.blocks import Document, Prose
from geneva_cli.study.document import answers, facts, verdict
from geneva_cli.study.document.facts import RemainingValues
from geneva_cli.study.document.verdict import key_figures
from geneva_cli.study.summary.load_lines import title_of


def document(design: Design) -> Document:
    """The document of a design. Raises GenevaError for a spec that makes no machine.

    >>> from geneva_cli.study.document import document
    >>> page = document(Design(External(6)))
    >>> page.title, page.state, page.verdict
    ('Geneva wheel of 6 slots', 'passes', 'All 16 checks pass')
    """
    table = design.report.table
    left = RemainingValues(dict(zip(table.names, next(table.rows()), strict=True)))
    for name in ("spec", "title"):  # the document's title shows them
        left.one(name)
    left.take("inputs")  # all of them, and more, are in the spec
    state, headline, reasons = verdict.verdict(design, left)
    blocks = (
        Prose(table.prose),
        *verdict.drawn(design),
        key_figures(design),
        *verdict.warnings(left),
        *facts.inputs(design.spec, design.with_units),
        *answers.timing(left, design.spec.drive.n_rpm, design.spec.output),
        *verdict.curves(design),
        *answers.loads(design, left),
        *answers.special(left),
        *answers.sizes(left),
        *answers.strength(left),
        *verdict.checks(design),
        *answers.both_ways(left),
        *answers.swinging(left),
        *answers.parts(left),
        *verdict.remarks(design, left),
        *facts.defaults(design.spec),
    )
    return Document(title_of(design), state, headline, reasons, blocks)
