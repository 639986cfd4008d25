"""A report on a design for people: words, timing, peaks, loads, sizes, warnings.

A section is a group of quantities in ``verdict.quantities.groups``, and its function.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.errors import Notice
from geneva_cli.parts.parts import Parts
from geneva_cli.table import Table, in_digits, record_table
from geneva_cli.verdict.checks.check import Check, all_pass
from geneva_cli.verdict.quantities.batch_designs import Values
from geneva_cli.verdict.quantities.groups import REPORT
from geneva_cli.verdict.quantities.groups import values as values_of


class Report(NamedTuple):
    """A report on a design; ``passes`` is the result of ``check``."""

    table: Table
    passes: bool


def report(parts: Parts, rows: Sequence[Check], warnings: Sequence[Notice]) -> Report:
    """Everything about one design, as a tree of named values under a paragraph of words.

    The names are equal for every machine; a value is None if it does not apply. ``rows`` and
    ``warnings`` are the checks and the warnings of the machine of ``parts``.
    """
    mechanism = parts.mechanism
    passes = all_pass(rows)
    title = mechanism.spec.title
    values: Values = {
        "spec": mechanism.spec.path,
        "title": title,
        "passes": passes,
        "checks_failed": tuple(_in_one_line(c) for c in rows if c.passes is False),
        "not_proved": tuple(f"{c.name}: {c.why}" for c in rows if c.passes is None),
    }
    from geneva_cli.verdict.report.words import words  # the loads take their values without it

    values |= values_of(REPORT, parts) | {"warnings": tuple(warnings)}
    return Report(record_table(values, title, words(mechanism)), passes)


def _in_one_line(check: Check) -> str:
    """A failing check in one line."""
    if check.value is None or check.limit is None:
        return check.not_computed
    where = "" if check.at_deg is None else f" at {check.at_deg:.6g}°"
    where += f" {check.direction}" if check.direction else ""
    value, limit = in_digits(check.value, 6), in_digits(check.limit, 6)
    change = f"; nearest change: {check.nearest}" if check.nearest else ""
    why = f"; {check.why}" if check.why else ""
    return f"{check.name} = {value}{where}, must be {check.must_be} {limit}{change}{why}"
