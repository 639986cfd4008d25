"""Names of keys, columns and quantities: the unit at their end, and their words for people.

Headings and sentences have short words (``spoken``), documents longer ones (``described``).
"""

# Units by the ending of a name, of which the longest counts.
UNITS = {
    "_kgm2": "kg m²",
    "_kgm3": "kg/m³",
    "_Nm_rad": "N m/rad",
    "_mm3_Nm": "mm³/(N m)",
    "_W_m2": "W/m²",
    "_rad_s": "rad/s",
    "_rad_s2": "rad/s²",
    "_rad_s3": "rad/s³",
    "_rad2_s3": "rad²/s³",
    "_m2_s3": "m²/s³",
    "_m_s": "m/s",
    "_m_s2": "m/s²",
    "_m_s3": "m/s³",
    "_Nms": "N m s",
    "_Hz": "Hz",
    "_W": "W",
    "_J": "J",
    "_m": "m",
    "_um": "µm",
    "_arcsec": "arc seconds",
    "_mm": "mm",
    "_mm_per_million": "mm/1e6",
    "_deg": "deg",
    "_rpm": "1/min",
    "_HRC": "HRC",
    "_Nm": "N m",
    "_MPa": "MPa",
    "_GPa": "GPa",
    "_kg": "kg",
    "_N": "N",
    "_h": "h",
    "_s": "s",
}
# Shorter forms of units, for people at a terminal.
SHORT_UNITS = {"1/min": "rpm", "arc seconds": "arcsec"}
# Words for names that are not clear by themselves, as a whole or without their units.
WORDS = {
    "z": "slots",
    "velocity_max": "peak velocity",
    "acceleration_max": "peak acceleration",
    "jerk_max": "peak jerk",
    "power_max": "peak power",
    "acceleration_max_deg": "peak at",  # the place of that peak, in the survey of wheels
    "rollers_max": "most rollers",
    "n": "input speed",
    "youngs_modulus": "Young's modulus",
    "poisson_ratio": "Poisson's ratio",
    "omega": "velocity",
    "alpha": "acceleration",
    "pv": "pressure times sliding",
    "gap_proved": "least gap",
    "center_distance": "centre distance",
    "p997": "99.7 % of machines",
    "rss": "root sum of squares",
}
# Longer words for some names, for documents, whose rows have more room than a heading.
LONG_WORDS = {
    "max": "greatest",
    "min": "least",
    "max_at": "greatest at the input angle",
    "min_at": "least at the input angle",
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
    "wheel_deg": "wheel angle",
    "rack_mm": "travel of the rack",
    "omega": "wheel's velocity",
    "alpha": "wheel's acceleration",
    "ratio": "ratio R/L",
    "none": "not known, because",
    "turns": "turns at the worst of the tolerances",
    "pv_max": "greatest pressure times sliding",
    "drag": "torque to add so that the roller stays on one wall",
    "inwards": "place of the greatest stress, from the rim inwards",
    "reversals": "the wheel's torque changes its sign at",
}


def unit_of(name: str) -> str | None:
    """The unit in the ending of a key's or a quantity's name; None without one."""
    last = "_" + name.rpartition(".")[2]  # a column may be its unit alone, such as rpm
    return UNITS.get(unit_end(last))


def spoken(name: str) -> tuple[str, str]:
    """A name as words and a unit, for people; an empty text without a unit.

    >>> spoken("wheel_bore_mm"), spoken("loads.pin_force_N.max")
    (('wheel bore', 'mm'), ('loads pin force max', 'N'))
    """
    words, unit = [], ""
    for part in name.split("."):
        text, own = _in_words(part, WORDS)
        words.append(text)
        unit = own or unit
    return " ".join(words), unit


def described(name: str) -> tuple[str, str]:
    """A name without dots as words and a unit, for documents; an empty text without a unit.

    >>> described("slot_mouth_radius_mm"), described("tau")
    (('slot mouth radius', 'mm'), ('τ, fraction of the cycle in motion', ''))
    """
    words, unit = _in_words(name, WORDS | LONG_WORDS)
    return words, "°" if unit == "deg" else unit


def _in_words(name: str, known: dict[str, str]) -> tuple[str, str]:
    end = unit_end(name)
    bare, unit = name.removesuffix(end), UNITS.get(end, "")
    text = bare if len(bare) <= 3 else bare.replace("_", " ")  # a symbol has its index, as C_v
    return known.get(name) or known.get(bare) or text, SHORT_UNITS.get(unit, unit)


def unit_end(name: str) -> str:
    """The longest ending of a name that is a unit; empty without one."""
    for i, letter in enumerate(name):
        if letter == "_" and name[i:] in UNITS:
            return name[i:]
    return ""


def heading(name: str) -> str:
    """A name in one line, its unit behind a comma."""
    words, unit = spoken(name)
    return f"{words}, {unit}" if unit else words


def capital(text: str) -> str:
    """A text that begins with a capital, unless it begins with a symbol."""
    is_symbol = len(text.partition(",")[0].partition("_")[0]) < 2
    return text if is_symbol else text[:1].upper() + text[1:]
