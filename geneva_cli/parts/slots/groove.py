"""The fixed groove of a cam-Geneva about the crank axis, and its plate: base, ring and island."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import partial
from itertools import chain, pairwise
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.errors import GenevaError, refuse_size
from geneva_cli.geometry import chords, fit
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Contour, Layer, closed, polar
from geneva_cli.motion.groove_path import distances, in_dwell
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import WALLED
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.roots import boundary_by_sections, greatest_at
from geneva_cli.parts.links.links import Links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.arm_and_shafts import bore_at
from geneva_cli.parts.shafts.bores import screw_radius
from geneva_cli.table import Table

if TYPE_CHECKING:
    from geneva_cli.motion.given_motion import SolvedPath

NAMES = ("input_deg", "radius_mm", *WALLED)
GRID = 3600  # positions all round, between which the greatest pressure angle is searched
BELOW = 2  # planes below the wheel: that of the groove, below the crank
MOUNTS = 4


def groove_curve(groove: SolvedPath, L: float, offset: float, t: Array) -> tuple[Array, Array]:
    """Return points, mm, and unit tangents of the groove, or a flank ``offset`` mm to its left.

    They are at input angles ``t`` of a whole turn, degrees.
    """
    R, slope, _ = distances(groove, t)
    c, s = -groove.sign * np.cos(np.radians(t)), np.sin(np.radians(t))
    x1, y1 = slope * c + groove.sign * R * s, slope * s - groove.sign * R * c
    tangents = np.column_stack((x1, y1)) / np.hypot(x1, y1)[:, None]
    normals = np.column_stack((-tangents[:, 1], tangents[:, 0]))
    return L * np.column_stack((R * c, R * s)) + offset * normals, tangents


def sampled_extremes(groove: SolvedPath, input_deg: Array) -> tuple[Array, Array]:
    """Return least distances from the crank's axis, over L, and pressure angles of m grooves, (m,).

    They are the extremes at ``input_deg`` (m, k) and 360 places of the dwell.
    """
    dwell = 360.0 - (groove.motion.exit_deg - groove.motion.entry_deg)
    rest = groove.motion.exit_deg + dwell * (np.arange(360) / 360)
    moving = groove.distances(input_deg, 1)[1].derivatives()
    resting = in_dwell(groove, np.atleast_2d(rest), 1).derivatives()
    R, slope = (np.hstack(pair) for pair in zip(moving, resting, strict=True))
    return R.min(axis=1), np.degrees(np.arctan((np.abs(slope) / R).max(axis=1)))


def greatest_pressure(groove: SolvedPath) -> tuple[float, float]:
    """Return the groove's greatest pressure angle, atan|R'/R|, degrees, and its input angle."""
    entry, exit_, step = groove.motion.entry_deg, groove.motion.exit_deg, 360.0 / GRID
    grid = entry + 360.0 * np.arange(GRID) / GRID
    R, slope, _ = distances(groove, grid)
    steep = np.abs(slope) / R
    tops = (steep >= np.roll(steep, 1)) & (steep >= np.roll(steep, -1))
    # the grid is fine enough that lower local maxima need no refinement
    tops &= steep > 0.99 * steep.max()
    middle, candidates = 0.5 * (entry + exit_), []

    def rise(x: Array) -> Array:
        r, dr, ddr = distances(groove, x)
        return np.sign(dr) * (r * ddr - dr * dr)

    # a groove is as steep before the motion as after it: start in the middle of the dwell
    for about in sorted(math.remainder(x - middle, 360.0) + middle for x in grid[tops]):
        # a corner of the groove, or a smooth maximum
        at_deg = boundary_by_sections(rise, about - step, about + step)
        r, dr, _ = distances(groove, np.array([at_deg]))
        candidates.append((float(abs(dr[0]) / r[0]), at_deg))
    tangent, at_deg = greatest_at(candidates)
    return math.degrees(math.atan(tangent)), at_deg


def groove_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return the groove over the motion: for a chord tolerance, or at ``samples`` even angles.

    The crank's axis is the origin, and x points away from the wheel's axis. Left and right are the
    flanks in the roller's direction of travel. The pressure angle is atan(R'/R).
    """
    groove = _groove_of(mechanism)
    clearance = mechanism.spec.size.allowances.slot_clearance_mm
    L, offset = mechanism.center_distance_mm, mechanism.roller_radius_mm + clearance
    lines = [partial(groove_curve, groove, L, side) for side in (0.0, offset, -offset)]
    ends = groove.motion.entry_deg, 0.0, groove.motion.exit_deg
    if samples is None:
        x = chords.nodes(lambda at: [line(at)[0] for line in lines], ends, tolerance_mm)
    else:
        x = np.linspace(ends[0], ends[-1], samples)
    R, slope, bend = groove.distances(x, 2)[1].derivatives()
    square = R * R + slope * slope
    turning = groove.sign * (R * bend - slope * slope - square)
    with np.errstate(divide="ignore"):
        # The roller enters along the slot, while the wheel still rests: a straight line.
        straight = np.abs(turning) < 1e-12 * square
        radius = np.where(straight, np.inf, L * square**1.5 / turning)
    points = [axis for line in lines for axis in line(x)[0].T]
    pressure = np.degrees(np.arctan2(np.abs(slope), R))
    shown = mechanism.engagements[0].inputs_deg(x)
    return Table(NAMES, [shown, L * R, *points, pressure, radius])


