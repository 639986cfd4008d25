"""The motion that a spec gives: a law, and what it is scaled to."""

from __future__ import annotations

from typing import Annotated, ClassVar, Self

from geneva_cli.machine.laws.law import Law
from geneva_cli.spec.rules import FINITE, Range, Words
from geneva_cli.spec.schema import SpecTable, fields, refuse_kind, unknown


class Motion(SpecTable):
    """``[motion]``: present when the motion is given and the slots are solved for.

    ``law`` is the wheel's motion over its step; ``alpha0_deg`` lengthens the dwell, degrees, at the
    motion's cost; ``ratio`` is R/L of curved slots, "matched" the one at which the pressure angle
    stays below 90 degrees at mid-motion.

    >>> Design(External(6), motion=Motion(Cycloidal(), ratio="matched")).peaks.acceleration.max
    1.5
    """

    TABLE: ClassVar[str] = "motion"
    law: Law
    alpha0_deg: Annotated[float, FINITE, "extra dwell angle of the crank"] = 0.0
    ratio: Annotated[
        float | str | None,
        Words(Range(0.0, 1.0, "()"), ("matched",)),
        'R/L of curved slots, or "matched"',
    ] = None

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_kind(self.law, "law", Law, "Cycloidal()")

    def with_key(self, key: str, value: object) -> Self:
        """A copy with one key of the motion or of its law changed; None: its default.

        >>> Motion(SineGroup(0.1)).with_key("lambda", 0.05).law
        SineGroup(lambda_=0.05)
        """
        law, own = ([f.key for f in fields(type(part))] for part in (self.law, self))
        if key in law:
            return self.replace(law=self.law.with_key(key, value))
        if key not in own:
            raise unknown(key, self.TABLE, (*law, *own))
        return super().with_key(key, value)
