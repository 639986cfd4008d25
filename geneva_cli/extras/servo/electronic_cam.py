"""The motion as an electronic cam: points or polynomials between which a controller interpolates.

The master is the input, in degrees from the first entry; the slave is the wheel, in degrees from
its place there. Each error is that of the controller's own interpolation, evaluated at 33 places of
a piece. One is the middle, where a smooth error of one sign is greatest or nearly so.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.motion_table import Stretch, stretches
from geneva_cli.numerics.jet import Array
from geneva_cli.table import Table

INSIDE = (np.arange(33) + 0.5) / 33.0  # places in a piece, its middle among them
# The greatest error over that at these places. An error of degree six with three zeros at each end
# is 0.3 % more at most, one that also changes its sign in the middle 0.8 %.
BETWEEN = 1.01
LEAST_DEG = 1e-3  # shorter pieces are not halved: a servo's cycle is longer

# widths of pieces, and the states after and before their ends -> powers of their polynomials
Interpolation: TypeAlias = Callable[[Array, Array, Array], Array]


class CamPoints(NamedTuple):
    """Points of a cam in ascending order, and the greatest error between them.

    ``master_deg``, ``slave_deg``, ``velocity`` (degrees a degree) and ``acceleration_per_deg`` are
    arrays (k,); ``error_deg`` is in degrees of the wheel.
    """

    master_deg: Array
    slave_deg: Array
    velocity: Array
    acceleration_per_deg: Array
    error_deg: float


def cam_pieces(mechanism: Mechanism, count: int, tolerance_deg: float) -> Table:
    """Polynomials of the fifth degree over ``count`` periods, a row each.

    Columns: ``begin_deg``, ``end_deg`` of the master; ``c0`` to ``c5``, of which the slave is
    c0 + c1 t + ... + c5 t^5 degrees at t degrees after the beginning; ``error_deg``.

    Source: Hermite interpolation; value, velocity and acceleration are the true ones at both ends.
    """
    begins, coefficients, errors = [], [], []
    for stretch in stretches(mechanism):
        nodes, states, error = _halved(stretch, _quintic, tolerance_deg, LEAST_DEG)
        begins.append(nodes[:-1])
        coefficients.append(_quintic(np.diff(nodes), *states))
        errors.append(error)
    error_deg = np.concatenate(errors)
    powers = np.concatenate(coefficients, axis=1)
    step = step_deg(mechanism)
    again = np.arange(count)[:, None]
    begin = (again * mechanism.period_deg + np.concatenate(begins)).ravel()
    end = np.append(begin[1:], count * mechanism.period_deg)
    constant = (again * step + powers[0]).ravel()
    others = [np.tile(one, count) for one in (*powers[1:], error_deg)]
    names = ("begin_deg", "end_deg", *(f"c{k}" for k in range(6)), "error_deg")
    return Table(names, [begin, end, constant, *others])


def cam_points(mechanism: Mechanism, count: int, tolerance_deg: float) -> CamPoints:
    """Points with velocity and acceleration, between which polynomials of degree five are drawn.

    A point has one velocity and one acceleration: a jump becomes a ramp over 0.01 degrees after it.
    """
    first, error_deg, last = _period_points(mechanism, tolerance_deg, None)
    later = first
    if count > 1:  # a period after another may begin with a jump
        later, error, last = _period_points(mechanism, tolerance_deg, last)
        error_deg = max(error_deg, error)
    step = np.array([[mechanism.period_deg], [step_deg(mechanism)], [0.0], [0.0]])
    whole = [first, *(later + k * step for k in range(1, count))]
    end = np.append(mechanism.period_deg, last)[:, None] + (count - 1) * step
    master, slave, velocity, acceleration = np.concatenate([*whole, end], axis=1)
    return CamPoints(master, slave, velocity, acceleration, error_deg)


def _period_points(
    mechanism: Mechanism, tolerance_deg: float, before: Array | None
) -> tuple[Array, float, Array]:
    """Points (4, k) of a period without its end, their error, and the state (3,) at its end."""
    points: list[Array] = []
    error_deg = 0.0
    for stretch in stretches(mechanism):
        nodes, (begin, end), errors = _halved(stretch, _quintic, tolerance_deg, LEAST_DEG)
        error_deg = max(error_deg, float(errors.max()))
        if before is not None and np.abs(begin[1:, 0] - before[1:]).max() > 1e-9:
            start = nodes[0]
            nodes[0] += min(0.01, 0.25 * (nodes[1] - start))
            after = stretch.states(nodes[:1], 1)
            ramp = np.append(begin[0, 0], before[1:])[:, None]
            begin[:, :1] = after
            points.append(np.vstack([[[start]], ramp]))
            places = np.append(start, nodes[:2])
            states = np.hstack([ramp, after]), np.hstack([after, end[:, :1]])
            powers = _quintic(np.diff(places), *states)
            error_deg = max(error_deg, float(_errors(stretch, places, powers).max()))
        points.append(np.vstack([nodes[:-1], begin]))
        before = end[:, -1]
    assert before is not None  # a period has a motion
    return np.concatenate(points, axis=1), error_deg, before


def cam_pairs(mechanism: Mechanism, count: int, tolerance_deg: float) -> CamPoints:
    """Pairs of master and slave for linear interpolation: at most 360, and 0.1 degrees apart.

    All are multiples of 1e-4 degrees. The tolerance grows until the pairs are few enough.
    """
    most, least_deg, grid = 360, 0.1, 1e-4  # of a table of Beckhoff's
    own = list(stretches(mechanism))
    for rung in range(240):
        tolerance = max(tolerance_deg, 0.5 * grid) * 2.0 ** (rung / 8.0)
        nodes = [_halved(stretch, _linear, tolerance, 2.0 * least_deg)[0] for stretch in own]
        ends = np.append(np.concatenate([one[:-1] for one in nodes]), mechanism.period_deg)
        if count * (len(ends) - 1) + 1 <= most:
            break
    else:
        raise GenevaError(f"{count} periods need more than {most} pairs; give fewer --turns")
    ends = grid * np.rint(ends / grid)
    near = np.diff(ends) < least_deg
    near[-1], near[-2] = False, near[-2] or near[-1]  # the end stays, the place before it goes
    ends = ends[np.append(True, ~near)]
    slave = np.empty_like(ends)
    for stretch in own:
        here = (ends >= stretch.begin_deg - grid) & (ends <= stretch.end_deg + grid)
        slave[here] = stretch.slave_deg(ends[here])
    slave = grid * np.rint(slave / grid)
    errors = []
    for stretch in own:
        inner = ends[(ends > stretch.begin_deg) & (ends < stretch.end_deg)]
        marks = np.concatenate([[stretch.begin_deg], inner, [stretch.end_deg]])
        places = (marks[:-1, None] + np.diff(marks)[:, None] * INSIDE).ravel()
        off = abs(np.interp(places, ends, slave) - stretch.slave_deg(places))
        errors.append(BETWEEN * float(off.max()))
    error_deg = max(errors)
    again = np.arange(count)[:, None]
    master = np.append((again * mechanism.period_deg + ends[:-1]).ravel(), 0.0)
    angle = np.append((again * step_deg(mechanism) + slave[:-1]).ravel(), 0.0)
    master[-1] = count * mechanism.period_deg
    angle[-1] = (count - 1) * step_deg(mechanism) + slave[-1]
    nothing = np.zeros_like(master)
    return CamPoints(master, angle, nothing, nothing, error_deg)


def step_deg(mechanism: Mechanism) -> float:
    """The wheel's angle over one period, degrees."""
    return math.degrees(sum(2.0 * one.half_step for one in mechanism.engagements))


