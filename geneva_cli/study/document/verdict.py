"""The verdict on a design, each check, the warnings, and unknown values."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.design import Design
from geneva_cli.document import BAD, Block, Grid, Heading, Prose, Row, TextList
from geneva_cli.loads.summary import missing
from geneva_cli.study.document.facts import capital
from geneva_cli.study.document.rest import RemainingValues
from geneva_cli.study.document.sources import sources
from geneva_cli.verdict.headline import headline
from geneva_cli.verdict.strength import OF_LIFE


def verdict(design: Design, left: RemainingValues) -> tuple[str, str, tuple[str, ...]]:
    """State of a design, its verdict in a line, and the checks that fail or lack a proof."""
    state, text = headline(design.checks, design.warnings)
    left.one("passes")
    return state, capital(text), (*left.one("checks_failed"), *left.one("not_proved"))


def checks(design: Design) -> Iterator[Block]:
    """The table of all checks, with a column of remarks if there are any."""
    words = {True: "passes", False: BAD, None: "not proved"}
    heads = ["Check", "Value", "At input angle, °", "Must be", "Limit", "Verdict"]
    rows: list[Row] = [
        (c.name, c.value, c.at_deg, c.must_be, c.limit, words[c.passes]) for c in design.checks
    ]
    remarks = [c.nearest or c.why for c in design.checks]
    if any(remarks):
        heads.append("Nearest change that passes, or why there is none")
        rows = [(*row, remark) for row, remark in zip(rows, remarks, strict=True)]
    yield Heading("Checks")
    yield Grid("Every check with its verdict", tuple(heads), tuple(rows))


def warnings(left: RemainingValues) -> Iterator[Block]:
    """The list of warnings."""
    texts = tuple(left.one("warnings"))
    yield Heading("Warnings")
    yield TextList(texts) if texts else Prose("None.")


def remarks(design: Design, left: RemainingValues) -> Iterator[Block]:
    """Unknown values with the keys that they need, and sources."""
    known = design.strength.missing(OF_LIFE)  # the report lists these, and more, itself
    unknown: dict[str, None] = dict.fromkeys(missing(design.cycle))
    unknown |= dict.fromkeys(t for t in _notes(design) if t not in known)
    unknown |= dict.fromkeys(left.one("strength.needs"))
    rest = list(left.rest())
    if rest:
        yield Heading("Other answers")
        yield from rest
    if unknown:
        yield Heading("What is not known, and the key that would give it")
        yield TextList(tuple(unknown))
    yield Heading("Sources of the formulas")
    yield TextList(sources(design.spec))


def _notes(design: Design) -> tuple[str, ...]:
    """The keys that sizing and life need."""
    notes: tuple[str, ...] = design.loads_page.to_dict().get("not_known", ())
    return notes
