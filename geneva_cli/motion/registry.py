"""Names of the kinds of wheels, drives and laws; each kind is imported when it is first used.

A new wheel, drive or law of the core is one file and one line here. A kind that only some users
need is a folder of ``kinds`` and a line there.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.extras import FOLDERS as EXTRAS
from geneva_cli.kinds import FOLDERS
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.kind import Kind
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.load_named import load_named

if TYPE_CHECKING:
    from geneva_cli.motion.laws.law import Law

# The kinds of the core; those in ``kinds`` follow.
_CORE = (
    Kind("external", wheel="motion.wheels.external:External", parts="drawings.model:Flat"),
    Kind("internal", wheel="motion.wheels.internal:Internal", parts="drawings.model:Flat"),
    Kind("spherical", wheel="motion.wheels.spherical:Spherical"),
    Kind("crank", drive="drives.crank:Crank", refuses="drives.refuses:of_crank"),
    Kind(
        "side-crank",
        drive="drives.side_crank:SideCrank",
        refuses="drives.refuses:of_transmission",
    ),
    Kind(
        "elliptical-gears",
        drive="drives.elliptical_gears:EllipticalGears",
        refuses="drives.refuses:of_transmission",
    ),
    Kind(
        "noncircular-gears",
        drive="drives.noncircular_gears:NoncircularGears",
        refuses="drives.refuses:of_transmission",
    ),
    Kind(
        "epicyclic",
        drive="drives.epicyclic:Epicyclic",
        gearings=("external",),
        refuses="drives.refuses:of_pin_path",
    ),
    Kind(
        "cam",
        drive="drives.cam:Cam",
        gearings=("external", "internal"),
        refuses="drives.refuses:of_cam",
    ),
)
KINDS: tuple[Kind, ...] = (
    *_CORE,
    *(kind for folder in FOLDERS for kind in load_named(f"kinds.{folder}:KINDS")),
)
GEARINGS = {kind.name: kind.wheel for kind in KINDS if kind.wheel}
DRIVES = {kind.name: kind.drive for kind in KINDS if kind.drive}
# function that puts a drive in front of another, which few machines need
IN_FRONT = "drives.retimed:retimed"
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
    LAWS.update(load_named(f"extras.{_folder}:EXTRA").laws)
LAWS |= {
    "scca": "motion.laws.scca:SineConstantCosine",
    "tuned": "loads.vibration.tuned:Tuned",
    "table": "motion.laws.table:TableLaw",
}

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

    >>> [kind.name for kind in of_wheel("internal")]
    ['internal']
    """
    return [kind for kind in KINDS if name in (kind.adds_to, kind.name if kind.wheel else "")]


def thing(wheel: str, field: str) -> Any:
    """Function or class of a kind of wheel in a field of its record; None without one.

    That of a kind that adds to the wheel replaces the wheel's own.

    >>> thing("external", "load_case")
    """
    paths = [path for kind in of_wheel(wheel) if (path := kind._asdict()[field])]
    return load_named(paths[-1]) if paths else None


def families_of_kinds(where: str) -> list[Any]:
    """Functions that return families of synth, of the kinds that are searched there."""
    return [load_named(kind.families[where]) for kind in KINDS if where in kind.families]


def gearing(name: str) -> type[Gearing]:
    """Class of a wheel. Raises GenevaError, naming the key, for an unknown name."""
    kind: type[Gearing] = _load_kind(GEARINGS, name, ("wheel", "gearing"))
    return kind


def drive(name: str) -> type[Drive]:
    """Class of a drive. Raises GenevaError, naming the key, for an unknown name."""
    kind: type[Drive] = _load_kind(DRIVES, name, ("drive", "kind"))
    return kind


def drives_with(thing: str) -> list[str]:
    """Names of the drives that have a thing of their own, such as ``gears``.

    >>> drives_with("gears")
    ['elliptical-gears', 'noncircular-gears']
    """
    return [name for name in DRIVES if vars(drive(name)).get(thing)]


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
