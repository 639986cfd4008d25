"""The horn of a spherical wheel: the wall between a slot and a recess, as a tapered cantilever.

A point at the angle t from the wheel's axis along the slot, and x across it from its middle, is

    p = (cos x sin t, sin x, cos x cos t)

The slot's wall is at x = w. Sections are square to it, along x. The recess is the circle at the
angle k from the crank's axis c, so that a section ends at

    x_k = d - acos(cos k / K),    K (cos d, sin d) = (p_0 . c, c_y),  p_0 = (sin t, 0, cos t)

and is L (x_k - w) thick. The roller presses at t0 along x, with friction along the wall, and bends,
twists and pulls a section farther inwards by L (p(t0, w) - q) x F, q being its middle. Von Mises of
corners and sides together is an upper bound. The body is rigid, and notches are neglected.
"""

from __future__ import annotations

from itertools import chain
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.strength.horn import Points, SlotEnd, slot_ends
from geneva_cli.loads.strength.pin_arm_key import torsion_MPa
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.arrays import Number, parameter
from geneva_cli.numerics.jet import Array


class SphereHorn(NamedTuple):
    """One horn of a slot; angles in radians. Numbers are floats or (m, 1)."""

    at: SlotEnd
    radius_mm: float  # L, of the sphere
    crank_axis: tuple[float, float, float]  # c: y towards this horn, z along the wheel's axis
    half_width: float  # w
    recess: float  # k
    half_step: float  # from the slot's middle to the next horn, about the wheel's axis
    width_mm: float  # of the contact

    @property
    def recess_mm(self) -> Number:
        """The recess's radius."""
        return self.radius_mm * np.sin(self.recess)

    def points(self, input_deg: Number) -> Points:
        """Places of the roller, or sections, at input angles (m, k); infinitely thick elsewhere."""
        slot, L, w = self.at.engagement.slot, self.radius_mm, self.half_width
        ends = np.atleast_2d(input_deg), self.at.mouth_deg
        t, mouth = (np.atleast_2d(slot(at, 0)[0].c[0]) for at in ends)  # polar angles
        t, thick = np.broadcast_arrays(t, self.thickness(t))  # designs may share their angles
        inwards = L * np.cos(w) * (mouth - t)
        with np.errstate(invalid="ignore"):
            axes = *_axes(t, w), *_axes(t, w + 0.5 * thick / L)  # of the wall, and of the middle
        return np.stack(np.broadcast_arrays(inwards, thick, L, self.width_mm, *chain(*axes)))

    @staticmethod
    def unit_stress(roller: Points, sections: Points) -> Array:
        """Von Mises stress of sections under 1 N, as ``horn.Horn`` describes."""
        at, push, towards = np.split(roller[4:13, ..., None], 3)
        h, L, b = sections[1:4, :, None]
        q, across, along = np.split(sections[13:, :, None], 3)
        with np.errstate(all="ignore"):
            force = push + roller[-1, ..., None] * towards
            arm = L * (at - q)
            both = (np.broadcast_to(of, arm.shape) for of in (push, force))
            bent, moment = (np.cross(arm, of, axis=0) for of in both)
            in_shell = (moment * q).sum(axis=0) * np.sign((bent * q).sum(axis=0))
            off_shell, twist = (abs((moment * axis).sum(axis=0)) for axis in (across, along))
            pull = (force * along).sum(axis=0)
            normal = 6.0 * in_shell / (b * h * h) + 6.0 * off_shell / (h * b * b) + pull / (b * h)
            shear = torsion_MPa(twist, b + 0.0 * h, h)
            stress = np.sqrt(np.maximum(normal, 0.0) ** 2 + 3.0 * shear**2)
            inner = sections[0][:, None] > roller[0][..., None]
            return np.where(inner & np.isfinite(stress), stress, 0.0)

    def thickness(self, t: Array) -> Array:
        """Thickness of the sections at polar angles, mm; infinite where another horn begins."""
        x, y, z = self.crank_axis
        along = x * np.sin(t) + z * np.cos(t)
        with np.errstate(invalid="ignore"):
            foot = np.arctan2(y, along) - np.arccos(np.cos(self.recess) / np.hypot(along, y))
        azimuth = np.arctan2(np.sin(foot), np.cos(foot) * np.sin(t))
        own = azimuth < self.half_step  # False without a foot, too
        return np.where(own, self.radius_mm * (foot - self.half_width), np.inf)


def _axes(t: Array, x: Array | float) -> tuple[Array, Array, Array]:
    """Points of the unit sphere, (3, ...); directions away from the slot, and to the mouth."""
    c, s, up, flat = np.cos(x), np.sin(x), np.cos(t), np.sin(t)
    rows = (c * flat, s, c * up), (-s * flat, c, -s * up), (up, 0.0 * t, -flat)
    at, across, along = (np.stack(np.broadcast_arrays(*row)) for row in rows)
    return at, across, along


def sphere_horns(
    mechanism: Mechanism, half_width: float, recess: float, axes: float, width_mm: float = 1.0
) -> list[SphereHorn]:
    """Both horns of each kind of slot; slot, recess and the angle of the shafts in radians.

    ``width_mm`` is that of the contact, which their stress depends on.
    """
    L, sides = mechanism.center_distance_mm, []
    for at in slot_ends(mechanism):
        half, out = at.engagement.half_step, np.sin(axes)
        axis = parameter(out * np.cos(half)), parameter(out * np.sin(half)), np.cos(axes)
        sides.append(SphereHorn(at, L, axis, half_width, recess, half, width_mm))
    return sides
