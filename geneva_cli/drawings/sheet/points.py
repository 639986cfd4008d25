"""Tables of points for curves without simple dimensions: slots, grooves, pitch curves."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.paper import table
from geneva_cli.drawings.sheet.view import Block, times
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.shafts.fits import Fits
from geneva_cli.spec.written import coordinate, is_metric, length, number

COARSE = 1e-4  # finest tolerance of a table, as a fraction of the centre distance
MIRRORED = "; the other half is its mirror image in the x axis"


def tables(parts: Outlines, tolerance: float) -> list[Block]:
    """Return a table for each kind of curved slot, and for the groove of a cam."""
    blocks = []
    assembly = parts.assembly
    close = max(tolerance, COARSE * assembly.L)
    for engagement in assembly.kinds:
        if not engagement.slot.curved:
            continue
        count = sum(1 for one, _ in assembly.slots if one is engagement)
        symmetric = engagement.mirrored

        def centre(x: Array, engagement: Engagement = engagement) -> Array:
            px, py = engagement.slot(x, 0)
            return assembly.L * np.column_stack((px.c[0], py.c[0] + 0.0 * x))

        last = 0.0 if symmetric else engagement.exit_deg
        points = polyline(centre, engagement.entry_deg, last, close)
        fits = Fits(assembly.mechanism.spec.size.process, parts.sizes.wheel_thickness)
        width = sized.made(fits, assembly.mechanism, "slot", parts.sizes.half_width)
        what = f"{times(count, 'slot')}, {width} wide: points of its centre line, slot 1"
        more = MIRRORED if symmetric else ""
        blocks.append(point_table(what + more, points, close))
    guide = assembly.rollers[0][0].groove
    if guide is not None:
        from geneva_cli.parts.slots.groove import groove_curve

        guided = groove_curve(guide, assembly.L, 0.0)
        symmetric = guide.motion.symmetric
        last = 180.0 if symmetric else 360.0
        points = polyline(lambda t: guided(t)[0], 0.0, last, close)
        what = "groove: points of its centre line"
        blocks.append(point_table(what + (MIRRORED if symmetric else ""), points, close))
    return blocks


def gear_tables(mechanism: Mechanism, tolerance: float) -> list[Block]:
    """Return a table for each noncircular gear; none without them."""
    pair, L = mechanism.spec.gears, mechanism.center_distance_mm
    if pair is None:
        return []
    from geneva_cli.parts.gears.gear_pair import driven_curve, driver_curve

    close, blocks = max(tolerance, COARSE * L), []
    for name, of in (("driven gear", driven_curve), ("driver gear", driver_curve)):
        both = of(pair, mechanism.gear_shaft.sense)

        def curve(t: Array, both: Callable[[Array], tuple[Array, Array]] = both) -> Array:
            return both(np.radians(t))[0]

        half = np.linspace(0.0, 180.0, 37)
        symmetric = bool(np.abs(curve(-half) - curve(half) * (1.0, -1.0)).max() < SAME_LENGTH * L)
        points = polyline(curve, 0.0, 180.0 if symmetric else 360.0, close)
        what = f"{name}: points of its pitch curve about its axis, at input angle 0"
        blocks.append(point_table(what + (MIRRORED if symmetric else ""), points, close))
    return blocks


def polyline(
    curve: Callable[[Array], Array], a: float, b: float, tolerance: float, begin: int = 4
) -> Array:
    """Return points of a curve, (n, 2), whose chords are within ``tolerance`` of the curve.

    There are at least ``begin`` chords.
    """
    nodes = np.linspace(a, b, begin + 1)
    quarters = (0.25, 0.5, 0.75)  # fractions of a chord at which its error is computed
    for _ in range(14):  # halvings
        steps = np.diff(nodes)
        inner = np.concatenate([nodes[:-1] + fraction * steps for fraction in quarters])
        ends = curve(nodes)
        between = curve(inner).reshape(len(quarters), -1, 2)
        chord = np.diff(ends, axis=0)
        off = between - ends[:-1]
        length = np.maximum(np.hypot(*chord.T), 1e-12)
        misses = np.abs(off[..., 0] * chord[:, 1] - off[..., 1] * chord[:, 0]) / length
        bad = misses.max(axis=0) > tolerance
        if not bad.any():
            break
        nodes = np.sort(np.concatenate((nodes, (nodes[:-1] + 0.5 * steps)[bad])))
    return curve(nodes)


def point_table(title: str, points: Array, close: float) -> Block:
    """Return a table of points in as many columns as they need, with their tolerance."""
    groups = math.ceil(len(points) / 40)  # a table of more than 40 rows has further columns
    high = math.ceil(len(points) / groups)
    rows = [["No.", "x", "y"] * groups]
    for i in range(high):
        row: list[str] = []
        for k in range(groups):
            j = k * high + i
            known = j < len(points)
            row += [str(j + 1), *(coordinate(v) for v in points[j])] if known else ["", "", ""]
        rows.append(row)
    within = number(close, 4) if is_metric() else length(close, fine=True)
    note = f"chords between them are within {within} of it"
    return table([title, note], rows, (9.0, 17.0, 17.0) * groups)  # mm
