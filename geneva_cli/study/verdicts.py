"""Checks of many specs, spread over the processor's cores, as tables and summaries."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import filterfalse
from operator import attrgetter
from typing import NamedTuple

from geneva_cli.answer import FAILS, PASSES, WARNS, Answer, Summary, SummaryLine
from geneva_cli.design import load
from geneva_cli.errors import GenevaError, Notice
from geneva_cli.names import spoken
from geneva_cli.output import choice
from geneva_cli.parts.chosen import ByLoad
from geneva_cli.progress import tracked
from geneva_cli.study.pool import cores, mapped
from geneva_cli.table import Reading, Table, record_table, rows_table
from geneva_cli.verdict.checks import Check, all_pass
from geneva_cli.verdict.failures import compared_text, meaning

# yes or no, and what a machine that turns always keeps
WITHOUT_MARGIN = ("dwell_hold", "parts", "full_turn", "turns", "turning_slack_mm")


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
    """Return the verdict on one spec; ``settings``, texts ``KEY=VALUE``, replace its own keys."""
    try:
        design = load(path, settings, reverse)
        if design.spec.is_loaded and not design.is_drawn:
            from geneva_cli.loads.strength.part_loads import single_loads
            from geneva_cli.verdict.quantities.groups import value_of

            # loads, the parts that they size, their strength: what checks and warnings read
            with suppress(GenevaError):  # a check says why
                single_loads(design.mechanism)
                _ = design.cycle.ends, design.parts.built.required
                for part in ("wheel_shaft", "horn", "lock"):
                    value_of(design.mechanism, f"strength.{part}.margin")
        checks = design.checks if to_mm is None else design.proved_to(to_mm)
        return Verdict(
            path=design.spec.path,
            passes=all_pass(checks),
            files=design.spec.files,
            checks=tuple(checks),
            warnings=tuple(design.check_warnings if design.is_drawn else design.warnings),
            unused=tuple(design.unused_acceptances) if design.spec.accept.reasons else (),
            chosen=design.chosen_by_load,
        )
    except GenevaError as error:
        return Verdict(path, error=str(error))


def verdicts(
    paths: Sequence[str],
    settings: Sequence[str] = (),
    to_mm: float | None = None,
    reverse: bool = False,
) -> Iterator[Verdict]:
    """The verdicts on specs, in their order, each as ``verdict`` returns it."""
    if list(paths).count("-") > 1:
        raise GenevaError("<stdin>: given twice, but it can be read only once; name it once")
    judge = partial(verdict, settings=settings, to_mm=to_mm, reverse=reverse)
    if len(paths) == 1:
        return map(judge, paths)
    files = [path for path in paths if path != "-"]
    others = mapped(judge, files, min(len(files), cores()))
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
    return rows_table(names, rows, reading=Reading(first))


def checks_record(verdicts: Sequence[Verdict]) -> Table:
    """The checks, the overall result, the warnings and the sizes by load, as json contains them."""
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
    """The answer on specs: a headline for each that was read, then the changes."""
    # a page for people has the table only where it or some of its columns are asked for
    is_shown = page or choice.columns
    table = checks_table(verdicts) if is_shown else Table((), ())
    data = checks_record(verdicts) if as_json else table
    is_single, judged = len(verdicts) == 1, [*filterfalse(attrgetter("error"), verdicts)]
    heads, details = list[Summary](), list[Summary]()
    for v in judged:
        state, text = headline(v.checks, v.warnings)
        lines = [*failure_lines(v.checks), *warning_lines(v.checks, v.warnings, v.unused)]
        if is_single:
            # what is proved: that no parts collide, and that a stop blocks the crank
            for check in v.checks:
                if check.passes and check.why:
                    label = "stop" if check.name == "stop_turns" else "turn"
                    lines.append(SummaryLine(label, check.why))
            lines += tightest(v.checks)
        lines += chosen_lines(v.chosen, v.path if is_single else None)
        if lines and not is_single:
            details.append(Summary(v.path, tuple(lines)))
        heads.append(Summary(f"{v.path}: {text}", tuple(lines) if is_single else (), state=state))
    if not is_single:
        unread = len(verdicts) - len(judged)
        failed, warned = (sum(head.state == state for head in heads) for state in (FAILS, WARNS))
        text = _counted("specs", len(verdicts), failed, unread)
        text += f", {unread} cannot be read" if unread else ""
        text += f", {warned} with warnings" if warned else ""
        state = FAILS if failed or unread else WARNS if warned else PASSES
        heads.append(Summary(text, state=state))
        if sized := sum(bool(v.chosen.sizes) for v in judged):
            of = f"in {sized} of {len(judged)} specs (geneva size SPEC writes them)"
            heads.append(Summary(f"sizes chosen by load {of}"))
    return Answer((*heads, *details), table if page else None, data)


def headline(checks: Sequence[Check], warnings: Sequence[Notice]) -> tuple[str, str]:
    """State of a design (PASSES, WARNS or FAILS), and counts of its checks and warnings in words.

    >>> from geneva_cli.verdict.checks import Check
    >>> headline([Check("jerk_max", 31.4, "at most", 30.0, False)], [])
    ('fails', '1 of 1 checks fails')
    """
    states = [*map(attrgetter("passes"), checks)]
    failed, not_proved = states.count(False), states.count(None)
    text = _counted("checks", len(states), failed, not_proved)
    text += f", {not_proved} not proved" if not_proved else ""
    for check in checks:
        if check.name == "driven_fraction" and check.passes and check.value and check.value < 1.0:
            text += f", {meaning(check)}"
    accepted = len([*filter(attrgetter("accepted"), warnings)])
    left = len(warnings) - accepted
    for count, end in ((left, ""), (accepted, " accepted")):
        text += f", {count} warning{'s' * (count != 1)}{end}" if count else ""
    state = FAILS if failed else WARNS if not_proved or left else PASSES
    return state, text


def _counted(what: str, many: int, failed: int, unknown: int) -> str:
    """The number that fails, or else that passes, in words."""
    if not (failed or unknown):
        return f"all {many} {what} pass"
    count, verb, end = (failed, "fail", "s") if failed else (many - unknown, "pass", "es")
    return f"{count} of {many} {what} {verb}{end * (count == 1)}"


def chosen_lines(by_load: ByLoad, path: str | None = None) -> Iterator[SummaryLine]:
    """The lines of the sizes that the load chose, for a spec's path, and an option chose anew."""
    if path is not None and (words := by_load.words):
        name = {"": "SPEC", "<stdin>": "-"}.get(path, path)
        text = f"chosen by load: {words} (geneva size {name} writes them)"
        yield SummaryLine("sizes", text)
    if changes := by_load.changes:
        yield SummaryLine("note", f"sizes chosen anew: {changes}")


