"""Names of a report's values for people: ``slot_mouth_radius_mm`` is a slot mouth radius in mm.

A name has its unit at its end, as in a spec.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from geneva_cli.document import Fact, Facts
from geneva_cli.names import UNITS as OF_NAMES

# Units by the ending of a name, the longest first.
OWN = {"_deg": "°", "_rpm": "rpm", "_mm_per_million": "mm per million motions"}
UNITS = dict(sorted((OF_NAMES | OWN).items(), key=lambda item: -len(item[0])))
# Words for names that are not clear by themselves.
WORDS = {
    "max": "greatest",
    "min": "least",
    "at": "at the input angle",
    "rms": "root mean square",
    "entry": "at entry",
    "exit": "at exit",
    "k": "k, time of motion over time of dwell",
    "tau": "τ, fraction of the cycle in motion",
    "k_r": "k_r, motion over the rest of a turn",
    "index": "step of the wheel",
    "Am": "Am, peak acceleration of the motion curve",
    "Vm": "Vm, peak velocity of the motion curve",
    "Qm": "Qm, torque factor of the motion curve",
    "rss": "root of the sum of squares",
    "p997": "of 99.7 % of machines",
    "worst": "worst case",
    "ratio": "ratio R/L",
    "none": "not known, because",
    "turns": "turns at the worst of the tolerances",
    "center_distance": "centre distance",
    "pv_max": "greatest pressure times sliding",
    "rollers_max": "most rollers",
    "motor_torque_max": "motor torque, greatest",
    "motor_torque_rms": "motor torque, root mean square",
    "drag": "torque to add so that the roller stays on one wall",
    "inwards": "place of the greatest stress, from the rim inwards",
    "reversals": "the wheel's torque changes its sign at",
}


def unit_of(name: str) -> str:
    """The unit of a value; empty for a number, or a word."""
    return next((unit for end, unit in UNITS.items() if f"_{name}".endswith(end)), "")


def words_of(name: str) -> str:
    """The name without its unit.

    >>> words_of("slot_mouth_radius_mm"), words_of("at_deg"), words_of("tau")
    ('slot mouth radius', 'at the input angle', 'τ, fraction of the cycle in motion')
    """
    if name in WORDS:
        return WORDS[name]
    end = next((end for end in UNITS if name.endswith(end)), "")
    bare = name.removesuffix(end)
    if bare.endswith("_at"):
        return f"{words_of(bare.removesuffix('_at'))}, at the input angle"
    return WORDS.get(bare, bare.replace("_", " "))


def capital(text: str) -> str:
    """A text that begins with a capital, unless it begins with a symbol.

    >>> capital("slot width"), capital("k, time of motion")
    ('Slot width', 'k, time of motion')
    """
    is_symbol = len(text.partition(",")[0].partition("_")[0]) < 2
    return text if is_symbol else text[:1].upper() + text[1:]


def fact(name: str, value: Any) -> Fact:
    """A value of a report by its name."""
    *groups, last = name.split(".")
    said = ", ".join([*(words_of(group) for group in groups), words_of(last)])
    return Fact(capital(said), value, unit_of(last))


def facts(caption: str, values: Mapping[str, Any]) -> list[Facts]:
    """The known values under a caption; empty without any."""
    known = tuple(fact(name, value) for name, value in values.items() if is_known(value))
    return [Facts(caption, known)] if known else []


def is_known(value: object) -> bool:
    """Return True if there is a value to show."""
    return value is not None and value not in ("", ())
