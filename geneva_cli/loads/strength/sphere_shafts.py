"""Bending and torque of the shafts of a spherical machine, from the force on its roller.

The axes meet at the sphere's centre. Let u point at the roller, m along the slot away from the
wheel's axis, and y across it, so that u, m, y are right-handed. The force is F (d y + f m) at L u:
F on the wall of the side d, and the friction f along it. The bearing is at b e, on an axis of
direction e at a distance b from the centre. There the moment is (L u - b e) x F (d y + f m). Less
its part along e, which is the torque, the square of what bends the shaft is

    F² [(L - b e.u)² (1 + f²) + (b² - L²) (e.m - d f e.y)²]

On the wheel e is u cos t - m sin t at the polar angle t, so that without friction the moment is
F (b - L cos t). On the crank e follows from the roller's velocity, -c e x u at the crank's rate c.
The roller is taken to be thin: its cone presses on the wall beside u.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from geneva_cli.numerics.jet import sqrt

if TYPE_CHECKING:
    from geneva_cli.analysis.contact import Contact
    from geneva_cli.analysis.instant import Instant
    from geneva_cli.numerics.arrays import Number
    from geneva_cli.numerics.jet import Jet


class _Axis(NamedTuple):
    """An axis of the machine in the roller's directions: cosines along u, m and y."""

    up: Jet
    away: Jet
    across: Jet


def on_sphere_wheel(i: Instant[Jet], at: Contact[Jet], overhang: Number) -> tuple[Jet, Jet]:
    """Squared bending moment of the wheel's shaft, and torque; the overhang beyond L in metres."""
    axis = _Axis(at.arm, at.lever * -1.0, at.lever * 0.0)
    return _bending_squared(i, axis, overhang), i.wheel_torque_Nm


def on_sphere_crank(i: Instant[Jet], at: Contact[Jet], overhang: Number) -> tuple[Jet, Jet]:
    """Squared bending moment of the crank's shaft, and torque; the overhang beyond L in metres."""
    aside = at.velocity * at.lever
    spin = at.spin + at.velocity * at.arm  # of the crank about the roller's axis
    rate = sqrt(at.along * at.along + aside * aside + spin * spin)
    axis = _Axis(spin / rate * -1.0, aside / rate, at.along / rate * -1.0)
    return _bending_squared(i, axis, overhang), i.input_torque_Nm / rate


def _bending_squared(i: Instant[Jet], axis: _Axis, overhang: Number) -> Jet:
    """The square of the moment that bends a shaft at its bearing, (N m)²."""
    L = i.case.L
    b = L + overhang
    rub = i.case.friction * i.slides
    lever = axis.up * -b + L
    turn = axis.away - axis.across * (i.drives * rub)
    bent = lever * lever * (1.0 + rub * rub) + turn * turn * ((b - L) * (b + L))
    return i.forces.force * i.forces.force * bent
