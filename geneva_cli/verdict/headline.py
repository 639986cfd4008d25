"""The verdict on a design in one line; failures and warnings in words; values with units."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from geneva_cli.answer import FAILS, PASSES, WARNS, SummaryLine, value_text
from geneva_cli.errors import Notice, is_warning, open_warnings
from geneva_cli.names import spoken
from geneva_cli.table import Table, in_digits, record_table
from geneva_cli.verdict.checks.all_checks import JAMS

if TYPE_CHECKING:
    from geneva_cli.parts.chosen import ByLoad
    from geneva_cli.parts.parts import Parts
    from geneva_cli.verdict.checks.check import Check

# The meaning of a failing check, by its name; without one its value says enough.
_PLAY = (
    "between lock and slot the {moves} by {value:.4g}{unit}{where}, more than the "
    "{limit:.4g}{unit} at which the roller still finds its slot"
)
_MOTION_PLAY = (
    "in its slot the {moves} by {value:.4g}{unit} either way{where}, more than {limit:.4g}{unit}"
)
MEANINGS = {
    "dwell_hold": "nothing holds the wheel in its dwell",
    "turns": "{value:.0f} of {limit:.0f} slots pass{where}",
    "gap_mm": "{parts} overlap by {short:.4g} mm{where}",
    "idle_roller_mm": "an idle roller overlaps the wheel by {short:.4g} mm{where}",
    "hand_over_play_deg": _PLAY,
    "hand_over_play_mm": _PLAY,
    "hand_over_pressure_deg": (
        "the roller meets the wheel{where} at a pressure angle of {value:.4g}°, above {limit:g}°"
    ),
    "hand_over_offset_mm": (
        "the mouth does not reach the roller, which first touches the wheel{where}, {value:.4g} mm "
        "farther off the slot's middle than the clearance"
    ),
    "driven_fraction": "not positively driven during {idle:.3g} % of the motion",
    "motion_play_deg": _MOTION_PLAY,
    "motion_play_mm": _MOTION_PLAY,
}
NO_WALL = {  # of a negative wall
    "wall_between_slots_mm": "neighbouring slots cut each other",
    "horn_mm": "the recess breaks into the slot",
    "wheel_bore_wall_mm": "the wheel's bore breaks into the slots",
    "crank_bore_wall_mm": "the crank's bore breaks through the relief",
    "rollers_apart_mm": "the rollers overlap each other",
    "outer_wall_mm": "the slots break through the wheel's outside",
}
# yes or no, and what a machine that turns always keeps
WITHOUT_MARGIN = ("dwell_hold", "parts", "full_turn", "turns", "turning_slack_mm")


def headline(checks: Sequence[Check], warnings: Sequence[str]) -> tuple[str, str]:
    """State of a design (PASSES, WARNS or FAILS), and counts of its checks and warnings in words.

    >>> from geneva_cli.verdict.checks.check import Check
    >>> headline([Check("jerk_max", 31.4, "at most", 30.0, False)], [])
    ('fails', '1 of 1 checks fails')
    """
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
    left = open_warnings(warnings)
    if left:
        text += f", {len(left)} warning{'s' * (len(left) != 1)}"
    if accepted := len(warnings) - len(left):
        text += f", {accepted} warning{'s' * (accepted != 1)} accepted"
    state = FAILS if failed else WARNS if not_proved or left else PASSES
    return state, text


def below_summary(record: Table, *, without: Sequence[str] = ()) -> Table:
    """A record as it stands below its summary, without the warnings and the names shown there.

    Notes on unknown values remain, as ``not_known``. Of an angle in two units, degrees remain. An
    allowed stress without a stress is left out.
    """
    values = dict(zip(record.names, next(record.rows()), strict=True))
    notes = tuple(text for text in values.pop("warnings") if not is_warning(text))
    left = {name: value for name, value in values.items() if name not in without}
    left = {name: value for name, value in left.items() if not name.endswith("_arcsec")}
    for name in [n for n in left if n.endswith(".allowed_MPa")]:
        if left.get(name.replace("allowed_MPa", "margin")) is None:  # there is no stress
            del left[name]
    return record_table(left | ({"not_known": notes} if notes else {}), prose=record.prose)


def chosen_lines(by_load: ByLoad, path: str) -> Iterator[SummaryLine]:
    """The lines of the sizes that the load chose, and of those that an option changed."""
    if by_load.words:
        name = {"": "SPEC", "<stdin>": "-"}.get(path, path)
        text = f"chosen by load: {by_load.words} (geneva size {name} writes them)"
        yield SummaryLine("sizes", text)
    yield from anew_lines(by_load)


def anew_lines(by_load: ByLoad) -> Iterator[SummaryLine]:
    """The line of the sizes that an option changed."""
    if by_load.changes:
        yield SummaryLine("note", f"sizes chosen anew: {by_load.changes}")


def failure_lines(checks: Iterable[Check]) -> list[SummaryLine]:
    """A line for each check that fails: its value, its limit, and the change."""
    lines = []
    for check in checks:
        if check.passes is not False:
            continue
        label, unit = spoken(check.name)
        explained = f"geneva explain {check.name}"
        if check.value is None or check.limit is None:
            lines.append(SummaryLine(label, check.why, explained, FAILS))
            continue
        how = "with" if "=" in check.nearest else "by"  # a value, or leaving out a key
        advice = f"passes {how} {check.nearest}" if check.nearest else ""
        advice += f" (sizes chosen anew: {check.anew})" if check.anew else ""
        refused = check.nearest and check.name in ("parts", "full_turn")  # the reason is the text
        change = "; ".join(words for words in ("" if refused else check.why, advice) if words)
        note = f"{change} ({explained})" if change else explained
        text = check.why if refused else meaning(check) or compared_text(check, unit)
        lines.append(SummaryLine(label, text, note, FAILS))
    return lines


def warning_lines(checks: Iterable[Check], warnings: Iterable[str]) -> list[SummaryLine]:
    """A line for each check without a proof, then for each warning."""
    unproved = [check for check in checks if check.passes is None]
    lines = [
        SummaryLine("not proved", f"{spoken(c.name)[0]}: {c.why}", "", WARNS) for c in unproved
    ]
    return lines + [warning(text) for text in warnings]


def warning(text: str) -> SummaryLine:
    """The line of a warning, and the command that explains it; of an accepted one its reason."""
    explained = f"geneva explain {text.name}" if isinstance(text, Notice) else ""
    if isinstance(text, Notice) and text.accepted:
        return SummaryLine("accepted", f"{text.name}: {text.accepted}", explained)
    return SummaryLine("warning", text, explained, WARNS)


def unused_lines(names: Iterable[str]) -> list[SummaryLine]:
    """A note on each accepted warning that does not occur."""
    text = "no such warning occurs: it can be removed from [accept]"
    return [SummaryLine("note", f"{name}: {text}") for name in names]


def compared_text(check: Check, unit: str) -> str:
    """The value of a check, its place, and its limit."""
    assert check.value is not None
    assert check.limit is not None
    where = "" if check.at_deg is None else f" at {measured(check.at_deg, 'deg')}"
    limit = measured(check.limit, unit) if unit == "deg" else value_text(check.limit)
    return f"{measured(check.value, unit)}{where}, {check.must_be} {limit}"


def proof_lines(checks: Iterable[Check]) -> Iterator[SummaryLine]:
    """The lines of what is proved: that no parts collide, and that a stop blocks the crank."""
    labels = {"stop_turns": "stop"}
    for check in checks:
        if check.is_proof:
            yield SummaryLine(labels.get(check.name, "turn"), check.why)


def tightest(checks: Iterable[Check]) -> Iterator[SummaryLine]:
    """The line of the passing check with the least relative margin, or none."""
    most, tight = 0.0, None
    for check in checks:
        value, limit = check.value, check.limit
        has_margin = not check.is_proof and check.name not in WITHOUT_MARGIN
        if check.passes and value and limit and has_margin:
            used = value / limit if check.must_be == "at most" else limit / value
            if tight is None or used > most:
                most, tight = used, check
    if tight:
        label, unit = spoken(tight.name)
        yield SummaryLine("tightest", f"{label} {compared_text(tight, unit)}")


def measured(value: float, unit: str = "", digits: int = 4) -> str:
    """A value with its unit, and with the significant digits of a sentence.

    >>> measured(8.25622, "mm"), measured(-58.2111, "deg")
    ('8.256 mm', '-58.21°')
    """
    return value_text(value, "°" if unit == "deg" else unit, digits)


def failures(rows: list[Check], parts: Parts) -> tuple[str, list[str]]:
    """The reason why the parts jam or cannot be cut, and a sentence on each other failing check.

    The first text is empty if the parts can be written.
    """
    refused, warned, advice = [], [], ""
    for c in rows:
        if c.passes is not False:
            continue
        if c.name == "full_turn":
            refused.append(c.why)
        elif c.name == "parts":  # the reason why there are none
            warned.append(c.why)
        elif c.not_computed:
            warned.append(c.not_computed)
        elif c.name in JAMS or (
            # Links and gears lie below the wheel's plane, so the wheel can be cut all the same.
            c.name not in ("link_wall_mm", "link_gap_mm", "gear_gap_mm")
            and c.must_be == "at least"
            and c.name.endswith("_mm")
            and (c.value or 0.0) < 0.0
        ):
            refused.append(in_words(c, parts.turn.smallest.parts if c.name == "gap_mm" else ""))
            advice = advice or c.nearest
        else:
            more = f"{c.nearest} would pass" if c.nearest else c.why
            warned.append("; ".join(text for text in (in_words(c), more) if text))
    return "; ".join(refused) + (f"; {advice} would free it" if advice else ""), [
        *dict.fromkeys(warned)
    ]


def in_words(c: Check, parts: str = "") -> str:
    """A failing check in words; ``parts`` names those that overlap, where they are known."""
    shown = in_digits(c.value or 0.0, 6)
    general = f"{c.name} is {shown}{c.where}; it must be {c.must_be} {c.limit or 0.0:.6g}"
    return meaning(c, parts) or general


def meaning(c: Check, parts: str = "") -> str:
    """The meaning of a failing check; empty if its value is enough."""
    value, limit = c.value or 0.0, c.limit or 0.0
    if c.name in NO_WALL and value < 0.0:
        return f"{NO_WALL[c.name]} by {-value:.4g} mm"
    moves, unit = ("rack can move", " mm") if c.name.endswith("_mm") else ("wheel can turn", "°")
    named = {"value": value, "limit": limit, "short": -value, "idle": 100.0 * (1.0 - value)}
    words = {"where": c.where, "moves": moves, "unit": unit, "parts": parts or "parts"}
    return MEANINGS.get(c.name, "").format(**named, **words)
