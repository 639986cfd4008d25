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
from collections.abc import Hashable, Sequence
from typing import NamedTuple, Protocol

import numpy as np

from geneva_cli.kept import Known
from geneva_cli.loads.carried import MM, carried_kg
from geneva_cli.loads.contact import QuantityValue
from geneva_cli.loads.cycle_quantities import FORCE
from geneva_cli.loads.impacts.reversal import reversal_impacts
from geneva_cli.loads.instant import Instant, LoadQuantity
from geneva_cli.loads.load_peaks import load_peaks
from geneva_cli.loads.strength.lock import dwell_torque_Nm
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.peak_search import PeakArray, greater
from geneva_cli.numerics.angles import omega
from geneva_cli.numerics.arrays import N, parameter
from geneva_cli.numerics.jet import Array, Jet, Number, sqrt


class ShaftForces(Hashable, Protocol):
    """The loads of a shaft at an instant: a function, or a tuple that is called as one."""

    def __call__(self, i: Instant[Jet], overhang: Number, /) -> tuple[Jet, Jet]:
        """Squared bending moment, (N m)², for an overhang in metres; and torque."""


class LoadedShaft(NamedTuple):
    """The loads on a shaft and its dimensions, floats or (m, 1); None for unknown ones."""

    forces: ShaftForces
    overhang_mm: float | None
    diameter_mm: float | None = None
    span_mm: float | None = None
    allowed_MPa: float | None = None
    held_N: Array | float = 0.0  # by the lock in the dwell, (m,)
    held_Nm: Array | float = 0.0


def shear_MPa(moment_Nm: N, diameter_mm: N) -> N:
    """Shear stress of a round shaft under an equivalent torque: 16 T/(pi d³)."""
    return 16e3 * moment_Nm / (math.pi * diameter_mm**3)


def on_wheel(i: Instant[Jet], overhang: Number) -> tuple[Jet, Jet]:
    """Squared bending moment of the wheel's shaft, and torque: the loads from slot and wheel."""
    return i.wheel_bearing_N * i.wheel_bearing_N * (overhang * overhang), i.wheel_torque_Nm


class OnCarrier(NamedTuple):
    """The loads of the shaft of a wheel on a carrier, which also bears its bodies' m L w².

    That is added to the roller's force as if both had one direction and one plane: an upper bound.
    """

    orbiting_N: float  # m L w²

    def force_N(self, i: Instant[Jet]) -> Jet:
        """The force on the shaft."""
        return i.wheel_bearing_N + self.orbiting_N

    def __call__(self, i: Instant[Jet], overhang: Number, /) -> tuple[Jet, Jet]:
        """Squared bending moment of the wheel's shaft, and torque."""
        force = self.force_N(i)
        return force * force * (overhang * overhang), i.wheel_torque_Nm


def on_crank(i: Instant[Jet], overhang: Number) -> tuple[Jet, Jet]:
    """Squared bending moment of the crank's shaft, and its torque."""
    return i.crank_bearing_squared * (overhang * overhang), i.crank_torque_Nm


def on_sphere_wheel(i: Instant[Jet], overhang: Number) -> tuple[Jet, Jet]:
    """Squared bending moment of the wheel's shaft, and torque; the overhang beyond L in metres."""
    axis = i.at.arm, i.at.lever * -1.0, i.at.lever * 0.0
    return _bending_squared(i, axis, overhang), i.wheel_torque_Nm


def on_sphere_crank(i: Instant[Jet], overhang: Number) -> tuple[Jet, Jet]:
    """Squared bending moment of the crank's shaft, and torque; the overhang beyond L in metres."""
    at = i.at
    away = at.velocity * at.lever
    spin = at.spin + at.velocity * at.arm  # of the crank about the roller's axis
    rate = sqrt(at.along * at.along + away * away + spin * spin)
    axis = spin / rate * -1.0, away / rate, at.along / rate * -1.0
    return _bending_squared(i, axis, overhang), i.input_torque_Nm / rate


def _bending_squared(i: Instant[Jet], axis: tuple[Jet, Jet, Jet], overhang: Number) -> Jet:
    """The square of the moment that bends a shaft whose axis has these cosines along u, m, y."""
    L, (up, away, across) = i.case.L, axis
    b, rub = L + overhang, i.case.friction * i.slides
    lever = up * -b + L
    turn = away - across * (i.drives * rub)
    bent = lever * lever * (1.0 + rub * rub) + turn * turn * ((b - L) * (b + L))
    return i.force_N * i.force_N * bent


def wheel_forces(mechanism: Mechanism) -> ShaftForces:
    """The loads of the wheel's shaft."""
    if mechanism.spec.drive.wheels_on_carrier:
        return on_carrier(mechanism)
    return on_wheel if mechanism.axes else on_sphere_wheel


def on_carrier(mechanism: Mechanism) -> OnCarrier:
    """The loads of the shaft of a wheel on a carrier."""
    spec, L = mechanism.spec, mechanism.center_distance_mm * MM
    return OnCarrier(carried_kg(spec) * omega(spec.drive.n_rpm) ** 2 * L)


def crank_forces(spec: Spec) -> ShaftForces:
    """The loads of the crank's shaft."""
    return on_crank if spec.wheel.axes(spec.given_distance_mm) else on_sphere_crank


# Rows for ``load_peaks``, which the grip bounds.


