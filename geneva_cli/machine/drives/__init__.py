"""What turns the crank: one file a kind, named here.

Each module has ``Keys``, the keys it adds to ``[drive]``, and one of two functions:

- ``front(spec)``, where the roller is carried on the crank's circle: a function from the crank's
  angle in degrees to a ``Front``. Optional beside it: ``turns(keys)``, input turns in a turn of the
  crank (1), and ``reach_deg(keys)``, how far from mid-motion the crank may move the wheel (180);
- ``plan(spec)``, where the roller has a path of its own: a ``Plan``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

from geneva_cli.machine.engagement import Station
from geneva_cli.numerics.jet import Coefficient, Jet
from geneva_cli.spec.tables import Size

KINDS = {
    "crank": "crank",
    "side-crank": "side_crank",
    "elliptical-gears": "elliptical_gears",
    "noncircular-gears": "noncircular_gears",
    "geneva-pair": "geneva_pair",
    "four-bar": "four_bar",
    "slider-crank": "slider_crank",
    "epicyclic": "epicyclic",
    "gear-sector": "gear_sector",
    "cam": "cam",
}

UNLOCKED = ("four-bar", "slider-crank")  # whose crank is no disc about the line of centres
GEARED = ("elliptical-gears", "noncircular-gears")  # whose ratio is a pair of pitch curves


class Front(NamedTuple):
    """The gearing between input shaft and crank, about one crank angle."""

    input_deg: float  # input angle there
    # input angle since then, radians, and order -> sin d and 1 - cos d of the crank's angle d
    # since then, with their derivatives by the input angle
    advance: Callable[[Coefficient, int], tuple[Jet, Jet]]


class Plan(NamedTuple):
    """A machine whose roller has a path of its own: one station, and what its sizes become."""

    station: Station
    ratio: float  # l = R/L at mid-motion
    size: Size


# from a crank angle in degrees to the front about it
Turn: TypeAlias = Callable[[float], Front]
