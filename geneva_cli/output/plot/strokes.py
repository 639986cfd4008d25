"""Strokes of a figure's curves: different dashes, and colours for light and dark paper.

The colours differ for colour-blind readers too, after Okabe and Ito (2008), with a contrast of at
least 3 to the paper (checked in tests/output/test_plot.py).
"""

from __future__ import annotations

from typing import NamedTuple


class Paper(NamedTuple):
    """The colours of a page."""

    page: str
    text: str
    axis: str
    grid: str
    rest: str  # shade of stretches at rest
    curves: tuple[str, ...]


LIGHT = Paper(
    "#ffffff",
    "#1a1a1a",
    "#707070",
    "#dddddd",
    "#f0f0f0",
    ("#0072b2", "#d55e00", "#007a5e", "#c0589a", "#4d4d4d", "#9a7400"),
)
DARK = Paper(
    "#15181c",
    "#e8e8e8",
    "#8c9197",
    "#343a41",
    "#22272d",
    ("#56b4e9", "#ff8a3c", "#1fc79b", "#e79ac9", "#d0d0d0", "#f0d94a"),
)


def colour(number: int, paper: Paper) -> str:
    """The colour of a curve by its number; colours repeat, with other dashes."""
    return paper.curves[number % len(paper.curves)]


def dashes(number: int) -> tuple[float, ...]:
    """Dash and gap of a curve by its number, px; none for a solid line."""
    patterns = (
        (),
        (7.0, 3.0),
        (2.0, 2.5),
        (10.0, 3.0, 2.0, 3.0),
        (14.0, 5.0),
        (7.0, 2.5, 2.0, 2.5, 2.0, 2.5),
    )
    return patterns[(number + number // len(patterns)) % len(patterns)]
