"""The law ``table``: a motion law that a user gives as a CSV of u,s points.

A quintic spline through every point, four times continuously differentiable; its four free
conditions put velocity and acceleration to zero at both ends (SciPy, make_interp_spline).
"""

from __future__ import annotations

import math
from typing import Any

from geneva_cli.errors import GenevaError
from geneva_cli.jet import Coefficient, Jet
from geneva_cli.keys import Spec
from geneva_cli.laws import Law
from geneva_cli.points import Pairs, read_pairs

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
    u, s = [p[0] for p in points], [p[1] for p in points]
    from geneva_cli.spline import at_rest

    return _law(at_rest(u, s))


def _law(spline: Any) -> Law:
    branches = [spline, *[spline.derivative(k) for k in range(1, 6)]]

    def first(u: Coefficient, order: int) -> Jet:
        return Jet([_value(branches[k], u) / math.factorial(k) for k in range(order + 1)])

    def second(w: Coefficient, order: int) -> Jet:
        # 1 - s(1 - w): even derivatives change sign
        c = first(1.0 - w, order).c
        return Jet([1.0 - c[0], *[x if k % 2 else -x for k, x in enumerate(c) if k]])

    # The knots, where the fifth derivative jumps, are no breaks up to the fourth.
    return Law("table", first, second, (), "a spline through the points of a CSV file", False)


def _value(spline: Any, u: Coefficient) -> Coefficient:
    value = spline(u)
    return float(value) if isinstance(u, float) else value
