"""Names of the kinds of wheels, drives and laws; each kind is imported when it is first used.

A new kind is one file and one line here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.kinematics.drive import Drive
from geneva_cli.kinematics.wheels.gearing import Gearing
from geneva_cli.spec.load_named import load_named

if TYPE_CHECKING:
    from geneva_cli.kinematics.laws.law import Law

GEARINGS = {
    "external": "kinematics.wheels.external:External",
    "internal": "kinematics.wheels.internal:Internal",
    "spherical": "kinematics.wheels.spherical:Spherical",
    "linear": "kinematics.wheels.linear:Linear",
    "counter": "kinematics.wheels.counter:Counter",
}
DRIVES = {
    "crank": "machine.drives.crank:Crank",
    "side-crank": "machine.drives.side_crank:SideCrank",
    "elliptical-gears": "machine.drives.elliptical_gears:EllipticalGears",
    "noncircular-gears": "machine.drives.noncircular_gears:NoncircularGears",
    "geneva-pair": "machine.drives.geneva_pair:GenevaPair",
    "four-bar": "machine.drives.four_bar:FourBar",
    "slider-crank": "machine.drives.slider_crank:SliderCrank",
    "epicyclic": "machine.drives.epicyclic:Epicyclic",
    "gear-sector": "machine.drives.gear_sector:GearSector",
    "cam": "machine.drives.cam:Cam",
    "carousel": "machine.drives.carousel:Carousel",
}
LAWS = {
    "harmonic": "kinematics.laws.standard:Harmonic",
    "cycloidal": "kinematics.laws.standard:Cycloidal",
    "modified-trapezoid": "kinematics.laws.standard:ModifiedTrapezoid",
    "modified-sine": "kinematics.laws.standard:ModifiedSine",
    "3-4-5": "kinematics.laws.standard:Polynomial345",
    "4-5-6-7": "kinematics.laws.standard:Polynomial4567",
    "mcv50": "kinematics.laws.standard:ModifiedConstantVelocity",
    "sine-group": "kinematics.laws.standard:SineGroup",
    "s-curve": "kinematics.laws.s_curve:SCurve",
    "scca": "kinematics.laws.scca:SineConstantCosine",
    "tuned": "kinematics.laws.tuned:Tuned",
    "table": "kinematics.laws.table:TableLaw",
}
# laws that need no key or file of the user
STANDARD_LAWS = tuple(
    name for name, path in LAWS.items() if path.startswith("kinematics.laws.standard:")
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
