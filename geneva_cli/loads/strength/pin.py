"""The roller's pin: its diameter, its stresses in bending and shear, and its stiffness."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

from geneva_cli.numerics.arrays import Number, choose, parameter
from geneva_cli.numerics.preferred import rounded_below

if TYPE_CHECKING:
    from geneva_cli.motion.mechanism import Mechanism
    from geneva_cli.spec.tables import Size


class PinSize(NamedTuple):
    """Diameter of a roller's pin, and length of the roller's contact line, mm."""

    diameter_mm: Number
    contact_mm: Number


def pin_stress_MPa(
    size: Size, width: Number, d: Number, force_N: Number
) -> tuple[Number, Number, Number]:
    """Bending, shear and equivalent stress of a roller's pin of diameter d, MPa.

    The force is spread evenly over the contact line, of the length b = ``width``, with the free
    length g between it and a plate. The greatest moment per newton is g + b/2 at a ``cantilever``'s
    plate; b/8 + g/2 in the middle of a ``supported`` pin, which turns in two plates; and
    (3 s² - b²)/(24 s) at the plates of a ``fixed`` one, s = b + 2 g apart. The bending stress is
    32 M/(pi d³), the shear stress 4/3 V/(pi d²/4) in the neutral axis.

    The equivalent stress is von Mises' greatest. At the height u over the axis, over the radius, it
    is sigma² u² + 3 tau² (1 - u²)², convex in u²: greatest at the outer fibre or at the axis.
    """
    gap, plates = size.allowances.pin_gap_mm, 2.0  # that share the force
    if size.pin_held == "cantilever":
        moment, plates = gap + width / 2.0, 1.0
    elif size.pin_held == "supported":
        moment = width / 8.0 + gap / 2.0
    else:
        s = width + 2.0 * gap
        moment = (3.0 * s * s - width * width) / (24.0 * s)
    bending = 32.0 * moment / (math.pi * d**3) * force_N
    shear = 16.0 / (3.0 * math.pi * d * d) / plates * force_N
    return bending, shear, cast("Number", np.maximum(bending, math.sqrt(3.0) * shear))


def stiffness_N_mm(size: Size, width: Number, d: Number, modulus_GPa: Number) -> Number:
    """Stiffness of a pin of diameter d under a force in the middle of its roller, N/mm.

    At the distance a = b/2 + g from rigid plates it is 3 E I/a³ for a ``cantilever``, 48 E I/(2 a)³
    for a ``supported`` pin and 192 E I/(2 a)³ for a ``fixed`` one; shear is neglected.

    >>> from geneva_cli import Size
    >>> round(stiffness_N_mm(Size(), 20.0, 10.0, 210.0))
    309251
    """
    factor = {"cantilever": 3.0, "supported": 6.0, "fixed": 24.0}[size.pin_held]
    a = 0.5 * width + size.allowances.pin_gap_mm
    return factor * 1e3 * modulus_GPa * (math.pi / 64.0) * d**4 / a**3


def pin_diameter_mm(mechanism: Mechanism) -> float:
    """Diameter of the roller's pin, by default r, rounded; the roller itself for 0."""
    size, r = mechanism.spec.size, mechanism.roller_radius_mm
    if size.pin_mm is None:
        if isinstance(r, float | int):
            return rounded_below(r)
        return parameter(np.array([[rounded_below(x)] for x in np.ravel(r)]))
    diameter: float = choose(size.pin_mm == 0.0, 2.0 * r, size.pin_mm)
    return diameter


def least_diameter_mm(bending: Number, shear: Number, d: Number, allowed_MPa: Number) -> Number:
    """Diameter at which a pin just holds a force under which it has these stresses at d, MPa."""
    sheared = np.sqrt(math.sqrt(3.0) * shear / allowed_MPa)
    return cast("Number", d * np.maximum(np.cbrt(bending / allowed_MPa), sheared))
