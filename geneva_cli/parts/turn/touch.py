"""Contacts of a turning wheel, flat or on a sphere, and the first of them, which stops it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.parts.turn.turned import Stopped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from geneva_cli.numerics.jet import Array

ZERO = 1e-13  # radians: a stop that lies behind by less is here
WAYS = np.array(((-1.0,), (1.0,)))  # back and on, for rows of angles
SLACK = 1e-9  # radians, and of a length: pieces that meet smoothly leave nothing between them


class Touch(NamedTuple):
    """Contacts: of which pose, at which turn of the wheel, and the pressure angle's cosine.

    n poses are counted twice: the wheel turns back from the first n, and on from the others.
    """

    row: NDArray[np.intp]
    lead: Array
    cosine: Array

    def at(self, which: NDArray[np.bool_]) -> Touch:
        """Some of them."""
        return Touch(self.row[which], self.lead[which], self.cosine[which])


def ahead_by(lead: Array, pitch: float) -> Array:
    """Angles from 0 up to the pitch, after which a wheel is as before."""
    found = lead % pitch
    return np.where(found > pitch - ZERO, 0.0, found)


def stopped(
    rolling: list[Touch], locking: list[Touch], count: int, most: float
) -> tuple[Stopped, Stopped]:
    """What stops the wheel first on its way back from ``count`` poses, and on: rollers, what locks,
    or nothing up to most.
    """
    twice = 2 * count
    nothing = Touch(np.arange(twice), np.full(twice, most), np.zeros(twice))
    by_roller, cosine = _first([nothing, *rolling])
    by_crank, _ = _first([nothing, *locking])
    rolls = (by_roller < most) & (by_roller <= by_crank)
    pressure = np.where(rolls, np.arccos(np.minimum(cosine, 1.0)), 0.0)
    lead = np.minimum(by_roller, by_crank)
    return Stopped(lead[:count], pressure[:count]), Stopped(lead[count:], pressure[count:])


def _first(touches: list[Touch]) -> tuple[Array, Array]:
    """The first contact of each pose: its turn, and its cosine."""
    row, lead, cosine = (np.concatenate(each) for each in zip(*touches, strict=True))
    order = np.lexsort((lead, row))
    first = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
    return lead[first], cosine[first]
