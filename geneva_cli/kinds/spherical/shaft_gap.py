"""Gaps between hubs or shafts of a spherical machine and parts that turn about the other axis.

Both may have points at equal distances from the centre. On a sphere of such a radius the parts are
caps and rings, and the gap is an arc between them (``ring_gap``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.plates import Plate, plates, steps_of
from geneva_cli.kinds.spherical.parts import SphereParts
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.shafts.bores import around
from geneva_cli.verdict.shaft_gap import ShaftGap, ring_gap


class Sweep(NamedTuple):
    """The region that a part sweeps in a whole turn: between two angles and two spheres.

    ``wide`` is the radius of a round part, mm; it is 0 for a ring between two angles. A round part
    begins at the sphere that touches its flat end. On a larger sphere its cap is limited by that
    end.
    """

    name: str
    back: bool  # on the far side of the centre
    low: float
    high: float
    inner: float
    outer: float
    wide: float = 0.0

    def angle(self, sphere: Array) -> Array:
        """Return the greatest angle from the axis on spheres (n,), radians."""
        if not self.wide:
            return np.full_like(sphere, self.high)
        end = np.arccos(np.minimum(1.0, self.inner / sphere))
        return np.minimum(np.arcsin(np.minimum(1.0, self.wide / sphere)), end)

    @property
    def grows_to(self) -> float:
        """The radius of the sphere up to which the angle grows; beyond it the angle shrinks."""
        return math.hypot(self.inner, self.wide) if self.wide else 0.0


def shaft_gap(parts: SphereParts) -> ShaftGap | None:
    """Return the least gap of hubs and shafts to parts about the other axis, mm along a sphere.

    None where no two of them share a distance from the centre.
    """
    ball = parts.ball
    shafts = [(step, m.frame is not None) for m in parts.shafts for step in steps_of(m.part)]
    on_wheel, on_crank = (
        [p for p in plates(one.part) if p.layer != "ROLLER"]
        + [p for p, of_crank in shafts if of_crank is crank]
        for crank, one in ((False, parts.wheel), (True, parts.crank))
    )
    wheel, crank = ([s for p in some for s in _round(p)] for some in (on_wheel, on_crank))
    pairs = [*product(wheel, [*crank, *_crank_rings(parts)])]
    inner = 0.0 if ball.opening_mm else ball.inner
    ring = Sweep("wheel", False, inner, ball.rim, *ball.span_mm)
    pairs += [(one, ring) for one in crank]
    near = SAME_LENGTH * ball.radius_mm
    return min(
        (
            ShaftGap(_gap(one, other, ball.axes), one.name, other.name)
            for one, other in pairs
            if min(one.outer, other.outer) - max(one.inner, other.inner) > near
        ),
        default=None,
    )


def _round(plate: Plate) -> Iterator[Sweep]:
    """Yield the region that a round plate sweeps on each side of the centre: the plate itself."""
    wide = around(plate.outline)
    for back, low, high in ((False, plate.low, plate.high), (True, -plate.high, -plate.low)):
        if high > 0.0:
            flat = max(low, 0.0)
            yield Sweep(plate.name, back, 0.0, 0.0, flat, math.hypot(high, wide), wide)


def _crank_rings(parts: SphereParts) -> Iterator[Sweep]:
    """Yield the regions that arm, locking sectors and rollers sweep about the crank's axis."""
    ball, arm, sectors = parts.ball, parts.arm, parts.shells.crank
    out = ball.span_mm[1]
    if arm:
        out = ball.arm_span_mm[1]
        yield Sweep("arm", False, 0.0, arm.reach, *ball.arm_span_mm)
    if sectors:
        low = min(math.pi - sector.boundary[2].angle for sector in sectors)
        yield Sweep("locking sector", False, low, ball.lock, *ball.lock_span_mm)
    low, high = ball.arm - ball.roller, ball.arm + ball.roller
    yield Sweep("roller", False, low, high, ball.span_mm[0], out)


def _gap(one: Sweep, other: Sweep, axes: float) -> float:
    """Return the least gap of a round part to a round part or ring about the other axis."""
    low, high = max(one.inner, other.inner), min(one.outer, other.outer)
    # farther out both angles only shrink, and an arc that is a gap grows with its sphere
    high = min(high, max(low, one.grows_to, other.grows_to))
    sphere = np.linspace(low, high, 257)
    sphere = sphere[sphere > 0.0]  # both may be at the centre
    apart = axes if one.back is other.back else math.pi - axes
    gaps = sphere * ring_gap(apart, other.low, other.angle(sphere), one.angle(sphere))
    return float(gaps.min())