class OnShaft(NamedTuple):
    """The force on the shaft of a wheel on a carrier."""

    loaded: OnCarrier

    def __call__(self, i: Instant[Jet]) -> QuantityValue[Jet]:
        """The force."""
        return QuantityValue(self.loaded.force_N(i), i.grip)


class Torque(NamedTuple):
    """The squared torque."""

    loaded: ShaftForces

    def __call__(self, i: Instant[Jet]) -> QuantityValue[Jet]:
        """The square."""
        _, torque = self.loaded(i, 0.0)
        return QuantityValue(torque * torque, i.grip)


class Moment(NamedTuple):
    """The square (Kb M)² + (Kt T)²; overhang in metres."""

    loaded: ShaftForces
    overhang: float
    bending: float
    torsion: float

    def __call__(self, i: Instant[Jet]) -> QuantityValue[Jet]:
        """The square."""
        square, torque = self.loaded(i, self.overhang)
        turned = torque * self.torsion
        return QuantityValue(square * (self.bending * self.bending) + turned * turned, i.grip)


def shafts_under_load(
    mechanism: Mechanism, shafts: Sequence[LoadedShaft]
) -> list[dict[str, Array]]:
    """Shafts of m designs under the forces and torques of a cycle: columns (m,) by their names.

    ``moment_Nm`` is the greatest sqrt((Kb M)² + (Kt T)²), at ``at_deg``; ``twist_deg`` the greatest
    over overhang and span. What needs unknown dimensions is left out, and all of a shaft without an
    overhang or a load. What is held loads a shaft in the dwell, from the first motion's end on.
    """
    table, own = mechanism.spec.shaft, dict[str, LoadQuantity]()
    for i, one in enumerate(shafts):
        if mechanism.spec.is_loaded and one.overhang_mm is not None:
            factors = table.bending_factor, table.torsion_factor
            own[f"moment {i}"] = Moment(one.forces, one.overhang_mm / 1000.0, *factors)
            own[f"torque {i}"] = Torque(one.forces)
    peaks = load_peaks(mechanism, tuple(own), own) if own else {}
    return [
        _columns(mechanism, one, one.overhang_mm, peaks[f"moment {i}"], peaks[f"torque {i}"])
        if one.overhang_mm is not None and peaks
        else {}
        for i, one in enumerate(shafts)
    ]


def _columns(
    mechanism: Mechanism, shaft: LoadedShaft, overhang_mm: float, both: PeakArray, turned: PeakArray
) -> dict[str, Array]:
    """Results from the greatest squares of moment and torque in motion."""
    table, d, span = mechanism.spec.shaft, shaft.diameter_mm, shaft.span_mm
    if np.any(np.asarray(shaft.held_N) > 0.0) or np.any(np.asarray(shaft.held_Nm) != 0.0):
        bent = np.ravel(table.bending_factor) * shaft.held_N * np.ravel(overhang_mm / 1000.0)
        square = bent**2 + (np.ravel(table.torsion_factor) * shaft.held_Nm) ** 2
        first = mechanism.under_load.engagements[0]
        exit_deg = np.ravel(mechanism.shown_deg(first.mid_deg + first.exit_deg))
        both = greater(both, PeakArray(square, np.broadcast_to(exit_deg, square.shape)))
        turned = turned._replace(max=np.maximum(turned.max, np.square(shaft.held_Nm)))
    most = np.sqrt(both.max)
    out = {"moment_Nm": most, "at_deg": both.at_deg}
    if d is not None:
        out["stress_MPa"] = shear_MPa(most, np.ravel(d))
    if shaft.allowed_MPa is not None:
        out["least_diameter_mm"] = np.cbrt(16e3 * most / (math.pi * np.ravel(shaft.allowed_MPa)))
    if d is not None and span is not None:
        polar = math.pi * d**4 / 32.0  # N m mm / (GPa mm^4) is 1
        rate = np.ravel((overhang_mm + span) / (table.shear_modulus_GPa * polar))
        torque = np.where(np.isfinite(turned.max), np.sqrt(turned.max), np.nan)
        out["twist_deg"] = np.degrees(torque * rate)
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
        return PartLoads(*(float(np.ravel(row)[i]) for row in self))


@Known
def single_loads(mechanism: Mechanism) -> PartLoads:
    """The loads for which a machine is sized as numbers, cached for its sizes and their checks."""
    return part_loads(mechanism).of(0)


def part_loads(mechanism: Mechanism) -> PartLoads:
    """The greatest loads of m designs."""
    spec = mechanism.spec
    turned = {"wheel_Nm": Torque(wheel_forces(mechanism)), "crank_Nm": Torque(crank_forces(spec))}
    shaft, own = "wheel_bearing_N", dict[str, LoadQuantity](turned)
    if spec.drive.wheels_on_carrier:
        shaft, own["wheel_shaft_N"] = "wheel_shaft_N", OnShaft(on_carrier(mechanism))
    names = FORCE, "wheel_bearing_N", shaft, "crank_bearing_N", *turned
    peaks = load_peaks(mechanism, tuple(dict.fromkeys(names)), own)
    force, wheel, on_shaft, crank = (peaks[name].max for name in names[:4])
    wheel_Nm, crank_Nm = (np.sqrt(peaks[name].max) for name in turned)
    jump = np.nan_to_num(reversal_impacts(mechanism).jump) + np.zeros(np.shape(force))
    held = np.maximum(wheel_Nm, dwell_torque_Nm(mechanism))
    return PartLoads(*map(parameter, (force, jump, wheel, on_shaft, held, crank, crank_Nm)))
