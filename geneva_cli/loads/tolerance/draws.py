"""Random machines: deviations of their dimensions, drawn from Sobol's sequence."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.loads.tolerance.dimensions import Deviations, deviations
from geneva_cli.numerics.jet import Array, Number
from geneva_cli.numerics.sobol import Sobol


class Draws(NamedTuple):
    """Quasi-random machines: Sobol's sequence, scrambled by the seed."""

    sizes: tuple[float, ...]
    normal: bool
    seed: int

    def blocks(self, samples: int, size: int) -> Iterator[Deviations]:
        """Deviations of ``samples`` machines, in blocks of ``size``, a power of two."""
        deviate = [i for i, size in enumerate(self.sizes) if size]
        sequence = Sobol.scrambled(len(deviate), self.seed)
        for start in range(0, samples, size):
            count = min(size, samples - start)
            quantiles = sequence.points(start, 1 << (count - 1).bit_length())[:, :count]
            columns: list[Number] = [0.0] * len(self.sizes)
            for i, quantile in zip(deviate, quantiles, strict=True):
                columns[i] = self._spread(quantile) * self.sizes[i]
            yield deviations(columns)

    def _spread(self, quantile: Array) -> Array:
        """Deviations over the tolerance for quantiles of the distribution."""
        if not self.normal:
            return 2.0 * quantile - 1.0
        from scipy.special import ndtri

        # The plus or minus is three standard deviations; a quantile of 0 would be infinite.
        out: Array = ndtri(np.maximum(quantile, 2.0**-53)) / 3.0
        return out
