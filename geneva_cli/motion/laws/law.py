"""The base of the motion laws s(u), and the table of a spec that has one.

s is the fraction of the step by the fraction u of the motion's time. The second half of a law is
the remainder 1 - s by the time w = 1 - u left: both ends are exact.
"""

from abc import abstractmethod
from collections.abc import Callable, Mapping
from typing import Annotated, Any, ClassVar, Self

from geneva_cli.kept import cached_property
from geneva_cli.numerics.arrays import Truth, all_true, choose
from geneva_cli.numerics.jet import Jet, Number, integral, piecewise
from geneva_cli.numerics.roots import boundary
from geneva_cli.spec.rules import Range, is_array
from geneva_cli.spec.schema import Field, SpecTable, fields, refuse_kind


class Law(SpecTable, table="motion"):
    """A motion law; its fields are the keys that it adds to ``[motion]``."""

    NAME: ClassVar[str]
    ABOUT: ClassVar[str]
    # True if the second half mirrors the first, an array for a batch; set where keys decide it
    symmetric: ClassVar[Truth] = True
    # True if analytic between the breaks; a spline is not
    ANALYTIC: ClassVar[bool] = True

    @property
    def breaks(self) -> tuple[float, ...]:
        """Values of u inside 0..1 at which a derivative up to the fourth jumps, in order."""
        return ()

    @property
    def knots(self) -> tuple[float, ...]:
        """Values of u inside 0..1 at which any derivative jumps; the law is analytic between."""
        return self.breaks

    def doubt(self) -> tuple[int, float] | None:
        """Decimals of a law of points, and the effect of their rounding on d³s/du³; else None."""
        return None

    @abstractmethod
    def first(self, u: Number, order: int) -> Jet:
        """Fraction s on 0 <= u <= 1/2, with its derivatives by u."""

    def second(self, w: Number, order: int) -> Jet:
        """Remainder 1 - s on 0 <= w = 1 - u <= 1/2, with its derivatives by w."""
        return self.first(w, order)

    @cached_property
    def varies(self) -> bool:
        """True if its numbers are arrays of a batch."""
        return any(is_array(getattr(self, field.attribute)) for field in fields(type(self)))

    @cached_property
    def half_way(self) -> float:
        """Fraction of the motion time after which the wheel is half-way."""
        even = self.symmetric
        if all_true(even):  # by definition, as rounding may move the computed value
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


class Motion(SpecTable, table="motion"):
    """``[motion]``: the wheel's motion law; the slots (or a cam drive's pin path) are solved for.

    ``law`` is the wheel's motion over its step. ``alpha0_deg`` is an extra dwell angle of the crank
    in degrees, which shortens the motion. ``ratio`` is R/L of curved slots; "matched" is the R/L at
    which the pressure angle stays below 90 degrees at mid-motion.

    >>> design = Design(External(6), motion=Motion(Cycloidal(), ratio="matched"))
    >>> round(design.peaks.acceleration.max, 12)
    1.5
    """

    law: Law
    alpha0_deg: Annotated[float, Range(-360.0, 360.0), "extra dwell angle of the crank"] = 0.0
    ratio: Annotated[
        float | str | None,
        Range(0.0, 1.0, "()", ("matched",)),
        'R/L of curved slots, or "matched" for a finite pressure angle',
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_kind(self.law, "law", Law, "Cycloidal()")

    def _own_keys(self) -> dict[str, Field]:
        return self.law._own_keys() | super()._own_keys()

    def as_dict(self) -> dict[str, Any]:
        """Values of the law and of the motion by key.

        >>> Motion(SineGroup(0.1)).as_dict()
        {'lambda': 0.1, 'alpha0_deg': 0.0, 'ratio': None}
        """
        return self.law.as_dict() | super().as_dict()

    def with_keys(self, values: Mapping[str, Any]) -> Self:
        """Return a copy with keys of the motion or of its law changed; None sets the default.

        >>> Motion(SineGroup(0.1)).with_keys({"lambda": 0.05}).law
        SineGroup(lambda_=0.05)
        """
        own = dict(values)
        law = {key: own.pop(key) for key in self.law._own_keys() if key in own}
        changed = super().with_keys(own)
        return changed.replace(law=self.law.with_keys(law)) if law else changed
