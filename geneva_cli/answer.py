"""The answer of a command: summaries for people above a table, and the data for programs."""

import math
import re
from collections.abc import Mapping
from typing import Any, NamedTuple, TypeAlias

from geneva_cli.errors import clean
from geneva_cli.names import spoken
from geneva_cli.table import NO_BOUND, Table, for_people

Value: TypeAlias = float | int | str | bool | None
NO_BREAK = "\u00a0"  # a space at which no line is broken
TIMES = f"{NO_BREAK}×{NO_BREAK}"
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
PASSES, WARNS, FAILS = "passes", "warns", "fails"  # the state of a design


class SummaryLine(NamedTuple):
    """One answer about a design: its label, the answer, and its reason."""

    label: str
    text: str
    note: str = ""
    state: str = ""  # WARNS or FAILS for a warning or a failed check


class Summary(NamedTuple):
    """A short summary of one design: a headline, and one line for each answer.

    ``state`` is PASSES, WARNS or FAILS; empty if nothing is judged.
    """

    head: str
    lines: tuple[SummaryLine, ...] = ()
    state: str = ""


class Answer(NamedTuple):
    """The answer of a command: summaries above a table for people, and the data for programs."""

    summaries: tuple[Summary, ...]
    page: Table | None
    data: Table


def value_text(
    value: Value | tuple[Value, ...], unit: str = "", digits: int = 4, bare: bool = False
) -> str:
    """A value, with its unit unless ``bare``. Raises ArithmeticError for NaN, a fault of ours.

    >>> value_text(182.612895, "deg"), value_text(53.17, "W"), value_text(None), value_text(True)
    ('182.6°', '53.17 W', '–', 'yes')
    """
    if isinstance(value, tuple):
        return ", ".join(value_text(one, unit, digits) for one in value) or "none"
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        if math.isnan(value):
            raise ArithmeticError("a value of the report is not a number")
        text, _, power = for_people(value, unit, digits).partition("e")
        text += f"{TIMES}10{str(int(power)).translate(RAISED)}" if power else ""
    else:
        text = clean(str(value))
    if bare or not unit or isinstance(value, str) or text == NO_BOUND:
        return text
    return f"{text}°" if unit in ("deg", "°") else f"{text} {unit}"


def phrases(values: Mapping[str, Any], *texts: str) -> str:
    """Texts with values in place of their names in braces; one with an unknown value is left out.

    >>> phrases({"force_N": 53.17, "at_deg": None}, "force {force_N}", " at {at_deg}")
    'force 53.17 N'
    """
    name, out = re.compile(r"{([\w.]+)}"), ""
    for text in texts:
        if all(values[known] is not None for known in name.findall(text)):
            out += name.sub(lambda m: value_text(values[m[1]], spoken(m[1])[1]), text)
    return out
