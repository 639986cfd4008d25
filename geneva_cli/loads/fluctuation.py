"""Fluctuation of the input's work about its mean, which a flywheel has to store and return.

The work has its extremes where the torque equals its mean. Motions are divided there too, and
integrated between to the last digits.

    >>> import numpy as np
    >>> from geneva_cli import External, Load
    >>> from geneva_cli.motion.many import many
    >>> from geneva_cli.motion.machine_spec import Spec
    >>> spec = Spec(External(4), load=Load(inertia_kgm2=2.0))
    >>> batch = many(spec, {"wheel.z": np.array([4, 6])}).machine
    >>> fluctuations(batch, np.zeros(2)).energy_J.round(6)  # I (w psi1max)²/2
    array([230.09708 ,  39.478418])
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from geneva_cli.loads.forces import QuantityValue
from geneva_cli.loads.instant import Instant
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import LoadFunctions, LoadQuantity
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import Mask, Whole
from geneva_cli.numerics.jet import Array, Jet
from geneva_cli.numerics.quadrature import Integrands, span_integrals


class Unevenness(NamedTuple):
    """The input's torque less its mean, which is (m, 1)."""

    mean: Array

    def __call__(self, i: Instant[Jet]) -> QuantityValue[Jet]:
        """The quantity, and the margin that bounds it."""
        return QuantityValue(i.input_torque_Nm - self.mean, i.friction_margin)


class Swings(NamedTuple):
    """Fluctuation of m designs, (m,) each."""

    energy_J: Array  # greatest minus least of the cumulated work less its mean line
    returned: Array  # integral over the period of the torque's square where the wheel drives


def fluctuations(mechanism: Mechanism, mean: Array) -> Swings:
    """The fluctuation of designs, from the means (m,) of their input torque.

    The mean of an unbounded torque must be infinite.
    """
    bounded = np.isfinite(mean)
    mean = np.where(bounded, mean, 0.0)[:, None]
    case, end = load_case(mechanism), None
    each, returned = [0.0 * mean], np.zeros(len(mean))
    for engagement in mechanism.engagements:
        if end is not None:
            each.append(-mean * (engagement.mid_deg + engagement.entry_deg - end) * DEGREE)
        own: dict[str, LoadQuantity] = {"unevenness_Nm": Unevenness(mean)}
        load = LoadFunctions(engagement, case, tuple(own), own, ("feeds", "wanted"))
        works, back = _works(load, bounded)
        each.append(works)
        returned += back
        end = engagement.mid_deg + engagement.exit_deg
    sums = np.cumsum(np.hstack(each), axis=1)
    energy = sums.max(axis=1) - sums.min(axis=1)
    return Swings(np.where(bounded, energy, np.inf), np.where(bounded, returned, np.inf))


def _works(load: LoadFunctions, bounded: Mask) -> tuple[Array, Array]:
    """Works less the mean's, J, a row for each design padded with zeros, and returned squares."""
    design, _, (a, b), positive = load.stretches()
    signs, n = np.where(positive, 1.0, -1.0), len(bounded)

    def rows(x: Array, which: Whole) -> Array:
        (here, *_), (uneven,) = load.at(x, design[which], 0, signs[:, which, None])
        back = 0.5 * (1.0 - here.feeds) * here.input_torque_Nm.c[0]
        return np.stack(np.broadcast_arrays(uneven(here).value.c[0], back * back))

    needed = np.stack((bounded, bounded))
    with np.errstate(all="ignore"):
        each = span_integrals(Integrands(rows, a, b, True), design, needed, apart=True) * DEGREE
    number = np.arange(len(design)) - np.searchsorted(design, design)
    works = np.zeros((n, int(number.max()) + 1))
    works[design, number] = each[0]
    returned = np.zeros(n)
    np.add.at(returned, design, each[1])
    return works, returned
