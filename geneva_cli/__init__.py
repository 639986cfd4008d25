"""Design calculator for Geneva (Maltese-cross) mechanisms.

    from geneva_cli import load, Design, External, SideCrank

What is imported from here is loaded when it is first asked for.
"""

from __future__ import annotations

import importlib
from typing import Any

__version__ = "0.1.0"

_FROM = {
    "load": "design",
    "Design": "design",
    "GenevaError": "errors",
    "Spec": "machine.spec",
    "Motion": "machine.spec",
    "Size": "spec.tables",
    "Load": "spec.tables",
    "Limits": "spec.tables",
    "External": "machine.wheels.external",
    "Internal": "machine.wheels.internal",
    "Spherical": "machine.wheels.spherical",
    "Crank": "machine.drives.crank",
    "SideCrank": "machine.drives.side_crank",
    "EllipticalGears": "machine.drives.elliptical_gears",
    "NoncircularGears": "machine.drives.noncircular_gears",
    "GenevaPair": "machine.drives.geneva_pair",
    "FourBar": "machine.drives.four_bar",
    "SliderCrank": "machine.drives.slider_crank",
    "Epicyclic": "machine.drives.epicyclic",
    "GearSector": "machine.drives.gear_sector",
    "Cam": "machine.drives.cam",
    "Harmonic": "machine.laws.standard",
    "Cycloidal": "machine.laws.standard",
    "ModifiedTrapezoid": "machine.laws.standard",
    "ModifiedSine": "machine.laws.standard",
    "Polynomial345": "machine.laws.standard",
    "Polynomial4567": "machine.laws.standard",
    "SineGroup": "machine.laws.standard",
    "TableLaw": "machine.laws.table",
}
__all__ = ["__version__", *_FROM]


def __getattr__(name: str) -> Any:
    if name not in _FROM:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = vars(importlib.import_module(f"{__name__}.{_FROM[name]}"))[name]
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
