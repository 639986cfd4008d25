"""The point of a coupler that drives a wheel with a given motion, in closed form.

A four-bar, the crank's angles at entry and exit, and the wheel's index angle 2b determine the
roller's place w on the coupler: a complex number, along it and across. With the crank's pin A and
the coupler's unit vector e, the roller is at P = A + w e, and its velocity is V = A' + w e'.
Between entry and exit of slots of a wheel of sense s, the tangent has turned by pi - 2b relative to
the wheel. The chord is half-way between both tangents:

    Im(V2 V1* exp(i s (pi - 2b))) = 0 ,    Im((P2 - P1) V1* exp(i s (pi - 2b)/2)) = 0 .

In the plane of w both are circles. One intersection is where the roller rests at entry, V1 = 0,
which is no solution; the other one is the solution.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.kinds.linkages.link_path import LinkPath
from geneva_cli.kinds.linkages.tangent_pairs import taken
from geneva_cli.numerics.arrays import Array, Complex, Mask, Number, Whole
from geneva_cli.numerics.jet import Jet, atan2, sin_cos


class CouplerMotion(NamedTuple):
    """The crank's pin and the coupler's unit vector as complex Taylor coefficients."""

    pin: list[Complex]
    along: list[Complex]


class CouplerDrive(NamedTuple):
    """The wheel's drive: entry and motion in radians, the wheel's sense, the roller's place."""

    entry: Array
    motion: Array
    sense: Array
    w: Complex


class DrivenWheels(NamedTuple):
    """Wheels that are driven and let the roller pass on its way back.

    ``which`` are their numbers, (m,). ``derivatives`` are those of their angles by the input angle
    at places of the motion, (m, places) each. ``distance`` is the centre distance; ``reach`` is the
    greatest distance of a joint or the roller from the crank's axis, (m,) each.
    """

    which: Whole
    derivatives: list[Array]  # the angle itself, velocity, acceleration, and jerk if requested
    distance: Array
    reach: Array


def coupler_motion(links: LinkPath, phi: Array, order: int) -> CouplerMotion:
    """The coupler's motion at crank angles ``phi`` in radians, to the derivatives of ``order``."""
    direction = sin_cos(Jet.variable(phi, order))
    return CouplerMotion(_complex(*links.joint(*direction)), _complex(*links.link(*direction)))


def _complex(x: Jet, y: Jet) -> list[Complex]:
    out = []
    for p, q in zip(x.c, y.c, strict=True):
        both = np.empty(np.broadcast(p, q).shape, dtype=complex)
        both.real, both.imag = p, q
        out.append(both)
    return out


def coupler_drive(
    links: LinkPath, entry: Array, motion: Array, b: Number, sense: Array
) -> CouplerDrive:
    """The roller's place that makes the motion, (n, 1).

    NaN if there is none, or if the chord does not run from entry to exit.
    """
    one, two = (coupler_motion(links, phi, 1) for phi in (entry, entry + motion))
    turn = np.exp(1j * sense * (0.5 * math.pi - b))
    v, u = one.pin[1], one.along[1]
    circles = []
    for p, e, k in (
        (two.pin[1], two.along[1], turn * turn),
        (two.pin[0] - one.pin[0], two.along[0] - one.along[0], turn),
    ):
        # Im((p + w e)(v + w u)* k) = A |w|² + Im(d w) + C
        d = e * v.conj() * k - (p * u.conj() * k).conj()
        circles.append(((e * u.conj() * k).imag, d, (p * v.conj() * k).imag))
    (A, d, C), (A2, d2, C2) = circles
    # The line through both points: Im(D w) + E = 0
    D, E = A2 * d - A * d2, A2 * C - A * C2
    direction, foot = D.conj() / np.abs(D), -1j * E / D
    at_rest = ((-v / u - foot) * direction.conj()).real
    total = -(2.0 * A * (foot * direction.conj()).real + (d * direction).imag) / A
    w = foot + (total - at_rest) * direction
    chord, speed = two.pin[0] + w * two.along[0] - (one.pin[0] + w * one.along[0]), v + w * u
    ahead = (chord * (speed / np.abs(speed)).conj() * turn).real > 0.0
    return CouplerDrive(entry, motion, sense, np.where(ahead, w, np.nan))


