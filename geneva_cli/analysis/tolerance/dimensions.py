"""The dimensions that deviate: by how much, how they are distributed, and a machine drawn of them.

Deviations are in millimetres and radians. They are jets, so that one formula gives a place for a
million machines at once (order 0) and its exact slope by one dimension (order 1).
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.machine.spec import Spec
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.arrays import all_true
from geneva_cli.numerics.jet import Jet, Number

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

SIGMAS = 3.0  # standard deviations in the plus or minus of a normal distribution
LEAST = 2.0**-53  # a share of 0 would be infinitely far out


class Deviations(NamedTuple):
    """One deviation each, of the keys of ``[tolerance]`` in their order."""

    center_distance_mm: Jet
    crank_radius_mm: Jet
    roller_diameter_mm: Jet
    slot_width_mm: Jet
    slot_angle_deg: Jet  # in radians here
    lock_radius_mm: Jet
    recess_radius_mm: Jet

    @property
    def slot_clearance(self) -> Jet:
        """What they add to the clearance between roller and slot, per side, mm."""
        return (self.slot_width_mm - self.roller_diameter_mm) * 0.5


def tolerances(spec: Spec) -> dict[str, float]:
    """The plus or minus of each dimension, in millimetres and radians."""
    given = spec.tolerance.as_dict()
    return {
        name: radians(given[name]) if name.endswith("_deg") else given[name]
        for name in Deviations._fields
    }


def without_effect(spec: Spec) -> dict[str, str]:
    """The dimensions whose deviations have no effect in a machine, and why."""
    why = {}
    if not spec.drive.ONE_ARM:
        why["crank_radius_mm"] = "no crank's arm carries the roller"
    if not spec.wheel.FLAT:
        why["center_distance_mm"] = "the shafts meet, whatever the sphere's radius"
    return why


def deviations(values: list[Number]) -> Deviations:
    """The deviations with these values; for places without slopes."""
    return Deviations(*[Jet((value,)) for value in values])


def slope_of(number: int) -> Deviations:
    """No deviation at all, and the slope by one of them."""
    return Deviations(*[Jet((0.0, float(i == number))) for i in range(len(Deviations._fields))])


def corners(sizes: list[float]) -> Deviations:
    """Every combination of the ends of the tolerances that are not 0: arrays of 2**n machines.

    Of m designs, whose tolerances may be (m, 1), the arrays may be (2**n, m, 1).
    """
    ends = [(0.0,) if all_true(size == 0.0) else (-size, size) for size in sizes]
    return deviations([np.array(column) for column in zip(*product(*ends), strict=True)])


class Draws(NamedTuple):
    """Machines drawn quasi-randomly: Sobol's sequence, shifted by a random vector of the seed."""

    sizes: tuple[float, ...]
    normal: bool
    seed: int

    def blocks(self, samples: int, size: int) -> Iterator[Deviations]:
        """So many machines, a block at a time."""
        from scipy.stats.qmc import Sobol

        deviate = [i for i, size in enumerate(self.sizes) if size]
        sequence = Sobol(len(deviate), scramble=False)
        shift = np.random.default_rng(self.seed).random(len(self.sizes))
        for start in range(0, samples, size):
            count = min(size, samples - start)
            # drawn in powers of two: of others the sequence warns that they are out of balance
            shares = sequence.random(1 << (count - 1).bit_length())[:count].T.copy()
            columns: list[Number] = [0.0] * len(self.sizes)
            for i, share in zip(deviate, shares, strict=True):
                share += shift[i]
                share[share >= 1.0] -= 1.0
                columns[i] = self._spread(share) * self.sizes[i]
            yield deviations(columns)

    def _spread(self, share: Array) -> Array:
        """Deviations over the tolerance for shares of the distribution."""
        if not self.normal:
            return 2.0 * share - 1.0
        from scipy.special import ndtri

        out: Array = ndtri(np.maximum(share, LEAST)) / SIGMAS
        return out
