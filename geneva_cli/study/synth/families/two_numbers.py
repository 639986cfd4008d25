"""Machines with two free numbers: a drive before the crank of a wheel on inclined shafts.

With a side-crank the result is gentler than with either alone. With elliptical gears the motion
depends only on its length, not on the shafts' angle, as the tangents of the quarters of both angles
have a constant ratio. They are tried only if more than times and peaks is required.

A place is the motion's length and the shafts' angle, each from 0 to 1 in its range; the drive's
parameter follows. All wheels are sampled as a batch: on a grid, then near the best places of each,
closer after every sampling without an improvement.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from geneva_cli.drives.elliptical_gears import EllipticalGears
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.errors import GenevaError
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.study.batches import columns
from geneva_cli.study.sweep.constraints import Objective
from geneva_cli.study.synth.families import closed
from geneva_cli.study.synth.families.family import (
    Family,
    allowed_motions,
    closed_span,
    machine,
    natural_deg,
    only,
)
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.quantity_names import is_motion

GRID = 10  # places of either number that are sampled first, in the middle of equal parts


class _InFront(NamedTuple):
    """A drive before the crank by its parameter, which follows from two motion angles."""

    make: Callable[[float], Drive]
    key: str
    parameter: Callable[[float, float], float]
    low: float
    high: float


def _side_crank() -> _InFront:
    most = closed.PARAMETER_MAX
    return _InFront(lambda A: SideCrank(A=A), "drive.A", closed.side_crank, -most, most)


def _gears(phase: str) -> _InFront:
    low, high = (0.0, closed.PARAMETER_MAX) if phase == "slow" else (-closed.PARAMETER_MAX, 0.0)
    make = lambda e: EllipticalGears(eccentricity=abs(e), phase=phase)  # noqa: E731
    return _InFront(make, "drive.eccentricity", closed.eccentricity, low, high)


def two_numbers(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    """For each wheel and drive the best machine of two numbers, if one keeps the bounds."""
    inclined = [wheel for wheel in wheels if "axes_deg" in wheel.as_dict()]
    if target.rollers not in (None, 1) or not inclined:
        return
    moved = all(map(is_motion, target.quantities))
    drives = [_side_crank()] if moved else [_side_crank(), _gears("slow"), _gears("quick")]
    for drive in drives:
        yield from map(only, _TwoNumberSearch(target, inclined, drive).machines())


class _TwoNumberSearch:
    """The best place of every wheel so far."""

    def __init__(self, target: Target, wheels: Sequence[Gearing], drive: _InFront) -> None:
        spans = [closed_span(allowed_motions(target, 1, natural_deg(wheel)), 1) for wheel in wheels]
        self.target, self.drive = target, drive
        self.wheels = [w for w, span in zip(wheels, spans, strict=True) if span]
        self.motions = [span for span in spans if span]
        self.bounds = target.known_bounds
        sort = target.known_sort
        self.nearest = target.any_motion and not sort
        self.sign, self.least = sort or Objective(1.0, target.peak)

    def machines(self) -> Iterator[Spec]:
        """The best machine of each wheel that has one."""
        if not self.wheels:
            return
        u, v, best = self._first()
        step = np.full(len(u), 1.0 / GRID)
        count = np.arange(16)  # places around the best, half of them at half the distance
        for number in range(28 if self.bounds else 14):  # along a bound the search takes longer
            turn = math.tau * (count + number * 0.382) / 16  # each sampling is rotated further
            off = step[:, None] * np.where(count % 2, 0.5, 1.0)
            us = np.clip(u[:, None] + off * np.cos(turn), 0.0, 1.0)
            vs = np.clip(v[:, None] + off * np.sin(turn), 0.0, 1.0)
            new, us, vs = self._least(us, vs)
            better = (new[0] < best[0]) | ((new[0] == best[0]) & (new[1] < best[1]))
            best = np.where(better, new, best)
            u, v = np.where(better, us, u), np.where(better, vs, v)
            step = step * np.where(better, 1.4, 0.7)
        order = np.lexsort((*best[::-1], self.of))
        rows = order[np.flatnonzero(np.diff(self.of[order], prepend=-1))]  # the first of each wheel
        for i in rows[best[0][rows] == 0.0]:
            motion, axes, x = self.place(int(self.of[i]), u[i], v[i])
            wheel = self.wheels[self.of[i]].with_key("axes_deg", axes)
            yield self.spec(wheel, x, motion)

    def _first(self) -> tuple[Array, Array, Array]:
        """The places of a grid that are better than their neighbours: u, v, and costs, (2, n)."""
        middles = (np.arange(GRID) + 0.5) / GRID
        lengths = np.array([1.0]) if all(m.exact for m in self.motions) else [0.0, *middles, 1.0]
        u, v = np.meshgrid(lengths, middles, indexing="ij")
        shape, wheels = u.shape, len(self.wheels)
        self.of = np.arange(wheels)
        costs = np.array(self.cost(*(np.tile(x.ravel(), (wheels, 1)) for x in (u, v))))
        # a bound, or another goal than the peak, may have several minima
        tracks = 3 if self.bounds or self.least != self.target.peak else 1
        starts = []
        for i in range(wheels):
            rank = np.empty(u.size, dtype=int)
            rank[np.lexsort(costs[::-1, i])] = np.arange(u.size)
            wide = np.pad(rank.reshape(shape), 1, constant_values=u.size)
            neighbours = sliding_window_view(wide, (3, 3)).min(axis=(2, 3)).ravel()
            tops = np.flatnonzero(rank == neighbours)
            starts += [(i, j) for j in tops[np.argsort(rank[tops])][:tracks]]
        self.of, at = np.array(starts).T
        return u.ravel()[at], v.ravel()[at], costs[:, self.of, at]

    def _least(self, u: Array, v: Array) -> tuple[Array, Array, Array]:
        """For places (n, k), the best cost of each row, (2, n), and its place."""
        broken, far = self.cost(u, v)
        rows, at = np.arange(len(u)), np.lexsort((far, broken), axis=1)[:, 0]
        return np.array([broken[rows, at], far[rows, at]]), u[rows, at], v[rows, at]

    def place(self, i: int, u: float, v: float) -> tuple[float, float, float]:
        """The motion angle, the shafts' angle and the drive's parameter of a wheel's place."""
        motions = self.motions[i]
        motion = motions.low + (motions.high - motions.low) * float(u)
        axes = closed.AXES.low + (closed.AXES.high - closed.AXES.low) * float(v)
        natural = closed.axes_motion(self.wheels[i].z, axes)
        return motion, axes, self.drive.parameter(natural, motion)

    def spec(self, wheel: Gearing, x: float, motion: float) -> Spec:
        """A machine of a wheel with the drive's parameter and a motion angle."""
        make = self.drive.make(x)
        return machine(self.target, wheel, lambda n: make.replace(n_rpm=n), 1, motion)

    def cost(self, u: Array, v: Array) -> tuple[Array, Array]:
        """Violations of the bounds, and costs, at places (w, k); infinite without a machine."""
        rows = np.repeat(self.of, u.shape[1])
        broken, far = np.full(u.size, math.inf), np.full(u.size, math.inf)
        at, (least, *values) = self._values(rows, u.ravel(), v.ravel())
        total = np.zeros(len(at))
        for bound, value in zip(self.bounds, values, strict=True):
            total += np.maximum(-bound.margin(value), 0.0)
        known = np.isfinite(total) & np.isfinite(least)
        off = self._far(rows[at], u.ravel()[at], v.ravel()[at], least)
        broken[at], far[at] = np.where(known, total, math.inf), np.where(known, off, math.inf)
        return broken.reshape(u.shape), far.reshape(u.shape)

    def _values(self, rows: Whole, u: Array, v: Array) -> tuple[Whole, list[Array]]:
        """The goal and the bounded quantities at places of the wheels ``rows``, all (n,).

        The first result holds the numbers of the places that have a machine.
        """
        drive, names = self.drive, [self.least, *(b.name for b in self.bounds)]
        none = np.zeros(0, dtype=int), [np.zeros(0) for _ in names]
        places = [self.place(*one) for one in zip(rows.tolist(), u, v, strict=True)]
        which = np.flatnonzero([drive.low <= x <= drive.high for _, _, x in places])
        if not len(which):
            return none
        motion, axes, x = np.array(places)[which].T
        varied = {
            "wheel.z": np.array([wheel.z for wheel in self.wheels])[rows[which]],
            "wheel.axes_deg": axes,
            drive.key: abs(x) if drive.low * drive.high == 0.0 else x,
            "drive.n_rpm": np.array([self.target.n_rpm(1, m) for m in motion.tolist()]),
        }
        middle = 0.5 * (drive.low + drive.high)
        try:
            batch = many(self.spec(self.wheels[0], middle, float(motion[0])), varied)
        except GenevaError:  # a frame that allows no such machine
            return none
        values = columns(batch.machine, names, len(batch.which)) if batch.machine else None
        return none if values is None else (which[batch.which], values)

    def _far(self, row: Whole, u: Array, v: Array, least: Array) -> Array:
        """The quantity to minimise, or the distance from the plain crank."""
        if not self.nearest:
            return self.sign * least
        natural = np.array([natural_deg(wheel) for wheel in self.wheels])
        low, wide = np.array([(m.low, m.high - m.low) for m in self.motions]).T
        distance: Array = np.hypot((low[row] + wide[row] * u - natural[row]) / 180.0, v - 0.5)
        return distance
