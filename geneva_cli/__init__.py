"""Design calculator for Geneva (Maltese-cross) mechanisms.

    from geneva_cli import load, Design, External, SideCrank

Each name is loaded at its first use. The examples in docstrings assume that these names are
imported.
"""

import importlib
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # for a type checker: one line for each name
    from geneva_cli.design import Design as Design
    from geneva_cli.design import load as load
    from geneva_cli.drives.cam import Cam as Cam
    from geneva_cli.drives.crank import Crank as Crank
    from geneva_cli.drives.epicyclic import Epicyclic as Epicyclic
    from geneva_cli.drives.gears import EllipticalGears as EllipticalGears
    from geneva_cli.drives.gears import NoncircularGears as NoncircularGears
    from geneva_cli.drives.side_crank import SideCrank as SideCrank
    from geneva_cli.errors import GenevaError as GenevaError
    from geneva_cli.extras.servo.s_curve import SCurve as SCurve
    from geneva_cli.kinds.carousel.motion import Carousel as Carousel
    from geneva_cli.kinds.gear_sector.motion import GearSector as GearSector
    from geneva_cli.kinds.linear.motion import Linear as Linear
    from geneva_cli.kinds.linkages.four_bar import FourBar as FourBar
    from geneva_cli.kinds.linkages.slider_crank import SliderCrank as SliderCrank
    from geneva_cli.kinds.series.geneva_pair import GenevaPair as GenevaPair
    from geneva_cli.motion.laws.law import Motion as Motion
    from geneva_cli.motion.laws.standard import Cycloidal as Cycloidal
    from geneva_cli.motion.laws.standard import Harmonic as Harmonic
    from geneva_cli.motion.laws.standard import ModifiedConstantVelocity as ModifiedConstantVelocity
    from geneva_cli.motion.laws.standard import ModifiedSine as ModifiedSine
    from geneva_cli.motion.laws.standard import ModifiedTrapezoid as ModifiedTrapezoid
    from geneva_cli.motion.laws.standard import Polynomial345 as Polynomial345
    from geneva_cli.motion.laws.standard import Polynomial4567 as Polynomial4567
    from geneva_cli.motion.laws.standard import SineConstantCosine as SineConstantCosine
    from geneva_cli.motion.laws.standard import SineGroup as SineGroup
    from geneva_cli.motion.laws.table_law import TableLaw as TableLaw
    from geneva_cli.motion.machine_spec import Spec as Spec
    from geneva_cli.motion.wheels.external import External as External
    from geneva_cli.motion.wheels.internal import Internal as Internal
    from geneva_cli.motion.wheels.spherical import Spherical as Spherical
    from geneva_cli.spec.tables import Accept as Accept
    from geneva_cli.spec.tables import Limits as Limits
    from geneva_cli.spec.tables import Load as Load
    from geneva_cli.spec.tables import Mass as Mass
    from geneva_cli.spec.tables import Motor as Motor
    from geneva_cli.spec.tables import Outline as Outline
    from geneva_cli.spec.tables import Product as Product
    from geneva_cli.spec.tables import RollerMaterial as RollerMaterial
    from geneva_cli.spec.tables import Shaft as Shaft
    from geneva_cli.spec.tables import Size as Size
    from geneva_cli.spec.tables import Support as Support
    from geneva_cli.spec.tables import TitleBlock as TitleBlock
    from geneva_cli.spec.tables import Tolerance as Tolerance
    from geneva_cli.spec.tables import WheelMaterial as WheelMaterial

__version__ = "1.0.0rc1"


def _rooms() -> dict[str, str]:
    """The module of each public name."""
    from geneva_cli.motion.registry import DRIVES, GEARINGS, LAWS
    from geneva_cli.spec.tables import PLAIN

    rooms = {"Design": "design", "load": "design", "GenevaError": "errors"}
    rooms |= dict.fromkeys(("Motion", "Spec"), "motion.machine_spec")
    rooms |= {table.__name__: "spec.tables" for table in PLAIN.values()}
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
