"""The horn, the wall between a slot and the recess of the lock, as a tapered cantilever.

Sections are perpendicular to the slot's wall, from there to the recess of radius R, at a distance s
inwards from the mouth; a straight slot's is t = h + R - sqrt(R² - s²) thick, h at the mouth. The
roller presses with N at s0. Over the face width b the section bears the bending stress
6 N (s - s0)/(b t²), a tension at the slot's wall. On a curved wall N also pushes or pulls along the
section's beam; so does friction f N along the wall, whose lever is t/2: towards the mouth it adds
4 f N/(b t). On a tip that is cut back to a flat the roller does not press.

The result is the greatest stress over all places of the roller and all sections, which end half-way
along the recess. The body that carries the horn is rigid; notches and the shear in the middle of
sections are neglected. Against plane stress by finite elements straight slots are 0.7 % lower to
2 % higher if h < R/6, 4 % higher at 2 R/7 and 7 % at R/2; curved ones -3 to 2 %, -5 to 7 % at R/2.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP, contact
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_case import first_alike, load_case
from geneva_cli.motion.batch import designs_in, taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import pitch
from geneva_cli.numerics.arrays import Number, Whole, array, blocks, joined, mapped, parameter
from geneva_cli.numerics.jet import Array, Jet
from geneva_cli.numerics.tolerances import TIE

STOUT = 0.5  # thickness at the mouth over the recess's radius, beyond which a horn is no beam


# The fraction of the greatest stress in any horn below which a horn's search ends: after samples a
# sixtieth of a half motion apart, after samples 8, 64 and 512 times as close, and at last. Where
# walls are curved or tips flat, places side by side differ more: after samples 16 and 256 times so.
BELOW = {8: (0.5, 0.9, 0.99, 0.999, 1.0), 16: (0.5, 0.95, 0.998, 1.0)}


class HornStress(NamedTuple):
    """The greatest stress in horns, its place and section; (m,) each, NaN without a load."""

    stress_MPa: float
    at_deg: float  # input angle from the engagement's mid-motion
    inwards_mm: float  # of the section, from the mouth
    thickness_mm: float


class SlotEnd(NamedTuple):
    """An end of a slot, entry or exit, and so the horn beside it that bears on that side.

    ``engagement`` is that of the roller in its slot. ``whole`` is the engagement of the motion,
    which has the load, at an input angle smaller by ``ahead_deg``.
    """

    engagement: Engagement
    end: float  # -1: between the slot and where the crank's axis is before the motion; 1: after it
    mouth_deg: float  # input angle at which the roller is at this end's mouth
    whole: Engagement
    ahead_deg: float


def slot_ends(mechanism: Mechanism) -> list[SlotEnd]:
    """Both ends of each kind of slot under its load."""
    ends = []
    for whole in mechanism.under_load.engagements:
        for end, (own, ahead) in ((-1.0, whole.passages[0]), (1.0, whole.passages[-1])):
            ends.append(SlotEnd(own, end, own.end_deg(end), whole, ahead))
    return ends


Sizes: TypeAlias = "tuple[float, ...]"  # half the slot's width, the recess, and what else differs
# Rows of what a horn's stress depends on at places of the roller or at sections, (rows, m, k) of m
# designs or one for all: the distance inwards from the mouth, a section's thickness, mm, and more;
# behind those of the roller is the friction on the wall under 1 N across it, towards the mouth.
Points: TypeAlias = "Array"


class Horn(NamedTuple):
    """One horn of a slot, in the wheel's frame: the one that bears torque forwards, or backwards.

    Numbers are floats or (m, 1), positions and directions (2, m, 1).
    """

    at: SlotEnd
    L: float
    half_width: float
    recess_mm: float
    centre: Array  # position of the recess's centre
    # directions (2, 2, m, 1): along the slot at its mouth; square to it, towards the slot
    axes: Array
    half: Array  # half the angle between this horn's mouth and the next one's, at that centre
    tip_mm: Number = 0.0  # width of the flat to which a thinner tip is cut back

    def points(self, input_deg: Number) -> Points:
        """Places of the roller, or sections, at input angles (m, k), in the axes of the horn.

        Rows 0 and 2 are the slot's wall from the recess's centre, inwards and across; row 1 is the
        thickness up to the recess. Rows 3 and 4 are the wall's normal towards the recess. Row 5 is
        0 where a tip is cut back. Row 6 is the angle about that centre, radians, from the section's
        foot to the next horn's.
        """
        at_deg = np.atleast_2d(input_deg)
        # one row as (k,) takes half the time
        x, y = self.at.engagement.slot(at_deg[0] if len(at_deg) == 1 else at_deg, 1)
        rows = np.broadcast_arrays(*map(np.atleast_2d, (*x.c[:2], *y.c[:2])))
        place, normal = np.stack((rows[0], rows[2])), np.stack((-rows[3], rows[1]))
        wall = (self.axes * (self.L * place - self.centre)).sum(axis=1)
        normal = (self.axes * normal).sum(axis=1)
        normal *= np.where(normal[1] > 0.0, -1.0, 1.0) / np.hypot(*normal)
        wall = wall + self.half_width * normal
        along = -(wall * normal).sum(axis=0)
        with np.errstate(invalid="ignore"):
            square = along * along - (wall * wall).sum(axis=0) + self.recess_mm**2
            thick = along - np.sqrt(square)
            left = self.half - np.arctan2(*(wall + thick * normal))
        depth = wall[1] - self.tip_mm
        inner = np.sqrt(np.maximum(np.square(self.recess_mm) - depth * depth, 0.0))
        begun = (depth >= self.recess_mm) | (wall[0] >= inner) | np.equal(self.tip_mm, 0.0)
        return np.stack(np.broadcast_arrays(wall[0], thick, wall[1], *normal, begun, left))

    @staticmethod
    def unit_stress(roller: Points, sections: Points) -> Array:
        """Stresses under 1 N on 1 mm of contact, MPa: (m, places, sections).

        They are 0 of sections that are not farther inwards than the roller.
        """
        contact, push, begun, rub = roller[:3:2], roller[3:5], roller[5], roller[7]
        thick, wall, normal = sections[1], sections[:3:2], sections[3:5]
        # friction along the wall towards the mouth, where the first axis is negative
        x, y = (push + rub * np.stack((push[1], -push[0]))) * begun
        # With the moment M about the section's middle and the pull P along the beam, the stress
        # 6 M/t² - P/t is a sum of products: each of a factor of the roller and one of the section.
        with np.errstate(all="ignore"):
            bends = 6.0 / thick**2
            along, across = bends * (wall + 0.5 * thick * normal) + normal / thick
            own = np.stack((across, along, bends))
            # where another horn begins there are no sections
            own = np.where(np.isfinite(own).all(axis=0) & (sections[6] > 0.0), own, 0.0)
        of_roller = np.stack((x, -y, contact[0] * y - contact[1] * x))
        stress = np.einsum("imp,ims->mps", of_roller, own)
        return np.where(sections[0][:, None] > roller[0][..., None], stress, 0.0)


# Horns of a mechanism and its sizes; those of a sphere have the members that are used of a Horn.
Sides: TypeAlias = Callable[..., Sequence[Any]]


def horns(mechanism: Mechanism, half_width_mm: float, recess_mm: float) -> list[Horn]:
    """Both horns of each kind of slot."""
    L, sides = mechanism.center_distance_mm, []
    moving = mechanism.spec.wheel.plane_motion(parameter(np.ravel(L)))
    for at in slot_ends(mechanism):
        turn = np.ravel(at.end * at.engagement.half_step)  # of the wheel at rest
        centre = moving.into(moving.crank_axis, turn)
        outwards = moving.outwards(centre).T[:, :, None]  # at the recess's centre, between horns
        centre = centre.T[:, :, None]
        mouth = pitch(at.engagement, at.mouth_deg)
        rows = mouth.tangent_x, mouth.tangent_y, mouth.x, mouth.y
        x, y, *place = np.broadcast_arrays(*map(np.atleast_2d, rows))
        inwards = -at.end * np.stack((x, y))
        across = np.stack((-inwards[1], inwards[0]))
        across = across * np.copysign(1.0, (across * (L * np.stack(place) - centre)).sum(axis=0))
        axes = np.stack(np.broadcast_arrays(inwards, across))
        away, up = (axes * outwards).sum(axis=1)
        sense = np.where(away > 0.0, 1.0, -1.0)
        half = np.arctan2(sense * away, sense * up)
        tip = mechanism.spec.size.horn_tip_mm
        sides.append(Horn(at, L, half_width_mm, recess_mm, centre, axes, half, tip))
    return sides


def greatest_stress(sides: Sides, mechanism: Mechanism, sizes: Sizes) -> HornStress:
    """Greatest stress of m designs, of flat horns for 1 mm of contact; a single one's is kept."""
    if isinstance(mechanism.design, int):
        return _single_stress(sides, first_alike(mechanism), sizes)
    every = [taken((mechanism, sizes), some) for some in blocks(mechanism.designs, 1024)]
    return joined([_greatest(sides, *some) for some in every])


