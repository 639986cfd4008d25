"""The characteristic values of the motion laws: C_v, C_a, C_j and C_p."""

from __future__ import annotations

import math
from typing import NamedTuple

from geneva_cli.analysis.peaks import peak
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Anchor, LawDriven
from geneva_cli.machine.laws.standard import LAWS, Law, named
from geneva_cli.numerics.jet import Coefficient, Jet
from geneva_cli.table import Table, rows_table

NAMES = ("law", "C_v", "C_a", "C_j", "C_p", "about")


class Characteristic(NamedTuple):
    """Greatest sizes of ds/du, d²s/du², d³s/du³ and ds/du times d²s/du²."""

    velocity: float
    acceleration: float
    jerk: float
    power: float


def _nowhere(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
    return Jet.variable(tau, order), Jet.variable(tau, order)


def characteristic(law: Law) -> Characteristic:
    """The characteristic values of one law, from the same root finding as a machine's peaks."""
    # A step of 1 in a motion of 1 radian: the invariants are then the law's own derivatives.
    nowhere = Anchor(0.0, 0.0, 0.0, _nowhere)
    station = LawDriven(0.0, math.degrees(1.0), 0.5, law, nowhere)
    return Characteristic(*[peak(station, name).max for name in Characteristic._fields])


def laws_table(shape: float) -> Table:
    """One row a law; ``shape`` is the sine group's lambda."""
    if not abs(shape) <= 10.0:
        raise GenevaError(f"--lambda {shape:g}: must be at least -10, at most 10")
    rows: list[tuple[object, ...]] = []
    for name in LAWS:
        law = named(name, shape if name == "sine-group" else 0.0)
        rows.append((name, *characteristic(law), law.about))
    rows.append(("table", None, None, None, None, "your own: a CSV of u,s points, file = ..."))
    return rows_table(NAMES, rows)
