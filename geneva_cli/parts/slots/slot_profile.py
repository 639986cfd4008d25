"""The slot's profile, its pitch curve and both flanks at input angles, and tables of it."""

from functools import partial

import numpy as np

from geneva_cli.geometry import chords
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import WALLED, Pitch, pitch, retraces
from geneva_cli.numerics.arrays import Array, array
from geneva_cli.numerics.roots import boundary_by_sections
from geneva_cli.numerics.tolerances import SAME_INPUT_DEG
from geneva_cli.table import Table, computed_table


def slot_columns(mechanism: Mechanism, input_deg: Array) -> list[Array]:
    """Return the columns of the slot's table at ascending input angles, in the wheel's frame, mm.

    Left and right are the flanks in the pin's direction of travel at entry. The radius is the pitch
    curve's, above 0 if its centre lies to the left, infinite on a straight line.
    """
    engagement, L = mechanism.engagements[0].through, mechanism.center_distance_mm
    input_deg, at, side, lines = _lines(mechanism, input_deg)
    output = array(engagement.motion(input_deg, 0).c[0]) * mechanism.output.per_radian
    with np.errstate(divide="ignore", invalid="ignore"):
        radius = L * side * np.divide(at.speed, at.turning)
    radius = np.where(at.turning == 0.0, np.inf, radius)
    points = [axis for line in lines for axis in line.T]
    return [input_deg, output, *points, np.degrees(at.pressure), radius]


def flanks(mechanism: Mechanism, input_deg: Array) -> tuple[Array, Array, Array]:
    """Return the pitch curve and both flanks at input angles, mm, (n, 2) each."""
    return _lines(mechanism, input_deg)[-1]


def _lines(
    mechanism: Mechanism, input_deg: Array
) -> tuple[Array, Pitch, Array, tuple[Array, Array, Array]]:
    """Return input angles, pitch curve, sense of travel on it, and points of curve and flanks.

    Angles near a retracing mid-motion are exactly 0. The sense is -1 where the pin returns on its
    path: the flanks keep their sides.
    """
    engagement, L = mechanism.engagements[0].through, mechanism.center_distance_mm
    retraced = retraces(engagement)
    input_deg = np.where((np.abs(input_deg) < SAME_INPUT_DEG) & retraced, 0.0, input_deg)
    at = pitch_at(engagement, input_deg)
    side = np.where(engagement.slot.curved & retraced & (input_deg > 0.0), -1.0, 1.0)
    offset = mechanism.roller_radius_mm + mechanism.spec.size.allowances.slot_clearance_mm
    normal = np.column_stack((-at.tangent_y * side, at.tangent_x * side))
    centre = L * np.column_stack((at.x, at.y))
    return input_deg, at, side, (centre, centre + offset * normal, centre - offset * normal)


def pitch_at(engagement: Engagement, input_deg: Array) -> Pitch:
    """Return the pitch curve, with its limit at a retracing mid-motion.

    In a straight slot, in which a pin may rest, the tangent is everywhere that of the way in.
    """
    if not engagement.slot.curved:
        x, y = (array(jet.c[0]) for jet in engagement.slot(input_deg, 0))
        outer, inner = (engagement.slot(end, 0) for end in (engagement.entry_deg, 0.0))
        ahead = np.array([b.c[0] - a.c[0] for a, b in zip(outer, inner, strict=True)])
        tx, ty = ahead / np.hypot(*ahead)
        pressure = np.arctan2(np.abs(x * ty - y * tx), np.abs(x * tx + y * ty))
        return Pitch(x, y, tx, ty, 0.0, 0.0, pressure)
    middle = np.abs(input_deg) < SAME_INPUT_DEG
    if not middle.any() or not retraces(engagement):
        return pitch(engagement, input_deg)
    # any regular place stands in for mid-motion
    at = pitch(engagement, np.where(middle, 0.5 * engagement.entry_deg, input_deg))
    columns = zip(at, pitch(engagement, 0.0, 2), strict=True)
    return Pitch(*(np.where(middle, limit, array(value)) for value, limit in columns))


def nodes(mechanism: Mechanism, tolerance_mm: float, few: bool = True) -> Array:
    """Return input angles to sample the slot at, so that no chord misses a curve by more.

    Cusps of the pitch curve and of undercut flanks are among them. Without ``few`` there are
    up to ten per cent more, computed in a third of the time.
    """
    engagement = mechanism.engagements[0].through
    cusps = _flank_cusps(mechanism)
    ends = [engagement.entry_deg, *[x for x in cusps if x < 0.0], 0.0]
    if not engagement.mirrored:
        ends += [*[x for x in cusps if x > 0.0], engagement.exit_deg]
    angles = chords.nodes(partial(flanks, mechanism), ends, tolerance_mm, few)
    return np.concatenate((angles[:-1], -angles[::-1])) if engagement.mirrored else angles


def _flank_cusps(mechanism: Mechanism) -> list[float]:
    """Return where a flank turns back, because the roller is as large as the curvature."""
    engagement, size = mechanism.engagements[0].through, mechanism.spec.size
    offset = mechanism.roller_radius_mm + size.allowances.slot_clearance_mm
    offset /= mechanism.center_distance_mm

    def excess(x: Array, side: float) -> Array:
        at = pitch(engagement, x)
        return array(at.speed - side * offset * at.turning)

    # Half a step off the grid's ends: mid-motion may be a cusp of the pitch curve itself.
    intervals = 2048
    step, mirrored = engagement.motion_deg / intervals, engagement.mirrored
    count = (intervals + 1) // 2 if mirrored else intervals  # one of two mirrored halves is enough
    grid = engagement.entry_deg + step * (np.arange(count, dtype=np.float64) + 0.5)
    at = pitch(engagement, grid)
    cusps = []
    for side in (-1.0, 1.0):
        sign = np.sign(at.speed - side * offset * at.turning)
        for i in np.flatnonzero(sign[1:] * sign[:-1] < 0.0):
            a, b = float(grid[i]), float(grid[i + 1])
            if a < 0.0 < b:
                continue
            runs = sign[i]  # sign before the flank stops
            cusps.append(boundary_by_sections(lambda x: excess(x, side) * runs, a, b))  # noqa: B023
    return sorted(cusps)


def profile_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return the slot's table: for a chord tolerance, or at ``samples`` even input angles."""
    engagement = mechanism.engagements[0].through
    names = ("input_deg", mechanism.output.column, *WALLED)
    entry, exit_ = engagement.entry_deg, engagement.exit_deg

    if samples is None:
        return Table(names, slot_columns(mechanism, nodes(mechanism, tolerance_mm)))

    def rows(begin: int, end: int) -> list[Array]:
        step = (exit_ - entry) / (samples - 1)
        at: Array = entry + np.arange(begin, end, dtype=np.float64) * step
        at[samples - 1 - begin :] = exit_  # the last of all, without rounding
        return slot_columns(mechanism, at)

    return computed_table(names, samples, rows)
