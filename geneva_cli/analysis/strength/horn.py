"""The horn, the wall between a slot and the recess of the lock, as a tapered cantilever.

Its sections are square to the slot's wall, from there to the recess: beside a straight slot they
are t(s) = h + R - sqrt(R² - s²) thick a distance s inwards of the mouth, h being the thickness at
the mouth and R the recess's radius. The roller presses on the wall with N at s0; the section at s
then carries, over the face width b, the bending stress 6 N (s - s0)/(b t²), which pulls at the
slot's wall; of a curved wall N also has a part along the section's beam, which pushes or pulls
evenly. The stress is the greatest at the wall over all places of the roller and all sections, to
half-way along the recess: past it another horn begins. In the middle of a section shear adds
3/2 N/(b t), at its faces nothing. The body that the horn stands on is taken as rigid, and no notch
is counted.

Plane stress (finite elements, in the tests), of external and internal wheels with straight slots:
0.7 % less to 2 % more where h < R/6, 4 % more at h = 2 R/7, 7 % more at R/2; beyond that it is no
beam. Of curved slots 3 % less to 2 % more where h < R/6, 5 % less to 7 % more at R/2.

Of one design, as the sizes of its parts are.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.loads.loads import state
from geneva_cli.machine.pitch_curve import pitch
from geneva_cli.numerics.roots import TIE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geneva_cli.machine.engagement import Engagement
    from geneva_cli.machine.mechanism import Mechanism
    from geneva_cli.numerics.jet import Array

THICK = 0.5  # thickness at the mouth over the recess's radius, beyond which a horn is no beam
GRID = 61  # places and sections looked at first
FINER = 33  # and around the best of them, time and again
ROUNDS = 3
NEAR = 1e-4  # share of a half motion: nearer to mid-motion a slot's direction is rounding
SHEAR = 1.2  # of a rectangular section: energy of its shear stress over that of the mean one


class HornStress(NamedTuple):
    """The greatest stress in a horn, where the roller is then, and the section that has it."""

    stress_MPa: float
    at_deg: float  # input angle from the engagement's mid-motion
    inwards_mm: float  # of the section from the mouth
    thickness_mm: float


class Side(NamedTuple):
    """One horn of a slot, in the wheel's frame: that which bears a torque forwards, or back."""

    engagement: Engagement
    L: float
    half_width: float
    recess: float
    end: float  # -1: between the slot and where the crank's axis is before the motion; 1: after
    centre: Array  # of the recess
    inwards: Array  # along the slot at its mouth
    across: Array  # square to that, from the recess's centre to the slot

    @property
    def mouth_deg(self) -> float:
        """Input angle at which the roller is at its mouth."""
        engagement = self.engagement
        return engagement.entry_deg if self.end < 0.0 else engagement.exit_deg

    def wall(self, input_deg: Array) -> tuple[Array, Array]:
        """Points of the slot's wall and its normals towards the recess, (2, n) on the horn's axes.

        The origin is the recess's centre.
        """
        x, y = self.engagement.slot(input_deg, 1)
        turn = np.array([self.inwards, self.across])
        place = turn @ (self.L * np.array([x.c[0], y.c[0]]) - self.centre[:, None])
        normal = turn @ np.array([-np.asarray(y.c[1]), x.c[1]])
        normal *= np.where(normal[1] > 0.0, -1.0, 1.0) / np.hypot(*normal)
        return place + self.half_width * normal, normal

    def thickness(self, wall: Array, normal: Array) -> Array:
        """The thickness at points of the wall, mm; infinite where another horn begins."""
        along = -(wall * normal).sum(axis=0)
        with np.errstate(invalid="ignore"):
            thick = along - np.sqrt(along * along - (wall * wall).sum(axis=0) + self.recess**2)
            foot = wall + thick * normal
            own = np.arctan2(*foot) < self._middle
        found: Array = np.where(own, thick, np.inf)
        return found

    @property
    def _middle(self) -> float:
        """Half the angle between this horn's mouth and the next one's, at the recess's centre."""
        away, up = float(self.centre @ self.inwards), float(self.centre @ self.across)
        return math.atan2(away, up) if away > 0.0 else math.atan2(-away, -up)

    def places(self, count: int) -> Array:
        """Input angles from the mouth inwards."""
        return self.mouth_deg * np.linspace(1.0, NEAR, count)

    @property
    def stoutness(self) -> float:
        """Thickness at the mouth over the recess's radius."""
        return float(self.thickness(*self.wall(np.array([self.mouth_deg])))[0]) / self.recess


