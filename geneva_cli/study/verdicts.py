"""Checks of many specs, spread over the processor's cores, as tables and summaries."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from geneva_cli.answer import FAILS, PASSES, WARNS, Answer, Summary, SummaryLine
from geneva_cli.design import load
from geneva_cli.errors import GenevaError, Notice
from geneva_cli.parts.chosen import ByLoad
from geneva_cli.progress import tracked
from geneva_cli.study.pool import cores, mapped
from geneva_cli.table import Reading, Table, record_table, rows_table
from geneva_cli.verdict.checks import Check, all_pass
from geneva_cli.verdict.headline import (
    chosen_lines,
    failure_lines,
    headline,
    tightest,
    warning_lines,
)


class Verdict(NamedTuple):
    """The checks and warnings of one spec, or why it could not be read."""

    path: str
    passes: bool = False  # no check fails; one without a proof does not
    files: tuple[str, ...] = ()  # all files that the design was read from
    checks: tuple[Check, ...] = ()
    warnings: tuple[Notice, ...] = ()
    unused: tuple[str, ...] = ()  # names of accepted warnings that do not occur
    error: str = ""
    chosen: ByLoad = ByLoad({}, {})


def verdict(
    path: str, settings: Sequence[str] = (), to_mm: float | None = None, reverse: bool = False
) -> Verdict:
    """Return the verdict on one spec; ``settings``, texts ``KEY=VALUE``, replace its own keys.

    ``to_mm`` is the tolerance of the proof that no parts collide. With ``reverse`` the machine
    turns the other way.
    """
    try:
        design = load(path, settings, reverse)
        checks = design.checks if to_mm is None else design.proved_to(to_mm)
        return Verdict(
            path=design.spec.path,
            passes=all_pass(checks),
            files=design.spec.files,
            checks=tuple(checks),
            warnings=tuple(design.check_warnings),
            unused=tuple(design.unused_acceptances),
            chosen=design.chosen_by_load,
        )
    except GenevaError as error:
        return Verdict(path, error=str(error))


def verdicts(
    paths: list[str],
    settings: Sequence[str] = (),
    to_mm: float | None = None,
    reverse: bool = False,
) -> Iterator[Verdict]:
    """The verdicts on specs, in their order, each as ``verdict`` returns it.

    This process reads standard input (``-``) itself. Raises GenevaError if it stands there twice.
    """
    if list(paths).count("-") > 1:
        raise GenevaError("<stdin>: given twice, but it can be read only once; name it once")
    judge = partial(verdict, settings=settings, to_mm=to_mm, reverse=reverse)
    if len(paths) == 1:
        return map(judge, paths)
    files = [path for path in paths if path != "-"]
    others = mapped(judge, files, min(len(files), cores()), "specs")
    each = (judge(path) if path == "-" else next(others) for path in paths)
    return tracked(each, "specs", len(paths))


def checks_table(verdicts: Sequence[Verdict]) -> Table:
    """A table with one row for each check of each spec."""
    names = "spec", "check", "value", "at_deg", "must_be", "limit", "passes", "nearest", "why"
    rows = [
        (v.path, c.name, c.value, c.at_deg, c.must_be, c.limit, c.passes, c.nearest, c.remark)
        for v in verdicts
        for c in v.checks
    ]
    # a narrow window shows the limit rather than the angle, which is not known for most checks
    first = ("spec", "check", "value", "must_be", "limit", "passes", "nearest", "at_deg", "why")
    return rows_table(names, rows).replaced(reading=Reading(first))


def checks_record(verdicts: Sequence[Verdict]) -> Table:
    """The checks, the overall result, the warnings and the sizes by load, as json contains them.

    A spec that could not be read is a row of its own kind. Of several specs, the sizes stand below
    the path of each.
    """
    warnings = [(v.path, w.name, w.plain, w.accepted or None) for v in verdicts for w in v.warnings]
    errors = [(v.path, v.error) for v in verdicts if v.error]
    chosen = {v.path: v.chosen.record for v in verdicts}
    rows = checks_table(verdicts)
    return record_table(
        {
            "rows": (rows, rows_table(("spec", "error"), errors)) if errors else rows,
            "passes": all(v.passes for v in verdicts),
            "warnings": rows_table(("spec", "name", "text", "accepted"), warnings),
            "chosen": verdicts[0].chosen.record if len(verdicts) == 1 else chosen,
        }
    )


def of_checks(verdicts: Sequence[Verdict], page: bool, as_json: bool) -> Answer:
    """The answer on specs: a headline for each that was read, then the changes.

    The proof and the tightest check are shown for a single spec only; ``page`` shows all checks
    below.
    """
    table = checks_table(verdicts)
    data = checks_record(verdicts) if as_json else table
    judged = [v for v in verdicts if not v.error]
    is_single = len(verdicts) == len(judged) == 1
    heads, details = list[Summary](), list[Summary]()
    for v in judged:
        state, text = headline(v.checks, v.warnings)
        lines = failure_lines(v.checks) + warning_lines(v.checks, v.warnings, v.unused)
        if is_single:
            # what is proved: that no parts collide, and that a stop blocks the crank
            for check in v.checks:
                if check.passes and check.why:
                    label = "stop" if check.name == "stop_turns" else "turn"
                    lines.append(SummaryLine(label, check.why))
            lines += tightest(v.checks) + chosen_lines(v.chosen, v.path)
        elif own := lines + chosen_lines(v.chosen):
            details.append(Summary(v.path, tuple(own)))
        heads.append(Summary(f"{v.path}: {text}", tuple(lines) if is_single else (), state=state))
    if not is_single:
        many, unread = len(verdicts), len(verdicts) - len(judged)
        failed, warned = (sum(head.state == state for head in heads) for state in (FAILS, WARNS))
        passed = many - failed - unread
        text = f"all {many} specs pass"
        if failed:
            text = f"{failed} of {many} specs fail{'s' * (failed == 1)}"
        elif unread:
            text = f"{passed} of {many} specs pass{'es' * (passed == 1)}"
        text += f", {unread} cannot be read" if unread else ""
        text += f", {warned} with warnings" if warned else ""
        state = FAILS if failed or unread else WARNS if warned else PASSES
        heads.append(Summary(text, state=state))
        if sized := sum(bool(v.chosen.sizes) for v in judged):
            of = f"in {sized} of {len(judged)} specs (geneva size SPEC writes them)"
            heads.append(Summary(f"sizes chosen by load {of}"))
    return Answer((*heads, *details), table if page else None, data)
