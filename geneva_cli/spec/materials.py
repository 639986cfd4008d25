"""The materials of parts: those of the spec, or the defaults of the process.

Wheel, arm and locking disc are plates of the process's material, ``[material.wheel]``. Rollers,
pins and shafts are rods, ``[material.roller]``: steel, whatever cuts or prints the plates.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.numerics.arrays import choose
from geneva_cli.spec.default_sizes import value_or
from geneva_cli.spec.workshops import Stock, workshop

if TYPE_CHECKING:
    from geneva_cli.motion.machine_spec import Spec
    from geneva_cli.spec.tables import Material


def wheel_material(spec: Spec) -> Stock:
    """Return the material of the wheel, and of all other plates.

    >>> from geneva_cli.motion.machine_spec import Spec
    >>> wheel_material(Spec(External(6), size=Size(process="print"))).youngs_modulus_GPa
    2.4
    """
    return _material(spec.material_wheel, workshop(spec.size.process).stock)


def roller_material(spec: Spec) -> Stock:
    """Return the material of rollers, pins and shafts, by default steel."""
    return _material(spec.material_roller, Stock())


def material_names(spec: Spec) -> tuple[str, str]:
    """Names of the material of plates and of rods: the grade, or the density of an unusual one.

    >>> from geneva_cli.motion.machine_spec import Spec
    >>> material_names(Spec(External(6), size=Size(process="print")))
    ('PLA', 'steel')
    """
    return (
        _named(spec.material_wheel, wheel_material(spec), workshop(spec.size.process).stock),
        _named(spec.material_roller, roller_material(spec), Stock()),
    )


def _named(own: Material, of: Stock, usual: Stock) -> str:
    if own.grade or of == usual._replace(allowed_MPa=of.allowed_MPa):
        return of.grade
    return f"{of.density_kgm3:g} kg/m³"


def _material(own: Material, usual: Stock) -> Stock:
    """Return the values of the spec, and else those of the usual material.

    A part of another stiffness is of another material, which has no default of its strength.
    """
    modulus = value_or(own.youngs_modulus_GPa, usual.youngs_modulus_GPa)
    is_usual = modulus == usual.youngs_modulus_GPa
    return Stock(
        own.grade or usual.grade,
        modulus,
        value_or(own.poisson_ratio, usual.poisson_ratio),
        value_or(own.density_kgm3, usual.density_kgm3),
        value_or(own.stress_max_MPa, choose(is_usual, usual.allowed_MPa, math.inf)),
    )
