"""The law ``scca``: sine, constant, cosine, in fractions of the time that the user chooses."""

from typing import Annotated, ClassVar

from geneva_cli.errors import GenevaError
from geneva_cli.motion.laws.law import Law
from geneva_cli.motion.laws.sine_constant_cosine import breaks, first_half
from geneva_cli.numerics.jet import Jet, Number
from geneva_cli.spec.rules import Range


class SineConstantCosine(Law):
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
    b: Annotated[float, Range(0.0, 1.0), "scca: time fraction of the sine (rising acceleration)"]
    c: Annotated[float, Range(0.0, 1.0), "scca: time fraction of constant acceleration"]
    d: Annotated[float, Range(0.0, 1.0), "scca: time fraction of the cosine; b + c + d = 1"]

    def __post_init__(self) -> None:
        super().__post_init__()
        whole = self.b + self.c + self.d
        # thirds are written with six digits
        if abs(whole - 1.0) > 2e-6:
            raise GenevaError(
                f"b + c + d = {whole:.9g} must be 1, the whole time: for example b = 0.25, "
                "c = 0.5, d = 0.25 for a modified trapezoid",
                (self.TABLE, "d"),
            )
        least = 1e-3  # in a shorter rise the jerk is as large as a jump
        for key, fraction in self.as_dict().items():
            if 0.0 < fraction < least:
                raise GenevaError(
                    f"{key} = {fraction:g} must be 0, for none, or at least {least:g}",
                    (self.TABLE, key),
                )

    def may_vary(self, table: str, key: str) -> bool:
        return table != "motion" or key not in self.as_dict()

    @property
    def _fractions(self) -> tuple[float, float]:
        """Fractions b and d of exactly the whole; without c, b is exactly 1 - d."""
        whole = self.b + self.c + self.d
        d = self.d / whole
        return (self.b / whole if self.c else 1.0 - d), d

    @property
    def breaks(self) -> tuple[float, ...]:
        return breaks(*self._fractions, 0.0)

    def first(self, u: Number, order: int) -> Jet:
        return first_half(u, order, *self._fractions)
