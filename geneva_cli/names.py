"""Names of keys, columns and quantities: the unit at their end, and their words for people."""

from __future__ import annotations

# Units by the ending of a name; a longer ending stands before a shorter one with the same end.
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
    "_m_s": "m/s",
    "_Nms": "N m s",
    "_Hz": "Hz",
    "_W": "W",
    "_J": "J",
    "_m": "m",
    "_um": "µm",
    "_arcsec": "arc seconds",
    "_mm": "mm",
    "_deg": "deg",
    "_rpm": "1/min",
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
# Words for names that are not clear by themselves, with or without their units.
WORDS = {
    "z": "slots",
    "velocity_max": "peak velocity",
    "acceleration_max": "peak acceleration",
    "jerk_max": "peak jerk",
    "power_max": "peak power",
    "acceleration_max_deg": "peak at",  # in the survey of wheels, beside that peak
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
    "rss": "root of squares",
}
SYMBOL = "C_v"  # a name with no more letters is a symbol with its index


def unit_of(name: str) -> str | None:
    """The unit in the ending of a key's or a quantity's name; None without one.

    >>> unit_of("loads.omega_rad_s"), unit_of("tau")
    ('rad/s', None)
    """
    last = "_" + name.rpartition(".")[2]  # a column may be its unit alone, such as rpm
    return next((unit for end, unit in UNITS.items() if last.endswith(end)), None)


def spoken(name: str) -> tuple[str, str]:
    """A name as words and a unit, for people; an empty text without a unit.

    >>> spoken("wheel_bore_mm"), spoken("loads.pin_force_N.max")
    (('wheel bore', 'mm'), ('loads pin force max', 'N'))
    """
    words, unit = [], ""
    for part in name.split("."):
        end = next((end for end in UNITS if part.endswith(end)), "")
        bare = part.removesuffix(end)
        plain = bare if len(bare) <= len(SYMBOL) else bare.replace("_", " ")
        words.append(WORDS.get(part) or WORDS.get(bare, plain))
        unit = UNITS.get(end) or unit
    return " ".join(words), SHORT_UNITS.get(unit, unit)


def heading(name: str) -> str:
    """A name in one line, its unit behind a comma.

    >>> heading("wheel_bore_mm"), heading("tau")
    ('wheel bore, mm', 'tau')
    """
    words, unit = spoken(name)
    return f"{words}, {unit}" if unit else words
