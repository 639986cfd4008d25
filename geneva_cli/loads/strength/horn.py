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

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.loads.contact import NEAR_CUSP, contact, contact_values
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_case import load_case
from geneva_cli.motion.batch import taken
from geneva_cli.motion.engagement import Engagement
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.path_and_slot import pitch
from geneva_cli.numerics.arrays import Number, array, blocks, joined, parameter
from geneva_cli.numerics.jet import Array
from geneva_cli.numerics.tolerances import TIE

STOUT = 0.5  # thickness at the mouth over the recess's radius, beyond which a horn is no beam


class HornStress(NamedTuple):
    """The greatest stress in horns, its place and section; (m,) each, NaN without a load."""

    stress_MPa: float
    at_deg: float  # input angle from the engagement's mid-motion
    inwards_mm: float  # of the section, from the mouth
    thickness_mm: float

    @property
    def single(self) -> HornStress | None:
        """The stress of a single design as numbers; None without a horn or a load."""
        one = HornStress(*(float(array(row)[0]) for row in self))
        return None if math.isnan(one.stress_MPa) else one


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
            at_deg = own.entry_deg if end < 0.0 else own.exit_deg
            ends.append(SlotEnd(own, end, at_deg, whole, ahead))
    return ends


Sizes: TypeAlias = "tuple[float, ...]"  # half the slot's width, the recess, and what else differs


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

    def sections(self, input_deg: Number) -> tuple[Array, Array, Array, Array]:
        """Sections where the roller is at input angles (m, k), in the axes of the horn.

        They are points of the slot's wall and its normals towards the recess, (2, m, k) from the
        recess's centre; thicknesses up to the recess, mm; and the angles about that centre, in
        radians, from the sections' feet to the next horn's. These are (m, k).
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
            return wall, normal, thick, self.half - np.arctan2(*(wall + thick * normal))

    def unit_stress(
        self, roller: Array, rub: Array, sections: Array, width_mm: float
    ) -> tuple[Array, Array, Array]:
        """Stresses under 1 N, MPa (m, places, sections), and of sections place and thickness.

        The roller's places and the sections are input angles (m, k). ``rub`` is the friction on the
        wall under 1 N across it, positive towards the mouth. A section's place is its distance from
        the mouth, mm; its thickness, mm, is infinite beyond the horn.
        """
        count = roller.shape[1]
        places, normals, thick, left = self.sections(np.hstack((roller, sections)))
        contact, push = places[..., :count, None], normals[..., :count, None]
        wall, normal = places[..., None, count:], normals[..., None, count:]
        # where another horn begins there are no sections
        thick = np.where(left[:, count:] > 0.0, thick[:, count:], np.inf)
        # places of the wall that a tip which is cut back has left
        depth = places[1, :, :count] - self.tip_mm
        inner = np.sqrt(np.maximum(np.square(self.recess_mm) - depth * depth, 0.0))
        begun = (depth >= self.recess_mm) | (places[0, :, :count] >= inner)
        begun = begun | np.equal(self.tip_mm, 0.0)
        # friction along the wall towards the mouth, where the first axis is negative
        push = push + rub[..., None] * np.stack((push[1], -push[0]))
        with np.errstate(all="ignore"):
            # from the contact to the middle of the section, (2, m, places, sections)
            deep = thick[:, None]
            arm = (wall + 0.5 * deep * normal) - contact
            moment = arm[1] * push[0] - arm[0] * push[1]
            pull = push[1] * normal[0] - push[0] * normal[1]  # along the beam
            bent = (moment * (6.0 / deep**2) - pull / deep) / np.asarray(width_mm)[..., None]
            further = (wall[0] > contact[0]) & begun[:, :, None]
            stress = np.where(further & np.isfinite(bent), bent, 0.0)
        return stress, places[0, :, count:], thick

    @property
    def stoutness(self) -> Array:
        """Thickness at the mouth over the recess's radius, (m,)."""
        return np.ravel(self.sections(self.at.mouth_deg)[2] / self.recess_mm)


# Horns of a mechanism and its sizes; those of a sphere have the members that are used of a Horn.
Sides: TypeAlias = Callable[..., Sequence[Any]]


def horns(mechanism: Mechanism, half_width_mm: float, recess_mm: float) -> list[Horn]:
    """Both horns of each kind of slot."""
    L, sides = mechanism.center_distance_mm, []
    moving = mechanism.spec.wheel.plane_motion(parameter(np.ravel(L)))
    for at in slot_ends(mechanism):
        turn = np.ravel(at.end * at.engagement.half_step)  # of the wheel at rest
        places = np.column_stack(np.broadcast_arrays(np.ravel(L), 0.0, turn))
        centre = moving.into(places[:, :2], places[:, 2])
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


