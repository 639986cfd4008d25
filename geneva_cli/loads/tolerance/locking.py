"""The play of the wheel in its lock during the dwell, for any deviations.

A recess of radius rho is cut into the wheel about a point at the centre distance L. The locking
disc of radius k turns about the crank's axis at L + dL. The wheel can turn by d until one of three
contacts stops it.

A corner of a recess, at p from the wheel's axis, meets the disc:

    d = chi(L, rho) - chi(L + dL, k) ,    cos chi = (L² + p² - rho²) / (2 L p) .

Here chi is the corner's angle from the line of centres. For a corner rounded by e this holds for
its centre, which is nearer by e, with rho + e and k + e.

An end of the disc meets the recess, if the recess reaches farther round than the disc.

The disc meets the recess between their ends, where the two centres are rho - k apart. This happens
if the disc is too near to the recess's bottom, or if both reach farther round than 90 degrees.

The play is computed in the middle of a dwell, where the disc is symmetric to the recess.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, NamedTuple, Protocol, cast

import numpy as np

from geneva_cli.numerics.arrays import (
    Mask,
    Truth,
    all_true,
    array,
    choose,
    larger,
    library,
    parameter,
    smaller,
)
from geneva_cli.numerics.jet import Jet, atan2, sqrt

if TYPE_CHECKING:
    from geneva_cli.loads.tolerance.dimensions import Deviations

ROUNDING = 1e-13  # of an angle, or of the centre distance


class LockPlay(NamedTuple):
    """The wheel's play to one side, radians; 0 if disc and recess do not fit together."""

    angle: Jet
    jams: Mask  # True if they do not fit together


class CutLock(Protocol):
    """A lock of parts as they are cut, whose play deviations change."""

    def __call__(self, by: Deviations) -> LockPlay:
        """Play of the wheel to one side."""


class LockContact(NamedTuple):
    """The contact of disc and recess, in radians and millimetres; (m, 1) for m locks."""

    on: str  # "corner" of the recess on the disc, "disc's end" on the recess, or arc on "recess"
    phi: float  # direction of the force, through one of the arcs' centres, from their middle
    play: float  # of the wheel, to either side
    radius: float  # R_e of the contact: 0 for a sharp edge, infinite without clearance