def _halved(
    stretch: Stretch, interpolation: Interpolation, tolerance_deg: float, least_deg: float
) -> tuple[Array, tuple[Array, Array], Array]:
    """Nodes of a stretch, the states (3, k) after and before each piece's ends, and its errors."""
    nodes = np.array([stretch.begin_deg, stretch.end_deg])
    while True:
        after = stretch.states(nodes[:-1], 1)
        before = stretch.states(nodes[1:], -1)
        width = np.diff(nodes)
        error = _errors(stretch, nodes, interpolation(width, after, before))
        wide = (error > tolerance_deg) & (width > least_deg)
        if not wide.any():
            return nodes, (after, before), error
        nodes = np.sort(np.append(nodes, nodes[:-1][wide] + 0.5 * width[wide]))


def _errors(stretch: Stretch, nodes: Array, powers: Array) -> Array:
    """The greatest error of each piece, from the powers (6, k) of its polynomial."""
    t = np.diff(nodes)[:, None] * INSIDE
    places = (nodes[:-1, None] + t).ravel()
    true = stretch.slave_deg(places).reshape(t.shape)
    value = np.zeros_like(t)
    for power in powers[::-1]:
        value = value * t + power[:, None]
    out: Array = BETWEEN * abs(value - true).max(axis=1)
    return out


def _quintic(width: Array, after: Array, before: Array) -> Array:
    """The powers (6, k) of the polynomials with these values, slopes and curvatures at the ends."""
    y0, v0, a0 = after
    y1, v1, a1 = before
    rise = y1 - y0 - width * (v0 + 0.5 * width * a0)
    slope = width * (v1 - v0 - width * a0)
    bend = width * width * (a1 - a0)
    third = 10.0 * rise - 4.0 * slope + 0.5 * bend
    fourth = -15.0 * rise + 7.0 * slope - bend
    fifth = 6.0 * rise - 3.0 * slope + 0.5 * bend
    return np.stack([y0, v0, 0.5 * a0, third / width**3, fourth / width**4, fifth / width**5])


def _linear(width: Array, after: Array, before: Array) -> Array:
    return np.stack([after[0], (before[0] - after[0]) / width])
