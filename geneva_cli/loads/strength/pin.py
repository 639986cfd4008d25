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


class Pin(NamedTuple):
    """A round pin's stresses per newton, MPa, and its diameter."""

    diameter_mm: Number
    bending: Number
    shear: Number

    def under(self, force_N: Number) -> Pin:
        """Stresses under a force, MPa."""
        return Pin(self.diameter_mm, self.bending * force_N, self.shear * force_N)

    @property
    def equivalent(self) -> Number:
        """Greatest von Mises stress of the section.

        At the height u over the axis, over the radius, it is sigma² u² + 3 tau² (1 - u²)², which is
        convex in u²: greatest at the outer fibre or at the neutral axis.
        """
        return cast("Number", np.maximum(self.bending, math.sqrt(3.0) * self.shear))


def moment_mm(support: str, width: Number, gap: Number) -> Number:
    """Greatest bending moment per newton, N mm, spread evenly over the contact line.

    ``width`` is the line's length b and ``gap`` the free length g between it and a plate, mm. At a
    ``cantilever``'s plate it is g + b/2. In the middle of a ``supported`` pin, which turns in two
    plates, it is b/8 + g/2. At the plates of a ``fixed`` one, s = b + 2 g apart, it is
    (3 s² - b²)/(24 s).

    >>> moment_mm("cantilever", 24.0, 0.0), moment_mm("fixed", 24.0, 0.0)
    (12.0, 2.0)
    """
    if support == "cantilever":
        return gap + width / 2.0
    if support == "supported":
        return width / 8.0 + gap / 2.0
    s = width + 2.0 * gap
    return (3.0 * s * s - width * width) / (24.0 * s)


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


def pin(size: Size, width: Number, d: Number) -> Pin:
    """A roller's pin of diameter d; ``width`` is the length of the contact line, mm.

    Bending 32 M/(pi d³) at the plate or in the middle, shear 4/3 V/(pi d²/4) in the neutral axis.
    """
    moment = moment_mm(size.pin_held, width, size.allowances.pin_gap_mm)
    plates = 1.0 if size.pin_held == "cantilever" else 2.0  # that share the force
    shear = 16.0 / (3.0 * math.pi * d * d) / plates
    return Pin(d, 32.0 * moment / (math.pi * d**3), shear)


def least_diameter_mm(of: Pin, force_N: Number, allowed_MPa: Number) -> Number:
    """Diameter at which the equivalent stress equals the allowable one."""
    bent = np.cbrt(of.bending * force_N / allowed_MPa)
    sheared = np.sqrt(math.sqrt(3.0) * of.shear * force_N / allowed_MPa)
    return cast("Number", of.diameter_mm * np.maximum(bent, sheared))
