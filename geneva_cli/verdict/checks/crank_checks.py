"""Gaps between cranks about one wheel, and between adjacent wheels on a carrier.

All cranks turn at one rate. So seen from one of them, another one does not turn: it moves on a
circle, whose radius is the distance of their axes. Both are taken as their convex hulls, seen along
the shafts. Their gap is the greatest over all directions of what separates them there.
"""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Member
from geneva_cli.loads.carried import farthest_mm
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.slots.roller_paths import roller_centres
from geneva_cli.verdict.checks.check import Check, compared


def cranks_apart(name: str, parts: FlatParts) -> Check | None:
    """The least gap between two cranks, and where it is."""
    if len(parts.mechanism.crank_places) < 2:
        return None
    edge = _edge(parts)
    pairs = combinations(parts.cranks, 2)
    gap, at_deg = min(_least(edge, one, other) for one, other in pairs)
    return compared(name, gap, "at least", 0.0, parts.mechanism.shown_deg(at_deg))


def _edge(parts: FlatParts) -> tuple[Array, Array]:
    """Return complex points of a crank in its own frame, and how far it reaches about each, mm."""
    outlines = parts.outlines
    L, sizes = outlines.assembly.L, outlines.sizes
    near = 1e-5 * L  # chords of arcs miss the outline by less
    contours = [*outlines.crank, *([parts.arm.outline] if parts.arm else [])]
    x, y = Polyarc(contours).samples(near, L).T if contours else np.empty((2, 0))
    centres = [0.0, *(complex(*at) for at in roller_centres(outlines.assembly))]
    reach = [parts.axle_radius("crank"), *[sizes.roller] * (len(centres) - 1)]
    return np.append(x + 1j * y, centres), np.append(np.full(len(x), near), reach)


def _least(edge: tuple[Array, Array], one: Member, other: Member) -> tuple[float, float]:
    """Return a lower bound of the gap of two cranks, mm, and its input angle, degrees."""
    # directions: the bound is less than a thousandth of the axes' distance below the gap
    count = 3600
    step = math.tau / count
    around: Array = step * np.arange(count, dtype=np.float64)
    between = complex(*other.at) - complex(*one.at)
    opposite: Array = around - (other.turn - one.turn) + math.pi
    taken = _support(edge, around) + _support(edge, opposite)
    # in each interval of the direction of the other's axis, from its middle to both ends
    gap, quarter = np.full(count, -math.inf), count // 4
    wrapped = np.concatenate((taken[-quarter:], taken, taken[:quarter]))
    spread = float(np.ptp(taken))
    for off in range(quarter + 1):
        least = abs(between) * math.cos((off + 0.5) * step)
        # what is taken varies by the spread: no direction so far off gives a greater gap
        if least < abs(between) * math.cos(0.5 * step) - spread:
            break
        for start in (quarter - off, quarter + off):
            np.maximum(gap, least - wrapped[start : start + count], out=gap)
    i = int(np.argmin(gap))
    seen = math.atan2(between.imag, between.real) - one.turn  # at input angle 0
    # rounded far below the step of the directions
    return float(gap[i]), round(math.degrees(math.remainder(around[i] - seen, math.tau)), 6)


def _support(edge: tuple[Array, Array], around: Array) -> Array:
    """Return how far a crank reaches from its axis in directions of its own frame, mm."""
    points, reach = edge
    out = []
    for some in np.split(around, len(around) // 100):
        middle = np.exp(1j * some[len(some) // 2])
        ahead = (points * middle.conjugate()).real + reach
        i = ahead.argmax()
        # turning by an angle brings a point ahead of the i-th by their distance times its chord
        chord = np.abs(np.exp(1j * some[[0, -1]]) - middle).max()
        may_lead = ahead[i] - ahead <= chord * np.abs(points - points[i]) + 1e-9  # mm: rounding
        x, y = points.real[may_lead], points.imag[may_lead]
        along = np.outer(np.cos(some), x) + np.outer(np.sin(some), y)
        out.append((along + reach[may_lead]).max(axis=1))
    return np.concatenate(out)


def wheels_apart(name: str, parts: FlatParts) -> Check | None:
    """The gap between the circles of adjacent wheels, each with all that it carries."""
    wheels = parts.mechanism.spec.drive.wheels_on_carrier
    if wheels < 2:
        return None
    between = 2.0 * parts.mechanism.center_distance_mm * math.sin(math.pi / wheels)
    return compared(name, between - 2.0 * reach_mm(parts.outlines), "at least", 0.0)


def reach_mm(outlines: Outlines) -> float:
    """Radius of the circle about a wheel's axis that contains it and its masses."""
    sizes = outlines.sizes
    return max(sizes.rim, sizes.outer, farthest_mm(outlines.assembly.mechanism.spec))
