"""Strength of the crank arm between shaft and pin, of keys, and of the roller's pin.

The crank arm is a beam under the force on the roller.

The force F acts at a distance c from the arm's mid-plane, in any direction. Across the arm it bends
it in its plane, by F x at a distance x from the pin (stress A), and twists it by F c (tau). Along
the arm it pulls, and bends it out of its plane by F c (B). The greatest von Mises stress squared,
over the direction of F, is (S + sqrt(S² - 12 tau² B²))/2 with S = A² + B² + 3 tau²: an upper bound,
as bending is greatest at corners and torsion in the middle of a side.

The arm's width changes evenly between eye and hub. Weakest are sections through the pin's hole and
the shaft's bore, beside these, or where the arm is twice as wide as its eye. A section through a
hole carries half the twist, as a couple of shear forces in its two walls. Notches are neglected.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, cast

import numpy as np

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array, Number, Truth, choose, parameter
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.tolerances import rounded_below
from geneva_cli.spec.tables import Shaft, Size


class ArmDimensions(NamedTuple):
    """An arm's dimensions, mm: radii but for lengths along and across it; (m,) for m designs."""

    length: Number  # from the shaft's axis to the pin's
    hub: Number
    eye: Number
    bored: Number  # of the shaft's bore, with its keyway
    hole: Number  # of the pin
    thickness: Number
    offset: Number  # c, from the force to the arm's mid-plane


NO_ARM = ArmDimensions(*[math.nan] * 7)


def arm_stress_MPa(dimensions: ArmDimensions, force_N: Number) -> Array:
    """The greatest von Mises stress in an arm, over all directions of the force; or infinite."""
    force_N, length, hub, eye, bored, pin, h, offset = np.broadcast_arrays(force_N, *dimensions)
    taper, none = (hub - eye) / length, 0.0 * length
    with np.errstate(divide="ignore"):
        twice = np.minimum(length, eye / np.maximum(taper, 0.0))
    # place of each section, its width, and the hole in its middle
    x = np.stack((pin, twice, length - bored, pin, length))
    width = 2.0 * np.stack((*(eye + taper * x[:3]), eye, hub))
    hole = 2.0 * np.stack((none, none, none, pin, bored))
    twist, left = force_N * offset, width - hole
    with np.errstate(divide="ignore", invalid="ignore"):  # nothing left; a force without a bound
        in_plane = 6.0 * force_N * x * width / (h * (width**3 - hole**3))
        out_of_plane = 6.0 * force_N * offset / (left * h * h) + force_N / (left * h)
        # at a hole 3/2 V/(left/2 h), V being half the twist over the walls' distance
        couple = 1.5 * twist / (0.5 * (width + hole) * left * h)
        shear = np.where(hole > 0.0, couple, torsion_MPa(twist, left, h))
        total = in_plane**2 + out_of_plane**2 + 3.0 * shear**2
        root = np.sqrt(np.maximum(total**2 - 12.0 * (shear * out_of_plane) ** 2, 0.0))
        stress = np.where(left > 0.0, np.sqrt(0.5 * (total + root)), np.inf)
    most: Array = stress.max(axis=0)
    return most


def torsion_MPa(torque_Nmm: Number, width: Number, height: Number) -> Array:
    """The greatest shear stress of a rectangle in torsion: Roark's polynomial, within 0.3 %."""
    a, b = np.maximum(width, height), np.minimum(width, height)
    k = b / a
    sides = 1.0 + 0.6095 * k + 0.8865 * k**2 - 1.8023 * k**3 + 0.91 * k**4
    return cast("Array", 3.0 * torque_Nmm / (a * b * b) * sides)


def thick(arm: ArmDimensions, thickness: Array) -> ArmDimensions:
    """An arm of another thickness: the gap between it and the roller stays."""
    offset = arm.offset + 0.5 * (thickness - arm.thickness)
    return arm._replace(thickness=thickness, offset=offset)


def least_size_mm(holds: Callable[[Array], Truth], usual: Number) -> Array:
    """The size from which on parts hold, up to 32 times the usual one; infinite for none."""
    most = np.asarray(32.0 * usual)
    least = boundary(holds, most, 0.0 * most, 50)  # halvings: to 1e-13 of the size
    return np.where(holds(most), least, np.inf)


class KeyDimensions(NamedTuple):
    """A parallel key as long as its bore, mm; (m,) for m designs, NaN for those without."""

    shaft: Number  # diameter
    width: Number
    bearing: Number  # height that stands in the hub, h - t1
    length: Number


NO_KEY = KeyDimensions(*[math.nan] * 4)


def key_stress(
    key: KeyDimensions, torque_Nm: Number, pressure: Number, shear: Number
) -> tuple[Number, Number, Number]:
    """The pressure on keys and their shear under a torque, MPa, and the least length, mm.

    That length keeps the allowable ``pressure`` and ``shear``. By DIN 6892, method C, the torque T
    acts on the shaft's circle of diameter d: the side in the hub bears 2 T/(d (h - t1) l), and the
    section 2 T/(d b l) of shear. Rounded ends and the fit between hub and shaft are neglected.
    """
    force = 2e3 * torque_Nm / key.shaft
    sides, section = key.bearing * key.length, key.width * key.length
    least = np.maximum(force / (key.bearing * pressure), force / (key.width * shear))
    return force / sides, force / section, least


def shear_allowed_MPa(shaft: Shaft, keyway: bool = False) -> Number:
    """The shear stress that shafts and keys allow: that of the spec, or of the default steel.

    The ASME code allows 0.3 of the yield strength of the default steel (``Stock``), and three
    quarters of that at a keyway.

    >>> round(shear_allowed_MPa(Shaft()), 6), round(shear_allowed_MPa(Shaft(), keyway=True), 6)
    (82.5, 61.875)
    """
    if shaft.shear_stress_max_MPa is not None:
        return shaft.shear_stress_max_MPa
    return 61.875 if keyway else 82.5  # 0.3 of 275 MPa, and three quarters of that


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