def _greatest(sides: Sides, mechanism: Mechanism, sizes: Sizes) -> HornStress:
    m, horns, searches = mechanism.designs, sides(mechanism, *sizes), list[tuple[Any, float]]()
    for side in horns:
        # the roller runs along this horn's wall from its own end; in a straight slot from both
        for start in (-1.0, 1.0):
            if side.at.whole.slot.walls_flat or start == side.at.end:
                searches.append((side, start))
    # fractions of a half motion, of places and of sections: (2, m, k)
    samples = [np.linspace(1.0, NEAR_CUSP, 61) + np.zeros((2, 1, 1))] * len(searches)
    each, lower = np.full((len(searches), 4, m), np.nan), np.full((len(searches), m), False)
    smooth = horns[0].at.whole.slot.walls_flat and not np.any(mechanism.spec.size.horn_tip_mm)
    steps = 8 if smooth else 16
    for below in BELOW[steps]:
        for i in np.flatnonzero(~lower.all(axis=1)):
            rows, samples[i] = _sampled(mechanism, *searches[i], samples[i], steps)
            each[i] = np.where(rows[0] > 0.0, rows, each[i])
        lower = np.nan_to_num(each[:, 0]) < below * np.fmax.reduce(each[:, 0])
    greatest = np.full((4, m), np.nan)
    for (side, _), best in zip(searches, each, strict=True):
        at = side.at
        best[1] += np.ravel(at.whole.mid_deg - at.ahead_deg)
        better = ~(best[0] <= greatest[0] * (1.0 + TIE)) & ~np.isnan(best[0])
        greatest = np.where(better, best, greatest)
    greatest[1] = np.ravel(mechanism.under_load.shown_deg(parameter(greatest[1][:, None])))
    return HornStress(*map(parameter, greatest))


