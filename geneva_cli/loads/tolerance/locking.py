"""The play of the wheel in its lock in the middle of a dwell, for any deviations.

A recess of radius rho is cut about a point at L from the wheel's axis; the disc of radius k turns
at L + dL. The wheel turns by d until a corner of the recess, at p from the wheel's axis, meets the
disc, at d = chi(L, rho) - chi(L + dL, k) with cos chi = (L² + p² - rho²) / (2 L p). (Of a corner
rounded by e that holds for its centre, with rho + e and k + e.) An end of the disc meets the recess
first if that reaches farther round; or both arcs meet where their centres are rho - k apart.

First the deviations themselves, in mm and radians. They are jets: of order 0 the values of many
machines, of order 1 the slope by one dimension.
"""

import math
from collections.abc import Sequence
from functools import partial
from itertools import product
from typing import NamedTuple, Protocol, cast

import numpy as np

from geneva_cli.motion.machine_spec import Spec
from geneva_cli.numerics import arrays
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.jet import Jet, Number, atan2, sqrt

ROUNDING = 1e-13  # of an angle, or of the centre distance


class Deviations(NamedTuple):
    """Deviations of the dimensions in ``[tolerance]``, in their order."""

    center_distance_mm: Jet
    crank_radius_mm: Jet
    roller_diameter_mm: Jet
    slot_width_mm: Jet
    slot_angle_deg: Jet  # in radians here
    lock_radius_mm: Jet
    recess_radius_mm: Jet


AS_DRAWN = Deviations(*[Jet((0.0,))] * len(Deviations._fields))  # without any


def without_effect(spec: Spec) -> dict[str, str]:
    """Dimensions whose deviations have no effect in a machine, with the reason."""
    why = {}
    if not spec.drive.ONE_ARM:
        why["crank_radius_mm"] = "no crank's arm carries the roller"
    if not spec.wheel.FLAT:
        why["center_distance_mm"] = "the shafts meet, whatever the sphere's radius"
    return why


def used(spec: Spec) -> dict[str, float]:
    """Plus or minus of each dimension, mm and radians, 0 without effect; (m, 1) for m designs."""
    values = spec.tolerance.as_dict() | dict.fromkeys(without_effect(spec), 0.0)
    values["slot_angle_deg"] = radians(values["slot_angle_deg"])
    return {name: values[name] for name in Deviations._fields}


def deviations(values: Sequence[Number]) -> Deviations:
    """Deviations with these values, without slopes."""
    return Deviations(*[Jet((value,)) for value in values])


def slope_of(number: int) -> Deviations:
    """Deviations of 0, with the slope by one of them."""
    return Deviations(*[Jet((0.0, float(i == number))) for i in range(len(Deviations._fields))])


def corners(sizes: Sequence[float]) -> Deviations:
    """Every combination of the ends of n nonzero tolerances: (2**n, 1 or m, 1) for m designs."""
    ends = [(0.0,) if arrays.all_true(size == 0.0) else (-size, size) for size in sizes]
    columns = zip(*product(*ends), strict=True)
    return deviations([np.reshape(column, (len(column), -1, 1)) for column in columns])


class Effect(Protocol):
    """What deviations cause, such as the play of a lock."""

    def __call__(self, by: Deviations, /) -> tuple[Jet, arrays.Mask]:
        """Errors of machines, and a mask of those that do not fit together."""


class LockContact(NamedTuple):
    """The contact of disc and recess, in radians and millimetres; (m, 1) for m locks."""

    on: str  # "corner" of the recess on the disc, "disc's end" on the recess, or arc on "recess"
    phi: float  # direction of the force, through one of the arcs' centres, from their middle
    play: float  # of the wheel, to either side
    radius: float  # R_e of the contact: 0 for a sharp edge, infinite without clearance


