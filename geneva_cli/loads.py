"""What the motion costs: pin force, torque on the input shaft, contact stress, power.

The wheel needs the torque T = I epsilon + M_r; the roller presses on the slot with N = |T| / h,
where h is the lever of the contact normal about the wheel's axis, less what friction takes.
Lengths in metres, forces in newtons.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import NamedTuple

from geneva_cli.classic import SIGN
from geneva_cli.jet import atan2
from geneva_cli.keys import Limits
from geneva_cli.mechanism import Mechanism
from geneva_cli.pitch import pitch, pitch_at_retrace, retraces
from geneva_cli.roots import maximum
from geneva_cli.station import LawDriven, Station
from geneva_cli.units import omega


class State(NamedTuple):
    """The loads at one input angle."""

    torque_Nm: float  # that the wheel needs
    pin_force_N: float
    input_torque_Nm: float
    contact_stress_MPa: float | None  # None where it cannot be said
    pressure_deg: float


class Greatest(NamedTuple):
    """A greatest load (infinite where nothing bounds it), and its input angle."""

    max: float
    at_deg: float


class Contact(NamedTuple):
    """What the loads at one input angle need of the motion and the slot; lengths over L."""

    velocity: float
    acceleration: float
    lever: float  # of the contact normal about the wheel's axis
    pressure: float  # radians
    curvature: float  # of the pitch curve, positive to the left of the way in
    along: float  # the roller's speed along the slot, per input radian
    crank: float  # the crank's speed, per input radian


def state(mechanism: Mechanism, station: Station, input_deg: float) -> State:
    """The loads of a station at an input angle from its mid-motion."""
    spec = mechanism.spec
    load, L = spec.load, spec.size.center_distance_mm / 1000.0
    r = spec.roller_radius_mm / 1000.0
    w = omega(spec.drive.n_rpm)
    sign = SIGN[spec.wheel.gearing]
    at = contact(station, sign, input_deg)
    torque = load.inertia_kgm2 * w * w * at.acceleration + load.torque_Nm
    # Speed at which the roller would rub if it did not roll: its own way along the slot, and the
    # turning of crank against wheel at its rim.
    drives = math.copysign(1.0, torque)
    slip = at.along + drives * sign * (at.crank + sign * at.velocity) * r / L
    # Friction shortens the lever on one side of the slot's axis and lengthens it on the other.
    grip = at.lever - math.copysign(load.friction, slip) * (r / L)
    force = abs(torque) / (grip * L) if grip > 0.0 else math.inf if torque else 0.0
    shaft = 0.0
    if math.isfinite(force):
        shaft = torque * at.velocity + load.friction * force * abs(slip) * L
    if shaft > 0.0:
        shaft /= load.efficiency
    # The roller drives (T > 0) on the wall ahead: outside, to the right of its way in.
    wall = -drives * sign * at.curvature
    stress = contact_stress(mechanism, force, r, wall / L)
    return State(torque, force, shaft, stress, math.degrees(at.pressure))


@lru_cache(maxsize=8192)
def contact(station: Station, sign: float, input_deg: float) -> Contact:
    """Motion and slot at an input angle; the loads of many speeds and sizes share them."""
    _, v, a = station.motion(input_deg, 2).derivatives()
    x, y = station.pin(input_deg, 1)
    crank = atan2(y, (1.0 - x) * sign).c[1]
    straight = station.rail(input_deg)
    if straight:
        return Contact(v, a, straight[0], 0.0, 0.0, straight[1], crank)
    back = retraces(station)
    middle = input_deg == 0.0
    at = pitch_at_retrace(station) if middle and back else pitch(station, input_deg)
    lever = math.hypot(at.x, at.y) * math.cos(at.pressure)
    if middle:
        return Contact(v, a, lever if back else 0.0, at.pressure, 0.0, 0.0, crank)
    way = math.copysign(1.0, input_deg)
    return Contact(v, a, lever, at.pressure, -way * at.turning / at.speed, way * at.speed, crank)


def contact_stress(
    mechanism: Mechanism, force_N: float, radius_m: float, curvature: float
) -> float | None:
    """Hertz pressure of the roller's line contact in MPa; ``curvature`` of the wall, per metre.

    p0 = sqrt(N E* / (pi b R_e)), E* = E / (2 (1 - nu²)) for two bodies of one material. A wall
    whose pitch curve curves towards it is convex, with the roller's radius less. Where such a
    wall is sharper than the roller itself, as it is beside a cusp at mid-motion, it ends in an
    edge and not in a cylinder, and the formula says nothing: None, and the undercut is reported.
    """
    width = mechanism.spec.size.face_width_mm
    if width is None:
        return None
    load = mechanism.spec.load
    modulus = load.youngs_modulus_GPa * 1e9 / (2.0 * (1.0 - load.poisson_ratio**2))
    # Wall at a roller's radius from a pitch curve of this curvature.
    bent = 1.0 - curvature * radius_m
    if bent < 0.5:
        return None
    relative = max(0.0, 1.0 / radius_m + curvature / bent)
    return math.sqrt(force_N * modulus * relative / (math.pi * width / 1000.0)) / 1e6


def greatest(mechanism: Mechanism, quantity: str) -> Greatest:
    """The greatest size of a field of ``State`` over all stations."""
    best = Greatest(0.0, 0.0)
    for station in mechanism.stations:
        found = _greatest(mechanism, station, quantity)
        if found.max > best.max:
            best = Greatest(found.max, station.mid_deg + found.at_deg)
    return best


def _greatest(mechanism: Mechanism, station: Station, quantity: str) -> Greatest:
    def size(x: float) -> float:
        value: float | None = getattr(state(mechanism, station, x), quantity)
        return abs(value or 0.0)

    if isinstance(station, LawDriven) and not retraces(station):
        if quantity == "pressure_deg":
            return Greatest(90.0, 0.0)
        w = omega(mechanism.spec.drive.n_rpm)
        a = station.motion(0.0, 2).derivatives()[2]
        load = mechanism.spec.load
        needed = load.inertia_kgm2 * w * w * a + load.torque_Nm
        largest = load.inertia_kgm2 * w * w * abs(station.motion(station.entry_deg / 2, 2).c[2])
        if quantity != "input_torque_Nm" and abs(needed) > 1e-12 * (largest + load.torque_Nm):
            return Greatest(math.inf, 0.0)
    value, at = 0.0, station.entry_deg
    breaks = station.breaks_deg
    for a, b in zip(breaks, breaks[1:], strict=False):
        x, y = maximum(size, a, b)
        if y > value * (1.0 + 1e-12):
            value, at = y, x
    return Greatest(value, at)


def fastest_rpm(mechanism: Mechanism) -> float | None:
    """The highest input speed at which the limits on force, torque and stress hold.

    None where there are no such limits, or where no speed keeps them.
    """
    limits = mechanism.spec.limits
    held = {q: limit for q, limit in zip(LIMITED, load_limits(limits), strict=True) if limit}
    if not held:
        return None

    def excess(n_rpm: float) -> float:
        drive = mechanism.spec.drive._replace(n_rpm=n_rpm)
        changed = mechanism._replace(spec=mechanism.spec._replace(drive=drive))
        return max(greatest(changed, q).max / limit for q, limit in held.items()) - 1.0

    # Loads rise with n², from what the resisting torque alone takes: regula falsi in n².
    low, high = 0.0, mechanism.spec.drive.n_rpm**2
    below, above = excess(1e-9), excess(math.sqrt(high))
    while above < 0.0 and high < 1e18:
        low, below, high = high, above, 16.0 * high
        above = excess(math.sqrt(high))
    if below > 0.0 or above < 0.0 or math.isinf(above):
        return None
    for _ in range(60):
        square = low - below * (high - low) / (above - below)
        here = excess(math.sqrt(square))
        if here > 0.0:
            high, above, below = square, here, 0.5 * below
        else:
            low, below, above = square, here, 0.5 * above
        if abs(here) < 1e-6:  # more digits of a speed than anybody sets
            break
    return math.sqrt(square)


LIMITED = ("pin_force_N", "input_torque_Nm", "contact_stress_MPa")


def load_limits(limits: Limits) -> tuple[float | None, float | None, float | None]:
    """The limits on the quantities in ``LIMITED``."""
    return limits.pin_force_max_N, limits.input_torque_max_Nm, limits.contact_stress_max_MPa


def kinetic_power_W(mechanism: Mechanism, power_invariant: float) -> float:
    """Peak power that the inertia takes from the input: I epsilon omega / eta."""
    load = mechanism.spec.load
    w = omega(mechanism.spec.drive.n_rpm)
    return load.inertia_kgm2 * power_invariant * w**3 / load.efficiency
