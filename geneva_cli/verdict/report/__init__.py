"""One page on a design, for a person: words, timing, peaks, loads, sizes, cautions.

A section is a group of quantities in ``verdict.quantities.groups``, and its function.
"""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.analysis.loads.cycle import cycle_of
from geneva_cli.analysis.loads.summary import summaries
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.wheel_inertia import known_wheel_body
from geneva_cli.table import Table, in_digits, record_table
from geneva_cli.verdict.advice import judged
from geneva_cli.verdict.carried_cautions import carried_cautions
from geneva_cli.verdict.cautions import cautions
from geneva_cli.verdict.checks.check import Check, all_pass
from geneva_cli.verdict.cycle_cautions import cycle_cautions
from geneva_cli.verdict.load_cautions import load_cautions
from geneva_cli.verdict.quantities.groups import REPORT
from geneva_cli.verdict.quantities.groups import values as values_of
from geneva_cli.verdict.report.values import Values
from geneva_cli.verdict.report.words import words
from geneva_cli.verdict.strength import strength
from geneva_cli.verdict.turn_cautions import turn_cautions


class Report(NamedTuple):
    """A page on a design; ``passes`` as ``check`` has it, and the warnings of every format."""

    table: Table
    passes: bool
    cautions: tuple[str, ...]


def report(
    mechanism: Mechanism, proof: Proof | None = None, rows: list[Check] | None = None
) -> Report:
    """Everything about one design, as a tree of named values under a paragraph of words.

    The names are the same for every machine; a value is None where it does not apply. ``proof``
    and the checks' ``rows`` are the machine's own, where they have been made already.
    """
    proof = proof or Proof(mechanism)
    rows = judged(mechanism, proof) if rows is None else rows
    cycle = cycle_of(mechanism)
    warnings = (
        *cautions(mechanism),
        *load_cautions(mechanism),
        *cycle_cautions(cycle, summaries(cycle)),
        *carried_cautions(mechanism, known_wheel_body(mechanism)),
        *strength(mechanism).cautions(),
        *turn_cautions(proof),
    )
    passes = all_pass(rows)
    title = mechanism.spec.title
    values: Values = {
        "spec": mechanism.spec.path,
        "title": title,
        "passes": passes,
        "checks_failed": tuple(_said(c) for c in rows if c.passes is False),
        "not_proved": tuple(f"{c.name}: {c.why}" for c in rows if c.passes is None),
    }
    values |= values_of(REPORT, proof) | {"warnings": warnings}
    return Report(record_table(values, title, words(mechanism)), passes, warnings)


def _said(check: Check) -> str:
    """A failing check in a line."""
    if check.value is None or check.limit is None:
        return check.not_computed
    where = "" if check.at_deg is None else f" at {check.at_deg:.6g} deg"
    value, limit = in_digits(check.value, 6), in_digits(check.limit, 6)
    change = f"; nearest change: {check.nearest}" if check.nearest else ""
    why = f"; {check.why}" if check.why else ""
    return f"{check.name} = {value}{where}, must be {check.must_be} {limit}{change}{why}"
