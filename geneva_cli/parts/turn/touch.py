"""Contacts of a turning wheel, flat or on a sphere, and the first of them, which stops it."""

from __future__ import annotations

from collections.abc import Callable
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


def triangles(
    apart: Array, one: Array, other: Array, measure: Callable[[Array], Array]
) -> tuple[tuple[NDArray[np.intp], ...], Array, Array]:
    """Sine and cosine of half the angle between two sides, of those triangles that exist.

    ``apart`` is the third side, ``measure(x)`` is x on a plane and sin x on a sphere. The indices
    of the triangles come first.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        size = measure(one) * measure(other)
        sine = measure(0.5 * (apart - one + other)) * measure(0.5 * (apart + one - other)) / size
        cosine = measure(0.5 * (one + other + apart)) * measure(0.5 * (one + other - apart)) / size
    exist = np.nonzero((sine >= 0.0) & (cosine >= 0.0))
    return exist, np.sqrt(sine[exist]), np.sqrt(cosine[exist])


def within(
    turn: Array, pitch: float, most: float, on_line: NDArray[np.bool_] | bool = True
) -> tuple[NDArray[np.intp], NDArray[np.intp], Array]:
    """Contacts that the wheel reaches, turning by less than ``most`` back (row 0) or on (row 1).

    ``turn`` is where they are, (n,) or (2, n); after a pitch the wheel is as before. ``on_line`` is
    where they are on what they touch. Returns their rows, columns and how far the wheel turns.
    """
    lead = WAYS * turn % pitch
    lead = np.where(lead > pitch - ZERO, 0.0, lead)
    row, column = np.nonzero((lead < most) & on_line)
    return row, column, lead[row, column]


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
