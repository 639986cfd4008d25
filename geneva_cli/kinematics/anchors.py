"""The anchors of a pin's path, each of which serves the input angles nearest to it."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
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
    chosen,
    picked,
)
from geneva_cli.numerics.jet import Jet, Number, piecewise
from geneva_cli.numerics.stacks import Stack, can_stack

Solve: TypeAlias = "Callable[[Anchor, Number], Jet]"


class Anchors(Batchable, ABC):
    """Anchors from entry to exit, with mid-motion in the middle.

    The anchors of both ends serve only near the ends, where the motion vanishes. ``cuts`` are the
    input angles at which one anchor hands over to the next.
    """

    cuts: Sequence[float]

    @property
    @abstractmethod
    def alike(self) -> bool:
        """True if the anchors differ in numbers only, so that one call can serve them all.

        The anchors of a single design may differ in more, such as those of gears with a ratio file.
        """

    @abstractmethod
    def __len__(self) -> int:
        """Number of anchors."""

    @abstractmethod
    def __getitem__(self, i: int) -> Anchor:
        """Anchor number i."""

    @abstractmethod
    def solved(self, input_deg: Number, solve: Solve) -> Jet:
        """Jet of ``solve(anchor, angles)``, with the anchor that serves each angle in degrees."""

    def __iter__(self) -> Iterator[Anchor]:
        return (self[i] for i in range(len(self)))


class EachAnchor(Anchors):
    """Anchors held one by one."""

    def __init__(self, each: tuple[Anchor, ...]) -> None:
        self.each = each
        self.cuts = cuts([a.input_deg for a in each])

    def __len__(self) -> int:
        return len(self.each)

    def __getitem__(self, i: int) -> Anchor:
        return self.each[i]

    @cached_property
    def alike(self) -> bool:
        """True for a batch, and for anchors that differ in numbers only."""
        one = isinstance(self.cuts[0], float) and isinstance(self.cuts[-1], float)
        return not one or are_alike(self.each)

    def solved(self, input_deg: Number, solve: Solve) -> Jet:
        """Jet of ``solve(anchor, angles)``, with the anchor that serves each angle in degrees."""
        if are_designs(input_deg, self.cuts[0], self.cuts[-1]) and self.alike:
            return solve(chosen(input_deg, self.cuts, self.each), input_deg)
        if not isinstance(input_deg, SINGLE) and input_deg.size and self.alike:
            import numpy as np

            # one call for the anchors that serve an angle
            low, high = np.searchsorted(self.cuts, (input_deg.min(), input_deg.max())).tolist()
            if low == high:
                return solve(self.each[low], input_deg)
            index = np.searchsorted(self.cuts, input_deg) - low
            return solve(picked(index, self.each[low : high + 1]), input_deg)

        def by(anchor: Anchor) -> Callable[[Number], Jet]:
            return lambda x: solve(anchor, x)

        return piecewise(input_deg, self.cuts, [by(a) for a in self.each])


class StackedAnchors(Anchors):
    """Anchors that differ in numbers only; ``rows`` are the numbers of the designs, (n, 1).

    A selection of designs selects rows and shares the stack.
    """

    def __init__(self, each: tuple[Anchor, ...]) -> None:
        self.stack: Stack[Anchor] = Stack(each)
        self.rows = self.stack.rows
        self.cuts = cuts([anchor.input_deg for anchor in each])

    @property
    def alike(self) -> bool:
        """Always True."""
        return True

    def __len__(self) -> int:
        return len(self.stack)

    def __getitem__(self, i: int) -> Anchor:
        return self.stack.one(i, self.rows)

    def solved(self, input_deg: Number, solve: Solve) -> Jet:
        """Jet of ``solve(anchor, angles)``, with the anchor that serves each angle in degrees."""
        x = array(input_deg)
        first, *others = [x > cut for cut in self.cuts]
        index: Whole = first.astype(int)  # laid out as the angles
        for past in others:
            index = index + past
        low, high = int(index.min(initial=len(self) - 1)), int(index.max(initial=0))
        # any anchor will do for no angles
        anchor = self[high] if low >= high else self.stack.picked(index, self.rows)
        return solve(anchor, x)


def anchors_of(each: tuple[Anchor, ...]) -> Anchors:
    """Anchors of one design, or of a batch."""
    one = all(isinstance(anchor.input_deg, float) for anchor in each)
    return EachAnchor(each) if one or not can_stack(each) else StackedAnchors(each)


def cuts(degrees: Sequence[float]) -> list[float]:
    """Input angles at which one anchor hands over to the next: half-way, nearer to both ends."""
    first, *inner, last = degrees
    near_end = 0.75  # fraction of the span from the last inner anchor to an end
    return [
        inner[0] + near_end * (first - inner[0]),
        *[0.5 * (a + b) for a, b in pairwise(inner)],
        inner[-1] + near_end * (last - inner[-1]),
    ]
