"""Straight slots whose axes miss the wheel's centre by e, in units of the centre distance L.

They are shockless with an axis tangent to the crank's circle: l = sin b cos d, sin d = e / cos b.
The jumps are l / cos(b - d) at entry, l / cos(b + d) at exit. What is small near the limit |e| =
cos² b is a product with the distance to it, which is computed once.
"""

from functools import partial

from geneva_cli.motion.engagement import Anchor, Slot, WheelMotion
from geneva_cli.motion.path_and_slot import AnchoredPath, StraightSlotMotion
from geneva_cli.motion.wheels.classic import HalfStep, PinPose, gap, half_motion_deg, middle
from geneva_cli.motion.wheels.gearing import RollerPlace
from geneva_cli.numerics.angles import radians, sin_cos_pi
from geneva_cli.numerics.arrays import choose, enclosed, library
from geneva_cli.numerics.jet import Jet, Number, integral, piecewise, sqrt, turning


class OffsetSlot(Slot):
    """A straight slot whose axis misses the wheel's centre."""

    def __init__(self, path: AnchoredPath, place: RollerPlace) -> None:
        self.path, self.deepest, self.offset, self.tilt = path, place.deepest, place.e, place.tilt

    def place(self, input_deg: Number, order: int) -> Jet:
        e, deepest = enclosed(input_deg, (self.offset, self.deepest))
        return _depth(e, deepest, _since(self.path.middle, input_deg, order)[0])[0]


class OffsetSlotMotion(StraightSlotMotion):
    """Motion of a wheel whose offset slot follows the pin."""

    def __init__(self, path: AnchoredPath, place: RollerPlace) -> None:
        super().__init__(path, place.step.b, mirrored=False)
        self.e, self.deepest = place.e, place.deepest

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        entry, _, exit_ = self.path.anchors
        first, last = (partial(self._from_end, end, order) for end in (entry, exit_))
        pieces = first, partial(self._inside, order), last
        return piecewise(input_deg, self.path.cuts, pieces)

    rate = WheelMotion.rate

    def _from_end(self, anchor: Anchor, order: int, x: Number) -> Jet:
        """Wheel angle near entry or exit.

        The pin is at (along, -e) in the slot's frame there. The slot's axis passes the pin at (s,
        -e) with s² = rho² - e². The excess of s over ``along`` is written so that it vanishes with
        ``across``. The wheel's angle and speed then vanish too.
        """
        (e,) = enclosed(x, (self.e,))
        along, across = anchor(x, order)
        more = across * (across - 2.0 * e)  # s² - along²
        square = along * along + more
        s = sqrt(square)
        gain = more / (s + along)
        rate = turning(along, across, gain * e, square + e * e)
        a, b, g, s0 = along.c[0], across.c[0], gain.c[0], s.c[0]
        value = library(a, b, e).atan2(b * s0 - g * e, a * s0 - (b - e) * e) + anchor.wheel
        return integral(rate, value)

    def _inside(self, order: int, x: Number) -> Jet:
        """Wheel angle near mid-motion: the pin's direction minus the slot's angle to it."""
        e, deepest = enclosed(x, (self.e, self.deepest))
        mid = self.path.middle
        toward, across = _since(mid, x, order)
        s, rho2 = _depth(e, deepest, toward)
        along = toward + mid.along
        rate = turning(along, across, s * e, rho2)
        m, u, depth = library(across.c[0], toward.c[0], e), toward.c[0], s.c[0]
        value = m.atan2(across.c[0], along.c[0]) + mid.wheel
        # atan2(e, deepest) - atan2(e, s)
        value -= m.atan2(2.0 * u / (depth + deepest) * e, depth * deepest + e * e)
        return integral(rate, value)


def _since(anchor: Anchor, input_deg: Number, order: int) -> tuple[Jet, Jet]:
    """Displacement of the pin since an anchor, along its ray and across it."""
    return anchor.displacement(radians(input_deg - anchor.input_deg), order)


def _depth(e: float, deepest: float, toward: Jet) -> tuple[Jet, Jet]:
    """Coordinate s of the pin along its slot's axis, and rho² = s² + e².

    The pin moves by u = l (1 - cos a) along the line of centres: s² = deepest² + 2 u.
    """
    square = toward * 2.0 + deepest**2
    return sqrt(square), square + e**2


def offset_place(step: HalfStep, e: float, spare: float) -> RollerPlace:
    """Place of a roller in a slot of offset e; ``spare`` is cos² b - |e|, above 0."""
    m = library(e, step.p, step.q)
    sin_b, cos_b = step.sin_cos
    less = 2.0 * sin_cos_pi(step.p, 2 * step.q)[0] ** 2  # 1 - cos b
    size = abs(e) / cos_b  # |sin d|
    # cos b - |e| = (cos² b - |e|) + cos b (1 - cos b)
    cos_d = m.sqrt((spare + cos_b * less) * (cos_b + abs(e))) / cos_b
    d = m.atan2(size, cos_d)
    wide = cos_b * cos_d + sin_b * size  # cos(b - |d|), a sum of positive terms
    near = spare / cos_b * (cos_b + size)  # cos² b - sin² d
    narrow = near / wide  # cos(b + |d|)
    deepest = near / (cos_d + sin_b)  # cos d - sin b
    least = gap(1.0, step.p, step.q) + sin_b * size * size / (1.0 + cos_d)  # 1 - l
    l = sin_b * cos_d
    half = half_motion_deg(1.0, step.p, step.q)
    long = half + m.degrees(d)
    short = m.degrees(m.atan2(narrow, sin_b * cos_d + cos_b * size))
    turn = m.atan2(size * (sin_b - cos_d * less), deepest * cos_d + abs(e) * size)
    mid = middle(1.0, l, least)
    gentle = e > 0.0  # at entry
    mid = mid._replace(wheel=choose(gentle, turn, -turn))
    enters, along = choose(gentle, -long, -short), choose(gentle, wide, narrow)
    entry = PinPose(enters, -step.b, along, (-l, 0.0), (0.0, l))
    leaves, along = choose(gentle, short, long), choose(gentle, narrow, wide)
    exit_ = PinPose(leaves, step.b, along, (l, 0.0), (0.0, -l))
    tilt = m.copysign(d, e)
    return RollerPlace(step, half, (entry, mid, exit_), l, e, tilt, deepest)
