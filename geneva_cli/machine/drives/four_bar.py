"""A four-bar linkage in front of the wheel: the roller is a point of its coupler.

Crank a from the input's axis to the pin A, coupler b from A to B, rocker c from B to its own pivot
at the distance g; the roller C stands k from A, at an angle from the line AB. The wheel's centre is
not given but solved for.
"""

from __future__ import annotations

from decimal import Decimal
from typing import Annotated, Any, NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.drives import Plan
from geneva_cli.machine.linkage import exact_point, plan_on, refuse_proportions
from geneva_cli.machine.wheel_for_path import Path, Way
from geneva_cli.numerics.jet import Jet, sqrt
from geneva_cli.spec.rules import POSITIVE, OneOf, Range
from geneva_cli.spec.tables import Spec


class Keys(NamedTuple):
    """The keys that ``kind = "four-bar"`` adds."""

    crank_mm: Annotated[float, POSITIVE, "crank a"]
    ground_mm: Annotated[float, POSITIVE, "distance g of the fixed pivots"]
    coupler_mm: Annotated[float, POSITIVE, "coupler b, from crank pin A to rocker pin B"]
    rocker_mm: Annotated[float, POSITIVE, "rocker c"]
    point_mm: Annotated[float, POSITIVE, "roller C from the crank pin A"]
    point_deg: Annotated[float, Range(-360.0, 360.0), "angle BAC, from AB to AC"]
    branch: Annotated[str, OneOf(("+", "-")), "side of the crank's line the coupler is on"] = "+"
    entry_deg: Annotated[
        float | None, Range(-360.0, 360.0), "crank angle near entry, where several wheels fit"
    ] = None


def plan(spec: Spec) -> Plan:
    """The one station of a four-bar Geneva, its wheel's centre solved for."""
    keys = spec.kind
    assert isinstance(keys, Keys)
    refuse_proportions(
        crank_mm=keys.crank_mm,
        ground_mm=keys.ground_mm,
        coupler_mm=keys.coupler_mm,
        rocker_mm=keys.rocker_mm,
        point_mm=keys.point_mm,
    )
    _refuse_linkage(keys)
    return plan_on(spec, CouplerPath(keys), keys.entry_deg)


class _Links(NamedTuple):
    """Crank, ground, coupler, rocker and the point's place on the coupler (along it, aside)."""

    a: Any
    g: Any
    b: Any
    c: Any
    p: Any
    q: Any


class CouplerPath(Path):
    """The path of a point of the coupler.

    With d the vector from A to the rocker's pivot, D = d² and N = sqrt(4 b² D - (b² + D - c²)²),
    the unit vector from A towards B is e = d k, k = ((D + b² - c²) + i N) / (2 b D).
    """

    def __init__(self, keys: Keys) -> None:
        lengths = (keys.crank_mm, keys.ground_mm, keys.coupler_mm, keys.rocker_mm)
        a, g, b, c = (Decimal(x) for x in lengths)
        p, q = exact_point(keys.point_mm, keys.point_deg)
        self.exact = _Links(a, g, b, c, p, q)
        self.rough = _Links._make(float(x) for x in self.exact)
        self.side = 1 if keys.branch == "+" else -1

    def link(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """The coupler's unit vector e, from A towards B."""
        a, g, b, c, _, _ = self.exact if exact else self.rough
        dx, dy = g - cosine * a, sine * -a
        D = dx * dx + dy * dy
        along = (D + (b - c) * (b + c)) / (D * (2 * b))
        # N² as a product (Heron)
        across = sqrt(((b + c) ** 2 - D) * (D - (b - c) ** 2)) / (D * (2 * b)) * self.side
        return dx * along - dy * across, dy * along + dx * across

    def place(self, sine: Jet, cosine: Jet, exact: bool = False) -> tuple[Jet, Jet]:
        """Crank, and e turned and stretched to the point."""
        a, _, _, _, p, q = self.exact if exact else self.rough
        ex, ey = self.link(sine, cosine, exact)
        return cosine * a + ex * p - ey * q, sine * a + ey * p + ex * q

    def about(self, sine: Decimal, cosine: Decimal) -> Way:
        """The change of each of A, D, 1/D, N, k and e, from the one before it."""
        a, g, b, c, p, q = self.exact
        D0 = g * g + a * a - 2 * g * a * cosine
        above, below = (b + c) ** 2 - D0, D0 - (b - c) ** 2
        N0, m = (above * below).sqrt(), (b - c) * (b + c)
        k0 = ((1 + m / D0) / (2 * b), self.side * N0 / (D0 * 2 * b))
        x0, y0 = float(g - cosine * a), float(-sine * a)
        s, t = float(a * sine), float(a * cosine)
        high, low, steep = float(above), float(below), float(above - below)
        root, inverse, span = float(N0), float(1 / D0), float(2 * g)
        real, imag = float(k0[0]), float(k0[1])
        by_u, by_N = float(m / (2 * b)), float(self.side / (2 * b))
        P, Q = float(p), float(q)

        def way(sine: Jet, versine: Jet) -> tuple[Jet, Jet]:
            x, y = sine * -s - versine * t, sine * t - versine * s
            D = x * -span
            u = 1.0 / (D + 1.0 / inverse)
            du = D * u * -inverse
            N = D * (steep - D) / (sqrt((high - D) * (D + low)) + root)
            k, n = du * by_u, (N * u + du * root) * by_N
            kk, nn = k + real, n + imag
            ex = y * nn - x * kk + k * x0 - n * y0
            ey = n * x0 - x * nn - y * kk + k * y0
            return x + ex * P - ey * Q, y + ey * P + ex * Q

        return way


def _refuse_linkage(keys: Keys) -> None:
    """Raise GenevaError unless the crank turns all round (Grashof)."""
    others = [keys.ground_mm, keys.coupler_mm, keys.rocker_mm]
    longest = max(others)
    limit = min(*others, sum(others) - 2.0 * longest)
    if keys.crank_mm >= limit:
        helps = f"it must be below {limit:.6g}" if limit > 0.0 else "change the other links first"
        raise GenevaError(
            f"crank_mm = {keys.crank_mm:g}: the crank cannot turn all round (Grashof: it is the "
            f"shortest link, and with the longest shorter than the other two together); {helps}",
            ("drive", "crank_mm"),
        )