def greatest_stress(
    sides: Sides, mechanism: Mechanism, sizes: Sizes, width: float = 1.0
) -> HornStress:
    """Greatest stress of m designs for a width of the contact, mm; of a single one it is kept."""
    every, m = (mechanism, sizes, width), mechanism.designs
    if isinstance(mechanism.design, int):
        return _single_stress(sides, *every)
    # the stresses of 16 designs stay in the cache
    return joined([_greatest(sides, *taken(every, some)) for some in blocks(m, 16)])


def _greatest(sides: Sides, mechanism: Mechanism, sizes: Sizes, width: float) -> HornStress:
    m = mechanism.designs
    best = np.full((4, m), np.nan)
    for side in sides(mechanism, *sizes):
        # the roller runs along this horn's wall from its own end; in a straight slot from both
        slot = side.at.engagement
        flat = side.at.whole.slot.walls_flat
        for start in (slot.entry_deg, slot.exit_deg) if flat else (side.at.mouth_deg,):
            own = _over_a_half(mechanism, side, start, width)
            own[1] += np.ravel(side.at.whole.mid_deg - side.at.ahead_deg)
            better = ~(own[0] <= best[0] * (1.0 + TIE)) & ~np.isnan(own[0])
            best = np.where(better, own, best)
    at_deg = np.ravel(mechanism.under_load.shown_deg(parameter(best[1][:, None])))
    return HornStress(*map(parameter, (best[0], at_deg, *best[2:])))


_single_stress = lru_cache(maxsize=64)(_greatest)


def _over_a_half(mechanism: Mechanism, side: Horn, start: float, width: float) -> Array:
    """The rows of ``HornStress``, (4, m), for the roller from ``start`` to mid-motion."""
    case, best = load_case(mechanism), np.full((4, mechanism.designs), np.nan)
    grid, finer = np.linspace(1.0, NEAR_CUSP, 61), np.linspace(0.0, 1.0, 33)
    places, sections = np.atleast_2d(start) * grid, np.atleast_2d(side.at.mouth_deg) * grid
    for _ in range(4):  # then between the neighbours of the best sample so far
        x = places - side.at.ahead_deg
        x = x[0] if len(x) == 1 else x  # as (k,) in half the time
        at = contact_values(contact(side.at.whole, x, reactions=False))
        with np.errstate(all="ignore"):
            loads = Instant(case, at, None, None, 1.0)
            bears = np.asarray(loads.wheel_torque_Nm) * side.at.end < 0.0  # or else the other horn
            force = np.where(bears & (loads.grip > 0.0), np.abs(loads.force_N), 0.0)
        own = np.flatnonzero(bears.any(axis=0) if bears.ndim > 1 else bears)  # elsewhere it is 0
        # a mouth is away from the axis, but for internal wheels
        rub = case.friction * mechanism.spec.wheel.SIGN * loads.slides * at.touches
        # designs may have the same force and rub in different ways, and the reverse
        force, rub = map(np.atleast_2d, np.broadcast_arrays(force, rub))
        unit, inwards, thick = side.unit_stress(places[:, own], rub[:, own], sections, width)
        m, count = max(len(force), len(unit)), sections.shape[1]
        stress = np.zeros((m, places.shape[1], count))
        with np.errstate(invalid="ignore"):  # of a force without a bound
            loaded = force[:, own, None] * unit
        stress[:, own] = np.where(np.isfinite(loaded), loaded, 0.0)
        # designs may differ in their loads or sizes alone, and share their slots
        sections, inwards, thick, _ = np.broadcast_arrays(sections, inwards, thick, stress[:, 0])
        places, every = np.broadcast_to(places, (m, places.shape[1])), np.arange(m)
        flat = stress.reshape(m, -1)
        most = flat.max(axis=1)
        first = np.argmax(flat >= most[:, None] * (1.0 - TIE), axis=1)
        i, j = np.divmod(first, count)
        rows = flat[every, first], places[every, i], inwards[every, j], thick[every, j]
        best = np.where(most > 0.0, rows, best)
        refined = list[Array]()
        for samples, k in ((places, i), (sections, j)):
            last = samples.shape[1] - 1
            before = samples[every, np.maximum(k - 1, 0), None]
            after = samples[every, np.minimum(k + 1, last), None]
            refined.append(before + (after - before) * finer)
        places, sections = refined
    return best
