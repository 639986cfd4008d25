"""Worst case, root sum of squares and Monte Carlo of one angle of the wheel."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.analysis.tolerance.dimensions import Deviations, deviations, slope_of
from geneva_cli.numerics.jet import Jet, Number

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array


class Spread(NamedTuple):
    """Error of the wheel's angle towards one side, degrees.

    ``mean`` and ``std`` are of that angle with its sign. ``p997`` is the size that 99.7 % of the
    machines keep. ``parts`` has the contribution of each dimension's plus or minus. ``shape`` is
    the histogram of the random machines: the middles of its bins, and the fraction of the machines
    in each.
    """

    worst: float
    rss: float
    mean: float
    std: float
    p997: float
    parts: tuple[float, ...]
    shape: tuple[tuple[float, float], ...] = ()

    @property
    def fractions(self) -> tuple[float, ...]:
        """Each dimension's fraction of the squares; 0 if nothing deviates."""
        total = math.fsum(part * part for part in self.parts)
        return tuple(part * part / total if total else 0.0 for part in self.parts)


def spread(
    angle: Callable[[Deviations], Jet], sizes: list[float], worst: float, drawn: Array
) -> Spread:
    """Spread of an angle in radians; ``drawn`` has it for random machines."""
    at_rest = _one(angle(deviations([0.0] * len(sizes))).c[0])
    parts = [_one(angle(slope_of(i)).c[1]) * size if size else 0.0 for i, size in enumerate(sizes)]
    rss = abs(at_rest) + math.sqrt(math.fsum(part * part for part in parts))
    # the place of p997 among the sizes in order
    k = min(math.ceil(0.997 * len(drawn)), len(drawn)) - 1
    return Spread(
        math.degrees(worst),
        math.degrees(rss),
        math.degrees(drawn.mean()),
        math.degrees(drawn.std()),
        math.degrees(np.partition(abs(drawn), k)[k]),
        tuple(math.degrees(abs(part)) for part in parts),
        _shape(drawn),
    )


def _shape(drawn: Array) -> tuple[tuple[float, float], ...]:
    counts, edges = np.histogram(np.degrees(drawn), bins=60)
    middles = 0.5 * (edges[:-1] + edges[1:])
    return tuple(zip(middles.tolist(), (counts / len(drawn)).tolist(), strict=True))


def _one(value: Number) -> float:
    return float(np.asarray(value).reshape(-1)[0])
