"""Where functions of a scan are zero between its samples."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from geneva_cli.numerics.angles import DEGREE
from geneva_cli.numerics.arrays import rows_of
from geneva_cli.numerics.jet import Jet
from geneva_cli.numerics.roots_many import Roots, roots_between
from geneva_cli.numerics.scan import Scan

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Mask, Whole
    from geneva_cli.numerics.jet import Array

STEP = 1e-9  # share of a bracket: after so short a Newton step, what is left is rounding


def inside(found: Scan) -> Mask:
    """Of each sample whether what is found after it is not the stretch's end itself.

    Samples crowd towards both ends: between the last two a zero or a top is the end's own.
    """
    same = found.joined
    inner: Mask = np.concatenate((same, [False]))
    inner[1:] &= same
    inner[:-2] &= same[1:]
    inner[0] = inner[-2] = False
    return inner


def zeros(
    of: Callable[[Array, Whole], tuple[Array, Array]],
    found: Scan,
    row: Whole,
    before: Whole,
    after: Whole,
) -> Array:
    """Where functions of a scan are zero between samples, to a last place of the bracket.

    ``row`` are their numbers in the scan. ``of`` gives value and slope; what is rounding beside a
    function's greatest value counts as zero.
    """
    bar = np.array([found.noise(number) for number in range(len(found.value))])[row]

    def line(way: Array, which: Whole) -> tuple[Array, Array]:
        value, slope = of(found.x[before[which]] + way, which)
        return np.where(abs(value) > bar[which], value, 0.0), slope

    ends = found.value[row, before], found.value[row, after]
    out: Array = found.x[before] + between_samples(line, found, before, after, *ends).x
    return out


def between_samples(
    of: Callable[[Array, Whole], tuple[Array, ...]],
    found: Scan,
    before: Whole,
    after: Whole,
    *ends: Array,
) -> Roots:
    """Roots between samples of functions known at both.

    Near 0 doubles are finer than angles, so ``of`` takes the way from the first sample on.
    """
    width = found.x[after] - found.x[before]
    first, last = ends
    return roots_between(of, 0.0 * width, width, (first, last), STEP)


def columns(jets: list[Jet], x: Array) -> tuple[Array, Array]:
    """Values and slopes by degrees, a row a jet."""
    value, slope = (rows_of([jet.c[k] for jet in jets], len(x)) for k in (0, 1))
    return value, slope * DEGREE