def failure_lines(checks: Iterable[Check]) -> Iterator[SummaryLine]:
    """A line for each check that fails: its value, its limit, and the change."""
    for check in checks:
        if check.passes is not False:
            continue
        label, explained = spoken(check.name)[0], f"geneva explain {check.name}"
        if check.value is None or check.limit is None:
            yield SummaryLine(label, check.why, explained, FAILS)
            continue
        how = "with" if "=" in check.nearest else "by"  # a value, or leaving out a key
        advice = f"passes {how} {check.nearest}" if check.nearest else ""
        advice += f" (sizes chosen anew: {check.anew})" if check.anew else ""
        refused = check.nearest and check.name in ("parts", "full_turn")  # the reason is the text
        change = "; ".join(words for words in ("" if refused else check.why, advice) if words)
        note = f"{change} ({explained})" if change else explained
        text = check.why if refused else meaning(check) or compared_text(check)
        yield SummaryLine(label, text, note, FAILS)


def warning_lines(
    checks: Iterable[Check], warnings: Iterable[str], unused: Iterable[str] = ()
) -> Iterator[SummaryLine]:
    """A line for each check without a proof, each warning, and each acceptance of none."""
    for check in checks:
        if check.passes is None:
            text = f"{spoken(check.name)[0]}: {check.why}"
            yield SummaryLine("not proved", text, "", WARNS)
    yield from map(warning, warnings)
    for name in unused:
        yield SummaryLine(
            "note", f"{name}: no such warning occurs: it can be removed from [accept]"
        )


def warning(text: str) -> SummaryLine:
    """The line of a warning, and the command that explains it; of an accepted one its reason."""
    explained = f"geneva explain {text.name}" if isinstance(text, Notice) else ""
    if isinstance(text, Notice) and text.accepted:
        return SummaryLine("accepted", f"{text.name}: {text.accepted}", explained)
    return SummaryLine("warning", text, explained, WARNS)


def tightest(checks: Iterable[Check]) -> Iterator[SummaryLine]:
    """The line of the passing check with the least relative margin, or none."""
    used: dict[Check, float] = {}
    for check in checks:
        value, limit = check.value, check.limit
        # where it passes, a reason says what is proved
        if check.passes and value and limit and not check.why and check.name not in WITHOUT_MARGIN:
            used[check] = value / limit if check.must_be == "at most" else limit / value
    if used:
        tight = max(used, key=used.__getitem__)
        yield SummaryLine("tightest", f"{spoken(tight.name)[0]} {compared_text(tight)}")
