"""The verdict on a design in one line; lines for failures and warnings; values with units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from geneva_cli.answer import FAILS, PASSES, WARNS, SummaryLine
from geneva_cli.errors import Notice, is_warning
from geneva_cli.names import spoken
from geneva_cli.output import shown, shown_text
from geneva_cli.output.document.blocks import value_text
from geneva_cli.table import Table, record_table

if TYPE_CHECKING:
    from geneva_cli.verdict.checks.check import Check


def headline(checks: Sequence[Check], warnings: Sequence[str]) -> tuple[str, str]:
    """State of a design (PASSES, WARNS or FAILS), and counts of its checks and warnings in words.

    >>> from geneva_cli.verdict.checks.check import Check
    >>> headline([Check("jerk_max", 31.4, "at most", 30.0, False)], [])
    ('fails', '1 of 1 checks fails')
    """
    from geneva_cli.verdict.failures import meaning

    many = len(checks)
    failed = sum(check.passes is False for check in checks)
    not_proved = sum(check.passes is None for check in checks)
    if failed:
        text = f"{failed} of {many} checks fail{'s' * (failed == 1)}"
    elif not_proved:
        passed = many - not_proved
        text = f"{passed} of {many} checks pass{'es' * (passed == 1)}"
    else:
        text = f"all {many} checks pass"
    if not_proved:
        text += f", {not_proved} not proved"
    for check in checks:
        if check.name == "driven_fraction" and check.passes and check.value and check.value < 1.0:
            text += f", {meaning(check)}"
    if warnings:
        text += f", {len(warnings)} warning{'s' * (len(warnings) != 1)}"
    state = FAILS if failed else WARNS if not_proved or warnings else PASSES
    return state, text


def below_summary(record: Table, *, without: Sequence[str] = ()) -> Table:
    """A record as it stands below its summary, without the warnings and the names shown there.

    Notes on unknown values remain, as ``not_known``.
    """
    values = dict(zip(record.names, next(record.rows()), strict=True))
    notes = tuple(text for text in values.pop("warnings") if not is_warning(text))
    left = {name: value for name, value in values.items() if name not in without}
    return record_table(left | ({"not_known": notes} if notes else {}), prose=record.prose)


def failure_lines(checks: Iterable[Check]) -> list[SummaryLine]:
    """A line for each check that fails."""
    return [_failure(check) for check in checks if check.passes is False]


def warning_lines(checks: Iterable[Check], warnings: Iterable[str]) -> list[SummaryLine]:
    """A line for each check without a proof, then for each warning."""
    unproved = [check for check in checks if check.passes is None]
    lines = [
        SummaryLine("not proved", f"{spoken(c.name)[0]}: {c.why}", "", WARNS) for c in unproved
    ]
    return lines + [warning(text) for text in warnings]


def warning(text: str) -> SummaryLine:
    """The line of a warning, and the command that explains it."""
    explained = f"geneva explain {text.name}" if isinstance(text, Notice) else ""
    return SummaryLine("warning", shown_text(text), explained, WARNS)


def input_lines(with_units: Iterable[str]) -> list[SummaryLine]:
    """A line for each input that has a unit in the spec's file, with the number that was read."""
    return [SummaryLine("read", text) for text in with_units]


def _failure(check: Check) -> SummaryLine:
    """The line of a failing check: its value, its limit, and the change."""
    from geneva_cli.verdict.failures import meaning

    label, unit = spoken(check.name)
    explained = f"geneva explain {check.name}"
    if check.value is None or check.limit is None:
        return SummaryLine(label, check.why, explained, FAILS)
    how = "with" if "=" in check.nearest else "by"  # a value, or leaving out a key
    advice = f"passes {how} {check.nearest}" if check.nearest else ""
    refused = check.nearest and check.name in ("parts", "full_turn")  # the reason is the text
    change = "; ".join(words for words in ("" if refused else check.why, advice) if words)
    note = f"{change} ({explained})" if change else explained
    text = check.why if refused else meaning(check) or compared_text(check, unit)
    return SummaryLine(label, text, note, FAILS)


def compared_text(check: Check, unit: str) -> str:
    """The value of a check, its place, and its limit."""
    assert check.value is not None
    assert check.limit is not None
    where = "" if check.at_deg is None else f" at {measured(check.at_deg, 'deg')}"
    where += f" {check.direction}" if check.direction else ""
    limit = measured(check.limit, unit) if unit == "deg" else bare(check.limit, unit)
    return f"{measured(check.value, unit)}{where}, {check.must_be} {limit}"


def proof_lines(checks: Iterable[Check]) -> Iterator[SummaryLine]:
    """The lines of what is proved: that no parts collide, and that a stop blocks the crank."""
    labels = {"stop_turns": "stop"}
    for check in checks:
        if check.is_proof:
            yield SummaryLine(labels.get(check.name, "turn"), check.why)


def both_ways_lines(checks: Sequence[Check]) -> Iterator[SummaryLine]:
    """The line on a machine that must turn both ways: whether it may, and what is worse."""
    worse = [spoken(check.name)[0] for check in checks if check.direction == "backwards"]
    better = any(check.direction == "forwards" for check in checks)
    shown = 3  # the table has them all
    names = ", ".join(worse[:shown]) + (f" and {len(worse) - shown} more" * (len(worse) > shown))
    text = "every check is the same in both directions"
    if worse:
        text = f"backwards is worse for {names}"
    elif better:
        text = "forwards is worse"
    failing = any(check.passes is False for check in checks)
    yield SummaryLine("both ways", f"{'no' if failing else 'yes'}: {text}")


def tightest(checks: Iterable[Check]) -> Iterator[SummaryLine]:
    """The line of the passing check with the least relative margin, or none."""
    used = [
        (fraction, check) for check in checks if (fraction := _limit_fraction(check)) is not None
    ]
    if used:
        _, check = max(used, key=lambda pair: pair[0])
        label, unit = spoken(check.name)
        yield SummaryLine("tightest", f"{label} {compared_text(check, unit)}")


def _limit_fraction(check: Check) -> float | None:
    """Fraction of its limit that a check uses, 1 at the limit; None if it has no such fraction."""
    value, limit = check.value, check.limit
    has_margin = not check.is_proof and check.name not in ("dwell_hold", "parts", "full_turn")
    if not (check.passes and value and limit and has_margin):
        return None
    return value / limit if check.must_be == "at most" else limit / value


def measured(value: float, unit: str = "", digits: int = 4) -> str:
    """A value with its unit, and with the significant digits of a sentence.

    >>> measured(8.25622, "mm"), measured(-58.2111, "deg")
    ('8.256 mm', '-58.21°')
    """
    value, unit = shown(value, unit)
    return value_text(value, "°" if unit == "deg" else unit, digits)


def bare(value: float, unit: str, digits: int = 4) -> str:
    """A value without its unit, which stands at another value of the sentence.

    >>> bare(8.25622, "mm")
    '8.256'
    """
    return value_text(shown(value, unit)[0], "", digits)
