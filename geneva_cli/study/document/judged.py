"""What is to be thought of a design: the verdict, each check, and what else is to be said."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.analysis.loads.summary import missing
from geneva_cli.design import Design
from geneva_cli.document import BAD, Block, Grid, Heading, Listed, Prose
from geneva_cli.study.document.left import Left
from geneva_cli.study.document.sources import sources
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


def verdict(design: Design, left: Left) -> tuple[str, tuple[str, ...]]:
    """In a line whether it works, and the checks that fail or could not be made."""
    failed, open_ = left.one("checks_failed"), left.one("not_proved")
    left.one("passes")
    many = len(design.checks)
    if failed:
        some = "a check" if len(failed) == 1 else f"{len(failed)} checks"
        return f"Fails {some} of {many}", (*failed, *open_)
    if open_:
        made = many - len(open_)
        return f"Passes {made} check{'s' * (made != 1)}; {len(open_)} cannot be proved", open_
    return f"Passes all {many} checks", ()


def checks(design: Design) -> Iterator[Block]:
    """Every check."""
    rows = tuple(
        (c.name, c.value, c.at_deg, c.must_be, c.limit, WORDS[c.passes], c.nearest or c.why)
        for c in design.checks
    )
    yield Heading("Checks")
    told = len(HEADS) if any(c.nearest or c.why for c in design.checks) else len(HEADS) - 1
    yield Grid("Every check with its verdict", HEADS[:told], tuple(r[:told] for r in rows))


def said(design: Design, left: Left) -> Iterator[Block]:
    """Warnings, what is not known and would be by which key, and sources."""
    cautions = tuple(left.one("warnings"))
    of_loads = design.loads_page.to_dict()["warnings"]  # the keys that sizing needs among them
    known = {*cautions, *design.strength.missing(OF_LIFE)}  # these, and more, are the report's own
    unknown = dict.fromkeys(missing(design.cycle))
    unknown |= dict.fromkeys(text for text in of_loads if text not in known)
    unknown |= dict.fromkeys(left.one("strength.needs"))
    rest = list(left.rest())
    if rest:
        yield Heading("Other answers")
        yield from rest
    yield Heading("Warnings")
    yield Listed(cautions) if cautions else Prose("None.")
    if unknown:
        yield Heading("What is not known, and the key that would give it")
        yield Listed(tuple(unknown))
    yield Heading("Sources of the formulas")
    yield Listed(sources(design.spec))
