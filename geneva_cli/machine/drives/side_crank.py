"""Side-crank drive (Whitworth's crank and rotating coulisse) in front of the crank.

The coulisse carries the Geneva crank. The symbols A and f follow Polyudov and Kandyak, "Kinematics
of the Maltese cross mechanism with a side-crank drive".
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, NamedTuple

from geneva_cli.machine.drives import Front
from geneva_cli.machine.whitworth import coulisse
from geneva_cli.spec.rules import Range
from geneva_cli.spec.tables import Spec


class Keys(NamedTuple):
    """The keys that ``kind = "side-crank"`` adds."""

    A: Annotated[
        float, Range(-1.0, 1.0, "()"), "side-crank: base offset / crank length; > 0 is slower"
    ]


def front(spec: Spec) -> Callable[[float], Front]:
    """Front about a crank (coulisse) angle f in degrees."""
    assert isinstance(spec.kind, Keys)
    return coulisse(spec.kind.A)
