"""The verdict on a design, each check, the warnings, and unknown values."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.analysis.loads.summary import missing
from geneva_cli.design import Design
from geneva_cli.document import BAD, Block, Grid, Heading, Prose, TextList
from geneva_cli.study.document.left import Left
from geneva_cli.study.document.named import capital
from geneva_cli.study.document.sources import sources
from geneva_cli.verdict.headline import headline
from geneva_cli.verdict.strength import OF_LIFE

WORDS = {True: "passes", False: BAD, None: "not proved"}
HEADS = (
    "Check",
    "Value",
    "At input angle, °",
    "Must be",
    "Limit",
    "Verdict",
    "Nearest change that passes, or why there is none",
)


def verdict(design: Design, left: Left) -> tuple[str, str, tuple[str, ...]]:
    """State of a design, its verdict in a line, and the checks that fail or lack a proof."""
    state, text = headline(design.checks, design.warnings)
    left.one("passes")
    return state, capital(text), (*left.one("checks_failed"), *left.one("not_proved"))


def checks(design: Design) -> Iterator[Block]:
    """Every check."""
    rows = tuple(
        (c.name, c.value, c.at_deg, c.must_be, c.limit, WORDS[c.passes], c.nearest or c.why)
        for c in design.checks
    )
    yield Heading("Checks")
    told = len(HEADS) if any(c.nearest or c.why for c in design.checks) else len(HEADS) - 1
    yield Grid("Every check with its verdict", HEADS[:told], tuple(r[:told] for r in rows))


def warned(left: Left) -> Iterator[Block]:
    """The warnings."""
    warnings = tuple(left.one("warnings"))
    yield Heading("Warnings")
    yield TextList(warnings) if warnings else Prose("None.")


def said(design: Design, left: Left) -> Iterator[Block]:
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
