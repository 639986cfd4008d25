"""The shear stresses that shafts and keys allow: those of the spec, or those of the default steel.

The ASME code of ``shafts`` allows 0.3 of the yield strength of the default steel (see ``Stock``).
Its other bound, 0.18 of the tensile strength, is higher. A keyway leaves three quarters for the
shaft. Another steel, known by its modulus, has no default: it is infinite.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geneva_cli.numerics.arrays import choose
from geneva_cli.spec.tables import Shaft

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Number


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
