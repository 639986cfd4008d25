"""Objective, bounds and free keys of a sweep, in the form that an optimiser takes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np

from geneva_cli.numerics.jet import Array
from geneva_cli.progress import Meter
from geneva_cli.study.fields import Cell
from geneva_cli.study.sweep.constraints import Constraint, Objective, is_number
from geneva_cli.study.sweep.run import Sweep
from geneva_cli.study.sweep.values import Value

Row: TypeAlias = Sequence[Cell]

MOST = 300  # designs of one run of the optimiser, far more than it needs with one or two keys
# The same where each design is computed alone, often with its parts: up to half a minute a run. It
# then has some three digits of the keys.
MOST_ALONE = 40

FAR = 1e3  # violation, or scaled cost, of a design that cannot be built


class SweepSearch:
    """The rows of a sweep for an optimiser, with free keys as fractions of their spans."""

    def __init__(
        self, sweep: Sweep, objective: Objective, constraints: Sequence[Constraint]
    ) -> None:
        self.sweep, self.sign, self.name = sweep, objective.sign, objective.name
        self.at = sweep.names.index(self.name)
        self.bounds = [(sweep.names.index(c.name), c) for c in constraints]
        axes = sweep.plan.axes
        self.free = [i for i, a in enumerate(axes) if a.span]
        ends = [axes[i].values for i in self.free]
        self.low, self.high = np.array(ends, dtype=float).reshape(-1, 2).T
        self.most = MOST if sweep.is_batched else MOST_ALONE
        self.is_cut_short = False  # True once the optimiser has reached that number

    def keys(self, row: Row) -> list[Value]:
        """The values of the varied keys of a row."""
        return [v for v in row[: len(self.sweep.plan.axes)] if v is not None]

    def cost(self, row: Row) -> float:
        """The objective, signed so that it is minimised; infinite for a design that lacks it."""
        value = row[self.at]
        return self.sign * float(value) if is_number(value) else np.inf

    def keeps(self, row: Row) -> bool:
        """Return True if a design has the objective and keeps all bounds."""
        return np.isfinite(self.cost(row)) and all(c.kept(row[i]) for i, c in self.bounds)

    def margins(self, row: Row) -> list[float]:
        """The relative margins to the bounds; -FAR for a design without the quantity."""
        return [c.margin(float(v)) if is_number(v := row[i]) else -FAR for i, c in self.bounds]

    def merit(self, row: Row) -> tuple[float, float]:
        """The violation of the bounds, then the cost: the smaller pair is the better design."""
        if self.keeps(row):
            return 0.0, self.cost(row)
        short = sum(max(0.0, -margin) for margin in self.margins(row))
        # a design outside by rounding alone is still outside
        return short + FAR * (self.cost(row) == np.inf) or 1e-9, self.cost(row)

    def fractions(self, row: Row) -> Array:
        """The free keys of a design as fractions of their spans: 0 is low, 1 is high."""
        keys = self.keys(row)
        here = np.array([float(keys[i]) for i in self.free])
        there: Array = (here - self.low) / (self.high - self.low)
        return there

    def moved(self, row: Row, x: Array) -> list[Value]:
        """The values of the keys of a design, with its free keys at the fractions ``x``."""
        keys = self.keys(row)
        values = self.low + np.clip(x, 0.0, 1.0) * (self.high - self.low)
        for i, value in zip(self.free, values.tolist(), strict=True):
            keys[i] = value
        return keys

    def refined(self, start: Row, reach: float = 0.05) -> Row:
        """The best design among a start and all that the optimiser evaluates from there.

        ``reach`` is the optimiser's first step as a fraction of the spans.
        """
        if not self.free:
            return start
        from scipy.optimize import NonlinearConstraint, minimize

        meter = Meter("designs near the best", self.most)
        scale = abs(self.cost(start)) or 1.0
        evaluated: dict[bytes, Row] = {}

        def row(x: Array) -> Row:
            place = x.tobytes()
            if place not in evaluated:
                evaluated[place] = self.sweep.row(self.moved(start, x))
                meter.report(len(evaluated))
            return evaluated[place]

        margin = 1e-13  # fraction of a bound, so that rounding does not leave a design outside
        margins = NonlinearConstraint(lambda x: self.margins(row(x)), margin, np.inf)
        minimize(
            lambda x: min(self.cost(row(x)) / scale, FAR),
            self.fractions(start),
            method="COBYQA",
            bounds=[(0.0, 1.0)] * len(self.free),
            constraints=[margins] if self.bounds else [],
            # a bound that binds is met to the last step
            options={"maxfev": self.most, "initial_tr_radius": reach, "final_tr_radius": 1e-12},
        )
        meter.close()
        self.is_cut_short |= len(evaluated) >= self.most
        kept = [r for r in (start, *evaluated.values()) if self.keeps(r)]
        inside = [r for r in kept if min(self.margins(r), default=0.0) >= 0.0]
        return min(inside or kept, key=self.cost)

    def left_out(self) -> list[str]:
        """A comment that says which part of the search was left out, if any."""
        if not self.is_cut_short:
            return []
        alone = "" if self.sweep.is_batched else ", as each is computed alone"
        return [
            f"# The search near the best ended after {self.most} designs{alone}: for more digits "
            "give a narrower range."
        ]
