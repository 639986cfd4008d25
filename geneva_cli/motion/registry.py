"""Names of the kinds of wheels, drives and laws; each kind is imported when it is first used.

A new kind is one file and one line here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from geneva_cli.errors import GenevaError, cut, few, nearest
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.spec.load_named import load_named

if TYPE_CHECKING:
    from geneva_cli.motion.laws.law import Law

GEARINGS = {
    "external": "motion.wheels.external:External",
    "internal": "motion.wheels.internal:Internal",
    "spherical": "motion.wheels.spherical:Spherical",
    "linear": "kinds.linear.motion:Linear",
}
DRIVES = {
    "crank": "drives.crank:Crank",
    "side-crank": "drives.side_crank:SideCrank",
    "elliptical-gears": "drives.elliptical_gears:EllipticalGears",
    "noncircular-gears": "drives.noncircular_gears:NoncircularGears",
    "geneva-pair": "kinds.series.geneva_pair:GenevaPair",
    "four-bar": "kinds.linkages.four_bar:FourBar",
    "slider-crank": "kinds.linkages.slider_crank:SliderCrank",
    "epicyclic": "drives.epicyclic:Epicyclic",
    "gear-sector": "kinds.gear_sector.motion:GearSector",
    "cam": "drives.cam:Cam",
    "carousel": "kinds.carousel.motion:Carousel",
}
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
