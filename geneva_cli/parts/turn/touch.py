"""Contacts of a turning wheel, flat or on a sphere, and the first contact, which stops it."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from geneva_cli.numerics.arrays import Array, Mask, Whole
from geneva_cli.parts.turn.pairs import Stop

WAYS = np.array(((-1.0,), (1.0,)))  # back and on: factors for rows of angles


class Touch(NamedTuple):
    """Contacts: pose, angle by which the wheel turns, and cosine of the pressure angle.

    Rows 0 to n - 1 are the n poses with the wheel turning back, the next n with it turning on.
    """

    row: Whole
    lead: Array
    cosine: Array

    def at(self, which: Mask) -> Touch:
        """Return the contacts that a mask selects."""
        return Touch(self.row[which], self.lead[which], self.cosine[which])


def triangles(
    excess: Array, one: Array, other: Array, measure: Callable[[Array], Array]
) -> tuple[tuple[Whole, ...], Array, Array]:
    """Return which triangles exist, and sine and cosine of half the angle between two sides.

    ``one`` and ``other`` are these sides, and ``excess`` is the third side minus ``one``: where
    both are kilometres long, their difference has no digits left. ``measure(x)`` is x on a plane
    and sin x on a sphere.
    """
    twice = 2.0 * one + excess
    with np.errstate(divide="ignore", invalid="ignore"):
        size = measure(one) * measure(other)
        sine = measure(0.5 * (excess + other)) * measure(0.5 * (twice - other)) / size
        cosine = measure(0.5 * (twice + other)) * measure(0.5 * (other - excess)) / size
    exist = np.nonzero((sine >= 0.0) & (cosine >= 0.0))
    return exist, np.sqrt(sine[exist]), np.sqrt(cosine[exist])


def within(
    turn: Array, pitch: float, most: float, on_line: Mask | bool = True
) -> tuple[Whole, Whole, Array]:
    """Return contacts that the wheel reaches by turning less than ``most`` back or on.

    ``turn`` is the angle of each contact, (n,) or (2, n); the wheel repeats after one pitch.
    ``on_line`` masks the contacts that lie within the piece that is touched. Returns the row (0
    back, 1 on), the column, and the angle that the wheel turns.
    """
    lead = WAYS * turn % pitch
    # a contact that lies behind by less than 1e-13 radians counts as being here
    lead = np.where(lead > pitch - 1e-13, 0.0, lead)
    row, column = np.nonzero((lead < most) & on_line)
    return row, column, lead[row, column]


def first_stops(
    rolling: list[Touch], locking: list[Touch], count: int, most: float
) -> tuple[Stop, Stop]:
    """Return the first stop in each of ``count`` poses, with the wheel turning back and on.

    It is a contact with a roller or with the crank; where there is none, ``most`` is returned.
    """
    twice = 2 * count
    nothing = Touch(np.arange(twice), np.full(twice, most), np.zeros(twice))
    by_roller, cosine = _first([nothing, *rolling])
    by_crank, _ = _first([nothing, *locking])
    rolls = (by_roller < most) & (by_roller <= by_crank)
    pressure = np.where(rolls, np.arccos(np.minimum(cosine, 1.0)), 0.0)
    lead = np.minimum(by_roller, by_crank)
    return Stop(lead[:count], pressure[:count]), Stop(lead[count:], pressure[count:])


def _first(touches: list[Touch]) -> tuple[Array, Array]:
    """Return the angle and the cosine of the first contact in each pose."""
    row, lead, cosine = (np.concatenate(each) for each in zip(*touches, strict=True))
    order = np.lexsort((lead, row))
    first = order[np.flatnonzero(np.diff(row[order], prepend=-1))]
    return lead[first], cosine[first]
