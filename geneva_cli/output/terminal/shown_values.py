"""Values for people at a terminal: five digits, and the unit behind a number."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any

from geneva_cli.output.text import cell
from geneva_cli.table import in_digits

NUMBER = 11  # letters of the widest number with five digits, -1.2345e-10


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
    # A life of more than 114 years of running day and night is meaningless.
    if unit == "h" and number > 1e6:
        return "practically unlimited"
    digits, e, power = in_digits(number, 5).partition("e")
    return f"{digits}e{int(power)}" if e else digits


def aligned(texts: Sequence[str]) -> Sequence[str]:
    """Numbers with aligned decimal points, if that takes little more width."""
    numeric = re.compile(r"-?[\d.]+|-")  # without a power of ten; or no value
    if not all(numeric.fullmatch(text) for text in texts):
        return texts
    tails = [len(text) - text.find(".") if "." in text else 0 for text in texts]
    most = max(tails)
    padded = [text + " " * (most - tail) for text, tail in zip(texts, tails, strict=True)]
    # A column may become three letters wider.
    return padded if max(map(len, padded)) <= max(map(len, texts)) + 3 else texts
