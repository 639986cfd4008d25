"""Entry and exit on a roller's closed path: the pairs of points that a wheel's slots can use.

A wheel with straight radial slots takes a roller without shock if the path enters along one slot
and leaves along the next. Both points are equally far from the wheel's centre O. With the unit
tangents t1 and t2 there,

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b ,

so that the chord P2 - P1 is parallel to t1 + t2. Between the two points the pin goes round the
wheel's centre in one direction. So the tangent, seen from its ray, turns from -t1 to t2 without
passing the ray again. From entry to exit it turns by pi - 2b in all, against the wheel. At each end
it turns in that direction too, or not at all.

Draw the line of the chord through each point of the path: as an entry at the angle pi/2 - b from
the tangent to one side, as an exit to the other side. The points of a pair have one line in common.
A line is a point in a plane of its angle and its offset from an origin. So entries and exits are
two curves in that plane, and the pairs are the crossings of the curves.

The search uses boxes: an arc of the path between two samples for the entry, and one for the exit.
In the plane of lines an arc is a cubic through the values and slopes at its ends. A box is
discarded if one of the cubics is on one side of the other. The rest are halved, until the
directions of both cubics show that they cross once or not at all. Newton's method leads from the
crossing to the pair. The cubics are no proof: a margin allows for their error. A bend within 1e-5
radians of the crank counts as a cusp, and pairs in it may be missed.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from geneva_cli.drives.paths.boxes import OVERLAP, Boxes, boxes_of, cross_once, crossings, halved
from geneva_cli.drives.paths.samples import PathPoints, PathSamples, points
from geneva_cli.drives.roller_path import RollerPath
from geneva_cli.numerics.arrays import Array, Mask, Which, Whole, joined
from geneva_cli.numerics.tolerances import ROUNDED

# Slope of the index angle along the family of pairs: a root with less is double, or nearly so.
DOUBLE_ROOT_SLOPE = 1e-5
SAME_ENTRY = 1e-6  # radians: entries nearer to each other are one


class EndPairs(NamedTuple):
    """Pairs of points of designs, entry first, in two columns."""

    which: Whole
    at: PathPoints

    def taken(self, where: Which) -> EndPairs:
        """Select some of the pairs."""
        return EndPairs(self.which[where], self.at.taken(where))


class PairSearch(NamedTuple):
    """Pairs, and places that have no pair or may have a double root."""

    pairs: EndPairs
    doubtful: EndPairs


class Residual(NamedTuple):
    """Residuals of both conditions, and their slopes.

    ``away`` is the chord's component across the sum of the tangents, with its slopes by entry and
    by exit. ``excess`` is the error of the index angle, which turns with the tangents. ``det`` is
    the determinant of both, and ``sense`` the wheel's sense of rotation.
    """

    away: Array
    by_entry: Array
    by_exit: Array
    excess: Array
    det: Array
    sense: Array


def pairs(path: RollerPath, samples: Iterable[PathSamples], b: Array) -> PairSearch:
    """All pairs for designs with half index angles b, (n, 1), from samples of their paths.

    They are in the order of designs and entries.
    """
    boxes = joined([part for some in samples for part in boxes_of(some, b)])
    roots, halvings = [], 9  # of a box
    for depth in range(halvings + 1):
        once = cross_once(boxes) | (depth == halvings)
        some = boxes.taken(np.flatnonzero(once))
        phi, close = _solved(path, some, crossings(some), b)
        roots.append((some.which[close], phi[close]))
        once[once] = close
        if once.all() or depth == halvings:
            break
        boxes = halved(path, boxes.taken(np.flatnonzero(~once)), b)
    which_of_root, at_root = joined(roots, 0)
    first = firsts(which_of_root, at_root)
    ends = ends_at(path, which_of_root[first], at_root[first])
    doubtful = ends_at(path, some.which[~close], phi[~close])
    # a pair without a root whose index angle is this near, in radians, may be a double root
    near = np.flatnonzero(np.abs(residual(doubtful, b).excess) < 1e-5)
    return PairSearch(ends, doubtful.taken(near))


def firsts(which: Whole, phi: Array, same: float = SAME_ENTRY) -> Whole:
    """First of each group of pairs of a design with equal entries."""
    # by designs and entries: a turn is less than 8 radians
    key = 8.0 * which + phi[:, 0] % math.tau
    order = np.argsort(key, kind="stable")
    new = np.ones(len(order), dtype=bool)
    new[1:] = np.diff(key[order]) > same
    return order[new]


def ends_at(path: RollerPath, which: Whole, phi: Array) -> EndPairs:
    """Points of designs at entry and exit angles, in two columns."""
    # by columns in memory, along which the designs' numbers vary too: a fifth faster
    return EndPairs(which, points(path.roughly(which), np.asfortranarray(phi)))


def residual(ends: EndPairs, b: Array) -> Residual:
    """Residuals of pairs; ``b`` holds the half index angles of all designs, (m, 1)."""
    at = ends.at
    (p, q), (t, u), (v, w) = at.p.T, at.t.T, at.v.T
    chord, both = q - p, (t + u).conj()
    turn, turn_out = at.turn.T
    by_exit = (w * both + chord * (1j * turn_out * u).conj()).imag
    by_entry = (chord * (1j * turn * t).conj() - v * both).imag
    angle = np.angle(-u * t.conj())
    sense = np.copysign(1.0, angle)
    excess = sense * angle - 2.0 * b[ends.which, 0]
    det = by_entry * turn_out + by_exit * turn
    return Residual((chord * both).imag, by_entry, by_exit, excess, det, sense)


def newton(ends: EndPairs, rest: Residual) -> Array:
    """Newton step from pairs, in two columns."""
    turn, turn_out = ends.at.turn.T
    excess = rest.sense * rest.excess
    by_entry = excess * rest.by_exit - rest.away * turn_out
    by_exit = -excess * rest.by_entry - rest.away * turn
    step: Array = np.stack((by_entry, by_exit)) / rest.det
    return step.T


def _solved(path: RollerPath, boxes: Boxes, phi: Array, b: Array) -> tuple[Array, Mask]:
    """Newton's method from places in boxes, (2, n): where it ends, and a mask of ends in their box.

    The ends are in two columns.
    """
    low = np.stack((boxes.entry.phi, boxes.exit.phi))
    width = np.stack((boxes.entry.width, boxes.exit.width))
    close = np.zeros(len(boxes.which), dtype=bool)
    live: Whole = np.arange(len(close))
    for _ in range(12):  # Newton steps
        if not len(live):
            break
        before, start, wide = (x.take(live, axis=1) for x in (phi, low, width))
        ends = ends_at(path, boxes.which.take(live), before.T)
        move = newton(ends, residual(ends, b)).T
        move *= np.minimum(1.0, (wide / np.abs(move)).min(axis=0))
        phi[:, live] = after = before + move
        off = np.maximum(start - after, after - (start + wide)) / wide
        inside = off.max(axis=0) <= OVERLAP + ROUNDED
        # radians: half of the digits; the next step gives all of them
        done = np.abs(move).max(axis=0) < 1e-6
        close[live] = done & inside
        live = live[~done & inside]
    return phi.T, close