_single_stress = lru_cache(maxsize=64)(_greatest)


def _sampled(
    mechanism: Mechanism, side: Horn, start: float, samples: Array, steps: int
) -> tuple[Array, Array]:
    """The greatest stress of n designs at samples, as rows of ``HornStress`` (4, n).

    The roller comes from the entry, ``start`` being -1, or from the exit, being 1. Then the samples
    (2, n, 2 steps + 1) between those beside that one.
    """
    m, slot, case = mechanism.designs, side.at.engagement, load_case(mechanism)
    first = row = np.arange(m)
    if m > 1 and designs_in((side, case.friction, case.radius)) == 1:
        # loads alone differ: horns under 1 N are computed once for designs with the same samples
        ends = np.broadcast_to(samples, (2, m, samples.shape[2]))[..., [0, -1]]
        _, first, row = np.unique(ends, axis=1, return_index=True, return_inverse=True)
        samples = samples[:, first]
    all_places = (slot.entry_deg if start < 0.0 else slot.exit_deg) * samples[0]
    x = all_places - side.at.ahead_deg
    x = x[0] if len(x) == 1 else x  # as (k,) in half the time
    at = contact(side.at.whole, x, reactions=False)
    if first is not row:
        at = mapped(lambda jet: jet and Jet([_picked(array(jet.c[0]), row)]), at)
    with np.errstate(all="ignore"):
        # with signs of the horn that bears: the force is below 0 where it is on the other one
        loads = Instant(case, at, -side.at.end, None, 1.0)
        force = np.where(array(loads.grip.c[0]) > 0.0, loads.force_N.c[0], 0.0)
    force = np.atleast_2d(np.where(np.isfinite(force), np.maximum(force, 0.0), 0.0))
    own = np.flatnonzero(force.any(axis=0))  # elsewhere it is 0
    own = own if len(own) else np.arange(1)
    # a mouth is away from the axis, but for internal wheels
    rub = case.friction * mechanism.spec.wheel.SIGN * loads.slides * at.touches.c[0]
    rub = np.broadcast_to(rub, (m, x.shape[-1]))[first]
    force, places, rub = force[:, own], all_places[:, own], rub[:, own]
    points = side.points(np.hstack((places, side.at.mouth_deg * samples[1])))
    roller = np.stack(np.broadcast_arrays(*points[..., : len(own)], rub))
    sections = points[..., len(own) :]
    unit = side.unit_stress(roller, sections)
    stress = np.broadcast_to(force * _picked(unit.max(axis=2), row), (m, len(own)))
    most = stress.max(axis=1, keepdims=True)
    i = np.argmax(stress >= most * (1.0 - TIE), axis=1)
    unit = unit[0 if len(unit) == 1 else row, i]
    load = _picked(force, np.arange(m), i)[:, None]
    j = np.argmax(load * unit >= most * (1.0 - TIE), axis=1)
    rows = np.stack((most[:, 0], _picked(places, row, i), *_picked(sections[:2], row, j)))
    beside = np.stack((own[i], j))[..., None] + np.array([-1, 1])
    every = np.broadcast_to(_picked(samples, row), (2, m, samples.shape[2]))
    ends = np.take_along_axis(every, np.clip(beside, 0, samples.shape[2] - 1), axis=2)
    return rows, ends[..., :1] + np.diff(ends) * np.linspace(0.0, 1.0, 2 * steps + 1)


def _picked(values: Array, row: Whole, k: Whole | None = None) -> Array:
    """Values (..., m, k) of m designs, from the rows of each, or from one of all; or sample k."""
    shared = np.ndim(values) < 2 or values.shape[-2] == 1
    if k is None:
        return values if shared else values.take(row, axis=-2)
    picked: Array = values[..., 0 if shared else row, k]
    return picked
