"""Summaries of ``geneva check``: passing specs, failures, warnings, the tightest check."""

from __future__ import annotations

from collections.abc import Sequence

from geneva_cli.answer import FAILS, PASSES, WARNS, Answer, Summary, SummaryLine
from geneva_cli.study.verdicts import Verdict, checks_record, checks_table
from geneva_cli.verdict.headline import (
    both_ways_lines,
    failure_lines,
    headline,
    input_lines,
    proof_lines,
    tightest,
    warning_lines,
)


def of_checks(verdicts: Sequence[Verdict], page: bool, as_json: bool) -> Answer:
    """The answer on specs: a headline for each that was read, then the changes.

    The proof and the tightest check are shown for a single spec only; ``page`` shows all checks
    below.
    """
    table = checks_table(verdicts)
    data = checks_record(verdicts) if as_json else table
    judged = [v for v in verdicts if not v.error]
    if len(verdicts) == len(judged) == 1:
        (verdict,) = verdicts
        both = both_ways_lines(verdict.checks) if verdict.both_ways else ()
        lines = (*_lines(verdict), *proof_lines(verdict.checks), *both, *tightest(verdict.checks))
        summaries = [_head(verdict)._replace(lines=lines)]
    else:
        details = [Summary(v.path, lines) for v in judged if (lines := _lines(v))]
        unread = len(verdicts) - len(judged)
        summaries = [*map(_head, judged), _count(judged, unread), *details]
    return Answer(tuple(summaries), table if page else None, data)


def _head(verdict: Verdict) -> Summary:
    state, text = headline(verdict.checks, verdict.warnings)
    return Summary(f"{verdict.path}: {text}", state=state)


def _lines(verdict: Verdict) -> tuple[SummaryLine, ...]:
    checks = verdict.checks
    inputs = input_lines(verdict.with_units)
    return (*failure_lines(checks), *inputs, *warning_lines(checks, verdict.warnings))


def _count(judged: Sequence[Verdict], unread: int) -> Summary:
    states = [headline(v.checks, v.warnings)[0] for v in judged]
    failed, warned = states.count(FAILS), states.count(WARNS)
    many = len(states) + unread
    passed = many - failed - unread
    text = (
        f"{failed} of {many} specs fail{'s' * (failed == 1)}"
        if failed
        else f"{passed} of {many} specs pass{'es' * (passed == 1)}"
        if unread
        else f"all {many} specs pass"
    )
    text += f", {unread} cannot be read" if unread else ""
    text += f", {warned} with warnings" if warned else ""
    return Summary(text, state=FAILS if failed or unread else WARNS if warned else PASSES)
