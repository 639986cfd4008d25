"""Widths of text in Helvetica and its bold, which every PDF reader has.

Arial and Liberation Sans, which replace it elsewhere, have equal widths. Source: Adobe's font
metrics, Core 14 AFM, Helvetica and Helvetica-Bold, in thousandths of the font's size.
"""

from __future__ import annotations

from functools import lru_cache

CAPITALS = 0.718  # height of capital letters, over the font's size
_ASCII = (  # from the space on
    *(278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278),
    *(556,) * 10,
    *(278, 278, 584, 584, 584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278),
    *(500, 667, 556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667),
    *(611, 278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222),
    *(222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500, 500),
    *(500, 334, 260, 334, 584),
)
_BOLD = (
    *(278, 333, 474, 556, 556, 889, 722, 238, 333, 333, 389, 584, 278, 333, 278, 278),
    *(556,) * 10,
    *(333, 333, 584, 584, 584, 611, 975, 722, 722, 722, 722, 667, 611, 778, 722, 278),
    *(556, 722, 611, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667),
    *(611, 333, 278, 333, 584, 556, 333, 556, 611, 556, 611, 556, 333, 611, 611, 278),
    *(278, 556, 278, 889, 611, 611, 611, 611, 389, 556, 333, 611, 556, 778, 556, 556),
    *(500, 389, 280, 389, 584),
)
# equal in both; the first is the non-breaking space
_OTHERS = {
    **{"\u00a0": 278, "·": 278, "²": 333, "³": 333, "°": 400},
    **{"–": 556, "±": 584, "×": 584, "Ø": 778},
}


@lru_cache(maxsize=256)  # a text is tried at many places
def width(text: str, bold: bool = False) -> float:
    """Width of a text over the height of its capitals; unlisted letters count as the widest.

    >>> round(width("20 H7"), 3)
    3.716
    """
    known = _BOLD if bold else _ASCII
    widest = 1000  # for letters that are not listed
    units = sum(known[ord(c) - 32] if " " <= c <= "~" else _OTHERS.get(c, widest) for c in text)
    return units / (1000.0 * CAPITALS)
