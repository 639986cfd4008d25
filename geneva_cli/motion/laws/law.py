"""The base of the motion laws s(u): fraction of the step by fraction of the motion's time.

Both run from 0 to 1. The first half of a law is s by u. The second half is the remainder 1 - s by
the remaining time w = 1 - u. So both ends are exact, and a symmetric law is written once.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar

from geneva_cli.kept import cached_property
from geneva_cli.numerics.arrays import Truth, all_true, choose
from geneva_cli.numerics.jet import Jet, Number, integral, piecewise
from geneva_cli.numerics.roots import boundary
from geneva_cli.spec.rules import is_array
from geneva_cli.spec.schema import SpecTable, fields

if TYPE_CHECKING:
    from geneva_cli.numerics.spline import Doubt


class Law(SpecTable):
    """A motion law; its fields are the keys that it adds to ``[motion]``."""

    TABLE: ClassVar[str] = "motion"
    NAME: ClassVar[str]
    ABOUT: ClassVar[str]
    # reason in the warning that the law turns the wheel back
    TURNS_BACK: ClassVar[str] = "the law's points must not fall"
    # True if analytic between the breaks; a spline is not
    ANALYTIC: ClassVar[bool] = True

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of u inside 0..1 at which a derivative up to the fourth jumps, in order.

        >>> ModifiedSine().breaks
        (0.125, 0.875)
        """
        return ()

    @property
    def symmetric(self) -> Truth:
        """True if the second half mirrors the first; an array for a batch.

        >>> Cycloidal().symmetric, SineGroup(0.1).symmetric
        (True, False)
        """
        return True

    @property
    def knots(self) -> tuple[float, ...]:
        """Values of u inside 0..1 at which any derivative jumps; between them the law is analytic.

        >>> ModifiedSine().knots
        (0.125, 0.875)
        """
        return self.breaks

    def may_vary(self, table: str, key: str) -> bool:
        """True if a number of a table may be an array along a design axis with this law.

        >>> Cycloidal().may_vary("motion", "alpha0_deg")
        True
        """
        return True

    @property
    def tuned_to(self) -> float | None:
        """Period ratio at which the law leaves a load at rest; None for a law that is not tuned.

        >>> Cycloidal().tuned_to is None
        True
        """
        return None

    def doubt(self) -> Doubt | None:
        """Decimals of a law of points, and the effect of their rounding on d³s/du³; else None.

        >>> Cycloidal().doubt() is None
        True
        """
        return None

    @abstractmethod
    def first(self, u: Number, order: int) -> Jet:
        """Fraction s on 0 <= u <= 1/2, with its derivatives by u.

        >>> Polynomial345().first(0.5, 3).derivatives()  # s, ds/du and so on
        (0.5, 1.875, 0.0, -30.0)
        """

    def second(self, w: Number, order: int) -> Jet:
        """Remainder 1 - s on 0 <= w = 1 - u <= 1/2, with its derivatives by w.

        >>> law = SineGroup(0.1)
        >>> round(law.first(0.5, 0).c[0] + law.second(0.5, 0).c[0], 12)
        1.0
        """
        return self.first(w, order)

    @property
    def backwards(self) -> Law:
        """The law run backwards, 1 - s by 1 - u; a symmetric law is its own.

        >>> law = SineGroup(0.1)
        >>> round(law.backwards(0.25, 0).c[0] + law(0.75, 0).c[0], 12)
        1.0
        """
        return self if all_true(self.symmetric) else Backwards(self)

    @cached_property
    def varies(self) -> bool:
        """True if its numbers are arrays of a batch.

        >>> Cycloidal().varies
        False
        """
        return any(is_array(getattr(self, field.attribute)) for field in fields(type(self)))

    @cached_property
    def half_way(self) -> float:
        """Fraction of the motion time after which the wheel is half-way.

        It is 1/2 for a symmetric law by definition, since rounding may move the computed value.

        >>> Cycloidal().half_way
        0.5
        """
        even = self.symmetric
        if all_true(even):
            return 0.5
        first, last = choose(even, 0.5, 0.0), choose(even, 0.5, 1.0)
        return boundary(lambda u: self(u, 0).c[0] <= 0.5, first, last)

    def __call__(self, u: Number, order: int = 3) -> Jet:
        """Fraction s at a number or an array of u in 0..1, with its derivatives by u."""
        return piecewise(
            u,
            (0.5,),
            (lambda x: self.first(x, order), lambda x: remaining(self.second(1.0 - x, order))),
        )


class Backwards(Law):
    """A law run backwards: the halves of ``of`` change places. It is no kind of its own."""

    of: Law

    def __post_init__(self) -> None:
        super().__post_init__()
        # a law's class declares these
        own = {"NAME": f"{self.of.NAME}, backwards", "TURNS_BACK": self.of.TURNS_BACK}
        vars(self).update(own, ANALYTIC=self.of.ANALYTIC)

    @property
    def backwards(self) -> Law:
        return self.of

    @property
    def breaks(self) -> tuple[float, ...]:
        return tuple(1.0 - u for u in reversed(self.of.breaks))

    @property
    def knots(self) -> tuple[float, ...]:
        return tuple(1.0 - u for u in reversed(self.of.knots))

    @property
    def symmetric(self) -> Truth:
        return self.of.symmetric

    @property
    def varies(self) -> bool:
        return self.of.varies

    def may_vary(self, table: str, key: str) -> bool:
        return self.of.may_vary(table, key)

    def doubt(self) -> Doubt | None:
        return self.of.doubt()

    def first(self, u: Number, order: int) -> Jet:
        return self.of.second(u, order)

    def second(self, w: Number, order: int) -> Jet:
        return self.of.first(w, order)


def remaining(rest: Jet, end: float = 1.0) -> Jet:
    """Jet by u of ``end`` minus a remainder, from the remainder's jet by w, which runs backward."""
    return Jet([end - rest.c[0], *[c if k % 2 else 0.0 - c for k, c in enumerate(rest.c) if k]])


def from_velocity(
    u: Number, order: int, position: Callable[[Number], Number], velocity: Callable[[Jet], Jet]
) -> Jet:
    """Jet of s(u) from a closed form of s and from the jet of ds/du."""
    if order == 0:
        return Jet((position(u),))
    return integral(velocity(Jet.variable(u, order - 1)), position(u))