class Lock(NamedTuple):
    """One corner of a recess and one locking arc of the disc, millimetres and radians.

    For m designs numbers and results are (m, 1).
    """

    L: float
    sign: float  # +1 if the disc reaches towards the wheel's axis, -1 away from it
    lock: float
    recess: float
    corner: float  # distance of the recess's corner from the wheel's axis
    half: float  # half angle of the disc's locking arc
    edge: float = 0.0  # radius of the recess's corners

    @property
    def reach(self) -> float:
        """Half of the recess, as an angle about the crank's axis."""
        a = (self.L**2 + self.recess**2 - self.corner**2) / (2.0 * self.L * self.recess)
        return library(a).acos(larger(-1.0, smaller(1.0, self.sign * a)))

    @property
    def on_corner(self) -> Truth:
        """Return True if the disc reaches as far round as the recess: a corner meets the disc."""
        return _truth(self.reach <= self.half)

    def __call__(self, by: Deviations) -> LockPlay:
        """Play of the wheel to one side."""
        L, away = self.L, by.center_distance_mm + self.L
        lock, recess = by.lock_radius_mm + self.lock, by.recess_radius_mm + self.recess
        spare, m = recess - lock, library(self.half, self.sign, self.L)

        def to_corner() -> Jet:
            still, corner = L - 0.0 * away, self._far
            return _at(still, corner, recess + self.edge) - _at(away, corner, lock + self.edge)

        def to_end() -> Jet:
            x = away - lock * (self.sign * m.cos(self.half))
            y = lock * m.sin(self.half)
            far = sqrt(x * x + y * y)
            return _at(far, L, recess) - atan2(y, x)

        angle = _either(self.on_corner, to_corner, to_end)
        # distance to the recess's bottom
        nearer = array(by.center_distance_mm.c[0]) * -self.sign
        left = array(spare.c[0]) - np.maximum(nearer, 0.0)
        jams = (left < -ROUNDING * L) | (array(angle.c[0]) < -ROUNDING)
        least = smaller(self.reach, self.half)
        on_it = nearer > np.maximum(spare.c[0], 0.0) * library(least).cos(least)
        angle = _chosen(on_it & ~jams, self._on_recess(by, spare), angle)
        return LockPlay(_chosen(jams, angle * 0.0, angle), jams)

    @property
    def _far(self) -> float:
        """Distance of a rounded corner's centre from the wheel's axis."""
        return self.corner - self.sign * self.edge

    def contact(self) -> LockContact:
        """Contact of disc and recess after the play is used up, without deviations.

        >>> touch = Lock(100.0, 1.0, 40.0, 40.5, 86.8, 2.0).contact()
        >>> round(math.degrees(touch.phi), 3), round(math.degrees(touch.play), 4)
        (59.455, 0.3325)
        >>> Lock(100.0, -1.0, 30.0, 30.5, 86.8, 2.0).contact().on  # an internal wheel
        'recess'
        """
        from geneva_cli.loads.tolerance.dimensions import Deviations, deviations

        L, corner, clearance = self.L, self.on_corner, self.recess - self.lock
        m = library(L, self.sign * self.lock, self.half * self.recess)
        x, y = L - self.sign * self.lock * m.cos(self.half), self.lock * m.sin(self.half)
        far = choose(corner, self._far, m.hypot(x, y))
        reach = choose(corner, self.lock + self.edge, self.recess)
        cosine = self.sign * (L * L + reach * reach - far * far) / (2.0 * L * reach)
        arcs = _truth(smaller(self.reach, self.half) > 0.5 * math.pi)
        # if the arcs touch there is no such triangle: the angle is 90 degrees
        # NaN where the recess's corner is beyond the recess, so that nothing meets it
        none = _truth(larger(cosine, -cosine) > 1.0)
        phi = library(cosine).acos(choose(arcs, 0.0, choose(none, math.nan, cosine)))
        edge = choose(corner, self.edge, 0.0)
        ended = self.lock * edge / (self.lock + edge)
        loose = _truth(clearance > 0.0)
        between = self.lock * self.recess / choose(loose, clearance, 1.0)
        radius = choose(loose, choose(arcs, between, ended), math.inf)
        on = _word(arcs, "recess", _word(corner, "corner", "disc's end"))
        play = self(deviations([0.0] * len(Deviations._fields))).angle.c[0]
        free = parameter(np.maximum(play, 0.0))  # without clearance rounding may make it negative
        return LockContact(on, phi, free if np.ndim(play) else float(free), radius)

    def _on_recess(self, by: Deviations, spare: Jet) -> Jet:
        """Play if disc and recess touch between their ends.

        4 L (L + dL) sin²(d/2) = c² - dL², where c is the difference of their radii.
        """
        off = by.center_distance_mm
        square = (spare * spare - off * off) / ((off + self.L) * (4.0 * self.L))
        sine = sqrt(_chosen(square.c[0] > 0.0, square, square * 0.0 + 0.25))
        out = atan2(sine, sqrt(1.0 - sine * sine)) * 2.0
        return _chosen(square.c[0] > 0.0, out, out * 0.0)


def _at(one: Jet, other: float, opposite: Jet) -> Jet:
    """Angle between two sides of a triangle, from all three."""
    a = one * one + (other * other) - opposite * opposite
    return atan2(positive_root(one * one * (4.0 * other * other) - a * a), a)


def positive_root(square: Jet) -> Jet:
    """Square root, or almost 0 without a slope if there is no triangle."""
    return sqrt(_chosen(square.c[0] > 0.0, square, square * 0.0 + 1e-300))


def _truth(condition: Truth) -> Truth:
    """Truth value of one lock as Python's own type."""
    return bool(condition) if np.ndim(condition) == 0 else condition


def _chosen(condition: Truth, yes: Jet, no: Jet) -> Jet:
    one = _truth(condition)
    return Jet([choose(one, a, b) for a, b in zip(yes.c, no.c, strict=True)])


def _either(condition: Truth, yes: Callable[[], Jet], no: Callable[[], Jet]) -> Jet:
    """One of two jets; only the needed one is computed if one lock's batch agrees."""
    if all_true(condition):
        return yes()
    return _chosen(condition, yes(), no()) if np.any(condition) else no()


def _word(condition: Truth, yes: str, no: str) -> str:
    """One of two words; an array of words for an array of truth values."""
    if isinstance(condition, bool):
        return yes if condition else no
    return cast("str", np.where(condition, yes, no))


def loosest(locks: Sequence[Lock]) -> Lock:
    """Return the lock with the most play, of single ones.

    Of equal ones, as without clearance, it is that with the least reach: it takes the most force.
    """
    return max(locks, key=lambda one: (round(float(one.contact().play), 12), -float(one.reach)))
