"""A commented spec to start from, made from the same keys that the reader knows."""

from __future__ import annotations

from typing import Any

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.machine import registry
from geneva_cli.spec.schema import REQUIRED, Field, fields
from geneva_cli.specfile.writer import keys_of, quoted

# KIND -> what it says of itself, and the keys that it sets
KINDS: dict[str, tuple[str, dict[str, dict[str, Any]]]] = {
    "external": ("an external wheel, straight slots", {"wheel": {"z": 6}}),
    "internal": (
        "an internal wheel: more motion than dwell",
        {"wheel": {"z": 6, "gearing": "internal"}},
    ),
    "rollers": (
        "several rollers: more indexes in a turn of the crank",
        {"wheel": {"z": 4}, "drive": {"rollers": 3}},
    ),
    "side-crank": (
        "a side-crank drive: a slower, softer index",
        {"wheel": {"z": 6}, "drive": {"kind": "side-crank", "A": 0.6}},
    ),
    "curved": (
        "curved slots for a given motion law, at the mid condition",
        {"wheel": {"z": 6}, "motion": {"law": "modified-sine", "ratio": "matched"}},
    ),
    "spherical": (
        "a spherical wheel: shafts that meet, motion and dwell equal",
        {"wheel": {"z": 6, "gearing": "spherical"}},
    ),
    "elliptical-gears": (
        "equal elliptical gears in front: a slower, softer index",
        {"wheel": {"z": 6}, "drive": {"kind": "elliptical-gears", "eccentricity": 0.3}},
    ),
    "noncircular-gears": (
        "noncircular gears in front, with the ratio of a side-crank",
        {"wheel": {"z": 6}, "drive": {"kind": "noncircular-gears", "A": 0.6}},
    ),
    "geneva-pair": (
        "two wheels in series: one index in many turns",
        {"wheel": {"z": 4}, "drive": {"kind": "geneva-pair", "first_z": 4}},
    ),
    "four-bar": (
        "the roller on a four-bar's coupler",
        {
            "wheel": {"z": 4, "held_by": "detent"},
            "drive": {
                "kind": "four-bar",
                "crank_mm": 40.0,
                "ground_mm": 90.0,
                "coupler_mm": 100.0,
                "rocker_mm": 100.0,
                "point_mm": 161.51903573811165,
                "point_deg": -36.13836508095113,
                "entry_deg": 123.3,
            },
            "size": {"roller_radius_mm": 2.0},
        },
    ),
    "slider-crank": (
        "the roller on a slider-crank's rod",
        {
            "wheel": {"z": 8, "held_by": "detent"},
            "drive": {
                "kind": "slider-crank",
                "crank_mm": 40.0,
                "rod_mm": 100.0,
                "point_mm": 80.0,
                "point_deg": 90.0,
            },
            "size": {"roller_radius_mm": 6.0},
        },
    ),
    "epicyclic": (
        "a gear-Geneva: the roller on a planet enters without a jump",
        {
            "wheel": {"z": 4},
            "drive": {"kind": "epicyclic", "planet_ratio": "shockless", "fixed": "sun"},
            "size": {"roller_radius_mm": 4.0},
        },
    ),
    "gear-sector": (
        "slot, gears at a constant ratio, slot",
        {
            "wheel": {"z": 3},
            "drive": {"kind": "gear-sector", "sector_deg": 60.0, "gear_ratio": "shockless"},
        },
    ),
    "cam": (
        "a cam-Geneva: straight slots, and a law that a fixed cam makes",
        {"wheel": {"z": 6}, "drive": {"kind": "cam"}, "motion": {"law": "cycloidal"}},
    ),
}


def template(kind: str) -> str:
    """The text of a valid spec; every key that it can have is there, its default and its meaning.

    Raises GenevaError for a kind that is not known.
    """
    if kind not in KINDS:
        known = ", ".join(KINDS)
        raise GenevaError(
            f'unknown KIND "{cut(kind)}"{nearest(kind, KINDS)}; it must be one of {known}'
        )
    about, given = KINDS[kind]
    lines = [
        f"# A Geneva mechanism: {about}.",
        "# Keys behind a # have the default shown, or none; remove the # to set them.",
        f"title = {quoted(about)}",
    ]
    wheel, drive = given["wheel"], given.get("drive", {})
    gearing = registry.gearing(wheel.get("gearing", "external"))
    # any law may be put in: a template shows the keys of all
    law_keys = [key for name in registry.LAWS for key in fields(registry.law(name))]
    keys = keys_of(gearing, registry.drive(drive.get("kind", "crank")), law_keys)
    for name, table in keys.items():
        lines += ["", f"[{name}]", *[_line(field, given.get(name, {})) for field in table]]
    return "\n".join(lines) + "\n"


def _line(field: Field, values: dict[str, Any]) -> str:
    rule = f"; {field.rule}" if field.rule is not None else ""
    note = f"  # {field.meaning}{rule}"
    if field.key in values:
        return f"{field.key} = {quoted(values[field.key])}{note}"
    default = "..." if field.default in (None, REQUIRED) else quoted(field.default)
    return f"# {field.key} = {default}{note}"
