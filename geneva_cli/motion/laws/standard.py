"""The motion laws in closed form: those of VDI 2143, MCV50, scca, and Krasniqi's sine group."""

from functools import reduce
from operator import mul
from typing import Annotated, ClassVar

from geneva_cli.errors import GenevaError
from geneva_cli.motion.laws.law import Law, from_velocity
from geneva_cli.motion.laws.sine_constant_cosine import breaks, first_half
from geneva_cli.numerics.arrays import library
from geneva_cli.numerics.jet import Jet, Number, sin, sin_cos, taylor
from geneva_cli.spec.rules import Range


class Cycloidal(Law):
    """Inclined sine line: ds/du = 2 sin²(pi u).

    Acceleration starts and ends at 0.

    >>> round(Cycloidal()(0.5).c[1], 6)  # ds/du at its greatest
    2.0
    """

    NAME: ClassVar[str] = "cycloidal"
    ABOUT: ClassVar[str] = "inclined sine line; no jump in acceleration"

    def first(self, u: Number, order: int) -> Jet:
        m = library(u)

        def velocity(u: Jet) -> Jet:
            s = sin(u * m.pi)
            return s * s * 2.0

        return from_velocity(u, order, lambda u: u - m.sin(2.0 * m.pi * u) / (2.0 * m.pi), velocity)


class _ScaledLaw(Law):
    """A law whose acceleration is a sine, a constant and a cosine in fixed time fractions."""

    # fractions of the sine and the cosine, and of constant velocity in the middle; they may be set
    # as a law is made
    FRACTIONS: ClassVar[tuple[float, float, float]]

    @property
    def breaks(self) -> tuple[float, ...]:
        return breaks(*self.FRACTIONS)

    def first(self, u: Number, order: int) -> Jet:
        return first_half(u, order, *self.FRACTIONS)


class Harmonic(_ScaledLaw):
    """Simple sine line: ds/du = (pi/2) sin(pi u).

    Acceleration jumps at both ends, by pi²/2.

    >>> round(Harmonic()(0.5).c[1], 6)  # ds/du at its greatest
    1.570796
    """

    NAME: ClassVar[str] = "harmonic"
    ABOUT: ClassVar[str] = "simple sine line; its acceleration jumps at both ends"
    FRACTIONS: ClassVar[tuple[float, float, float]] = (0.0, 1.0, 0.0)


class SineConstantCosine(_ScaledLaw):
    """Sine, constant and cosine acceleration in fractions b, c and d of the time.

    Special cases (b, c, d):

    - (0, 0, 1): harmonic
    - (1/2, 0, 1/2): cycloidal
    - (1/4, 0, 3/4): modified sine
    - (1/4, 1/2, 1/4): modified trapezoid
    - (0, 1, 0): constant acceleration

    >>> SineConstantCosine(b=0.25, c=0.5, d=0.25)(0.125, 2).derivatives()[2]  # 8 pi / (2 + pi)
    4.88812...
    """

    NAME: ClassVar[str] = "scca"
    ABOUT: ClassVar[str] = "your own: fractions b of sine, c of constant, d of cosine acceleration"
    SHARED: ClassVar[tuple[str, ...]] = ("b", "c", "d")  # they decide the pieces
    b: Annotated[float, Range(0.0, 1.0), "scca: time fraction of the sine (rising acceleration)"]
    c: Annotated[float, Range(0.0, 1.0), "scca: time fraction of constant acceleration"]
    d: Annotated[float, Range(0.0, 1.0), "scca: time fraction of the cosine; b + c + d = 1"]

    def __post_init__(self) -> None:
        super().__post_init__()
        whole = self.b + self.c + self.d
        # thirds are written with six digits
        if abs(whole - 1.0) > 2e-6:
            text = f"b + c + d = {whole:.9g} must be 1, the whole time, as 0.25, 0.5 and 0.25"
            raise GenevaError(text, (self.TABLE, "d"))
        least = 1e-3  # in a shorter rise the jerk is as large as a jump
        for key, fraction in self.as_dict().items():
            if 0.0 < fraction < least:
                text = f"{key} = {fraction:g} must be 0, for none, or at least {least:g}"
                raise GenevaError(text, (self.TABLE, key))

        # of exactly the whole; without c, b is exactly 1 - d
        d = self.d / whole
        b = self.b / whole if self.c else 1.0 - d
        vars(self)["FRACTIONS"] = b, d, 0.0


class ModifiedTrapezoid(_ScaledLaw):
    """Modified acceleration trapezoid: constant acceleration, joined by quarter sines.

    It has the lowest acceleration peak of the laws here, 4.888.

    >>> round(ModifiedTrapezoid()(0.5).c[1], 6)  # ds/du at its greatest
    2.0
    """

    NAME: ClassVar[str] = "modified-trapezoid"
    ABOUT: ClassVar[str] = "constant acceleration joined by sines; the lowest peak without a jump"
    # a sine to u = 1/8, constant acceleration to 3/8, a cosine to the middle
    FRACTIONS: ClassVar[tuple[float, float, float]] = (0.25, 0.25, 0.0)


