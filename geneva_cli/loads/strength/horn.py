"""The horn, the wall between a slot and the recess of the lock, as a tapered cantilever.

Its sections are perpendicular to the slot's wall, from there to the recess. h is the thickness at
the mouth, and R the recess's radius. At a distance s inwards from the mouth, a straight slot's
section is t(s) = h + R - sqrt(R² - s²) thick. The roller presses on the wall with N at s0. The
section at s then carries, over the face width b, the bending stress 6 N (s - s0)/(b t²), a tension
at the slot's wall. On a curved wall N also has a part along the section's beam, which pushes or
pulls evenly.

The result is the greatest stress at the wall, over all places of the roller and all sections.
Sections end half-way along the recess, where another horn begins. In the middle of a section shear
adds 3/2 N/(b t), at its faces nothing. The body that carries the horn is rigid, and notches are
neglected.

The tests compare it with plane stress by finite elements. For external and internal wheels with
straight slots, the stress is 0.7 % lower to 2 % higher if h < R/6. It is 4 % higher at h = 2 R/7
and 7 % higher at R/2; beyond that a horn is not a beam. For curved slots it is 3 % lower to 2 %
higher if h < R/6, and 5 % lower to 7 % higher at R/2.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.contact import NEAR_CUSP
from geneva_cli.kinematics.pitch_curve import pitch
from geneva_cli.loads.loads import state
from geneva_cli.machine.many import taken
from geneva_cli.numerics.arrays import array, blocks, joined, parameter
from geneva_cli.numerics.tolerances import TIE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geneva_cli.kinematics.engagement import Engagement
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.arrays import Number, Whole
    from geneva_cli.numerics.jet import Array

STOUT = 0.5  # thickness at the mouth over the recess's radius, beyond which a horn is no beam
SHEAR = 1.2  # of a rectangular section: energy of its shear stress over that of the mean stress


class HornStress(NamedTuple):
    """The greatest stress in a horn, with the roller's place and the section.

    (m,) each for m designs, NaN for those without a horn or a load.
    """

    stress_MPa: float
    at_deg: float  # input angle from the engagement's mid-motion
    inwards_mm: float  # of the section, from the mouth
    thickness_mm: float


class Horn(NamedTuple):
    """One horn of a slot, in the wheel's frame: the one that bears torque forwards, or backwards.

    ``engagement`` is that of the roller in its slot. ``whole`` is the engagement of the motion,
    which has the load, at an input angle smaller by ``ahead_deg``.

    Numbers are floats or (m, 1), positions and directions (2, m, 1).
    """

    engagement: Engagement
    L: float
    half_width: float
    recess: float
    end: float  # -1: between the slot and where the crank's axis is before the motion; 1: after
    centre: Array  # position of the recess's centre
    inwards: Array  # direction along the slot at its mouth
    across: Array  # direction perpendicular to that, from the recess's centre to the slot
    whole: Engagement
    ahead_deg: float

    @property
    def mouth_deg(self) -> float:
        """Input angle at which the roller is at this horn's mouth."""
        engagement = self.engagement
        return engagement.entry_deg if self.end < 0.0 else engagement.exit_deg

    def wall(self, input_deg: Number) -> tuple[Array, Array]:
        """Points of the slot's wall, and its normals towards the recess, in the horn's frame.

        At angles (m, k) both are (2, m, k). The origin is the recess's centre.
        """
        x, y = self.engagement.slot(_alike(input_deg), 1)
        place = self._turned(self.L * vector(x.c[0], y.c[0]) - self.centre)
        normal = self._turned(vector(-np.asarray(y.c[1]), x.c[1]))
        normal *= np.where(normal[1] > 0.0, -1.0, 1.0) / np.hypot(*normal)
        return place + self.half_width * normal, normal

    def _turned(self, of: Array) -> Array:
        """Transform a vector to the horn's frame."""
        return np.stack(np.broadcast_arrays(product(of, self.inwards), product(of, self.across)))

    def thickness(self, wall: Array, normal: Array) -> Array:
        """Thickness at points of the wall, mm; infinite where another horn begins."""
        thick, turned = self.feet(wall, normal)
        thickness: Array = np.where(turned < self.middle, thick, np.inf)
        return thickness

    def feet(self, wall: Array, normal: Array) -> tuple[Array, Array]:
        """Thickness at points of the wall up to the recess, and directions of the sections' feet.

        Directions are seen from the recess's centre: radians from the mouth's.
        """
        along = -product(wall, normal)
        with np.errstate(invalid="ignore"):
            thick = along - np.sqrt(along * along - product(wall, wall) + self.recess**2)
            return thick, np.arctan2(*(wall + thick * normal))

    @property
    def middle(self) -> Array:
        """Half the angle between this horn's mouth and the next one's, at the recess's centre."""
        away, up = product(self.centre, self.inwards), product(self.centre, self.across)
        sense = np.where(away > 0.0, 1.0, -1.0)
        half: Array = np.arctan2(sense * away, sense * up)
        return half

    def places(self, count: int) -> Array:
        """Input angles from the mouth inwards."""
        return self.mouth_deg * np.linspace(1.0, NEAR_CUSP, count)

    @property
    def stoutness(self) -> Array:
        """Thickness at the mouth over the recess's radius, (m,)."""
        return np.ravel(self.thickness(*self.wall(self.mouth_deg)) / self.recess)


