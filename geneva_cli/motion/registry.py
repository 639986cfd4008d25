"""The records of all kinds: a new wheel or drive is a file and a line here, or in ``kinds``.

Their classes, and those of laws, are imported by name at their first use.
"""

from functools import cache, partial
from itertools import chain
from operator import attrgetter
from typing import Any

from geneva_cli.errors import GenevaError, few, nearest
from geneva_cli.extras import FOLDERS as EXTRAS
from geneva_cli.kept import load_named
from geneva_cli.kinds import FOLDERS
from geneva_cli.motion.kind import Kind
from geneva_cli.spec.schema import shown

CRANK = "drives.crank:Crank"  # the drive of a spec without one
_CAM = "motion.compatible:of_cam"
_CRANK, _PIN_PATH = "motion.compatible:of_transmission", "motion.compatible:of_pin_path"
# Of flat parts, and of links and gears in front of a crank.
_DRAWN = (
    *("slot", "wheel", "crank", "arm", "links", "first-wheel", "first-crank", "frame"),
    *("assembly", "gears", "groove", "groove-plate"),
)
_DRAWINGS = dict.fromkeys(_DRAWN, "drawings.part_drawings")
_DRAWINGS["plate"] = "drawings.parts_list"
_TABLES = {
    "slot": "parts.slots.slot_profile:profile_table",
    "gears": "parts.gears.gear_pair:gears_table",
    "groove": "parts.slots.groove:groove_table",
}
# class of the parts of a wheel without its own: the links and gears in front
FRONT = "parts.flat_parts:FrontParts"
# What wheels in the plane have in common.
_FLAT = Kind("", parts="parts.flat_parts:FlatParts", tables=_TABLES)
_FLAT = _FLAT._replace(drawings=_DRAWINGS | {"sheet": "drawings.sheet.machine_sheet"})
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
    Kind("crank", drive=CRANK, refuses="motion.compatible:of_crank"),
    Kind("side-crank", drive="drives.side_crank:SideCrank", refuses=_CRANK),
    Kind("elliptical-gears", drive="drives.gears:EllipticalGears", refuses=_CRANK),
    Kind("noncircular-gears", drive="drives.gears:NoncircularGears", refuses=_CRANK),
    Kind(
        "epicyclic", drive="drives.epicyclic:Epicyclic", gearings=("external",), refuses=_PIN_PATH
    ),
    Kind("cam", drive="drives.cam:Cam", gearings=("external", "internal"), refuses=_CAM),
)
_FOLDED = map(load_named, map("kinds.{}:KINDS".format, FOLDERS))
KINDS: tuple[Kind, ...] = (*_CORE, *chain.from_iterable(_FOLDED))
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


_wheel, _drive = attrgetter("wheel"), attrgetter("drive")
GEARINGS: dict[str, str] = dict(map(attrgetter("name", "wheel"), filter(_wheel, KINDS)))
DRIVES: dict[str, str] = dict(map(attrgetter("name", "drive"), filter(_drive, KINDS)))
# laws that need no key or file of the user
_STANDARD = {
    "harmonic": "motion.laws.standard:Harmonic",
    "cycloidal": "motion.laws.standard:Cycloidal",
    "modified-trapezoid": "motion.laws.standard:ModifiedTrapezoid",
    "modified-sine": "motion.laws.standard:ModifiedSine",
    "3-4-5": "motion.laws.standard:Polynomial345",
    "4-5-6-7": "motion.laws.standard:Polynomial4567",
    "mcv50": "motion.laws.standard:ModifiedConstantVelocity",
    "sine-group": "motion.laws.standard:SineGroup",
}
STANDARD_LAWS = tuple(_STANDARD)
LAWS = _STANDARD.copy()
for _folder in EXTRAS:
    LAWS.update(load_named(f"extras.{_folder}:LAWS"))
LAWS["scca"] = "motion.laws.standard:SineConstantCosine"
LAWS["table"] = "motion.laws.table_law:TableLaw"


def _class(kinds: dict[str, str], key: tuple[str, str], name: object) -> type[Any]:
    """Class of a kind by its name in the spec. Raises GenevaError, naming the key, for another."""
    if isinstance(name, str) and name in kinds:
        found: type[Any] = load_named(kinds[name])
        return found
    known = few(name, [f'"{kind}"' for kind in kinds])
    synonyms = {word: kind.name for kind in KINDS for word in kind.synonyms}
    hint = nearest(synonyms.get(str(name), str(name)), kinds)
    raise GenevaError(f"{key[1]} must be one of {known}, not {shown(name)}{hint}", key)


# classes of wheels, drives and motion laws by their names
gearing = partial(_class, GEARINGS, ("wheel", "gearing"))
drive = partial(_class, DRIVES, ("drive", "kind"))
law = partial(_class, LAWS, ("motion", "law"))


def drives_with(thing: str) -> list[str]:
    """Names of the drives that have a thing of their own, such as ``gears``."""
    plain = getattr(drive("crank"), thing)
    return [name for name in DRIVES if getattr(drive(name), thing) != plain]