def horns(mechanism: Mechanism, half_width_mm: float, recess_mm: float) -> list[Side]:
    """Both horns of each kind of slot."""
    L, found = mechanism.center_distance_mm, []
    for engagement in mechanism.engagements:
        for end, mouth in ((-1.0, engagement.entry_deg), (1.0, engagement.exit_deg)):
            rest = -end * engagement.half_step  # direction of the crank's axis, the wheel at rest
            at = pitch(engagement, mouth)
            inwards = -end * np.array([at.tangent_x, at.tangent_y])
            centre = L * np.array([math.cos(rest), math.sin(rest)])
            across = np.array([-inwards[1], inwards[0]])
            way = L * np.array([at.x, at.y]) - centre
            across *= math.copysign(1.0, float(across @ way))
            found.append(
                Side(engagement, L, half_width_mm, recess_mm, end, centre, inwards, across)
            )
    return found


def stoutness(mechanism: Mechanism, half_width_mm: float, recess_mm: float) -> float:
    """The stoutest horn's thickness at the mouth over the recess's radius."""
    return max(side.stoutness for side in horns(mechanism, half_width_mm, recess_mm))


@lru_cache(maxsize=16)
def horn(
    mechanism: Mechanism, half_width_mm: float, recess_mm: float, width_mm: float
) -> HornStress | None:
    """The greatest bending stress in a machine's horns; None without a lock, or without a load.

    ``half_width_mm`` of the slot, ``recess_mm`` the radius of the wheel's recesses, ``width_mm``
    the wheel's thickness.
    """
    if not recess_mm:
        return None
    best = None
    for side in horns(mechanism, half_width_mm, recess_mm):
        start = _Search(side, _from(_halves(side), GRID), _from([side.mouth_deg], GRID)[0])
        found = _looked(mechanism, start, width_mm)
        if found and not (best and found[0].stress_MPa <= best[0].stress_MPa * (1.0 + TIE)):
            best = found
    if best is None:
        return None
    for _ in range(ROUNDS):  # the middle of what is left is the best so far
        best = _looked(mechanism, best[1], width_mm) or best
    bent, engagement = best[0], best[1].side.engagement
    return bent._replace(at_deg=mechanism.shown_deg(engagement.mid_deg + bent.at_deg))


def _halves(side: Side) -> list[float]:
    """The ends from which the roller runs along this horn's wall: of curved slots its own."""
    engagement = side.engagement
    if engagement.slot.curved:
        return [side.mouth_deg]
    return [engagement.entry_deg, engagement.exit_deg]


def _from(ends: Sequence[float], count: int) -> Array:
    """Input angles from each of some ends to mid-motion, a row an end."""
    return np.array([np.linspace(end, NEAR * end, count) for end in ends])


class _Search(NamedTuple):
    """At which input angles roller and section are looked at."""

    side: Side
    roller: Array  # a row for each half of the motion
    section: Array


def _looked(
    mechanism: Mechanism, within: _Search, width: float
) -> tuple[HornStress, _Search] | None:
    """The greatest stress of all these places, and places around it to look at next."""
    side, roller, u = within
    places, normals = side.wall(np.append(roller, u))
    wall, square = (of[:, roller.size :] for of in (places, normals))
    thick = side.thickness(wall, square)
    stress = _stress(mechanism, side, width, roller.ravel(), (places, normals), thick)
    first = int(np.argmax(stress >= stress.max() * (1.0 - TIE)))
    i, j = divmod(first, len(u))
    if not stress[i, j] > 0.0:
        return None
    half, k = divmod(i, roller.shape[1])
    x = roller[half]
    bent = HornStress(float(stress[i, j]), float(x[k]), float(wall[0, j]), float(thick[j]))
    return bent, _Search(side, _around(x, k)[None], _around(u, j))


def _around(places: Array, i: int) -> Array:
    """Places between the neighbours of one of them."""
    return np.linspace(places[max(i - 1, 0)], places[min(i + 1, len(places) - 1)], FINER)


def _stress(
    mechanism: Mechanism,
    side: Side,
    width: float,
    x: Array,
    walls: tuple[Array, Array],
    thick: Array,
) -> Array:
    """The stress, a row for each place of the roller and a column for each section, MPa.

    ``walls`` are points and normals of the wall, where the roller is and at the sections.
    """
    loads = state(mechanism, side.engagement, x)
    bears = np.asarray(loads.torque_Nm) * side.end < 0.0
    force = np.where(bears, loads.pin_force_N, 0.0)[:, None]
    (contact, wall), (way, normal) = (np.split(of, [len(x)], axis=1) for of in walls)
    further = wall[0] > contact[0][:, None]
    with np.errstate(all="ignore"):
        # from the contact to the middle of the section, (2, places, sections)
        arm = (wall + 0.5 * thick * normal)[:, None, :] - contact[:, :, None]
        moment = abs(arm[0] * way[1][:, None] - arm[1] * way[0][:, None])
        push = way[1][:, None] * normal[0] - way[0][:, None] * normal[1]  # along the beam
        found = force / width * (6.0 * moment / thick**2 - push / thick)
    return np.where(further & np.isfinite(found), found, 0.0)
