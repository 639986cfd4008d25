"""A four-bar linkage in front of the wheel: the roller is a point of its coupler.

Crank a from the input's axis to the pin A, coupler b from A to B, rocker c from B to its own pivot
at the distance g; the roller C stands k from A, at an angle from the line AB. The wheel's centre is
not given but solved for.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from geneva_cli.drives import Plan
from geneva_cli.errors import GenevaError
from geneva_cli.jet import Coefficient, Jet, sin_cos, sqrt
from geneva_cli.keys import Spec
from geneva_cli.linkage import plan_on, refuse_proportions
from geneva_cli.rules import POSITIVE, OneOf, Range


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
    a, g, b, c = keys.crank_mm, keys.ground_mm, keys.coupler_mm, keys.rocker_mm
    side = 1.0 if keys.branch == "+" else -1.0
    angle = math.radians(keys.point_deg)
    p, q = keys.point_mm * math.cos(angle), keys.point_mm * math.sin(angle)

    def coupler(phi: Coefficient, order: int) -> tuple[Jet, Jet]:
        sine, cosine = sin_cos(Jet.variable(phi, order))
        dx, dy = g - cosine * a, sine * -a  # from A to the rocker's pivot
        D = dx * dx + dy * dy
        along = (D + (b - c) * (b + c)) / (D * (2.0 * b))
        # 4 b² D - (b² + D - c²)² as a product (Heron)
        across = sqrt(((b + c) ** 2 - D) * (D - (b - c) ** 2)) / (D * (2.0 * b)) * side
        return dx * along - dy * across, dy * along + dx * across  # from A towards B

    def path(phi: Coefficient, order: int) -> tuple[Jet, Jet]:
        sine, cosine = sin_cos(Jet.variable(phi, order))
        ex, ey = coupler(phi, order)
        return cosine * a + ex * p - ey * q, sine * a + ey * p + ex * q

    return plan_on(spec, path, keys.entry_deg, coupler)


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
