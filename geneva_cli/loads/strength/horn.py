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

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.strength.horn_search import SlotEnd, slot_ends, squeezed
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pitch_curve import pitch
from geneva_cli.numerics.arrays import Number, parameter
from geneva_cli.numerics.jet import Array

STOUT = 0.5  # thickness at the mouth over the recess's radius, beyond which a horn is no beam
SHEAR = 1.2  # of a rectangular section: energy of its shear stress over that of the mean stress


class Horn(NamedTuple):
    """One horn of a slot, in the wheel's frame: the one that bears torque forwards, or backwards.

    Numbers are floats or (m, 1), positions and directions (2, m, 1).
    """

    at: SlotEnd
    L: float
    half_width: float
    recess_mm: float
    centre: Array  # position of the recess's centre
    inwards: Array  # direction along the slot at its mouth
    across: Array  # direction perpendicular to that, from the recess's centre to the slot
    outwards: Array  # direction out of the wheel at the recess's centre, between two horns
    tip_mm: Number = 0.0  # width of the flat to which a thinner tip is cut back

    def wall(self, input_deg: Number) -> tuple[Array, Array]:
        """Points of the slot's wall, and its normals towards the recess, in the horn's frame.

        At angles (m, k) both are (2, m, k). The origin is the recess's centre.
        """

        def turned(of: Array) -> Array:
            axes = product(of, self.inwards), product(of, self.across)
            return np.stack(np.broadcast_arrays(*axes))

        x, y = self.at.engagement.slot(squeezed(input_deg), 1)
        place = turned(self.L * vector(x.c[0], y.c[0]) - self.centre)
        normal = turned(vector(-np.asarray(y.c[1]), x.c[1]))
        normal *= np.where(normal[1] > 0.0, -1.0, 1.0) / np.hypot(*normal)
        return place + self.half_width * normal, normal

    def thickness(self, wall: Array, normal: Array) -> Array:
        """Thickness at points of the wall, mm; infinite where another horn begins."""
        thick, turned = self.feet(wall, normal)
        return np.where(turned < self.middle, thick, np.inf)

    def feet(self, wall: Array, normal: Array) -> tuple[Array, Array]:
        """Thickness at points of the wall up to the recess, and directions of the sections' feet.

        Directions are seen from the recess's centre: radians from the mouth's.
        """
        along = -product(wall, normal)
        with np.errstate(invalid="ignore"):
            thick = along - np.sqrt(along * along - product(wall, wall) + self.recess_mm**2)
            return thick, np.arctan2(*(wall + thick * normal))

    @property
    def middle(self) -> Array:
        """Half the angle between this horn's mouth and the next one's, at the recess's centre."""
        away, up = product(self.outwards, self.inwards), product(self.outwards, self.across)
        sense = np.where(away > 0.0, 1.0, -1.0)
        half: Array = np.arctan2(sense * away, sense * up)
        return half

    def unit_stress(
        self, roller: Array, rub: Array, sections: Array, width_mm: float
    ) -> tuple[Array, Array, Array]:
        """Bending and tension at sections under 1 N, as ``horn_search.HornSide`` describes."""
        places, normals = self.wall(np.hstack((roller, sections)))
        count = roller.shape[1]
        (contact, wall), (push, normal) = (
            np.split(of, [count], axis=2) for of in (places, normals)
        )
        thick = self.thickness(wall, normal)
        # places of the wall that a tip which is cut back has left
        depth = contact[1] - self.tip_mm
        inner = np.sqrt(np.maximum(np.square(self.recess_mm) - depth * depth, 0.0))
        left = (depth >= self.recess_mm) | (contact[0] >= inner) | np.equal(self.tip_mm, 0.0)
        contact, push = contact[..., None], push[..., None]
        # friction along the wall towards the mouth, where the first axis is negative
        push = push + rub[..., None] * np.stack((push[1], -push[0]))
        with np.errstate(all="ignore"):
            # from the contact to the middle of the section, (2, m, places, sections)
            arm = (wall + 0.5 * thick * normal)[:, :, None] - contact
            moment = arm[1] * push[0] - arm[0] * push[1]
            along, deep = normal[:, :, None], thick[:, None]
            pull = push[1] * along[0] - push[0] * along[1]  # along the beam
            bent = (moment * (6.0 / deep**2) - pull / deep) / np.asarray(width_mm)[..., None]
            further = (wall[0][:, None] > contact[0]) & left[:, :, None]
            stress = np.where(further & np.isfinite(bent), bent, 0.0)
        return stress, wall[0], thick

    @property
    def stoutness(self) -> Array:
        """Thickness at the mouth over the recess's radius, (m,)."""
        return np.ravel(self.thickness(*self.wall(self.at.mouth_deg)) / self.recess_mm)


def vector(x: Number, y: Number) -> Array:
    """Vectors of a batch: (2, m, k)."""
    return np.stack(np.broadcast_arrays(np.atleast_2d(x), np.atleast_2d(y)))


def product(a: Array, b: Array) -> Array:
    """Scalar products of vectors."""
    products: Array = a[0] * b[0] + a[1] * b[1]
    return products


def horns(mechanism: Mechanism, half_width_mm: float, recess_mm: float) -> list[Horn]:
    """Both horns of each kind of slot."""
    L, sides = mechanism.center_distance_mm, []
    moving = mechanism.spec.wheel.plane_motion(parameter(np.ravel(L)))
    for at in slot_ends(mechanism):
        turn = np.ravel(at.end * at.engagement.half_step)  # of the wheel at rest
        axes = np.column_stack(np.broadcast_arrays(np.ravel(L), 0.0, turn))
        centre = moving.into(axes[:, :2], axes[:, 2])
        outwards = moving.outwards(centre).T[:, :, None]
        centre = centre.T[:, :, None]
        mouth = pitch(at.engagement, at.mouth_deg)
        inwards = -at.end * vector(mouth.tangent_x, mouth.tangent_y)
        across = vector(-inwards[1], inwards[0])
        towards = L * vector(mouth.x, mouth.y) - centre
        across = across * np.copysign(1.0, product(across, towards))
        tip = mechanism.spec.size.horn_tip_mm
        sides.append(Horn(at, L, half_width_mm, recess_mm, centre, inwards, across, outwards, tip))
    return sides
