"""Parallel keys: pressure on their sides and shear; the shear that keys and shafts allow.

A key of width b is as long as the bore, l. Its height h stands in the shaft by t1. The torque T
acts on the shaft's circle, of diameter d, so the force is 2 T/d (DIN 6892, method C). The side in
the hub bears 2 T/(d (h - t1) l), and the key's section 2 T/(d b l) of shear. Rounded ends and the
fit between hub and shaft are neglected.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Number, choose
from geneva_cli.spec.tables import Shaft


class KeyDimensions(NamedTuple):
    """A key, mm; (m,) for m designs, NaN for those without."""

    shaft: Number  # diameter
    width: Number
    bearing: Number  # height that stands in the hub, h - t1
    length: Number


NO_KEY = KeyDimensions(*[math.nan] * 4)


class KeyStress(NamedTuple):
    """Stresses of a key, MPa, and the least length, mm, that keeps both allowable ones."""

    pressure_MPa: Number
    shear_MPa: Number
    least_length_mm: Number


def key_stress(key: KeyDimensions, torque_Nm: Number, pressure: Number, shear: Number) -> KeyStress:
    """The stresses of keys under a torque; ``pressure`` and ``shear`` are the allowable ones."""
    force = 2e3 * torque_Nm / key.shaft
    sides, section = key.bearing * key.length, key.width * key.length
    least = np.maximum(force / (key.bearing * pressure), force / (key.width * shear))
    return KeyStress(force / sides, force / section, least)


def shear_allowed_MPa(shaft: Shaft, keyway: bool = False) -> Number:
    """The shear stress that shafts and keys allow: that of the spec, or of the default steel.

    The ASME code of ``shafts`` allows 0.3 of the yield strength of the default steel (see
    ``Stock``). Its other bound, 0.18 of the tensile strength, is higher. A keyway leaves three
    quarters for the shaft. Another steel, known by its modulus, has no default: it is infinite.

    >>> round(shear_allowed_MPa(Shaft()), 6), round(shear_allowed_MPa(Shaft(), keyway=True), 6)
    (82.5, 61.875)
    """
    if shaft.shear_stress_max_MPa is not None:
        return shaft.shear_stress_max_MPa
    is_steel = shaft.shear_modulus_GPa == Shaft().shear_modulus_GPa
    # 0.3 of 275 MPa, and three quarters of that
    return choose(is_steel, 61.875 if keyway else 82.5, math.inf)
