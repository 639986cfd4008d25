"""Gaps between hubs or shafts of a spherical machine and parts that turn about the other axis.

Both may share distances from the centre. On a sphere of such a radius they are caps and rings, and
the gap is an arc between them (``ring_gap``).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import product
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.plates import Plate, plates
from geneva_cli.curves.shapes import Circle
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.sphere.built import ROLLER, BuiltBall
from geneva_cli.parts.sphere.sizes import Ball
from geneva_cli.parts.turn.beside_shafts import ShaftGap, ring_gap

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array
    from geneva_cli.parts.sphere.shells import Shells

LOOKS = 257  # spheres on which a gap is looked at, where it may grow and shrink


class Swept(NamedTuple):
    """What something sweeps in a whole turn about its axis: between two angles and two spheres.

    ``wide`` is the radius of a round part, mm, 0 for what is a ring of angles. A round part begins
    at the sphere that its flat end touches: its cap on a sphere is no wider than that lets it be.
    """

    name: str
    back: bool  # on the far side of the centre
    low: float
    high: float
    inner: float
    outer: float
    wide: float = 0.0

    def angle(self, sphere: Array) -> Array:
        """How far it is from the axis at most, on spheres (n,), radians."""
        if not self.wide:
            return np.full_like(sphere, self.high)
        end = np.arccos(np.minimum(1.0, self.inner / sphere))
        out: Array = np.minimum(np.arcsin(np.minimum(1.0, self.wide / sphere)), end)
        return out

    @property
    def grows_to(self) -> float:
        """The sphere to which its angle grows; beyond it shrinks."""
        return math.hypot(self.inner, self.wide) if self.wide else 0.0


def beside_shafts(found: Shells, whole: BuiltBall) -> ShaftGap | None:
    """The least gap between a hub or shaft and what turns about the other axis, mm along a sphere.

    None where they share no distance from the centre.
    """
    ball = found.ball
    shafts = [(member.part, member.frame is not None) for member in whole.shafts]
    on_wheel, on_crank = (
        [p for p in plates(one.part) if p.layer != ROLLER]
        + [p for p, of_crank in shafts if isinstance(p, Plate) and of_crank is crank]
        for crank, one in ((False, whole.wheel), (True, whole.crank))
    )
    wheel, crank = ([s for p in some for s in _round(p)] for some in (on_wheel, on_crank))
    pairs = [*product(wheel, [*crank, *_crank_rings(found, whole)])]
    pairs += [*product(crank, [_wheel_ring(ball)])]
    near = SAME_LENGTH * ball.radius_mm
    return min(
        (
            ShaftGap(_gap(one, other, ball.axes), one.name, other.name)
            for one, other in pairs
            if min(one.outer, other.outer) - max(one.inner, other.inner) > near
        ),
        default=None,
    )


def _round(plate: Plate) -> Iterator[Swept]:
    """What a round plate sweeps, which it is, on either side of the centre."""
    assert isinstance(plate.outline, Circle)
    wide = plate.outline.radius
    for back, low, high in ((False, plate.low, plate.high), (True, -plate.high, -plate.low)):
        if high > 0.0:
            flat = max(low, 0.0)
            yield Swept(plate.name, back, 0.0, 0.0, flat, math.hypot(high, wide), wide)


def _crank_rings(found: Shells, whole: BuiltBall) -> Iterator[Swept]:
    """What arm, locking sectors, and rollers with their pins sweep about the crank's axis."""
    ball, arm = found.ball, whole.arm
    out = ball.span_mm[1]
    if arm:
        out = ball.arm_span_mm[1]
        yield Swept("arm", False, 0.0, arm.reach, *ball.arm_span_mm)
    if found.crank:
        low = min(math.pi - sector.boundary[2].angle for sector in found.crank)
        yield Swept("locking sector", False, low, ball.lock, *ball.lock_span_mm)
    low, high = ball.arm - ball.roller, ball.arm + ball.roller
    yield Swept("roller", False, low, high, ball.span_mm[0], out)


def _wheel_ring(ball: Ball) -> Swept:
    return Swept("wheel", False, 0.0 if ball.opening_mm else ball.inner, ball.rim, *ball.span_mm)


def _gap(one: Swept, other: Swept, axes: float) -> float:
    """Between what is round and what is round or a ring about the other axis, on any sphere."""
    low, high = max(one.inner, other.inner), min(one.outer, other.outer)
    # farther out both only shrink, and an arc that is a gap grows with its sphere
    high = min(high, max(low, one.grows_to, other.grows_to))
    sphere = np.linspace(low, high, LOOKS)
    sphere = sphere[sphere > 0.0]  # both may be at the centre
    apart = axes if one.back is other.back else math.pi - axes
    gaps = sphere * ring_gap(apart, other.low, other.angle(sphere), one.angle(sphere))
    return float(gaps.min())