def _groove_of(mechanism: Mechanism) -> SolvedPath:
    groove = mechanism.engagements[0].groove
    if groove is None:
        kind = mechanism.spec.drive.NAME
        raise GenevaError(f'--part groove: kind = "{kind}" has no groove; "cam" has one')
    return groove


def groove_lines(parts: Outlines, tolerance: float | None, curves: str) -> tuple[Contour, ...]:
    """Return both flanks of the groove all round, about the crank's axis, and its pitch curve."""
    guide = _groove_of(parts.assembly.full)
    # the flanks are within 0.001 mm by default, as a drawing's
    motion, fine = guide.motion, 1e-3 if tolerance is None else tolerance
    ends = (motion.entry_deg, motion.exit_deg, motion.entry_deg + 360.0)

    def line(layer: Layer, side: float) -> Contour:
        curve = partial(groove_curve, guide, parts.assembly.L, side * parts.sizes.half_width)
        runs = [fit.KINDS[curves](curve, a, b, fine) for a, b in pairwise(ends)]
        return closed(layer, chain(*runs))

    return line("GROOVE", 1.0), line("GROOVE", -1.0), line("PITCH", 0.0)


def groove_base(parts: Outlines, bars: Links) -> Plate:
    """Return the base below the groove, with its holes, on the links ``bars`` of the machine.

    Raises GenevaError where the wheel's hub leaves no space for the rim around the groove.
    """
    sizes, full = parts.sizes, parts.assembly.full
    guide = _groove_of(full)
    L, wall = parts.assembly.L, sizes.wall_min
    # farthest where a flank is normal to the ray; 3601 angles of a turn: the error is quadratic
    at, _ = groove_curve(guide, L, 0.0, np.linspace(0.0, 360.0, 3601))
    far = float(np.hypot(*at.T).max()) + sizes.half_width
    space = L - max(sizes.wheel_bore, sizes.wheel_hub) - wall - far
    # where it fits, the rim around the groove is 1.5 roller radii wide
    rim = min(max(1.5 * sizes.roller, 4.0 * wall), space)
    text = f"{space:.4g} mm between groove and wheel's hub are less than four times wall_min_mm"
    text = f"--part groove-plate: {text}: reduce roller, wheel_hub_mm or wheel_bore_mm"
    refuse_size(rim < 4.0 * wall, "wheel_hub_mm", text)
    screw, away = screw_radius(0.5 * rim), far + 0.5 * rim
    turns = [math.tau * (k + 0.5) / MOUNTS for k in range(MOUNTS)] if screw else []
    mounts = [Circle("BORE", polar(ORIGIN, away, turn), screw) for turn in turns]
    shaft = bars.shaft((L, 0.0), L)
    if shaft:  # which turns in the base
        shaft = bore_at(full, (L, 0.0), shaft).around
    bore = [Circle("BORE", ORIGIN, shaft + bars.sizes.loose)] if shaft else []
    high, _ = bars.sizes.span(BELOW)
    # before another drive it fills its plane
    low = bars.sizes.span(BELOW + 1)[0] if full.spec.drive_before else high - sizes.arm_thickness
    edge = Circle("FRAME", ORIGIN, far + rim)
    return Plate("groove plate's base", "FRAME", edge, (*bore, *mounts), low, high)


def groove_stack(base: Plate, bars: Links, flanks: Iterable[Contour]) -> tuple[Plate, ...]:
    """Return base, ring and island; ``flanks`` are those of the groove."""
    inner, outer = sorted(flanks, key=lambda one: max(math.hypot(*p.start) for p in one.segments))
    low, high = bars.sizes.span(BELOW)
    bore = tuple(one for one in base.holes if isinstance(one, Circle) and one.centre == ORIGIN)
    mounts = base.holes[len(bore) :]
    ring = Plate("groove plate's ring", "FRAME", base.outline, (outer, *mounts), low, high)
    return base, ring, Plate("groove plate's island", "FRAME", inner, bore, low, high)
