"""The best of a sweep: found by looking everywhere, then refined where it was found."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.specfile.writer import quoted, written
from geneva_cli.study.fields import Cell
from geneva_cli.study.sweep.constraints import Constraint, Nearness, is_number
from geneva_cli.study.sweep.front import Objective
from geneva_cli.study.sweep.run import Sweep
from geneva_cli.study.sweep.values import Value

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

Row: TypeAlias = Sequence[Cell]

STARTS = 3  # of the best designs of the scan, from each of which the optimiser sets out
EVALUATIONS = 300  # of the optimiser, from each start
FINEST = 1e-9  # share of a key's range to which it is refined
FAR = 1e3  # outside a bound, or above a cost: a design that cannot be built


class Asked(NamedTuple):
    """What is wanted of the designs of a sweep: an objective, within bounds."""

    objective: Objective
    constraints: tuple[Constraint, ...]


class Winner(NamedTuple):
    """The best design: its numbers by name, its machine, and how it was found."""

    values: dict[str, float]
    mechanism: Mechanism
    tried: int
    feasible: int
    binding: tuple[Constraint, ...]

    def lines(self, asked: Asked) -> list[str]:
        """The design as a spec, what it is the best of in a comment above it."""
        name = asked.objective.name
        word = "least" if asked.objective.sign > 0.0 else "greatest"
        notes = [
            f"# The {word} {name} of {self.tried:,} designs, {self.feasible:,} of them within the "
            f"bounds: {self.values[name]:.9g}.",
            *[
                f"# {c}: {self.values[c.name]:.9g}{' (binds)' * c.binds(self.values[c.name])}"
                for c in asked.constraints
            ],
        ]
        spec = self.mechanism.spec
        title = [f"title = {quoted(spec.title)}"] if spec.title else []
        return [*notes, *title, *written(spec)]


def winner(found: Sweep, every: Iterable[Sequence[Row]], asked: Asked) -> Winner:
    """The best of the rows of a sweep, which come some at a time and are not kept.

    It is refined over those of its keys that were given as spans. Raises GenevaError, saying how
    near the designs come, where none keeps the bounds.
    """
    search = SweepSearch(found, asked)
    tally = Tally(search)
    for rows in every:
        tally.add(rows)
    if not tally.first:
        raise GenevaError(tally.none())
    best = min((search.refined(row) for row in tally.first), key=search.cost)
    best = found.row(search.keys(best))  # built alone, which is what counts
    assert search.keeps(best), best
    values = dict(zip(found.names, best, strict=True))
    numbers = {name: float(v) for name, v in values.items() if is_number(v)}
    binding = tuple(c for c in asked.constraints if c.binds(numbers[c.name]))
    return Winner(numbers, found.machine(search.keys(best)), tally.tried, tally.feasible, binding)


class SweepSearch:
    """The rows of a sweep as an optimiser sees them: shares of the free keys' spans."""

    def __init__(self, found: Sweep, asked: Asked) -> None:
        self.found, self.sign = found, asked.objective.sign
        self.name = asked.objective.name
        self.at = found.names.index(self.name)
        self.bounds = [(found.names.index(c.name), c) for c in asked.constraints]
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

    def refined(self, start: Row) -> Row:
        """The best design that the optimiser comes by on its way from this one, or this one."""
        if not self.free:
            return start
        from scipy.optimize import NonlinearConstraint, minimize

        scale = abs(self.cost(start)) or 1.0
        keys = self.keys(start)
        seen: dict[bytes, Row] = {}

        def row(x: Array) -> Row:
            place = x.tobytes()
            if place not in seen:
                values = self.low + np.clip(x, 0.0, 1.0) * (self.high - self.low)
                here = keys.copy()
                for i, value in zip(self.free, values.tolist(), strict=True):
                    here[i] = value
                seen[place] = self.found.row(here)
            return seen[place]

        first = np.array([float(keys[i]) for i in self.free])
        rooms = NonlinearConstraint(lambda x: self.rooms(row(x)), 0.0, np.inf)
        minimize(
            lambda x: min(self.cost(row(x)) / scale, FAR),
            (first - self.low) / (self.high - self.low),
            method="COBYQA",
            bounds=[(0.0, 1.0)] * len(self.free),
            constraints=[rooms] if self.bounds else [],
            options={"maxfev": EVALUATIONS, "initial_tr_radius": 0.05, "final_tr_radius": FINEST},
        )
        return min((r for r in (start, *seen.values()) if self.keeps(r)), key=self.cost)


class Tally:
    """What is kept of rows that go by: the ``first`` few of the best, and how near others come."""

    def __init__(self, search: SweepSearch) -> None:
        self.search = search
        self.tried = self.feasible = 0
        self.first: list[Row] = []
        self.nearness = Nearness(search.bounds)

    def add(self, rows: Sequence[Row]) -> None:
        """More rows."""
        kept = [row for row in rows if self.search.keeps(row)]
        self.tried += len(rows)
        self.feasible += len(kept)
        # the first of equals stays first
        self.first = sorted((*self.first, *kept), key=self.search.cost)[:STARTS]
        self.nearness.add(rows)

    def none(self) -> str:
        """What to say where no design keeps the bounds."""
        why = "; ".join(self.nearness.said()) or f"{self.search.name} is known of none"
        return f"--best: none of {self.tried:,} designs will do: {why}"
