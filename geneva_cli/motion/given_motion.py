"""Engagements with a known motion by a law: curved slots, and grooves for straight slots.

A curved slot is solved for from a known pin path. For a straight slot, with wheel and crank at psi
and phi, the law of sines gives the roller's distances from the crank's axis, L sin psi / sin(phi +
psi), and from the wheel's L sin phi / sin(phi + psi); inside phi - psi.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache, partial

from geneva_cli.errors import refuse_text
from geneva_cli.kept import cached_property
from geneva_cli.motion.engagement import Anchor, Peak, Slot, WheelMotion
from geneva_cli.motion.laws.law import Law, remaining
from geneva_cli.numerics import arrays
from geneva_cli.numerics.angles import radians
from geneva_cli.numerics.jet import Jet, Number, piecewise, sin, sin_cos, taylor

# Where psi and phi nearly vanish together, series of their sines over phi serve. Within this
# fraction of the motion 15 terms are exact to a double, even for a law with five waves. Beyond it
# the quotient of the sines keeps enough digits in its derivatives. A spline has five terms.
NEAR, TERMS = 1.0 / 30.0, 15
NEAR_SPLINE_DEG, SPLINE_TERMS = 0.06, 5


class SolvedPath(arrays.Batchable):
    """A fixed groove about the crank's axis, which guides the roller along the crank.

    Called with input angles it returns the roller's path. ``sign`` is +1 outside, -1 inside.
    """

    def __init__(self, motion: LawMotion, sign: float) -> None:
        self.motion, self.sign = motion, sign
        self.terms = TERMS if motion.law.ANALYTIC else SPLINE_TERMS

    @cached_property
    def seams_deg(self) -> tuple[float, float]:
        """Input angles between which the series about mid-motion is used, degrees."""
        motion = self.motion
        wide = motion.exit_deg - motion.entry_deg
        near = NEAR * wide if motion.law.ANALYTIC else NEAR_SPLINE_DEG
        return -near, near

    def distances(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Roller distances from the wheel's axis and from the crank's, in units of L."""
        whole, middle = (partial(f, order=order) for f in (self._by_sines, self._by_series))
        both = piecewise(input_deg, self.seams_deg, (whole, middle, whole)).c
        return Jet(both[: order + 1]), Jet(both[order + 1 :])

    def _by_sines(self, x: Number, order: int) -> Jet:
        phi, psi = Jet.variable(radians(x), order), self.motion(x, order)
        below = sin(phi + psi * self.sign)
        return Jet((*(sin(phi) / below).c, *(sin(psi) / below).c))

    def _sines(self, zero: Number) -> list[Sequence[Number]]:
        """The sines of phi, psi and phi +- psi over phi, in its powers about mid-motion."""
        phi, psi = Jet.variable(zero, self.terms), self.motion(zero, self.terms)
        return [sin(angle).c[1:] for angle in (phi, psi, phi + psi * self.sign)]

    @cached_property
    def _series(self) -> list[Sequence[Number]]:
        return self._sines(0.0)

    def _by_series(self, x: Number, order: int) -> Jet:
        """Both distances near mid-motion, where the sines vanish."""
        # an enclosure knows nothing of the rounding of the cached series
        exact = isinstance(x, arrays.Enclosed)
        series = self._sines(*arrays.enclosed(x, (0.0,))) if exact else self._series
        phi, psi, below = (Jet(taylor(radians(x), c, order)) for c in series)
        return Jet((*(phi / below).c, *(psi / below).c))

    @property
    def crossing(self) -> Number:
        """Roller distance from the crank's axis at mid-motion, on the line of centres."""
        slope = self.motion(0.0, 1).c[1]
        return slope / (slope * self.sign + 1.0)

    @cached_property
    def ends(self) -> tuple[Sequence[Number], Sequence[Number]]:
        """Roller distance from the crank's axis with two derivatives, at entry and exit."""
        at = self.motion.entry_deg, self.motion.exit_deg
        entry, exit_ = (self.distances(end, 2)[1].derivatives() for end in at)
        return entry, exit_

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        """Roller (x, y) in its straight slot, which stands at the wheel's angle."""
        rho, _ = self.distances(input_deg, order)
        s, c = sin_cos(self.motion(input_deg, order))
        return rho * c, rho * s


class SolvedPathSlot(Slot):
    """The straight radial slot of a solved path."""

    def __init__(self, path: SolvedPath) -> None:
        self.path, self.seams_deg = path, path.seams_deg

    def place(self, input_deg: Number, order: int) -> Jet:
        return self.path.distances(input_deg, order)[0]


class SolvedSlot(Slot):
    """Slot along the pin's path as seen from the turning wheel."""

    curved, walls_flat = True, False

    def __init__(self, path: Anchor, motion: WheelMotion) -> None:
        self.path, self.motion = path, motion

    def __call__(self, input_deg: Number, order: int = 3) -> tuple[Jet, Jet]:
        (x, y), (s, c) = self.path(input_deg, order), sin_cos(self.motion(input_deg, order))
        return x * c + y * s, y * c - x * s


UNIT_DEG = 64.0  # motion in which the peaks of a law are searched: places are exact fractions of it
MOTION_MIN = 1e-10  # degrees: a shorter motion, or dwell, is rounding


