"""Classes of wheels, drives and laws by their names, imported at their first use."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.extras import FOLDERS as EXTRAS
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.records import KINDS
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.load_named import load_named

if TYPE_CHECKING:
    from geneva_cli.motion.laws.law import Law

GEARINGS: dict[str, str] = {}
DRIVES: dict[str, str] = {}
for _kind in KINDS:
    if _kind.wheel:
        GEARINGS[_kind.name] = _kind.wheel
    if _kind.drive:
        DRIVES[_kind.name] = _kind.drive
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
    "scca": "motion.laws.standard:SineConstantCosine",
    "table": "motion.laws.table_law:TableLaw",
}


def gearing(name: str) -> type[Gearing]:
    """Class of a wheel. Raises GenevaError, naming the key, for an unknown name."""
    if not isinstance(name, str) or name not in GEARINGS:
        raise _unknown(GEARINGS, name, ("wheel", "gearing"))
    kind: type[Gearing] = load_named(GEARINGS[name])
    return kind


def drive(name: str) -> type[Drive]:
    """Class of a drive. Raises GenevaError, naming the key, for an unknown name."""
    if not isinstance(name, str) or name not in DRIVES:
        raise _unknown(DRIVES, name, ("drive", "kind"))
    kind: type[Drive] = load_named(DRIVES[name])
    return kind


def drives_with(thing: str) -> list[str]:
    """Names of the drives that have a thing of their own, such as ``gears``."""
    return [name for name in DRIVES if vars(drive(name)).get(thing)]


def law(name: str) -> type[Law]:
    """Class of a motion law. Raises GenevaError, naming the key, for an unknown name."""
    if not isinstance(name, str) or name not in LAWS:
        raise _unknown(LAWS, name, ("motion", "law"))
    kind: type[Law] = load_named(LAWS[name])
    return kind


def _unknown(kinds: dict[str, str], name: object, key: tuple[str, str]) -> GenevaError:
    """The error for a name that is none of the kinds."""
    known = few(name, [f'"{kind}"' for kind in kinds])
    quoted, hint = cut(str(name)), ""
    if isinstance(name, str):
        synonyms = {word: kind.name for kind in KINDS for word in kind.synonyms}
        quoted, hint = f'"{cut(name)}"', nearest(synonyms.get(name, name), kinds)
    return GenevaError(f"{key[1]} must be one of {known}, not {quoted}{hint}", key)
