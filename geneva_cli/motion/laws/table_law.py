"""The law ``table``: a quintic spline through points u,s of the user, at rest at both ends."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, ClassVar

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.motion.laws.law import Law
from geneva_cli.numerics.jet import Jet, Number, taylor
from geneva_cli.spec.rules import Csv
from geneva_cli.spec.schema import Points

if TYPE_CHECKING:
    from geneva_cli.numerics.spline import PiecewisePolynomial


class TableLaw(Law):
    """A spline through the points of a CSV file.

    ``points`` are pairs u,s from 0,0 to 1,1 in ascending order, or the name of a CSV file with
    them. Raises GenevaError for any other points.

    >>> law = TableLaw([(u / 10, (u / 10) ** 2 * (3 - u / 5)) for u in range(11)])
    >>> round(law(0.5).c[0], 12)
    0.5
    """

    NAME: ClassVar[str] = "table"
    ABOUT: ClassVar[str] = "your own: a CSV of u,s points, file = ..."
    ANALYTIC: ClassVar[bool] = False
    symmetric: ClassVar[bool] = False
    # The points of s are rounded by 1e-16, which moves a third derivative by about 1e-16 / step³.
    # At this step, 10,001 points in all, that is 1e-4 of a usual law's. Ten times closer the jerk
    # is only noise, with a peak at every point. A law that passes ten times its rise is a mistake.
    points: Annotated[Points, Csv(), "points of the law `table`"]

    def __post_init__(self) -> None:
        super().__post_init__()
        pairs, file = self.points
        if pairs[0] != (0.0, 0.0) or pairs[-1] != (1.0, 1.0):
            text = f"{file or 'points'}: a law runs from 0,0 to 1,1: change its first or last point"
            raise GenevaError(text, ("motion", "file"))

    @cached_property
    def _halves(self) -> tuple[PiecewisePolynomial, PiecewisePolynomial]:
        """The spline from its start; and from its end, as 1 - s by w = 1 - u."""
        return _halves(self.points.pairs)

    @property
    def knots(self) -> tuple[float, ...]:
        return tuple(u for u, _ in self.points.pairs[1:-1])

    def first(self, u: Number, order: int) -> Jet:
        return Jet(self._halves[0](u, order))

    def second(self, w: Number, order: int) -> Jet:
        return Jet(self._halves[1](w, order))

    def doubt(self) -> tuple[int, float]:
        from geneva_cli.numerics.spline import doubt

        u, s = zip(*self.points.pairs, strict=True)
        return doubt(u, s, 3)


@lru_cache(4)  # advice builds one machine many times
def _halves(
    points: tuple[tuple[float, float], ...],
) -> tuple[PiecewisePolynomial, PiecewisePolynomial]:
    # a list of the laws needs no splines
    import numpy as np

    from geneva_cli.numerics.spline import SPLINE_DEGREE, PiecewisePolynomial, at_rest

    u, s = zip(*points, strict=True)
    spline = at_rest(u, s)
    ends = np.array(u[1:])
    columns = taylor(ends - spline.origins, list(spline.rows.T), SPLINE_DEGREE)
    # 1 - s changes the sign of every coefficient, and w = 1 - u that of the odd ones
    left = [1.0 - np.array(s[1:]), *[c if k % 2 else -c for k, c in enumerate(columns) if k]]
    rows = np.array(left).T[::-1].copy()
    rows[0, :3] = 0.0  # at rest at the end
    starts = 1.0 - ends[::-1]
    return spline, PiecewisePolynomial(starts[1:], starts, rows)
