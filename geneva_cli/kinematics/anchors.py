"""The anchors of a pin's path, each of which serves the input angles nearest to it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import pairwise
from typing import TypeAlias

from geneva_cli.kinematics.engagement import Anchor
from geneva_cli.numerics.arrays import Batchable, Whole, are_designs, array, picked
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

    def solved(self, input_deg: Number, solve: Solve) -> Jet:
        """Jet of ``solve(anchor, angles)``, with the anchor that serves each angle in degrees."""
        if not are_designs(input_deg, self.cuts[0], self.cuts[-1]):
            return piecewise(input_deg, self.cuts, [partial(solve, one) for one in self.each])
        # the anchors of a batch differ in numbers only, so that one call serves them all
        x = array(input_deg)
        first, *others = [x > cut for cut in self.cuts]
        index: Whole = first.astype(int)  # laid out as the angles
        for past in others:
            index = index + past
        low, high = int(index.min(initial=len(self) - 1)), int(index.max(initial=0))
        if low >= high:  # any anchor will do for no angles
            return solve(self.each[high], input_deg)
        return solve(picked(index - low, self.each[low : high + 1]), input_deg)


def cuts(degrees: Sequence[float]) -> list[float]:
    """Input angles at which one anchor hands over to the next: half-way, nearer to both ends."""
    first, *inner, last = degrees
    near_end = 0.75  # fraction of the span from the last inner anchor to an end
    return [
        inner[0] + near_end * (first - inner[0]),
        *[0.5 * (a + b) for a, b in pairwise(inner)],
        inner[-1] + near_end * (last - inner[-1]),
    ]
