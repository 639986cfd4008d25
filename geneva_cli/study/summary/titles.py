"""A design's title and the count of its warnings, for headlines."""

from __future__ import annotations

from collections.abc import Sequence

from geneva_cli.design import Design


def title_of(design: Design) -> str:
    """The title of a design, or else its description.

    >>> title_of(Design(External(6)))
    'Geneva wheel of 6 slots'
    """
    return design.spec.title or f"Geneva wheel of {design.spec.wheel.z} slots"


def counted(warnings: Sequence[str]) -> str:
    """The number of warnings behind a headline; empty without any.

    >>> counted(["a", "b"]), counted([])
    (': 2 warnings', '')
    """
    many = len(warnings)
    return f": {many} warning{'s' * (many != 1)}" if many else ""
