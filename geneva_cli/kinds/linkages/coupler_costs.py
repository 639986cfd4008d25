"""Quantities of four-bars in a search, from samples of their motions."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geneva_cli.motion.peak_search import ORDERS
from geneva_cli.motion.timing import Timing, timing
from geneva_cli.numerics.arrays import Array
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.groups import RATES

# by a quantity in the unit of a time, the power of the speed that it has
SPEED_POWERS = {f"{at}_rad{end}": n for n, _, end in RATES.values() for at in ("max", "entry")}


class Costs(NamedTuple):
    """Samples of n motions: derivatives (n, places), steps and motion angles, degrees, (n,)."""

    target: Target
    index_deg: Array
    derivatives: list[Array]
    motion_deg: Array

    def of(self, name: str) -> Array:
        """A quantity for which ``is_known`` is true, (n,)."""
        group, _, quantity = name.partition(".")
        if group == "timing":
            dwell = 360.0 - self.motion_deg
            times = timing(self.motion_deg, dwell, self.index_deg, self._n_rpm())  # type: ignore[arg-type]
            return np.broadcast_to(times._asdict()[quantity], self.motion_deg.shape)
        value = self.derivatives[ORDERS[group]]
        if group == "power":
            value = value * self.derivatives[1]
        end = _end(quantity)
        size = top(np.abs(value)) if end is None else np.abs(value[:, end])
        if quantity in SPEED_POWERS:
            size = size * (self._n_rpm() * (math.pi / 30.0)) ** SPEED_POWERS[quantity]
        return size

    def broken(self, bounds: tuple[Constraint, ...]) -> Array:
        """The sum of the relative violations of the bounds, (n,)."""
        total = np.zeros(len(self.motion_deg))
        for b in bounds:
            # a peak between samples may be 1e-4 higher; times follow from the motion angle
            needed = -1e-9 if b.name.startswith("timing.") else 1e-4
            total = total + np.maximum(needed - b.margin(self.of(b.name)), 0.0)
        return total

    def _n_rpm(self) -> Array:
        return np.array([self.target.n_rpm(1, float(x)) for x in self.motion_deg])


def is_known(name: str) -> bool:
    """Return True if the search can compute a quantity."""
    group, _, quantity = name.partition(".")
    if group == "timing":
        return quantity in Timing._fields[:-1]  # the last is a rack's step
    whole = quantity in ("max", "entry", "exit") or quantity in SPEED_POWERS
    at_rest = _end(quantity) is not None and group in ("velocity", "power")
    return group in ORDERS and whole and not at_rest


def _end(quantity: str) -> int | None:
    """The sample at which a quantity is taken; None for its greatest value."""
    return {"entry": 0, "exit": -1}.get(quantity.partition("_")[0])


def order(names: tuple[str, ...]) -> int:
    """The order of derivatives that these quantities need, at least that of the acceleration."""
    return max([2, *(ORDERS.get(name.partition(".")[0], 0) for name in names)])


def top(values: Array) -> Array:
    """The greatest of each row, from the parabola through it and its neighbours."""
    rows = np.arange(len(values))
    at = np.clip(values.argmax(axis=1), 1, values.shape[1] - 2)
    low, middle, high = (values[rows, at + i] for i in (-1, 0, 1))
    bend, slope = low - 2.0 * middle + high, 0.5 * (high - low)
    inside = (bend < 0.0) & (middle >= low) & (middle >= high)
    vertex = middle - slope * slope / np.where(inside, 2.0 * bend, 1.0)
    peaks: Array = np.where(inside, vertex, values.max(axis=1))
    return peaks
