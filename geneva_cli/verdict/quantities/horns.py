"""The horns of designs, between slot and recess: their stress, and how thick they are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.loads.strength import horn

if TYPE_CHECKING:
    from geneva_cli.loads.strength.horn_search import HornStress
    from geneva_cli.verdict.quantities.batch_designs import Designs


class Horns:
    """The horns of flat designs.

    ``sizes`` are half the slot's width and the recess's radius, mm, (m, 1); None without a recess.
    """

    def __init__(self, of: Designs, sizes: tuple[float, float] | None) -> None:
        self.of, self.sizes = of, sizes

    @property
    def exist(self) -> bool:
        """True if a design has horns: a locking disc and its recesses."""
        return self.sizes is not None

    def stress(self, width: float) -> HornStress:
        """The greatest stress under the roller, for a width of its contact."""
        assert self.sizes
        if self.of.single:
            return horn.single_horn_stresses(self.of.machine, *self.sizes).over(width)
        return horn.horn_stresses(self.of.machine, *self.sizes, width)

    def stoutness(self) -> tuple[float, float]:
        """A single design's greatest thickness at the mouth over the recess's radius, and that."""
        assert self.sizes
        return float(horn.stoutness(self.of.machine, *self.sizes)[0]), self.sizes[1]
