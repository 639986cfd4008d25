"""A slider-crank in front of the wheel: the roller is a point of its connecting rod.

Crank a from the input's axis to the pin A, rod b from A to the slider B, which runs at the height h
beside the crank's axis; the roller C stands k from A, at an angle from the line AB. The wheel's
centre is not given but solved for.
"""

from __future__ import annotations

import math
from typing import Annotated, NamedTuple

from geneva_cli.drives import Plan
from geneva_cli.errors import GenevaError
from geneva_cli.jet import Coefficient, Jet, sin_cos, sqrt
from geneva_cli.keys import Spec
from geneva_cli.linkage import plan_on, refuse_proportions
from geneva_cli.rules import LENGTH, POSITIVE, Range


class Keys(NamedTuple):
    """The keys that ``kind = "slider-crank"`` adds."""

    crank_mm: Annotated[float, POSITIVE, "crank a"]
    rod_mm: Annotated[float, POSITIVE, "connecting rod b, from crank pin A to slider B"]
    point_mm: Annotated[float, POSITIVE, "roller C from the crank pin A"]
    point_deg: Annotated[float, Range(-360.0, 360.0), "angle BAC, from AB to AC"]
    height_mm: Annotated[float, LENGTH, "slider's line beside the crank's axis, h"] = 0.0
    entry_deg: Annotated[
        float | None, Range(-360.0, 360.0), "crank angle near entry, where several wheels fit"
    ] = None


def plan(spec: Spec) -> Plan:
    """The one station of a slider-crank Geneva, its wheel's centre solved for."""
    keys = spec.kind
    assert isinstance(keys, Keys)
    a, b, h = keys.crank_mm, keys.rod_mm, keys.height_mm
    refuse_proportions(crank_mm=a, rod_mm=b, point_mm=keys.point_mm)
    if a + abs(h) >= b:
        raise GenevaError(
            f"crank_mm = {a:g}: the crank cannot turn all round; crank and height together must "
            f"be shorter than the rod, so the crank below {b - abs(h):.6g}",
            ("drive", "crank_mm"),
        )
    angle = math.radians(keys.point_deg)
    p, q = keys.point_mm * math.cos(angle), keys.point_mm * math.sin(angle)

    def rod(phi: Coefficient, order: int) -> tuple[Jet, Jet]:
        ey = (h - sin_cos(Jet.variable(phi, order))[0] * a) / b  # unit vector from A towards B
        return sqrt((1.0 - ey) * (ey + 1.0)), ey

    def path(phi: Coefficient, order: int) -> tuple[Jet, Jet]:
        sine, cosine = sin_cos(Jet.variable(phi, order))
        ex, ey = rod(phi, order)
        return cosine * a + ex * p - ey * q, sine * a + ey * p + ex * q

    return plan_on(spec, path, keys.entry_deg, rod)
