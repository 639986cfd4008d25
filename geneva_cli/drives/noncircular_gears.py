"""Noncircular gears in front of the crank, for a wanted ratio i = crank speed / input speed.

The ratio is the side-crank's (``A``), or comes from a CSV of input_deg,ratio points over a turn
(``ratio_file``): a periodic quintic spline through them, four times continuously differentiable.
The gears close where the ratio's mean over a turn is 1, and cannot be made where it reaches 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, Any, NamedTuple

from geneva_cli.coulisse import coulisse
from geneva_cli.drives import Front
from geneva_cli.errors import GenevaError
from geneva_cli.jet import Coefficient, Jet, library, sine_versine_of
from geneva_cli.keys import Spec
from geneva_cli.points import Pairs, read_pairs
from geneva_cli.rules import POSITIVE, Range

POINTS = Pairs("input_deg", "ratio", 1e-3, 1e3, 7)
MEAN = 1e-6  # by which the mean ratio may miss 1; the rest is scaled away


class Keys(NamedTuple):
    """The keys that ``kind = "noncircular-gears"`` adds."""

    A: Annotated[float | None, Range(-1.0, 1.0, "()"), "the side-crank's ratio, as gears"] = None
    ratio_file: Annotated[str | None, None, "CSV of input_deg,ratio points over a turn"] = None
    gear_distance_mm: Annotated[float, POSITIVE, "distance of the two gears' axes, C"] = 100.0


def front(spec: Spec) -> Callable[[float], Front]:
    """Front about a crank angle in degrees. Raises GenevaError for a ratio that no gears have."""
    keys = spec.kind
    assert isinstance(keys, Keys)
    if (keys.A is None) == (keys.ratio_file is None):
        raise GenevaError(
            "noncircular gears need A (the side-crank's ratio) or ratio_file, and not both",
            ("drive", "kind"),
        )
    if keys.A is not None:
        return coulisse(keys.A)
    path = spec.beside(keys.ratio_file or "")
    return _from_file(read_pairs(path, POINTS, ("drive", "ratio_file")))


def _from_file(points: list[tuple[float, float]]) -> Callable[[float], Front]:
    from geneva_cli.spline import periodic

    key = ("drive", "ratio_file")
    x, i = [math.radians(p[0]) for p in points], [p[1] for p in points]
    if points[0][0] != 0.0 or points[-1][0] != 360.0 or i[0] != i[-1]:
        raise GenevaError(
            "the ratio runs over a turn: from 0 to 360 deg, and ends as it began", key
        )
    if min(i) <= 0.0:
        raise GenevaError(
            f"not realisable as gears: the ratio falls to {min(i):g}, not above 0", key
        )
    spline = periodic(x, i)
    mean = float(spline.integrate(0.0, math.tau)) / math.tau
    if abs(mean - 1.0) > MEAN:
        raise GenevaError(
            f"the gears do not close: the ratio's mean over a turn is {mean:.9g}, and must be 1; "
            f"divide it by {mean:.9g}",
            key,
        )
    whole = spline.antiderivative()
    rates = [spline, *[spline.derivative(k) for k in range(1, 5)]]
    start = float(whole(0.0))
    total = float(whole(math.tau)) - start

    def crank(phi: Coefficient) -> Coefficient:
        floor = library(phi).floor(phi / math.tau)
        return ((whole(phi - floor * math.tau) - start) / total + floor) * math.tau

    def about(crank_deg: float) -> Front:
        wanted = math.radians(crank_deg)
        low, high = wanted - math.tau, wanted + math.tau
        for _ in range(80):
            phi = 0.5 * (low + high)
            low, high = (phi, high) if float(crank(phi)) < wanted else (low, phi)

        def advance(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
            m = library(tau)
            turn = _number(crank(phi + tau), tau) - float(crank(phi))
            at = (phi + tau) % math.tau
            terms = [
                _number(r(at), tau) * (math.tau / total) / math.factorial(k)
                for k, r in enumerate(rates[: max(order, 1)])
            ]
            return sine_versine_of(Jet(terms), m.sin(turn), m.cos(turn), order)

        return Front(math.degrees(phi), advance)

    return about


def _number(value: Any, like: Coefficient) -> Coefficient:
    return float(value) if isinstance(like, float) else value