def driven_wheels(
    links: LinkPath, drive: CouplerDrive, b: Array, roller: Array, order: int, places: int
) -> DrivenWheels:
    """The wheels that pass the test at samples of the motion and of the way back.

    ``b`` is half the step and ``roller`` the roller's radius over the centre distance, (n, 1) each.
    ``order`` is that of the derivatives.
    """
    entry, motion, sense, w = drive
    motion_path = coupler_motion(links, entry + motion * (np.arange(places + 1) / places), order)
    pins = [p + w * e for p, e in zip(motion_path.pin, motion_path.along, strict=True)]
    p, q, v = pins[0][:, :1], pins[0][:, -1:], pins[1][:, :1]
    rho = np.abs(q - p) / (2.0 * np.sin(b))
    centre = p + rho * (v / np.abs(v))  # the tangents at both ends meet there
    ray, rate = pins[0] - centre, pins[1]
    L, near = np.abs(centre), np.abs(ray)
    turning = ray.real * rate.imag - ray.imag * rate.real
    drives = (turning[:, 1:-1] * sense > 0.0).all(axis=1) & (near[:, 1:-1] < rho).all(axis=1)
    half_wall = 1.0 / 400.0  # of the least wall between two slots, over the centre distance
    drives &= (near.min(axis=1, keepdims=True) * np.sin(b) >= (roller + half_wall) * L)[:, 0]
    which = np.flatnonzero(drives)
    # the way back is tested for these only
    links, (entry, motion, sense, w) = links.of(which), taken(drive, which)
    away = np.arange(1, 2 * places) / (2 * places)  # the way back has twice the motion's samples
    rest = coupler_motion(links, entry + motion + (math.tau - motion) * away, 0)
    pin = rest.pin[0] + w * rest.along[0]
    place = (pin - centre[which]) / (p - centre)[which]
    passes = _passes(place, (roller * L / rho)[which], b[which])
    _, ground, coupler, *_ = links.numbers
    joint = (motion_path.pin[0][which] + coupler * motion_path.along[0][which], pins[0][which])
    back = (rest.pin[0] + coupler * rest.along[0], pin)
    reach = np.maximum.reduce([np.abs(z).max(axis=1) for z in (*joint, *back)])
    reach = np.maximum(reach, np.ravel(ground))
    kept = which[passes]
    rays = [ray[kept], *(pin[kept] for pin in pins[1:])]
    x, y = Jet([z.real for z in rays]), Jet([z.imag for z in rays])
    derivatives = [np.asarray(d) for d in atan2(y, x).derivatives()]
    return DrivenWheels(kept, derivatives, L[kept, 0], reach[passes])


def _passes(place: Complex, r: Array, b: Number) -> Mask:
    """Masks of the rollers that pass the wheel at rest without touching it.

    Lengths are over the distance of the slots' mouths from the wheel's axis, and a slot points
    along the real axis. The wheel ends at hypot(1, r), where slots as wide as the roller leave
    corners at (1, r).
    """
    d, angle = np.abs(place), np.abs((np.angle(place) + b) % (2.0 * b) - b)
    along, across = d * np.cos(angle), d * np.sin(angle)
    corner = np.where(along >= 1.0, np.hypot(along - 1.0, r - across), r - across)
    away = np.where(across < r * along, corner, d - np.hypot(1.0, r))  # in front of a slot or not
    touch = 1e-6  # a roller that leaves its slot is this near to it
    clear: Mask = np.all((away - r >= -touch) & (d > 1.0), axis=1)
    return clear
