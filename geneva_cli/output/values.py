"""Values for people at a terminal: five digits, and the unit beside a number."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from geneva_cli.output.text import cell
from geneva_cli.table import in_digits

DIGITS = 5  # significant digits; csv and json have all
NUMBER = 11  # letters of the widest number with these digits, -1.2345e-10
HOURS = 1e6  # of a life, 114 years of running day and night: longer ones are meaningless
ENDLESS = "practically unlimited"
NUMERIC = re.compile(r"-?[\d.]+|-")  # without a power of ten; or no value
SPARE = 3  # letters by which a column may be wider to align its decimal points


def value(number: Any, unit: str = "") -> str:
    """A value for people at a terminal, with its unit.

    >>> value(34.733492, "N m"), value(53173000.0), value(2.8e8, "h")
    ('34.733 N m', '5.3173e7', 'practically unlimited')
    """
    return with_unit(bare(number, unit), unit)


def with_unit(text: str, unit: str) -> str:
    """A number with its unit; words stand alone."""
    return f"{text} {unit}" if unit and text[-1:].isdigit() else text


def bare(number: Any, unit: str) -> str:
    """A value without its unit, which identifies times too long to be meaningful."""
    if not isinstance(number, float):
        return cell(number)
    if unit == "h" and number > HOURS:
        return ENDLESS
    digits, e, power = in_digits(number, DIGITS).partition("e")
    return f"{digits}e{int(power)}" if e else digits


def aligned(texts: Sequence[str]) -> Sequence[str]:
    """Numbers with aligned decimal points, if that takes little more width."""
    if not all(NUMERIC.fullmatch(text) for text in texts):
        return texts
    tails = [len(text) - text.find(".") if "." in text else 0 for text in texts]
    most = max(tails)
    found = [text + " " * (most - tail) for text, tail in zip(texts, tails, strict=True)]
    return found if max(map(len, found)) <= max(map(len, texts)) + SPARE else texts
