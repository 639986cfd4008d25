"""Widths of letters in unknown fonts, and replacements for letters that some fonts lack."""

import re
import unicodedata

LETTER = 0.62  # width of a letter over its height, generous


SPELLED = {"≥": ">=", "≤": "<=", "−": "-", "→": "->", "√": "sqrt", "∞": "infinite"}


def width(text: str) -> float:
    """A text's width over its height, an upper estimate."""
    return sum(1.1 if unicodedata.east_asian_width(c) in "WF" else LETTER for c in text)


def western(text: str) -> str:
    """The text in letters of Windows' western fonts; others are spelled in words or ASCII.

    >>> western("d²ψ/dθ² = 3 × 10⁻³"), western("Дα")
    ('d²psi/dtheta² = 3 × 10^-3', '[U+0414]alpha')
    """

    def power(match: re.Match[str]) -> str:
        plain = match[0].translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
        return match[0] if all(map(_is_western, match[0])) else f"^{plain}"

    return "".join(map(_spelled, re.sub("[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+", power, text)))


def _spelled(letter: str) -> str:
    if _is_western(letter) or letter in SPELLED:
        return SPELLED.get(letter, letter)
    name = unicodedata.name(letter, "")
    if name.startswith("GREEK ") and " LETTER " in name:
        word = name.partition(" LETTER ")[2].partition(" WITH ")[0]
        return word.capitalize() if "CAPITAL" in name else word.lower()
    plain = "".join(filter(_is_western, unicodedata.normalize("NFKD", letter)))
    return plain or f"[U+{ord(letter):04X}]"


def _is_western(letter: str) -> bool:
    return bool(letter.encode("cp1252", "ignore"))
