"""Ranges as text: ``LOW..HIGH`` and ``LOW..HIGH:STEP``."""

from __future__ import annotations

from typing import NamedTuple

from geneva_cli.errors import GenevaError


class RangeText(NamedTuple):
    """The ends and the step of a range as they are typed; empty if left out."""

    low: str
    high: str
    step: str


def range_text(text: str, option: str) -> RangeText | None:
    """Return the parts of a range; None for a text without ``..``.

    ``option``, with its value, begins the text of errors. Raises GenevaError for a step without
    its range, or without a number.

    >>> range_text("0..0.9:0.01", "--vary drive.A")
    RangeText(low='0', high='0.9', step='0.01')
    """
    ends, colon, step = text.partition(":")
    low, dots, high = ends.partition("..")
    if colon and not (dots and step.strip()):
        raise GenevaError(
            f"{option}: a range is LOW..HIGH or LOW..HIGH:STEP, as 3..12 or 0..0.9:0.1"
        )
    return RangeText(low.strip(), high.strip(), step.strip()) if dots else None
