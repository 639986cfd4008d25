"""Names of the kinds of wheels, drives and laws; each kind is imported when it is first used.

A new wheel, drive or law of the core is one file and one line here. A kind that only some users
need is a folder of ``kinds`` and a line there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.kinds import FOLDERS
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.kind import Kind
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.load_named import load_named

if TYPE_CHECKING:
    from geneva_cli.motion.laws.law import Law

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
    "assembly": "drawings.machine_drawing:machine",
    "gears": "drawings.part_drawings:gears",
    "groove": "drawings.part_drawings:groove",
    "groove-plate": "drawings.part_drawings:groove_plate",
    "coupon": "drawings.coupon:coupon",
    "plate": "drawings.print_plate:plate",
    "sheet": "drawings.sheet.sheet:sheet",
}
_TABLES = {
    "slot": "parts.slots.slot_sampling:profile_table",
    "gears": "parts.gears.gear_curves:gears_table",
    "groove": "parts.slots.groove:groove_table",
}
_FRONT = "parts.front_parts:FrontParts"
# The kinds of the core; those in ``kinds`` follow.
_CORE = (
    Kind(
        "external",
        wheel="motion.wheels.external:External",
        parts="parts.flat_parts:FlatParts",
        drawings=_DRAWINGS,
        tables=_TABLES,
    ),
    Kind(
        "internal",
        wheel="motion.wheels.internal:Internal",
        parts="parts.flat_parts:FlatParts",
        drawings=_DRAWINGS,
        tables=_TABLES,
    ),
    Kind(
        "spherical",
        wheel="motion.wheels.spherical:Spherical",
        front=_FRONT,
        drawings=_DRAWINGS,
        tables=_TABLES,
    ),
    Kind("crank", drive="drives.crank:Crank"),
    Kind("side-crank", drive="drives.side_crank:SideCrank"),
    Kind("elliptical-gears", drive="drives.elliptical_gears:EllipticalGears"),
    Kind("noncircular-gears", drive="drives.noncircular_gears:NoncircularGears"),
    Kind("epicyclic", drive="drives.epicyclic:Epicyclic"),
    Kind("cam", drive="drives.cam:Cam"),
)
KINDS: tuple[Kind, ...] = (
    *_CORE,
    *(kind for folder in FOLDERS for kind in load_named(f"kinds.{folder}:KINDS")),
)
GEARINGS = {kind.name: kind.wheel for kind in KINDS if kind.wheel}
DRIVES = {kind.name: kind.drive for kind in KINDS if kind.drive}
LAWS = {
    "harmonic": "motion.laws.standard:Harmonic",
    "cycloidal": "motion.laws.standard:Cycloidal",
    "modified-trapezoid": "motion.laws.standard:ModifiedTrapezoid",
    "modified-sine": "motion.laws.standard:ModifiedSine",
    "3-4-5": "motion.laws.standard:Polynomial345",
    "4-5-6-7": "motion.laws.standard:Polynomial4567",
    "mcv50": "motion.laws.standard:ModifiedConstantVelocity",
    "sine-group": "motion.laws.standard:SineGroup",
    "s-curve": "extras.servo.s_curve:SCurve",
    "scca": "motion.laws.scca:SineConstantCosine",
    "tuned": "loads.vibration.tuned:Tuned",
    "table": "motion.laws.table:TableLaw",
}
# laws that need no key or file of the user
STANDARD_LAWS = tuple(
    name for name, path in LAWS.items() if path.startswith("motion.laws.standard:")
)

# other words for a kind, where the nearest by its letters would be another one
_SYNONYMS = {
    "inner": "internal",
    "inside": "internal",
    "outer": "external",
    "outside": "external",
    "rack": "linear",
    "bevel": "spherical",
}


def of_wheel(name: str) -> list[Kind]:
    """The records of a kind of wheel: its own, then those that add to it.

    >>> [kind.name for kind in of_wheel("external")]
    ['external', 'stop']
    """
    return [kind for kind in KINDS if name in (kind.adds_to, kind.name if kind.wheel else "")]


def thing(wheel: str, field: str) -> Any:
    """Function or class of a kind of wheel in a field of its record; None without one.

    That of a kind that adds to the wheel replaces the wheel's own.

    >>> thing("external", "wheel_body")
    """
    paths = [path for kind in of_wheel(wheel) if (path := kind._asdict()[field])]
    return load_named(paths[-1]) if paths else None


def parts_class(wheel: str) -> Any:
    """Class of the parts of a kind of wheel; without its own, of the links and gears in front."""
    return thing(wheel, "parts") or load_named(_FRONT)


def gearing(name: str) -> type[Gearing]:
    """Class of a wheel. Raises GenevaError, naming the key, for an unknown name."""
    kind: type[Gearing] = _load_kind(GEARINGS, name, ("wheel", "gearing"))
    return kind


def drive(name: str) -> type[Drive]:
    """Class of a drive. Raises GenevaError, naming the key, for an unknown name."""
    kind: type[Drive] = _load_kind(DRIVES, name, ("drive", "kind"))
    return kind


def law(name: str) -> type[Law]:
    """Class of a motion law. Raises GenevaError, naming the key, for an unknown name."""
    kind: type[Law] = _load_kind(LAWS, name, ("motion", "law"))
    return kind


def _load_kind(kinds: dict[str, str], name: str, key: tuple[str, str]) -> Any:
    if not isinstance(name, str) or name not in kinds:
        quoted = f'"{cut(name)}"' if isinstance(name, str) else cut(name)
        known = few(name, [f'"{kind}"' for kind in kinds])
        hint = nearest(_SYNONYMS.get(name, name), kinds) if isinstance(name, str) else ""
        raise GenevaError(f"{key[1]} must be one of {known}, not {quoted}{hint}", key)
    return load_named(kinds[name])
