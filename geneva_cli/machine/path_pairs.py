"""Entry and exit on a roller's closed path: the pairs of places that a wheel's slots could take.

A wheel with straight radial slots takes a roller without shock where the roller's path enters along
one slot and leaves along the next, equally far from the wheel's centre O: with the unit tangents t1
and t2 there,

    O = P1 + rho t1 = P2 - rho t2 ,    the angle from -t1 to t2 = the index angle 2b ,

so that the chord P2 - P1 is parallel to t1 + t2. All the way between them the pin goes round the
wheel's centre one way. So the tangent, seen from its ray, turns from -t1 to t2 without passing the
ray again, and from entry to exit it turns by pi - 2b in all, against the wheel; at either end
it turns that way too, or not at all.

That makes the search one of boxes: an interval of crank angles between two samples for the entry,
and one for the exit. A box is laid aside where the turn, or the chord's part across t1 + t2, has
one sign in all of it, as the cubics through the samples' values and slopes have it. What is left
is halved, until both change so evenly over the box that Newton finds its only pair.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.machine.path_boxes import (
    BESIDE,
    Boxes,
    boxes_of,
    halved,
    newton_steps,
)
from geneva_cli.machine.path_samples import PathPoints, PathSamples, joined, points
from geneva_cli.machine.roller_path import RollerPath
from geneva_cli.numerics.tolerances import ROUNDED

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array, Mask, Which, Whole

HALVINGS = 8  # of a box
STEPS = 12  # of Newton in a box
CLOSE = 1e-6  # radians: after so short a step of Newton, half of the digits and all of them next
FLAT = 1e-5  # of the index angle along the family of pairs: less slope is a double root
DOUBTFUL = 1e-5  # radians of the index angle: nearer than that without a root, it may be double


class Pairs(NamedTuple):
    """Pairs of places of designs, entry first, in two columns."""

    which: Whole
    at: PathPoints

    def taken(self, where: Which) -> Pairs:
        """Some of the pairs."""
        return Pairs(self.which[where], self.at.taken(where))


class FoundPairs(NamedTuple):
    """Pairs; and places where there is none, or where a double root may be."""

    pairs: Pairs
    doubtful: Pairs


class Residual(NamedTuple):
    """What is left of both conditions, and their slopes.

    ``away``: the chord's part across the sum of the tangents, with slopes by entry and by exit;
    ``excess`` of the index angle, which turns with the tangents. ``det`` is of both.
    """

    away: Array
    by_entry: Array
    by_exit: Array
    excess: Array
    det: Array
    sense: Array


def pairs(path: RollerPath, samples: Iterable[PathSamples], b: Array) -> FoundPairs:
    """All pairs of designs of half an index angle b, (n, 1), from samples of their paths."""
    wanted = math.pi - 2.0 * b[:, 0]
    boxes = joined([boxes_of(some, wanted[some.which]) for some in samples])
    found = []
    for depth in range(HALVINGS + 1):
        steps = newton_steps(boxes, wanted)
        last = depth == HALVINGS
        tried = np.arange(len(steps.near)) if last else np.flatnonzero(steps.alike & steps.near)
        ends, close = _solved(path, boxes.taken(tried), steps.phi[tried], b)
        found.append(ends.taken(close))
        rest = np.concatenate((np.flatnonzero(~steps.alike), tried[~close]))
        if last or not len(rest):
            break
        boxes = halved(path, boxes.taken(rest), wanted)
    ends = ends.taken(np.flatnonzero(~close))
    near = np.flatnonzero(np.abs(residual(ends, b).excess) < DOUBTFUL)
    return FoundPairs(joined(found), ends.taken(near))


def ends_at(path: RollerPath, which: Whole, phi: Array) -> Pairs:
    """Places of designs at entry and exit angles, in two columns."""
    return Pairs(which, points(path.roughly(which), phi))


def residual(ends: Pairs, b: Array) -> Residual:
    """Of pairs of places, and of all designs' half index angles (m, 1)."""
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


def newton(ends: Pairs, rest: Residual) -> Array:
    """The step of Newton from places, in two columns."""
    turn, turn_out = ends.at.turn.T
    excess = rest.sense * rest.excess
    by_entry = excess * rest.by_exit - rest.away * turn_out
    by_exit = -excess * rest.by_entry - rest.away * turn
    step: Array = np.stack((by_entry, by_exit), axis=1) / rest.det[:, None]
    return step


def _solved(path: RollerPath, boxes: Boxes, phi: Array, b: Array) -> tuple[Pairs, Mask]:
    """Newton from places in boxes: where it ends, and whether that is a pair in the box."""
    low = np.stack((boxes.entry.first.phi, boxes.exit.first.phi), axis=1)
    high = np.stack((boxes.entry.last.phi, boxes.exit.last.phi), axis=1)
    width = high - low
    phi = np.clip(phi, low - BESIDE * width, high + BESIDE * width)
    close = np.zeros(len(phi), dtype=bool)
    live = np.arange(len(phi))
    for _ in range(STEPS):
        if not len(live):
            break
        ends = ends_at(path, boxes.which[live], phi[live])
        rest = residual(ends, b)
        move = newton(ends, rest)
        move *= np.minimum(1.0, (width[live] / np.abs(move)).min(axis=1))[:, None]
        phi[live] += move
        off = np.maximum(low[live] - phi[live], phi[live] - high[live]) / width[live]
        inside = (off <= BESIDE + ROUNDED).all(axis=1)
        done = np.abs(move).max(axis=1) < CLOSE
        close[live] = done & inside
        live = live[~done & inside]
    return ends_at(path, boxes.which, phi), close
