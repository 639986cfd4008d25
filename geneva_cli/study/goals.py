"""Goals such as ``min:acceleration.max``: a quantity to minimise or to maximise."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut


class Objective(NamedTuple):
    """A quantity to minimise (sign 1) or to maximise (-1)."""

    sign: float
    name: str

    def __str__(self) -> str:
        return f"{'least' if self.sign > 0.0 else 'greatest'} {self.name}"


def objective(text: str, option: str) -> Objective:
    """Return the objective of ``min:acceleration.max``. Raises GenevaError for another text."""
    sense, _, name = text.strip().partition(":")
    sign = {"min": 1.0, "max": -1.0}.get(sense)
    if sign is None or not name:
        raise GenevaError(
            f"{option} {cut(text.strip())}: it must be min:FIELD or max:FIELD, as "
            "min:acceleration.max"
        )
    return Objective(sign, name)


def refuse_opposites(objectives: Sequence[Objective]) -> None:
    """Raise GenevaError for a quantity that is both minimised and maximised."""
    names = [o.name for o in dict.fromkeys(objectives)]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice:
        raise GenevaError(f"--pareto {twice}: it cannot be both min and max; keep one of them")