def vector(x: Number, y: Number) -> Array:
    """Vectors of a batch: (2, m, k)."""
    both = np.atleast_2d(x), np.atleast_2d(y)
    if both[0].shape != both[1].shape:
        return np.stack(np.broadcast_arrays(*both))
    return np.array(both)


def _alike(input_deg: Number) -> Array:
    """Input angles (m, k); as (k,) for one row, which takes half the time."""
    x = np.atleast_2d(input_deg)
    return x[0] if len(x) == 1 else x


def product(a: Array, b: Array) -> Array:
    """Scalar products of vectors."""
    products: Array = a[0] * b[0] + a[1] * b[1]
    return products


def horns(mechanism: Mechanism, half_width_mm: float, recess_mm: float) -> list[Horn]:
    """Both horns of each kind of slot."""
    L, sides = mechanism.center_distance_mm, []
    for whole in mechanism.under_load.engagements:
        engagement, aheads = whole.through, whole.ahead_deg
        ends = engagement.entry_deg, engagement.exit_deg
        for end, mouth, ahead in zip((-1.0, 1.0), ends, (aheads[0], aheads[-1]), strict=True):
            rest = -end * engagement.half_step  # direction of the crank's axis, the wheel at rest
            at = pitch(engagement, mouth)
            inwards = -end * vector(at.tangent_x, at.tangent_y)
            centre = L * vector(np.cos(rest), np.sin(rest))
            across = vector(-inwards[1], inwards[0])
            towards = L * vector(at.x, at.y) - centre
            across = across * np.copysign(1.0, product(across, towards))
            frame = centre, inwards, across
            sides.append(Horn(engagement, L, half_width_mm, recess_mm, end, *frame, whole, ahead))
    return sides


def stoutness(mechanism: Mechanism, half_width_mm: float, recess_mm: float) -> Array:
    """Greatest thickness at the mouth over the recess's radius of all horns, (m,)."""
    every = [side.stoutness for side in horns(mechanism, half_width_mm, recess_mm)]
    most: Array = np.max(np.broadcast_arrays(*every), axis=0)
    return most


@lru_cache(maxsize=16)
def horn(
    mechanism: Mechanism, half_width_mm: float, recess_mm: float, width_mm: float
) -> HornStress | None:
    """Greatest bending stress in a machine's horns; None without a lock, or without a load.

    ``half_width_mm`` is half the slot's width, ``recess_mm`` the radius of the wheel's recesses,
    and ``width_mm`` the wheel's thickness.
    """
    if not recess_mm:
        return None
    rows = _horns(1, mechanism, half_width_mm, recess_mm, width_mm)
    one = HornStress(*(float(array(row)[0]) for row in rows))
    return None if math.isnan(one.stress_MPa) else one


def horn_stresses(
    mechanism: Mechanism, half_width_mm: float, recess_mm: float, width_mm: float
) -> HornStress:
    """Greatest bending stress of m designs, whose sizes may be (m, 1).

    NaN for a recess of 0, or without a load.
    """
    every = (mechanism, half_width_mm, recess_mm, width_mm)
    m = mechanism.designs
    if m == 1:
        return _horns(1, *every)
    # the stresses of 16 designs stay in the cache
    return joined([_horns(b.stop - b.start, *taken(every, b)) for b in blocks(m, 16)])


class _SamplePlaces(NamedTuple):
    """Input angles of each design at which roller and section are sampled."""

    roller: Array  # (m, halves of the motion, places)
    section: Array  # (m, sections)


def _horns(
    m: int, mechanism: Mechanism, half_width: float, recess: float, width: float
) -> HornStress:
    """Greatest bending stress of m designs that are searched together."""
    best, which = np.full((4, m), np.nan), np.zeros(m, dtype=int)
    next_, count = [], 61  # places and sections of the first sampling
    for number, side in enumerate(horns(mechanism, half_width, recess)):
        start = _SamplePlaces(_from(_halves(side), count), _from([side.mouth_deg], count)[:, 0])
        sample, around = _sampled(mechanism, side, start, width)
        better = ~(sample[0] <= best[0] * (1.0 + TIE)) & ~np.isnan(sample[0])
        best, which = np.where(better, sample, best), np.where(better, number, which)
        next_.append((side, around))
    for number, (side, around) in enumerate(next_):
        own = np.flatnonzero((which == number) & ~np.isnan(best[0]))
        if not len(own):
            continue
        some, one = (mechanism, half_width, recess, width), side
        if len(own) < m:
            some = taken(some, own)
            one = horns(*some[:3])[number]
            around = _SamplePlaces(*(places[own] for places in around))
        for _ in range(3):  # the middle of the remaining places is the best so far
            sample, around = _sampled(some[0], one, around, some[3])
            best[:, own] = np.where(np.isnan(sample[0]), best[:, own], sample)
        best[1, own] += np.ravel(one.whole.mid_deg - one.ahead_deg)
    at_deg = np.ravel(mechanism.shown_deg(parameter(best[1][:, None])))
    return HornStress(*map(parameter, (best[0], at_deg, *best[2:])))


