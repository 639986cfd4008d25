"""What turns the crank: one file a kind, named here.

Each module has ``Keys``, the keys it adds to ``[drive]``, and ``front(keys)``, a function from
the crank's angle in degrees to a ``Front``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

from geneva_cli.jet import Coefficient, Jet

KINDS = {"crank": "crank", "side-crank": "side_crank"}


class Front(NamedTuple):
    """The gearing between input shaft and crank, about one crank angle."""

    input_deg: float  # input angle there
    # input angle since then, radians, and order -> sin d and 1 - cos d of the crank's angle d
    # since then, with their derivatives by the input angle
    advance: Callable[[Coefficient, int], tuple[Jet, Jet]]


# from a crank angle in degrees to the front about it
Turn: TypeAlias = Callable[[float], Front]
