"""The records of all kinds: a new wheel or drive is a file and a line here, or in ``kinds``."""

from __future__ import annotations

from functools import cache
from typing import Any

from geneva_cli.kinds import FOLDERS
from geneva_cli.motion.kind import Kind
from geneva_cli.spec.load_named import load_named

CRANK = "drives.crank:Crank"  # the drive of a spec without one
_CRANK, _PIN_PATH = "drives.refuses:of_transmission", "drives.refuses:of_pin_path"
# Of flat parts, and of links and gears in front of a crank.
_DRAWINGS = {
    "slot": "drawings.part_drawings:slot",
    "wheel": "drawings.part_drawings:wheel",
    "crank": "drawings.part_drawings:crank",
    "arm": "drawings.part_drawings:arm",
    "links": "drawings.part_drawings:links",
    "first-wheel": "drawings.part_drawings:wheel",
    "first-crank": "drawings.part_drawings:crank",
    "frame": "drawings.part_drawings:frame",
    "assembly": "drawings.part_drawings:machine",
    "gears": "drawings.part_drawings:gears",
    "groove": "drawings.part_drawings:groove",
    "groove-plate": "drawings.part_drawings:groove_plate",
    "plate": "drawings.single_parts:plate",
}
_SHEET = {"sheet": "drawings.sheet.machine_sheet:sheet"}
_TABLES = {
    "slot": "parts.slots.slot_profile:profile_table",
    "gears": "parts.gears.gear_curves:gears_table",
    "groove": "parts.slots.groove:groove_table",
}
# class of the parts of a wheel without its own: the links and gears in front
FRONT = "parts.flat_parts:FrontParts"
# What wheels in the plane have in common.
_FLAT = Kind(
    "",
    parts="parts.flat_parts:FlatParts",
    frame="parts.frame:framed",
    drawings=_DRAWINGS | _SHEET,
    tables=_TABLES,
)
# The kinds of the core; those in ``kinds`` follow.
_CORE = (
    _FLAT._replace(
        name="external",
        synonyms=("outer", "outside"),
        wheel="motion.wheels.external:External",
        families={"wheel": "study.synth.families.straight_slots:offset_slots"},
    ),
    _FLAT._replace(
        name="internal", synonyms=("inner", "inside"), wheel="motion.wheels.internal:Internal"
    ),
    Kind(
        "spherical",
        synonyms=("bevel",),
        wheel="motion.wheels.spherical:Spherical",
        front=FRONT,
        drawings=_DRAWINGS,
        tables=_TABLES,
        families={"wheel": "study.synth.families.straight_slots:inclined"},
    ),
    Kind("crank", drive=CRANK, refuses="drives.refuses:of_crank"),
    Kind("side-crank", drive="drives.side_crank:SideCrank", refuses=_CRANK),
    Kind("elliptical-gears", drive="drives.elliptical_gears:EllipticalGears", refuses=_CRANK),
    Kind("noncircular-gears", drive="drives.noncircular_gears:NoncircularGears", refuses=_CRANK),
    Kind(
        "epicyclic", drive="drives.epicyclic:Epicyclic", gearings=("external",), refuses=_PIN_PATH
    ),
    Kind(
        "cam",
        drive="drives.cam:Cam",
        gearings=("external", "internal"),
        refuses="drives.refuses:of_cam",
    ),
)
_kinds = [*_CORE]
for _folder in FOLDERS:
    _kinds += load_named(f"kinds.{_folder}:KINDS")
KINDS: tuple[Kind, ...] = tuple(_kinds)
# function that puts a drive in front of another, which few machines need
IN_FRONT = "drives.retimed:retimed"


def of_wheel(name: str) -> list[Kind]:
    """The records of a kind of wheel: its own, then those that add to it."""
    out = []
    for kind in KINDS:
        if name == kind.adds_to or (kind.wheel and name == kind.name):
            out.append(kind)
    return out


def thing(wheel: str, field: str) -> Any:
    """Function or class of a kind of wheel in a field of its record; None without one."""
    path = named(wheel, field)
    return load_named(path) if path else None


@cache  # it is asked for each design of a sweep
def named(wheel: str, field: str) -> str:
    """Name of that function or class, as ``module:name``; empty without one."""
    path = ""
    for kind in of_wheel(wheel):
        path = getattr(kind, field) or path
    return path


def families_of_kinds(where: str, wheel: str = "") -> list[Any]:
    """Functions that return the families of kinds, or of a wheel's kinds, searched there."""
    kinds = of_wheel(wheel) if wheel else KINDS
    return [load_named(kind.families[where]) for kind in kinds if where in kind.families]