class ModifiedSine(_ScaledLaw):
    """Modified sine line: sine acceleration of period 1/2 for u < 1/8, then of period 3/2.

    It has the lowest velocity peak, 1.760, of the laws here without a jump in acceleration.

    >>> round(ModifiedSine()(0.5).c[1], 6)  # ds/du at its greatest
    1.759603
    """

    NAME: ClassVar[str] = "modified-sine"
    ABOUT: ClassVar[str] = "sines of two periods; a low peak of velocity and of torque"
    # the fast sine to u = 1/8, the slow one to the middle
    FRACTIONS: ClassVar[tuple[float, float, float]] = (0.25, 0.75, 0.0)


class ModifiedConstantVelocity(_ScaledLaw):
    """MCV50: the modified sine's acceleration in half the time, constant velocity between.

    It has the lowest velocity peak of the laws here, and the greatest jerk.

    >>> [round(c, 5) for c in ModifiedConstantVelocity()(0.5, 2).derivatives()]
    [0.5, 1.27526, 0.0]
    """

    NAME: ClassVar[str] = "mcv50"
    ABOUT: ClassVar[str] = "modified sine with constant velocity for half the time"
    # the fast sine to u = 1/16, the slow one to 1/4, constant velocity to the middle
    FRACTIONS: ClassVar[tuple[float, float, float]] = (0.25, 0.75, 0.5)


class _Polynomial(Law):
    """A law with ds/du in proportion to (u (1-u))^n, n = 2 or 3."""

    TERMS: ClassVar[tuple[float, ...]]  # of s over u^(n+1), the constant first

    def first(self, u: Number, order: int) -> Jet:
        n = len(self.TERMS)

        def velocity(u: Jet) -> Jet:
            w = u * (1.0 - u)
            return reduce(mul, (n - 1) * [w]) * (n * self.TERMS[0])

        return from_velocity(u, order, lambda u: u**n * taylor(u, self.TERMS, 0)[0], velocity)


class Polynomial345(_Polynomial):
    """Polynomial 3-4-5: ds/du = 30 u² (1-u)².

    Acceleration starts and ends at 0.

    >>> round(Polynomial345()(0.5).c[1], 6)  # ds/du at its greatest
    1.875
    """

    NAME: ClassVar[str] = "3-4-5"
    ABOUT: ClassVar[str] = "polynomial of degree 5; no jump in acceleration"
    TERMS: ClassVar[tuple[float, ...]] = (10.0, -15.0, 6.0)


class Polynomial4567(_Polynomial):
    """Polynomial 4-5-6-7: ds/du = 140 u³ (1-u)³.

    Jerk starts and ends at 0.

    >>> round(Polynomial4567()(0.5).c[1], 6)  # ds/du at its greatest
    2.1875
    """

    NAME: ClassVar[str] = "4-5-6-7"
    ABOUT: ClassVar[str] = "polynomial of degree 7; no jump in jerk"
    TERMS: ClassVar[tuple[float, ...]] = (35.0, -84.0, 70.0, -20.0)


class SineGroup(Law):
    """Krasniqi's law: ds/du = (8/3) sin⁴ x (1 - 8 lambda cos x), x = pi u.

    All derivatives from velocity to snap vanish at both ends. The wheel turns back if |lambda| >
    1/8.

    >>> round(SineGroup(0.1)(0.5).c[1], 6)
    2.666667
    """

    NAME: ClassVar[str] = "sine-group"
    ABOUT: ClassVar[str] = "four sines; no jump up to snap; lambda tilts it, |lambda| <= 1/8"
    lambda_: Annotated[float, Range(-10.0, 10.0), "shape parameter of the sine-group law"] = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        vars(self)["symmetric"] = self.lambda_ == 0.0

    def first(self, u: Number, order: int) -> Jet:
        return _tilted(u, order, self.lambda_)

    def second(self, w: Number, order: int) -> Jet:
        return _tilted(w, order, -self.lambda_)


def _tilted(u: Number, order: int, shape: Number) -> Jet:
    m = library(u)

    def position(u: Number) -> Number:
        x = m.pi * u
        even = x - 2.0 * m.sin(2.0 * x) / 3.0 + m.sin(4.0 * x) / 12.0
        return (even - 64.0 * shape * m.sin(x) ** 5 / 15.0) / m.pi

    def velocity(u: Jet) -> Jet:
        s, c = sin_cos(u * m.pi)
        squared = s * s
        out: Jet = squared * squared * (1.0 - c * (8.0 * shape)) * 8.0 / 3.0
        return out

    return from_velocity(u, order, position, velocity)
