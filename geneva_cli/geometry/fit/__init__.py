"""A smooth parametric curve in as few pieces as a tolerance allows: arcs or cubics.

A curve is a function of n parameters, from a to b > a. It returns points (n, 2) in millimetres and
unit tangents (n, 2). Callers split it at corners and cusps; its speed may go to zero at an end.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TypeAlias

from geneva_cli.geometry.fit.arcs import Curve
from geneva_cli.geometry.fit.arcs import arcs as arcs
from geneva_cli.geometry.fit.cubics import cubics as cubics
from geneva_cli.geometry.shapes import Segment

Writer: TypeAlias = Callable[[Curve, float, float], Sequence[Segment]]  # fits a curve from a to b

# the kinds of pieces that a curve can be written in
KINDS: dict[str, Callable[[Curve, float, float, float], Sequence[Segment]]]
KINDS = {"arcs": arcs, "cubics": cubics}
