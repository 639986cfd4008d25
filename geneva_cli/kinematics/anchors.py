"""The anchors of a pin's path, each of which serves the input angles nearest to it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property, partial
from itertools import pairwise
from typing import TypeAlias

from geneva_cli.kinematics.engagement import Anchor
from geneva_cli.numerics.arrays import (
    SINGLE,
    Batchable,
    Whole,
    are_alike,
    are_designs,
    array,
    picked,
)
from geneva_cli.numerics.jet import Jet, Number, piecewise

Solve: TypeAlias = "Callable[[Anchor, Number], Jet]"


class Anchors(Batchable):
    """Anchors from entry to exit, with mid-motion in the middle; of one design or of a batch.

    The anchors of both ends serve only near the ends, where the motion vanishes. ``cuts`` are the
    input angles at which one anchor hands over to the next.
    """

    def __init__(self, each: tuple[Anchor, ...]) -> None:
        self.each = each
        self.cuts = cuts([anchor.input_deg for anchor in each])

    def __len__(self) -> int:
        return len(self.each)

    def __getitem__(self, i: int) -> Anchor:
        return self.each[i]

    def __iter__(self) -> Iterator[Anchor]:
        return iter(self.each)

    @cached_property
    def alike(self) -> bool:
        """True if the anchors differ in numbers only, so that one call can serve them all.

        Those of a batch do. A single design's may differ in more, as with a ratio file of gears.
        """
        one = isinstance(self.cuts[0], float) and isinstance(self.cuts[-1], float)
        return not one or are_alike(self.each)

    def solved(self, input_deg: Number, solve: Solve) -> Jet:
        """Jet of ``solve(anchor, angles)``, with the anchor that serves each angle in degrees."""
        of_batch = are_designs(input_deg, self.cuts[0], self.cuts[-1])
        if (of_batch or not isinstance(input_deg, SINGLE)) and self.alike:
            x = array(input_deg)
            first, *others = [x > cut for cut in self.cuts]
            index: Whole = first.astype(int)  # laid out as the angles
            for past in others:
                index = index + past
            low, high = int(index.min(initial=len(self) - 1)), int(index.max(initial=0))
            if low >= high:  # any anchor will do for no angles
                return solve(self.each[high], input_deg)
            designs = len(index) if index.ndim > 1 else 1
            return solve(picked(index - low, self.each[low : high + 1], designs), input_deg)
        return piecewise(input_deg, self.cuts, [partial(solve, one) for one in self.each])


def cuts(degrees: Sequence[float]) -> list[float]:
    """Input angles at which one anchor hands over to the next: half-way, nearer to both ends."""
    first, *inner, last = degrees
    near_end = 0.75  # fraction of the span from the last inner anchor to an end
    return [
        inner[0] + near_end * (first - inner[0]),
        *[0.5 * (a + b) for a, b in pairwise(inner)],
        inner[-1] + near_end * (last - inner[-1]),
    ]
