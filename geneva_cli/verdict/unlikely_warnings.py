"""Warnings about unlikely numbers: an inertia or a speed that may be in another unit."""

from __future__ import annotations

import math

from geneva_cli.analysis.carried import inertia_kgm2
from geneva_cli.analysis.peaks import worst_of
from geneva_cli.errors import Notice
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.angles import omega


def unlikely_warnings(mechanism: Mechanism) -> list[Notice]:
    """The warnings, of a wheel that turns."""
    return [*_heavy(mechanism), *_fast(mechanism)] if mechanism.output.turns else []


def _heavy(mechanism: Mechanism) -> list[Notice]:
    L, inertia = mechanism.center_distance_mm / 1000.0, inertia_kgm2(mechanism.spec)
    # The largest table expected is solid steel, 6 L across and L/2 thick; J = pi rho h D^4 / 32. A
    # larger inertia is nearly always meant in kg cm2.
    diameter, thickness, density = 6.0 * L, 0.5 * L, 7850.0  # m, m, kg/m3
    most = math.pi * density * thickness * diameter**4 / 32.0
    if not inertia > most:
        return []
    return [
        Notice(
            "heavy-inertia",
            f"an inertia of {inertia:.4g} kg m² is large for a centre distance of {1e3 * L:.4g} "
            f"mm. A solid steel table {1e3 * diameter:.4g} mm across and {1e3 * thickness:.4g} "
            f"mm thick has {most:.3g} kg m². If it is in kg cm², write {1e-4 * inertia:.4g}",
        )
    ]


def _fast(mechanism: Mechanism) -> list[Notice]:
    engagement = mechanism.engagements[0]
    x, y = engagement.path(engagement.entry_deg, 0)
    rim = math.hypot(x.c[0], y.c[0]) * mechanism.center_distance_mm / 1000.0
    n = mechanism.spec.drive.n_rpm
    speed = rim * worst_of(mechanism, "velocity").max * omega(n)
    sound_m_s = 343.0
    if not speed > sound_m_s:
        return []
    return [
        Notice(
            "faster-than-sound",
            f"the wheel's rim moves at up to {speed:.4g} m/s, faster than sound ({sound_m_s:g} "
            f"m/s): check n_rpm = {n:g}, the input's turns a minute",
        )
    ]
