"""Values with a unit, such as ``"8 in"``, in the unit of their key."""

from __future__ import annotations

import re
from functools import cache
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, cut
from geneva_cli.names import spoken

if TYPE_CHECKING:
    from fractions import Fraction

# Units by the powers of metre, kilogram, second and turn in them, each in these base units. All are
# exact but the radian, which has 40 digits of 1/(2 pi): NIST SP 811, appendix B (inch, pound,
# standard gravity 9.80665 m/s², and horsepower of 550 ft lbf/s).
RADIAN = "0.1591549430918953357688837633725143620345"
PSI, KSI = "44482216152605/6451600000", "44482216152605/6451600"  # lbf/in²
UNITS: dict[tuple[int, ...], dict[str, str]] = {
    (1, 0, 0, 0): {"mm": "1e-3", "cm": ".01", "m": "1", "in": ".0254", "ft": ".3048", "um": "1e-6"},
    (0, 1, 0, 0): {"kg": "1", "g": "1e-3", "t": "1e3", "lb": "0.45359237", "oz": "0.028349523125"},
    (0, 0, 1, 0): {"s": "1", "ms": "1e-3", "min": "60", "h": "3600"},
    (0, 0, 0, 1): {"rev": "1", "deg": "1/360", "rad": RADIAN, "arcmin": "1/21600"},
    (0, 0, -1, 0): {"Hz": "1"},
    (0, 0, -1, 1): {"rpm": "1/60"},
    (1, 1, -2, 0): {"N": "1", "kN": "1e3", "lbf": "4.4482216152605", "kgf": "9.80665"},
    (2, 1, -2, 0): {"Nm": "1", "J": "1"},
    (-1, 1, -2, 0): {"Pa": "1", "MPa": "1e6", "GPa": "1e9", "bar": "1e5", "psi": PSI, "ksi": KSI},
    (2, 1, -3, 0): {"W": "1", "kW": "1e3", "hp": "745.69987158227022"},
}
# A number with its unit: decimal, or as on a drawing in inches, 3/8 or 1 1/2.
NUMBER = (
    r"[+-]?(?:(?:\d{1,9}[ -])?\d{1,9}/\d{1,9}(?![\d.])"
    r"|(?:\d{1,40}(?:\.\d{0,40})?|\.\d{1,40})(?:[eE][+-]?\d{1,3})?)(?!\d)"
)


def unit_key(key: str) -> str | None:
    """The unit of a key whose values may have another one, None for other keys."""
    unit = spoken(key)[1]
    return unit if unit and re.fullmatch(pattern(), f"1 {unit}") else None


@cache
def pattern() -> str:
    """Regular expression of a number with its unit, for editors; its units are known ones."""
    names = sorted((n for names in UNITS.values() for n in names), key=len, reverse=True)
    one = rf"(?:{'|'.join([*names, '°', 'µm', '1/min'])})(?:\^?-?[1-6]|[²³])?"
    return rf"^\s*{NUMBER}\s*(?:1/)?\(?{one}(?:(?:\s*[*·/]\s*|\s+|-)\(?{one}\)?)*\)?\s*$"


def in_unit_of(key: str, text: str) -> float:
    """The number that a text with a unit is in the unit of a key.

    Raises GenevaError for a text without a number, and for a unit that is unknown or of another
    kind.

    >>> in_unit_of("center_distance_mm", "8 in"), in_unit_of("lock_radius_mm", "1 1/2 in")
    (203.2, 38.1)
    >>> in_unit_of("torque_Nm", "12 lbf in")
    1.355817948331...
    """
    from fractions import Fraction  # only where a text has a unit: it takes some milliseconds

    own = unit_key(key)
    parts = re.fullmatch(rf"\s*({NUMBER})(.*)", text, re.DOTALL)
    if own is None or not parts or not parts[2].strip() or parts[2][0] == ",":
        hint = f'; with a unit it is a text such as "10 {own}", with a point' if own else ""
        raise GenevaError(f'{key} must be a number, not "{cut(text)}"{hint}')
    own_powers, own_size = _unit(own)
    powers, size = _unit(parts[2]) if re.fullmatch(pattern(), text) else ((), own_size)
    if powers != own_powers:
        others = [name for name in UNITS.get(own_powers, {}) if name != own][:5]
        like = f"{own} or {', '.join(others)}" if others else f"{own}, or units of that kind"
        raise GenevaError(f'{key} = "{cut(text)}" must be in {like}')
    # a decimal number, a fraction, or a whole number and a fraction
    bare = parts[1].lstrip("+-")
    try:
        number = sum(map(Fraction, re.split("[ -]", bare) if "/" in bare else [bare]), Fraction(0))
        return float((-number if parts[1][0] == "-" else number) * size / own_size)
    except (OverflowError, ZeroDivisionError):
        raise GenevaError(f'{key} = "{cut(text)}" is too large a number') from None


def _unit(text: str) -> tuple[tuple[int, ...], Fraction]:
    """Powers of metre, kilogram, second and turn in a unit or a product of units, and its size.

    Everything behind a slash divides.
    """
    from fractions import Fraction

    known = {name: (powers, one) for powers, ones in UNITS.items() for name, one in ones.items()}
    powers: tuple[int, ...] = (0, 0, 0, 0)
    size = Fraction(1)
    plain = text.translate(str.maketrans("²³()µ", "23  u"))
    above, *below = plain.replace("°", " deg ").replace("1/min", " rpm ").split("/")
    for sign, part in ((1, above), *((-1, one) for one in below)):
        for name, power in re.findall(r"([A-Za-z]+)\^?(-?[1-6])?", part):
            times, (own, one_size) = sign * int(power or 1), known[name]
            powers = tuple(a + times * b for a, b in zip(powers, own, strict=True))
            size *= Fraction(one_size) ** times
    return powers, size
