"""The law ``tuned``: a command that leaves no vibration of a load on an elastic shaft.

With r the load's angle minus the wheel's, r'' + 2 zeta wn r' + wn² r = -psi''. For any law y,

    psi = y + 2 zeta y'/wn + y''/wn²

moves the load along y + 2 zeta y'/wn, from rest to rest: y is the flat output of the oscillator.
Without damping the load follows y itself. In fractions of the step and of the motion's time wn is
Omega = 2 pi lambda, with the period ratio lambda. So the law is a pure shape, and its own key is
lambda.
"""

from typing import Annotated, ClassVar

from geneva_cli.errors import GenevaError
from geneva_cli.kept import cached_property
from geneva_cli.motion import registry
from geneva_cli.motion.laws.law import Law
from geneva_cli.numerics.arrays import Truth, library, scalar
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.numerics.tolerances import ROUNDED
from geneva_cli.spec.rules import OneOf, Range


class Tuned(Law):
    """A law of the load's flat output, converted to the wheel's motion.

    >>> from geneva_cli import Cycloidal
    >>> law = Tuned(period_ratio=2.0)
    >>> round(law(0.25).c[0], 12), law.symmetric
    (0.117308846944, True)
    """

    NAME: ClassVar[str] = "tuned"
    ABOUT: ClassVar[str] = "leaves an elastic load at rest at its period_ratio; of = a law"
    TURNS_BACK: ClassVar[str] = "a tuned law turns back at period ratios below about 0.8"
    period_ratio: Annotated[
        float, Range(0.05, 1e5), "tuned: motion time over the load's natural period"
    ]
    of: Annotated[
        str,
        OneOf(registry.STANDARD_LAWS),
        "tuned: the law of the load, 4-5-6-7 or (for no jump) sine-group",
    ] = "4-5-6-7"
    damping_ratio: Annotated[
        float, Range(0.0, 1.0, "[)"), "tuned: damping ratio of the load on its shaft"
    ] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        if not _serves(self._y):
            serve = [n for n in registry.STANDARD_LAWS if _serves(registry.law(n)())]
            usable = " or ".join(f'"{name}"' for name in serve)
            raise GenevaError(
                f'of = "{self.of}": one of its first three derivatives jumps, so the wheel would '
                f"jump in position or velocity; use {usable}",
                ("motion", "of"),
            )

    @cached_property
    def _y(self) -> Law:
        law: Law = registry.law(self.of)()
        return law

    @property
    def symmetric(self) -> Truth:
        """True without damping, if its law is symmetric."""
        return self._y.symmetric & (self.damping_ratio == 0.0)

    @property
    def tuned_to(self) -> float:
        """Period ratio at which it leaves the load at rest."""
        return self.period_ratio

    @property
    def knots(self) -> tuple[float, ...]:
        """Knots of its law."""
        return self._y.knots

    def first(self, u: Number, order: int) -> Jet:
        """Fraction s = y + 2 zeta y'/Omega + y''/Omega²."""
        return self._with_rates(self._y.first(u, order + 2), 1.0)

    def second(self, w: Number, order: int) -> Jet:
        """Remainder 1 - s; the first derivative changes sign, since the time runs backwards."""
        return self._with_rates(self._y.second(w, order + 2), -1.0)

    def _with_rates(self, y: Jet, sign: float) -> Jet:
        omega = 2.0 * library(y.c[0]).pi * self.period_ratio
        rate = y.derivative().lower * (sign * 2.0 * self.damping_ratio / omega)
        return Jet(y.c[:-2]) + rate + y.derivative().derivative() * (1.0 / (omega * omega))


def _serves(y: Law) -> bool:
    """True if the law's derivatives up to the third vanish at both ends and do not jump."""
    # three derivatives of y must not jump: the wheel's velocity contains the third
    ends = [c for x in (0.0, 1.0) for c in y(x, 3).c[1:]]
    return not y.breaks and all(abs(scalar(c)) < ROUNDED for c in ends)
