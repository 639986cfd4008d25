"""Motion of a wheel as its spec sets it: a law, an extra dwell angle and R/L."""

from typing import Annotated, ClassVar, Self

from geneva_cli.motion.laws.law import Law
from geneva_cli.spec.rules import FINITE, Range
from geneva_cli.spec.schema import SpecTable, fields, refuse_kind, unknown


class Motion(SpecTable):
    """``[motion]``: the wheel's motion law; the slots (or a cam drive's pin path) are solved for.

    ``law`` is the wheel's motion over its step. ``alpha0_deg`` is an extra dwell angle of the crank
    in degrees, which shortens the motion. ``ratio`` is R/L of curved slots; "matched" is the R/L at
    which the pressure angle stays below 90 degrees at mid-motion.

    >>> design = Design(External(6), motion=Motion(Cycloidal(), ratio="matched"))
    >>> round(design.peaks.acceleration.max, 12)
    1.5
    """

    TABLE: ClassVar[str] = "motion"
    law: Law
    alpha0_deg: Annotated[float, FINITE, "extra dwell angle of the crank"] = 0.0
    ratio: Annotated[
        float | str | None,
        Range(0.0, 1.0, "()", ("matched",)),
        'R/L of curved slots, or "matched" for a finite pressure angle',
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_kind(self.law, "law", Law, "Cycloidal()")

    @property
    def backwards(self) -> Self:
        """The motion that the same law gives a machine that turns the other way.

        >>> motion = Motion(SineGroup(0.1))
        >>> round(motion.law(0.5).c[0], 6), round(motion.backwards.law(0.5).c[0], 6)
        (0.364188, 0.635812)
        """
        return self.replace(law=self.law.backwards)

    def with_key(self, key: str, value: object) -> Self:
        """Return a copy with one key of the motion or of its law changed; None sets the default.

        >>> Motion(SineGroup(0.1)).with_key("lambda", 0.05).law
        SineGroup(lambda_=0.05)
        """
        law, own = ([f.key for f in fields(type(part))] for part in (self.law, self))
        if key in law:
            return self.replace(law=self.law.with_key(key, value))
        if key not in own:
            raise unknown(key, self.TABLE, (*law, *own))
        return super().with_key(key, value)
