"""The fixed groove of a cam-Geneva: its pitch curve, both flanks, pressure angle and curvature."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.drives.cam import CamDriven
from geneva_cli.errors import GenevaError
from geneva_cli.linear import solve
from geneva_cli.mechanism import Mechanism
from geneva_cli.pitch import WALLED
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.jet import Array

NAMES = ("input_deg", "radius_mm", *WALLED)
SAMPLES = 721


def distance(station: CamDriven, input_deg: Array) -> Array:
    """The roller's distance from the crank's axis over a whole turn, in units of L."""
    return _distances(station, input_deg)[0]


def groove_curve(
    station: CamDriven, L: float, offset: float
) -> Callable[[Array], tuple[Array, Array]]:
    """The groove, or a flank ``offset`` mm to its left, as points in mm and unit tangents.

    By the input angle over a whole turn, in the frame of the groove's table.
    """

    def curve(t: Array) -> tuple[Array, Array]:
        R, slope, _ = _distances(station, t)
        c, s = -station.sign * np.cos(np.radians(t)), np.sin(np.radians(t))
        x1, y1 = slope * c + station.sign * R * s, slope * s - station.sign * R * c
        tangents = np.column_stack((x1, y1)) / np.hypot(x1, y1)[:, None]
        normals = np.column_stack((-tangents[:, 1], tangents[:, 0]))
        return L * np.column_stack((R * c, R * s)) + offset * normals, tangents

    return curve


def _distances(station: CamDriven, input_deg: Array) -> list[Array]:
    """The roller's distance from the crank's axis, with two derivatives by the input in radians.

    In the dwell the groove goes back from exit to entry by the polynomial of degree 5 in the
    crank's angle that has both ends' distance, slope and curvature.
    """
    at = (input_deg - station.entry_deg) % 360.0 + station.entry_deg
    moving = at <= station.exit_deg
    out = [np.empty(len(at)) for _ in range(3)]
    if moving.any():
        found = station.distances(at[moving], 2)[1].derivatives()
        for column, values in zip(out, found, strict=True):
            column[moving] = values
    span = math.radians(360.0 - station.motion_deg)
    ends = [station.distances(x, 2)[1].derivatives() for x in (station.exit_deg, station.entry_deg)]
    conditions, values = [], []
    for u, end in zip((0.0, 1.0), ends, strict=True):
        for order, value in enumerate(end):
            conditions.append([_power(k, order, u) for k in range(6)])
            values.append(value * span**order)
    shape = np.polynomial.Polynomial(solve(np.array(conditions), np.array(values)))
    rest = np.radians(at[~moving] - station.exit_deg) / span
    for order, column in enumerate(out):
        column[~moving] = shape.deriv(order)(rest) / span**order
    return out


def _power(k: int, order: int, u: float) -> float:
    """A derivative of u^k."""
    factor = math.prod(range(k - order + 1, k + 1))
    return factor * u ** (k - order) if k >= order else 0.0


def groove_table(mechanism: Mechanism, samples: int | None = None) -> Table:
    """The groove over the motion, evenly in the input angle, the crank's axis being the origin.

    x points away from the wheel's axis; left and right are the flanks as the roller travels. The
    pressure angle is the one between the groove's normal and the crank's arm, atan(R'/R).
    """
    station = mechanism.stations[0]
    if not isinstance(station, CamDriven):
        raise GenevaError(
            f'--part groove: kind = "{mechanism.spec.drive.kind}" has none; kind = "cam" has'
        )
    size = mechanism.spec.size
    L, offset = size.center_distance_mm, mechanism.spec.roller_radius_mm + size.slot_clearance_mm
    x = np.linspace(station.entry_deg, station.exit_deg, samples or SAMPLES)
    R, slope = (L * c for c in station.distances(x, 2)[1].c[:2])
    px, py = station.groove(x, 2)
    (x0, x1, x2), (y0, y1, y2) = px.derivatives(), py.derivatives()
    speed = np.hypot(x1, y1)
    turning = x1 * y2 - y1 * x2
    with np.errstate(divide="ignore"):
        # The roller enters along the slot, while the wheel still stands: a straight line.
        straight = np.abs(turning) < 1e-12 * speed * speed
        radius = np.where(straight, np.inf, L * speed**3 / turning)
    nx, ny = -y1 / speed * offset, x1 / speed * offset
    columns = [
        x,
        R,
        L * x0,
        L * y0,
        L * x0 + nx,
        L * y0 + ny,
        L * x0 - nx,
        L * y0 - ny,
        np.degrees(np.arctan2(np.abs(slope), R)),
        radius,
    ]
    return Table(NAMES, columns)