class Lock(NamedTuple):
    """One corner of a recess and one locking arc of the disc, mm and radians; (m, 1) for m."""

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
        return arrays.library(a).acos(arrays.larger(-1.0, arrays.smaller(1.0, self.sign * a)))

    def __call__(self, by: Deviations) -> tuple[Jet, arrays.Mask]:
        """Play of the wheel to one side, radians: 0 where disc and recess do not fit together."""
        L, off, far = self.L, by.center_distance_mm, self.corner - self.sign * self.edge
        lock, recess = by.lock_radius_mm + self.lock, by.recess_radius_mm + self.recess
        away, spare = off + L, recess - lock
        with np.errstate(all="ignore"):
            on_corner = _at(L - 0.0 * away, far, recess + self.edge)
            on_corner = on_corner - _at(away, far, lock + self.edge)
            x, y = away - lock * (self.sign * np.cos(self.half)), lock * np.sin(self.half)
            on_end = _at(sqrt(x * x + y * y), L, recess) - atan2(y, x)
            # Between their ends disc and recess touch where 4 L (L + dL) sin²(d/2) = c² - dL², with
            # the difference c of their radii.
            square = (spare * spare - off * off) / (away * (4.0 * L))
            sine = sqrt(chosen(square.c[0] > 0.0, square, square * 0.0 + 0.25))
            between = atan2(sine, sqrt(1.0 - sine * sine)) * 2.0
            on_recess = chosen(square.c[0] > 0.0, between, between * 0.0)
        angle = chosen(self.reach <= self.half, on_corner, on_end)
        # distance to the recess's bottom
        nearer = arrays.array(off.c[0]) * -self.sign
        left = arrays.array(spare.c[0]) - np.maximum(nearer, 0.0)
        jams = (left < -ROUNDING * L) | (arrays.array(angle.c[0]) < -ROUNDING)
        least = np.cos(arrays.smaller(self.reach, self.half))
        angle = chosen((nearer > np.maximum(spare.c[0], 0.0) * least) & ~jams, on_recess, angle)
        return chosen(jams, angle * 0.0, angle), jams

    def contact(self) -> LockContact:
        """Contact of disc and recess after the play is used up, without deviations."""
        L, clearance = self.L, self.recess - self.lock
        # a corner meets the disc if the disc reaches as far round as the recess
        half_reach = self.reach
        corner, loose = half_reach <= self.half, clearance > 0.0
        x, y = L - self.sign * self.lock * np.cos(self.half), self.lock * np.sin(self.half)
        far = np.where(corner, self.corner - self.sign * self.edge, np.hypot(x, y))
        reach = np.where(corner, self.lock + self.edge, self.recess)
        cosine = self.sign * (L * L + reach * reach - far * far) / (2.0 * L * reach)
        # if the arcs touch there is no such triangle: the angle is 90 degrees
        arcs = arrays.smaller(half_reach, self.half) > 0.5 * math.pi
        with np.errstate(invalid="ignore"):
            # NaN where the recess's corner is beyond the recess, so that nothing meets it
            phi = np.arccos(np.where(arcs, 0.0, cosine))
        edge = np.where(corner, self.edge, 0.0)
        between = self.lock * self.recess / np.where(loose, clearance, 1.0)
        ended = self.lock * edge / (self.lock + edge)
        radius = np.where(loose, np.where(arcs, between, ended), math.inf)[()]
        on = np.where(arcs, "recess", np.where(corner, "corner", "disc's end"))[()]
        # without clearance rounding may make it negative
        play = np.maximum(self(AS_DRAWN)[0].c[0], 0.0)
        return LockContact(cast("str", on), *map(arrays.parameter, (phi, play, radius)))


def _at(one: Jet, other: float, opposite: Jet) -> Jet:
    """Angle between two sides of a triangle, from all three."""
    a = one * one + (other * other) - opposite * opposite
    return atan2(positive_root(one * one * (4.0 * other * other) - a * a), a)


def positive_root(square: Jet) -> Jet:
    """Square root, or almost 0 without a slope if there is no triangle."""
    return sqrt(chosen(square.c[0] > 0.0, square, square * 0.0 + 1e-300))


def chosen(condition: arrays.Truth, yes: Jet, no: Jet) -> Jet:
    """One of two values for each machine."""
    one = bool(condition) if np.ndim(condition) == 0 else condition
    return Jet([*map(partial(arrays.choose, one), yes.c, no.c)])


def loosest(locks: Sequence[Lock]) -> Lock:
    """The lock with the most play, of single ones.

    Of equal ones, as without clearance, it is that with the least reach: it takes the most force.
    """
    return max(locks, key=lambda one: (round(float(one.contact().play), 12), -float(one.reach)))
