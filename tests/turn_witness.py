"""Witnesses of the full turn, its stops and its certificates: dense gaps, and polygons."""

from functools import partial

import numpy as np
import shapely
from drawing_witness import polygon
from sampling import some
from shapely import affinity

from geneva_cli.parts.turn.turn_certificate import certificate, intervals
from geneva_cli.parts.turn.turned_parts import wheel_stops, windows

TO_MM = 1e-3
PAST = 1e-5  # radians: what grazes at 100 mm overlaps by some 1e-7 mm more, as much as counts
OF_GAPS = 1e-10  # mm: rounding of gaps of some hundred mm
ROUNDING = 1e-9  # mm: a hundred times the rounding of a distance here
DENSE = some(20_000, 4_000)  # positions of a turn


def smallest_clearance(parts, pose, lead=0.0):
    """The smallest clearance of all parts in each pose, mm, the wheel turned on, radians."""
    gaps = parts.gaps
    return np.minimum(gaps.locking(pose, lead), gaps.rollers(pose, lead).min(axis=1))


def least_gap(parts, at):
    """The smallest gap of all parts over some input angles, mm."""
    return float(smallest_clearance(parts, parts.gaps.pose(at)).min())


def check_first_contacts(parts, at_deg, looks=50):
    """No parts overlap before the stops at input angles, and some do behind them.

    By gaps that are distances of points, not contacts, at some turns of the wheel up to each stop.
    """
    pose, most = parts.gaps.pose(at_deg), parts.assembly.half_step
    apart = smallest_clearance(parts, pose) + parts.close >= 0.0
    many, share = parts.gaps.pose(np.tile(at_deg, looks)), np.linspace(0.0, 1.0, looks)[:, None]
    for way, free in zip((-1.0, 1.0), wheel_stops(parts, at_deg)[0], strict=True):
        assert ((free >= 0.0) & (free <= most)).all()
        assert (free[~apart] == 0.0).all()
        turned = np.where(apart, share * free, 0.0)
        gap = smallest_clearance(parts, many, way * turned.ravel()).reshape(turned.shape)
        assert (gap[:, apart] >= -parts.close - OF_GAPS).all(), "a stop is missed"
        stopped = apart & (free < most)
        behind = smallest_clearance(parts, pose, way * (free + PAST))
        assert (behind[stopped] < -parts.close).all(), "nothing is behind a stop"
        yield apart, stopped


def check_proof(parts, gap_mm, to_mm=TO_MM):
    """Return the certificate of parts whose smallest gap is known, compared with dense positions.

    Parts that are proved have no smaller gap than is proved, and that is near to the smallest.
    """
    proof = certificate(parts, gap_mm, to_mm)
    if proof.open is None:
        assert max(gap_mm, 0.0) - 1.01 * to_mm <= proof.least_mm <= max(gap_mm, 0.0)
        assert least_gap(parts, turn_of(parts)) >= proof.least_mm
    return proof


def check_overlap(worse, depth, walls_mm=0.0):
    """Parts that overlap by a known depth, of walls that may be off, are proved to no less."""
    found = certificate(worse, 0.0, TO_MM)
    assert (found.open is None) == (depth < TO_MM)
    if found.open is None:
        assert found.least_mm <= -depth + walls_mm
    else:
        assert -depth - walls_mm - ROUNDING <= found.open[2] < -TO_MM


def turn_of(parts, count=DENSE):
    start = parts.assembly.start_deg
    return np.linspace(start, start + parts.assembly.turn_deg, count)


def pairs(parts, window):
    """Yield each pair of parts in a motion or dwell: its interval, its bounds, and its gap."""
    every = parts.pairs(-TO_MM)
    if parts.locked:
        ends = window.start, window.end
        yield ends, partial(every.lock, window), lambda at: parts.gaps.locking(parts.gaps.pose(at))
    for roller in range(len(parts.assembly.rollers)):

        def gap(at, roller=roller):
            return parts.gaps.rollers(parts.gaps.pose(at))[:, roller]

        yield (window.start, window.end), partial(every.roller, roller, window, None), gap
        for *span, driver in window.spans:
            if roller == driver:
                yield span, partial(every.roller, roller, window, span), gap


def check_bounds(parts, rng):
    for window in windows(parts):
        for (low, high), pair, gap in pairs(parts, window):
            width = (high - low) * 10.0 ** rng.uniform(-5.0, -0.5, 40)
            start = low + (high - low - width) * rng.random(40)
            found, least = pair(intervals(parts.gaps, start, start + width))
            at = start[:, None] + width[:, None] * np.linspace(0.0, 1.0, 41)
            dense = gap(at.ravel()).reshape(at.shape).min(axis=1)
            near = parts.gaps.near  # wider gaps are returned as this
            assert (np.minimum(least, near) <= dense + ROUNDING).all()
            middle = gap(start + 0.5 * width)
            assert np.allclose(np.minimum(found, near), middle, atol=ROUNDING)


def overlapping(parts, at_deg, lead=0.0, flat=1e-5):
    """Whether fine polygons overlap at input angles, the wheel turned on by ``lead`` radians.

    They stray by ``flat`` of the centre distance. The crank's parts are taken smaller by twice
    that, and must not even touch the wheel.
    """
    assembly, flat = parts.assembly, flat * parts.assembly.L
    less = 2.0 * flat + parts.close
    wheel = polygon(parts.outlines.wheel, flat)
    if assembly.sign < 0.0:
        wheel = shapely.Point(0.0, 0.0).buffer(parts.sizes.outer, quad_segs=512).difference(wheel)
    shapely.prepare(wheel)
    roller = shapely.Point(0.0, 0.0).buffer(parts.sizes.roller - less, quad_segs=800)
    cranks = [polygon(contour, flat).buffer(-less) for contour in parts.outlines.crank]
    poses, out = assembly.crank(at_deg), []
    for i, turn in enumerate(assembly.wheel(at_deg) + lead):
        pins = [assembly.pin(k, at_deg[i : i + 1])[0] for k in range(len(assembly.rollers))]
        moved = [affinity.translate(roller, *pin) for pin in pins]
        for crank in cranks:
            own = affinity.rotate(crank, poses[i], (0.0, 0.0), use_radians=True)
            moved.append(affinity.translate(own, assembly.L))
        back = (affinity.rotate(one, -turn, (0.0, 0.0), use_radians=True) for one in moved)
        out.append(any(wheel.intersects(one) for one in back))
    return out
