"""The law ``table``: a motion law that a user gives as a CSV of u,s points.

A quintic spline through every point, four times continuously differentiable; its four free
conditions put velocity and acceleration to zero at both ends.
"""

from __future__ import annotations

from decimal import Decimal, localcontext
from functools import cache, lru_cache
from itertools import pairwise

from geneva_cli.errors import GenevaError
from geneva_cli.machine.laws.standard import Law
from geneva_cli.numerics.digits import FIFTY
from geneva_cli.numerics.jet import Coefficient, Jet
from geneva_cli.numerics.spline import Exact, at_rest, doubt, shifted
from geneva_cli.spec.tables import Spec
from geneva_cli.specfile.points import Pairs, read_pairs

# The points of s are rounded by 1e-16, which moves a third derivative by some 1e-16 / step³: at
# this step, 10,001 points in all, by 1e-4 of a usual law's; ten times closer the jerk is nothing
# else, with a peak at every point. Past ten times its rise a law is a mistake.
POINTS = Pairs("u", "s", 0.9e-4, 10.0, 6)
_WHERE = ("motion", "file")


def read_law(spec: Spec) -> Law:
    """The law in the file that ``[motion] file`` names, relative to the spec.

    Raises GenevaError naming the file and the line.
    """
    name = spec.motion.file
    if not name:
        raise GenevaError('the law "table" needs file = "points.csv", lines of u,s', _WHERE)
    path = spec.beside(name)
    points = read_pairs(path, POINTS, _WHERE)
    if points[0] != (0.0, 0.0) or points[-1] != (1.0, 1.0):
        raise GenevaError(f"{path}: a law runs from 0,0 to 1,1; the first or last point does not")
    return _law(tuple(points))


@lru_cache(4)  # advice builds one machine many times
def _law(points: tuple[tuple[float, float], ...]) -> Law:
    """Each half from its own end: the second is the spline of 1 - s by w = 1 - u."""
    u = [Decimal(p[0]) for p in points]
    spline = at_rest(u, [Decimal(p[1]) for p in points])
    with localcontext(FIFTY):
        parts = zip(pairwise(spline.x), spline.c, strict=True)
        ends = [(1 - b, shifted(c, b - a)) for (a, b), c in parts]
        w = [*[end for end, _ in reversed(ends)], 1 - spline.x[0]]
        left = [
            [1 - c[0], *[v if k % 2 else -v for k, v in enumerate(c) if k]]
            for _, c in reversed(ends)
        ]
    halves = [part.rounded() for part in (spline, Exact(w, left))]

    def first(u: Coefficient, order: int) -> Jet:
        return Jet(halves[0](u, order))

    def second(w: Coefficient, order: int) -> Jet:
        return Jet(halves[1](w, order))

    def known() -> tuple[int, float]:
        return doubt(u, [p[1] for p in points], False, 3)

    # The knots, where the fifth derivative jumps, are no breaks up to the fourth.
    about = "a spline through the points of a CSV file"
    return Law("table", first, second, (), about, False, cache(known))
