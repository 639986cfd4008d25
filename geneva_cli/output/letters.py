"""How wide a text is that a reader's program draws, in a font that we do not know."""

from __future__ import annotations

import unicodedata

LETTER = 0.62  # width of a letter beside the height, with some to spare


def width(text: str) -> float:
    """A text's width beside its height, rather too great than too small."""
    return sum(1.1 if unicodedata.east_asian_width(c) in "WF" else LETTER for c in text)
