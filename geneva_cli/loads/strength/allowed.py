"""The stresses that the materials allow: those of the spec, or those of the default steel.

The default steel is C45+N (1.0503, normalised). Its least yield strength is 275 MPa, that of pieces
of 100 to 250 mm (EN 10083-2); thinner ones have more. The ASME code of ``shafts`` allows 0.3 of it
in shear, and 0.6 in tension, bending and pressure. Its other bound, 0.18 and 0.36 of the tensile
strength of 560 MPa, is higher. A keyway leaves three quarters for the shaft.

Another material, known by its modulus, has no default: it is infinite.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.numerics.arrays import choose
from geneva_cli.spec.tables import Shaft, WheelMaterial

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.spec.tables import Material


def allowed_MPa(material: Material) -> Number:
    """The allowable stress of a wheel, an arm or a pin.

    >>> round(allowed_MPa(WheelMaterial()), 6)
    165.0
    """
    if material.stress_max_MPa is not None:
        return material.stress_max_MPa
    is_steel = material.youngs_modulus_GPa == WheelMaterial().youngs_modulus_GPa
    return choose(is_steel, 165.0, math.inf)  # 0.6 of 275 MPa


def shear_allowed_MPa(shaft: Shaft, keyway: bool = False) -> Number:
    """The allowable shear stress of a shaft.

    >>> round(shear_allowed_MPa(Shaft()), 6), round(shear_allowed_MPa(Shaft(), keyway=True), 6)
    (82.5, 61.875)
    """
    if shaft.shear_stress_max_MPa is not None:
        return shaft.shear_stress_max_MPa
    is_steel = shaft.shear_modulus_GPa == Shaft().shear_modulus_GPa
    # 0.3 of 275 MPa, and three quarters of that
    return choose(is_steel, 61.875 if keyway else 82.5, math.inf)