class LawMotion(WheelMotion):
    """A law, scaled to the wheel's step and to the motion angle."""

    breaks_to = 1e-15  # a few roundings of an angle

    def __init__(self, entry_deg: float, exit_deg: float, half_step: float, law: Law) -> None:
        super().__init__(entry_deg, exit_deg, half_step)
        self.law, self.mirrored = law, arrays.all_true(law.symmetric)

    @property
    def breaks_deg(self) -> tuple[float, ...]:
        return self._places(self.law.breaks)

    @property
    def knots_deg(self) -> tuple[float, ...]:
        return self._places(self.law.knots)

    def _places(self, fractions: tuple[float, ...]) -> tuple[float, ...]:
        whole = self.exit_deg - self.entry_deg
        if self.symmetric:
            inner = [0.0, *[(u - 0.5) * whole for u in fractions]]
        else:
            inner = [0.0, *[self.entry_deg + u * whole for u in (0.5, *fractions)]]
        return (self.entry_deg, *arrays.ascending(inner), self.exit_deg)

    @property
    def seams_deg(self) -> tuple[float, ...]:
        whole = self.exit_deg - self.entry_deg
        inner = sorted({0.5, *self.law.knots})
        return (self.entry_deg, *[self.entry_deg + u * whole for u in inner], self.exit_deg)

    def closed_peak(self, quantity: str) -> Peak[float] | None:
        if self.law.varies:
            return None
        size, at_deg = greatest(self.law)[quantity]
        whole, step = self.exit_deg - self.entry_deg, 2.0 * self.half_step
        end, of_end = (self.entry_deg, -0.5) if at_deg <= 0.0 else (self.exit_deg, 0.5)
        at_deg = end + (at_deg / UNIT_DEG - of_end) * whole
        if quantity == "power":  # velocity times acceleration
            size = size * step
        times = {"velocity": 1, "acceleration": 2, "jerk": 3, "power": 3}[quantity]
        return Peak(size * step * (UNIT_DEG / whole) ** times, at_deg)

    def __call__(self, input_deg: Number, order: int = 3) -> Jet:
        ends = self.entry_deg, self.exit_deg
        # their difference may round, which an enclosure then counts
        entry, exit_ = arrays.enclosed(input_deg, ends)
        whole, step, middle = exit_ - entry, 2.0 * self.half_step, 0.5 * sum(ends)

        def first(x: Number) -> Jet:
            return self.law.first((x - entry) / whole, order) * step - self.half_step

        def second(x: Number) -> Jet:
            rest = self.law.second((exit_ - x) / whole, order)
            return remaining(rest * step, self.half_step)

        s = piecewise(input_deg, (middle,), (first, second))
        rate = 1.0 / (whole * (arrays.library(input_deg).pi / 180.0))
        return Jet([c * rate**k if k else c for k, c in enumerate(s.c)])


@lru_cache(maxsize=256)
def greatest(law: Law) -> dict[str, Peak[float]]:
    """Peaks of a law whose keys are numbers, for a step of 1 in ``UNIT_DEG`` about angle 0."""
    from geneva_cli.motion.peak_search import QUANTITIES, search_peaks

    motion = LawMotion(-0.5 * UNIT_DEG, 0.5 * UNIT_DEG, 0.5, law)
    motion.breaks_to = 0.0  # breaks are scaled without rounding
    peaks = search_peaks(motion, QUANTITIES)
    return {name: Peak(size.item(), at_deg.item()) for name, (size, at_deg) in peaks.items()}


def shortened(alpha0_deg: float, natural_deg: float) -> float:
    """The motion angle that an extra dwell leaves of a natural one, degrees.

    Raises GenevaError if it leaves no motion, or no dwell at all.
    """
    low, high = natural_deg - 360.0 + MOTION_MIN, natural_deg - MOTION_MIN
    text = "alpha0_deg = {angle:.12g} leaves no motion angle between 0 and 360 degrees; it must be "
    text += "above {low:.12g} and below {high:.12g}"
    outside = (alpha0_deg <= low) | (alpha0_deg >= high)
    key = ("motion", "alpha0_deg")
    refuse_text(outside, key, text, angle=alpha0_deg, low=low, high=high)
    return natural_deg - alpha0_deg


class Backwards(Law):
    """A law run backwards: the halves of ``of`` change places. It is no kind of its own."""

    of: Law

    def __post_init__(self) -> None:
        super().__post_init__()
        # a law's class declares these, and finds in its keys if it varies; this one has none
        vars(self)["NAME"] = f"{self.of.NAME}, backwards"
        for name in ("ANALYTIC", "varies", "symmetric"):
            vars(self)[name] = getattr(self.of, name)

    @property
    def breaks(self) -> tuple[float, ...]:
        return tuple(1.0 - u for u in reversed(self.of.breaks))

    @property
    def knots(self) -> tuple[float, ...]:
        return tuple(1.0 - u for u in reversed(self.of.knots))

    def doubt(self) -> tuple[int, float] | None:
        return self.of.doubt()

    def first(self, u: Number, order: int) -> Jet:
        return self.of.second(u, order)

    def second(self, w: Number, order: int) -> Jet:
        return self.of.first(w, order)


def run_backwards(law: Law) -> Law:
    """The law 1 - s by 1 - u; a symmetric law is its own."""
    if isinstance(law, Backwards):
        return law.of
    return law if arrays.all_true(law.symmetric) else Backwards(law)
