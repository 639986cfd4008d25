"""The rows of a sweep as a search of the best sees them: costs, bounds, places between them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from geneva_cli.study.fields import Cell
from geneva_cli.study.goals import Objective
from geneva_cli.study.sweep.constraints import Constraint, is_number
from geneva_cli.study.sweep.run import Sweep
from geneva_cli.study.sweep.values import Value

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

Row: TypeAlias = Sequence[Cell]

EVALUATIONS = 300  # of the optimiser, from each start
WIDE, CLOSE = 0.05, 2e-3  # first steps, shares of the spans: from a place, and at the end
FINEST = 1e-9  # share of a key's range to which it is refined
# Share of a bound by which the optimiser stays inside, so that rounding does not leave it outside.
INSIDE = 1e-13
FAR = 1e3  # outside a bound, or above a cost: a design that cannot be built


class SweepSearch:
    """The rows of a sweep as an optimiser sees them: shares of the free keys' spans."""

    def __init__(
        self, found: Sweep, objective: Objective, constraints: Sequence[Constraint]
    ) -> None:
        self.found, self.sign, self.name = found, objective.sign, objective.name
        self.at = found.names.index(self.name)
        self.bounds = [(found.names.index(c.name), c) for c in constraints]
        axes = found.plan.axes
        self.free = [i for i, a in enumerate(axes) if a.span]
        ends = [axes[i].values for i in self.free]
        self.low, self.high = np.array(ends, dtype=float).reshape(-1, 2).T

    def keys(self, row: Row) -> list[Value]:
        """The values of the keys of a row."""
        return [v for v in row[: len(self.found.plan.axes)] if v is not None]

    def cost(self, row: Row) -> float:
        """What is to be small; infinite for a design that does not have it."""
        value = row[self.at]
        return self.sign * float(value) if is_number(value) else np.inf

    def keeps(self, row: Row) -> bool:
        """Whether a design has the objective and keeps all bounds."""
        return np.isfinite(self.cost(row)) and all(c.kept(row[i]) for i, c in self.bounds)

    def rooms(self, row: Row) -> list[float]:
        """How far inside each bound a design is; one without the quantity is far outside."""
        return [c.room(float(v)) if is_number(v := row[i]) else -FAR for i, c in self.bounds]

    def merit(self, row: Row) -> tuple[float, float]:
        """What is to be small of any design: how far it is outside the bounds, then its cost."""
        if self.keeps(row):
            return 0.0, self.cost(row)
        short = sum(max(0.0, -room) for room in self.rooms(row))
        return short + FAR * (self.cost(row) == np.inf) or FINEST, self.cost(row)

    def shares(self, row: Row) -> Array:
        """Where a design is in the spans of the free keys: 0 at the low end, 1 at the high."""
        keys = self.keys(row)
        here = np.array([float(keys[i]) for i in self.free])
        there: Array = (here - self.low) / (self.high - self.low)
        return there

    def moved(self, row: Row, x: Array) -> list[Value]:
        """The values of the keys of a design, with the free ones at these shares."""
        keys = self.keys(row)
        values = self.low + np.clip(x, 0.0, 1.0) * (self.high - self.low)
        for i, value in zip(self.free, values.tolist(), strict=True):
            keys[i] = value
        return keys

    def refined(self, start: Row, reach: float = WIDE) -> Row:
        """The best design that the optimiser comes by on its way from this one, or this one."""
        if not self.free:
            return start
        from scipy.optimize import NonlinearConstraint, minimize

        scale = abs(self.cost(start)) or 1.0
        seen: dict[bytes, Row] = {}

        def row(x: Array) -> Row:
            place = x.tobytes()
            if place not in seen:
                seen[place] = self.found.row(self.moved(start, x))
            return seen[place]

        rooms = NonlinearConstraint(lambda x: self.rooms(row(x)), INSIDE, np.inf)
        minimize(
            lambda x: min(self.cost(row(x)) / scale, FAR),
            self.shares(start),
            method="COBYQA",
            bounds=[(0.0, 1.0)] * len(self.free),
            constraints=[rooms] if self.bounds else [],
            options={"maxfev": EVALUATIONS, "initial_tr_radius": reach, "final_tr_radius": FINEST},
        )
        kept = [r for r in (start, *seen.values()) if self.keeps(r)]
        inside = [r for r in kept if min(self.rooms(r), default=0.0) >= 0.0]
        return min(inside or kept, key=self.cost)
