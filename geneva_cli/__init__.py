"""Design calculator for Geneva (Maltese-cross) mechanisms.

    from geneva_cli import load, Design, External, SideCrank

Each name is loaded at its first use. The examples in docstrings assume that these names are
imported.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # for a type checker: one line for each name
    from geneva_cli.design import Design as Design
    from geneva_cli.design import load as load
    from geneva_cli.errors import GenevaError as GenevaError
    from geneva_cli.kinematics.laws.s_curve import SCurve as SCurve
    from geneva_cli.kinematics.laws.scca import SineConstantCosine as SineConstantCosine
    from geneva_cli.kinematics.laws.standard import Cycloidal as Cycloidal
    from geneva_cli.kinematics.laws.standard import Harmonic as Harmonic
    from geneva_cli.kinematics.laws.standard import (
        ModifiedConstantVelocity as ModifiedConstantVelocity,
    )
    from geneva_cli.kinematics.laws.standard import ModifiedSine as ModifiedSine
    from geneva_cli.kinematics.laws.standard import ModifiedTrapezoid as ModifiedTrapezoid
    from geneva_cli.kinematics.laws.standard import Polynomial345 as Polynomial345
    from geneva_cli.kinematics.laws.standard import Polynomial4567 as Polynomial4567
    from geneva_cli.kinematics.laws.standard import SineGroup as SineGroup
    from geneva_cli.kinematics.laws.table import TableLaw as TableLaw
    from geneva_cli.kinematics.laws.tuned import Tuned as Tuned
    from geneva_cli.kinematics.motion import Motion as Motion
    from geneva_cli.kinematics.wheels.counter import Counter as Counter
    from geneva_cli.kinematics.wheels.external import External as External
    from geneva_cli.kinematics.wheels.internal import Internal as Internal
    from geneva_cli.kinematics.wheels.linear import Linear as Linear
    from geneva_cli.kinematics.wheels.spherical import Spherical as Spherical
    from geneva_cli.machine.drives.cam import Cam as Cam
    from geneva_cli.machine.drives.carousel import Carousel as Carousel
    from geneva_cli.machine.drives.crank import Crank as Crank
    from geneva_cli.machine.drives.elliptical_gears import EllipticalGears as EllipticalGears
    from geneva_cli.machine.drives.epicyclic import Epicyclic as Epicyclic
    from geneva_cli.machine.drives.four_bar import FourBar as FourBar
    from geneva_cli.machine.drives.gear_sector import GearSector as GearSector
    from geneva_cli.machine.drives.geneva_pair import GenevaPair as GenevaPair
    from geneva_cli.machine.drives.noncircular_gears import NoncircularGears as NoncircularGears
    from geneva_cli.machine.drives.side_crank import SideCrank as SideCrank
    from geneva_cli.machine.drives.slider_crank import SliderCrank as SliderCrank
    from geneva_cli.machine.spec import Spec as Spec
    from geneva_cli.spec.tables import Limits as Limits
    from geneva_cli.spec.tables import Load as Load
    from geneva_cli.spec.tables import Mass as Mass
    from geneva_cli.spec.tables import Motor as Motor
    from geneva_cli.spec.tables import Product as Product
    from geneva_cli.spec.tables import RollerMaterial as RollerMaterial
    from geneva_cli.spec.tables import Shaft as Shaft
    from geneva_cli.spec.tables import Size as Size
    from geneva_cli.spec.tables import Support as Support
    from geneva_cli.spec.tables import TitleBlock as TitleBlock
    from geneva_cli.spec.tables import Tolerance as Tolerance
    from geneva_cli.spec.tables import WheelMaterial as WheelMaterial

__version__ = "1.0.0rc1"

# The modules of other names; drives, wheels and laws are in their registries.
_FROM = {
    "design": ("Design", "load"),
    "errors": ("GenevaError",),
    "machine.spec": ("Motion", "Spec"),
    "spec.tables": (
        "Limits",
        "Load",
        "Mass",
        "Motor",
        "Product",
        "RollerMaterial",
        "Shaft",
        "Size",
        "Support",
        "TitleBlock",
        "Tolerance",
        "WheelMaterial",
    ),
}


def _rooms() -> dict[str, str]:
    """The module of each public name."""
    from geneva_cli.kinematics.registry import DRIVES, GEARINGS, LAWS

    rooms = {name: module for module, names in _FROM.items() for name in names}
    for path in (*GEARINGS.values(), *DRIVES.values(), *LAWS.values()):
        module, _, name = path.partition(":")
        rooms[name] = module
    return rooms


def __dir__() -> list[str]:
    return ["__version__", *sorted(_rooms())]


if not TYPE_CHECKING:  # otherwise a type checker would accept any name

    def __getattr__(name: str) -> object:
        if name == "__all__":
            return __dir__()
        rooms = _rooms()
        if name not in rooms:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        value = vars(importlib.import_module(f"{__name__}.{rooms[name]}"))[name]
        globals()[name] = value
        return value
