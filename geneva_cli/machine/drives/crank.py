"""The input shaft carries the crank itself."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from geneva_cli.machine.drives import Front
from geneva_cli.numerics.jet import Coefficient, Jet, sine_versine
from geneva_cli.spec.tables import Spec


class Keys(NamedTuple):
    """No keys of its own."""


def front(spec: Spec) -> Callable[[float], Front]:
    """Crank angle and input angle are one."""
    return lambda crank_deg: Front(crank_deg, _same)


def _same(tau: Coefficient, order: int) -> tuple[Jet, Jet]:
    return sine_versine(Jet.variable(tau, order))
