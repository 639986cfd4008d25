"""A smooth parametric curve in as few pieces as a tolerance allows: arcs or cubics.

A curve is a function of an array of n parameters. It returns its points (n, 2) in millimetres, and
its unit tangents (n, 2) in the direction of rising parameters. It is smooth from a to b > a, and
may have inflections; callers split it at corners and cusps. Its speed may go to zero at an end,
where the tangent is the limit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from geneva_cli.geometry.fit.arcs import Curve
from geneva_cli.geometry.fit.arcs import arcs as arcs
from geneva_cli.geometry.fit.cubics import cubics as cubics
from geneva_cli.geometry.shapes import Segment

# the kinds of pieces that a curve can be written in
KINDS: dict[str, Callable[[Curve, float, float, float], Sequence[Segment]]]
KINDS = {"arcs": arcs, "cubics": cubics}
