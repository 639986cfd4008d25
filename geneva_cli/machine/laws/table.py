"""The law ``table``: a motion law that a user gives as points u,s.

A quintic spline through every point, four times continuously differentiable; its four free
conditions put velocity and acceleration to zero at both ends.
"""

from __future__ import annotations

from decimal import Decimal, localcontext
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Annotated, ClassVar

from geneva_cli.errors import GenevaError
from geneva_cli.machine.laws.law import Law
from geneva_cli.numerics.digits import FIFTY
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.spline import Doubt, Exact, Pieces, at_rest, doubt, shifted
from geneva_cli.spec.rules import Csv
from geneva_cli.spec.schema import Points


class TableLaw(Law):
    """A spline through the points of a CSV file.

    ``file`` are pairs u,s from 0,0 to 1,1 in ascending order, or a CSV file's. Raises GenevaError
    for pairs that are not.

    >>> law = TableLaw([(u / 10, (u / 10) ** 2 * (3 - u / 5)) for u in range(11)])
    >>> round(law(0.5).c[0], 12)
    0.5
    """

    NAME: ClassVar[str] = "table"
    ABOUT: ClassVar[str] = "your own: a CSV of u,s points, file = ..."
    ANALYTIC: ClassVar[bool] = False
    # The points of s are rounded by 1e-16, which moves a third derivative by some 1e-16 / step³: at
    # this step, 10,001 points in all, by 1e-4 of a usual law's; ten times closer the jerk is
    # nothing else, with a peak at every point. Past ten times its rise a law is a mistake.
    points: Annotated[Points, Csv("file", "u", "s", 0.9e-4, 10.0, 6), "points of the law `table`"]

    def __post_init__(self) -> None:
        super().__post_init__()
        pairs, file = self.points
        if pairs[0] != (0.0, 0.0) or pairs[-1] != (1.0, 1.0):
            raise GenevaError(
                f"{file or 'points'}: a law runs from 0,0 to 1,1; the first or last point does not",
                ("motion", "file"),
            )

    @cached_property
    def _halves(self) -> tuple[Pieces, Pieces]:
        """Each half from its own end: the second is the spline of 1 - s by w = 1 - u."""
        return _halves(self.points.pairs)

    @property
    def symmetric(self) -> bool:
        """Points need not be."""
        return False

    @property
    def knots(self) -> tuple[float, ...]:
        """The points: a spline's fifth derivative jumps there."""
        return tuple(u for u, _ in self.points.pairs[1:-1])

    def first(self, u: Number, order: int) -> Jet:
        """The spline."""
        return Jet(self._halves[0](u, order))

    def second(self, w: Number, order: int) -> Jet:
        """What is left, from the other end."""
        return Jet(self._halves[1](w, order))

    def doubt(self) -> Doubt:
        """What the rounding of the points leaves unknown of the third derivative."""
        return _doubt(self.points.pairs)


@lru_cache(4)  # advice builds one machine many times
def _halves(points: tuple[tuple[float, float], ...]) -> tuple[Pieces, Pieces]:
    spline = at_rest([Decimal(p[0]) for p in points], [Decimal(p[1]) for p in points])
    with localcontext(FIFTY):
        parts = zip(pairwise(spline.x), spline.c, strict=True)
        ends = [(1 - b, shifted(c, b - a)) for (a, b), c in parts]
        w = [*[end for end, _ in reversed(ends)], 1 - spline.x[0]]
        left = [
            [1 - c[0], *[v if k % 2 else -v for k, v in enumerate(c) if k]]
            for _, c in reversed(ends)
        ]
    return spline.rounded(), Exact(w, left).rounded()


@lru_cache(4)
def _doubt(points: tuple[tuple[float, float], ...]) -> Doubt:
    return doubt([Decimal(p[0]) for p in points], [p[1] for p in points], False, 3)