def _halves(side: Horn) -> list[float]:
    """Input angles of the ends from which the roller runs along this horn's wall.

    It is the horn's own end for curved slots, and also if another roller leaves by another slot.
    Else both.
    """
    engagement = side.engagement
    if not side.whole.slot.walls_flat:
        return [side.mouth_deg]
    return [engagement.entry_deg, engagement.exit_deg]


def _from(ends: Sequence[float], count: int) -> Array:
    """Input angles from each of some ends to mid-motion: (m, ends, count)."""
    whole = np.hstack([np.atleast_2d(end) for end in ends])
    return whole[..., None] * np.linspace(1.0, NEAR_CUSP, count)


def _sampled(
    mechanism: Mechanism, side: Horn, within: _SamplePlaces, width: float
) -> tuple[Array, _SamplePlaces]:
    """Greatest stress at these places, (4, m), and places around it for the next step.

    The rows are those of ``HornStress``, NaN if there is no stress.
    """
    roller, u = within
    x = roller.reshape(len(roller), -1)
    places, normals = side.wall(np.hstack((x, u)))
    wall, square = (of[..., x.shape[1] :] for of in (places, normals))
    thick = side.thickness(wall, square)
    stress = _stress(mechanism, side, width, x, (places, normals), thick)
    m, _, count = stress.shape
    stress = stress.reshape(m, -1)
    most, every = stress.max(axis=1), np.arange(m)
    first = np.argmax(stress >= most[:, None] * (1.0 - TIE), axis=1)
    i, j = np.divmod(first, count)
    half, k = np.divmod(i, roller.shape[2])
    if m > len(u):  # their loads differ, their slots do not
        roller, u, thick = (np.repeat(of, m, axis=0) for of in (roller, u, thick))
        wall = np.repeat(wall, m, axis=1)
    runs = roller[every, half]
    rows = (stress[every, first], runs[every, k], wall[0, every, j], thick[every, j])
    sample = np.where(most > 0.0, rows, np.nan)
    return sample, _SamplePlaces(_around(runs, k)[:, None], _around(u, j))


def _around(places: Array, i: Whole) -> Array:
    """Places between the neighbours of one of them, in each row."""
    every, last = np.arange(len(places)), places.shape[1] - 1
    before = places[every, np.maximum(i - 1, 0), None]
    after = places[every, np.minimum(i + 1, last), None]
    refined: Array = before + (after - before) * np.linspace(0.0, 1.0, 33)
    return refined


def _stress(
    mechanism: Mechanism,
    side: Horn,
    width: float,
    x: Array,
    walls: tuple[Array, Array],
    thick: Array,
) -> Array:
    """Stress in MPa: for each design a row per place of the roller, a column per section.

    ``walls`` are points and normals of the wall, at the roller and at the sections.
    """
    loads = state(mechanism, side.whole, _alike(x - side.ahead_deg))
    bears = np.asarray(loads.torque_Nm) * side.end < 0.0
    line = np.atleast_2d(np.where(bears, loads.pin_force_N, 0.0) / width)
    (contact, wall), (push, normal) = (np.split(of, [x.shape[1]], axis=2) for of in walls)
    m = max(len(line), len(thick))
    stress = np.zeros((m, x.shape[1], thick.shape[1]))
    own = np.flatnonzero(bears.any(axis=0) if bears.ndim > 1 else bears)  # elsewhere it is 0
    contact, push, line = contact[..., own, None], push[..., own, None], line[:, own, None]
    with np.errstate(all="ignore"):
        # from the contact to the middle of the section, (2, m, places, sections)
        arm = (wall + 0.5 * thick * normal)[:, :, None] - contact
        moment = abs(arm[0] * push[1] - arm[1] * push[0])
        along, thick = normal[:, :, None], thick[:, None]
        pull = push[1] * along[0] - push[0] * along[1]  # along the beam
        bent = line * (moment * (6.0 / thick**2) - pull / thick)
        further = wall[0][:, None] > contact[0]
        stress[:, own] = np.where(further & np.isfinite(bent), bent, 0.0)
    return stress
