"""A smooth parametric curve in as few pieces as a tolerance allows: arcs or cubics.

A curve is a function of an array of n parameters. It returns its points (n, 2) in millimetres, and
its unit tangents (n, 2) in the direction of rising parameters. It is smooth from a to b > a, and
may have inflections; callers split it at corners and cusps. Its speed may go to zero at an end,
where the tangent is the limit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from geneva_cli.geometry.fit.arcs import fitted_arcs
from geneva_cli.geometry.fit.cubics import fitted_cubics
from geneva_cli.geometry.fit.path import Curve, CurvePath
from geneva_cli.geometry.shapes import Arc, Cubic, Line, Segment


def arcs(curve: Curve, a: float, b: float, tolerance: float) -> list[Arc | Line]:
    """Arcs within ``tolerance`` mm of the curve, and lines where it is straight.

    Adjacent pieces share their tangent, and the first and last have the curve's own.

    Raises GenevaError for a tolerance that double precision cannot show.
    """
    return fitted_arcs(CurvePath(curve, a, b, tolerance))


def cubics(curve: Curve, a: float, b: float, tolerance: float) -> list[Cubic]:
    """Cubic Béziers within ``tolerance`` mm of the curve.

    They meet on the curve and have its tangents there.

    Raises GenevaError for a tolerance that double precision cannot show.
    """
    return fitted_cubics(CurvePath(curve, a, b, tolerance))


# the kinds of pieces that a curve can be written in
KINDS: dict[str, Callable[[Curve, float, float, float], Sequence[Segment]]]
KINDS = {"arcs": arcs, "cubics": cubics}
