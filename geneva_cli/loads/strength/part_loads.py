"""The greatest loads on parts over a cycle, and the stress of shafts by the ASME code (B17c-1927).

It limits tau = 16/(pi d³) sqrt((Kb M)² + (Kt T)²): Kb = 1.5 and Kt = 1 for rotating shafts with
load applied gradually, 1.5 to 2 and 1 to 1.5 with sudden loads, 2 to 3 and 1.5 to 3 with heavy
shocks. M is the force on the shaft times its overhang and T the torque at the same moment; their
greatest combination over the cycle is exact.

The axes of a spherical machine meet at the sphere's centre. Let u point at the roller, m along the
slot away from the wheel's axis, and y across it. The force is F (d y + f m) at L u: F on the wall
of the side d, and the friction f along it. About a bearing at the distance b on an axis e, less the
part along e, which is the torque, the square of the moment is

    F² [(L - b e.u)² (1 + f²) + (b² - L²) (e.m - d f e.y)²]

On the wheel e is u cos t - m sin t at the polar angle t. On the crank it follows from the roller's
velocity, -c e x u at the crank's rate c. The roller is thin: its cone presses on the wall beside u.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from geneva_cli.kept import Known
from geneva_cli.loads.contact import QuantityValue
from geneva_cli.loads.impacts.reversal import reversal_impacts
from geneva_cli.loads.impacts.shock_force import forces_N
from geneva_cli.loads.instant import Instant, LoadQuantity
from geneva_cli.loads.load_case import centrifugal_N, load_case, load_key
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.loads.strength.lock import dwell_torque_Nm
from geneva_cli.loads.strength.pin_arm_key import PinSize
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray, greater
from geneva_cli.numerics.arrays import N, parameter
from geneva_cli.numerics.jet import Array, Jet, Number, sqrt


class ShaftLoad(NamedTuple):
    """The square (Kb M)² + (Kt T)² of a shaft, for ``load_peaks``; T² without an overhang."""

    part: str
    on_sphere: bool
    orbiting_N: float  # m L w² of the bodies of a wheel on a carrier, which load its shaft too
    overhang_m: Number | None = None  # on a sphere beyond L
    bending: float = 1.0  # Kb
    torsion: float = 1.0  # Kt

    def __call__(self, i: Instant) -> QuantityValue:
        """The square, at an instant."""
        on_wheel, lever = self.part == "wheel", self.overhang_m
        if self.on_sphere:
            square, torque = sphere_moments(i, on_wheel, 0.0 if lever is None else lever)
        else:
            # of the crank's shaft that of the power through the slot
            torque = i.wheel_torque_Nm if on_wheel else i.slot_torque_Nm * i.losses / i.at.crank
        if lever is None:
            return QuantityValue(torque * torque, i.grip)
        turned = torque * self.torsion
        if not self.on_sphere:
            square = i.crank_bearing_squared
            if on_wheel:  # what orbits is added as if in one plane: an upper bound
                force = i.wheel_bearing_N + self.orbiting_N
                square = force * force
            square = square * (lever * lever)
        return QuantityValue(square * (self.bending * self.bending) + turned * turned, i.grip)


def sphere_moments(i: Instant, on_wheel: bool, overhang_m: Number) -> tuple[Jet, Jet]:
    """Squared bending moment of a shaft of a sphere, and its torque; the overhang beyond L."""
    at, L = i.at, i.case.L
    # the shaft's axis by its cosines along u, m and y
    if on_wheel:
        axis, torque = (at.arm, at.lever * -1.0, at.lever * 0.0), i.wheel_torque_Nm
    else:
        away = at.velocity * at.lever
        spin = at.spin + at.velocity * at.arm  # of the crank about the roller's axis
        rate = sqrt(at.along * at.along + away * away + spin * spin)
        axis = spin / rate * -1.0, away / rate, at.along / rate * -1.0
        torque = i.input_torque_Nm / rate
    b, rub = L + overhang_m, i.case.friction * i.slides
    lever, turn = axis[0] * -b + L, axis[1] - axis[2] * (i.drives * rub)
    bent = lever * lever * (1.0 + rub * rub) + turn * turn * ((b - L) * (b + L))
    return i.force_N * i.force_N * bent, torque


def shear_MPa(moment_Nm: N, diameter_mm: N) -> N:
    """Shear stress of a round shaft under an equivalent torque: 16 T/(pi d³)."""
    return 16e3 * moment_Nm / (math.pi * diameter_mm**3)


def _shaft_load(mechanism: Mechanism, part: str, overhang_mm: float | None = None) -> ShaftLoad:
    """Return the load of a shaft with an overhang, or of its torque alone."""
    table, lever = mechanism.spec.shaft, None if overhang_mm is None else overhang_mm / 1000.0
    orbiting = parameter(centrifugal_N(mechanism)) if mechanism.frame else 0.0
    factors = table.bending_factor, table.torsion_factor
    return ShaftLoad(part, not mechanism.axes, orbiting, lever, *factors)


def shaft_squares(
    mechanism: Mechanism,
    overhangs_mm: Mapping[str, float | None],
    held: Mapping[str, tuple[Array, Array]] = MappingProxyType({}),
) -> dict[str, PeakArray]:
    """The greatest squares (Kb M)² + (Kt T)² of shafts of m designs over a cycle, (N m)².

    By their parts, "wheel" and "crank", none without an overhang or a load. ``held`` are force, N,
    and torque, N m, (m,) each, that load a shaft in the dwell, from the first motion's end on.
    """
    table, own = mechanism.spec.shaft, dict[str, LoadQuantity]()
    for part, overhang_mm in overhangs_mm.items():
        if mechanism.spec.is_loaded and overhang_mm is not None:
            own[part] = _shaft_load(mechanism, part, overhang_mm)
    out = load_peaks(mechanism, own=own) if own else {}
    for part, (force_N, torque_Nm) in held.items():
        lever = overhangs_mm[part]
        if lever is not None and part in out:
            bent = np.ravel(table.bending_factor) * force_N * np.ravel(lever) / 1000.0
            square = bent**2 + (np.ravel(table.torsion_factor) * torque_Nm) ** 2
            first = mechanism.under_load.engagements[0]
            exit_deg = np.ravel(mechanism.shown_deg(first.mid_deg + first.exit_deg))
            at_rest = PeakArray(square, np.broadcast_to(exit_deg, square.shape))
            out[part] = greater(out[part], at_rest)
    return out


class PartLoads(NamedTuple):
    """The greatest sizes of loads, (m,) each, or numbers of one design; infinite if unbounded."""

    pin_N: float  # of a roller, along the wall's normal
    pin_jump: float  # at its change of sides: of the wheel's speed, over the input's
    wheel_N: float  # on the wheel in motion, which is that on the roller and its arm
    wheel_shaft_N: float  # on the wheel's shaft in motion: on a carrier that of its bodies, too
    wheel_Nm: float  # torque in the wheel's shaft, also in the dwell
    crank_N: float  # of the crank's bearings together, with the push of gears or of a link
    crank_Nm: float  # torque in the crank's shaft

    def of(self, i: int) -> PartLoads:
        """The loads of one design of a batch, as numbers."""
        return PartLoads(*np.reshape(self, (len(self), -1))[:, i].tolist())


def part_loads(mechanism: Mechanism) -> PartLoads:
    """The greatest loads of m designs, or as numbers of a single one."""
    wheel_shaft, crank_shaft = _shaft_load(mechanism, "wheel"), _shaft_load(mechanism, "crank")
    names = ("pin_force_N", "wheel_bearing_N", "crank_bearing_N")
    peaks = load_peaks(mechanism, names, {"wheel_Nm": wheel_shaft, "crank_Nm": crank_shaft})
    force, wheel = peaks["pin_force_N"].max, peaks["wheel_bearing_N"].max
    jump = np.nan_to_num(reversal_impacts(mechanism).jump) + np.zeros(np.shape(force))
    wheel_Nm, crank_Nm = np.sqrt(peaks["wheel_Nm"].max), np.sqrt(peaks["crank_Nm"].max)
    if mechanism.spec.load.dwell_torque_Nm is not None:
        wheel_Nm = np.maximum(wheel_Nm, dwell_torque_Nm(mechanism))
    crank, on_shaft = peaks["crank_bearing_N"].max, wheel + np.ravel(wheel_shaft.orbiting_N)
    rows = force, jump, wheel, on_shaft, wheel_Nm, crank, crank_Nm
    out = PartLoads(*map(parameter, rows))
    return out.of(0) if isinstance(mechanism.design, int) else out


def pin_forces_N(mechanism: Mechanism, loads: PartLoads, pin: PinSize) -> Array:
    """The greatest forces on pins (m, k) with friction, in the cycle or by impact."""
    force, jump = np.reshape((loads.pin_N, loads.pin_jump), (2, -1, 1))
    if jump.any():
        force = np.fmax(force, forces_N(mechanism, jump, pin))
    return np.asarray(force * np.hypot(1.0, load_case(mechanism).friction))


# The loads for which a machine is sized, cached for its sizes and their checks.
single_loads = Known(part_loads, load_key)
