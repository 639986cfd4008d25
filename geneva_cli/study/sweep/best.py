"""The best of a sweep: found by looking everywhere, then refined where it was found."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.specfile.writer import quoted, written
from geneva_cli.study.fields import Cell
from geneva_cli.study.goals import Objective
from geneva_cli.study.sweep.best_search import CLOSE, Row, SweepSearch
from geneva_cli.study.sweep.constraints import Constraint, Nearness, is_number
from geneva_cli.study.sweep.places import Places, closer
from geneva_cli.study.sweep.run import Sweep

STARTS = 3  # of the best places, from each of which the optimiser sets out


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
    beside: dict[str, Cell]  # quantities that were asked for beside

    def lines(self, asked: Asked) -> list[str]:
        """The design as a spec, what it is the best of in a comment above it."""
        name = asked.objective.name
        word = "least" if asked.objective.sign > 0.0 else "greatest"
        notes = [
            f"# The {word} {name} of {self.tried:,} designs, {self.feasible:,} of them within the "
            f"bounds: {self.values[name]:.9g}.",
            *[
                f"# {c}: {self.values[c.name]:.9g}{c.standing(self.values[c.name])}"
                for c in asked.constraints
            ],
            *[f"# {name}: {_said(value)}" for name, value in self.beside.items()],
        ]
        spec = self.mechanism.spec
        # its title may tell what was varied
        title = f"{word.capitalize()} {name}, varied from: {spec.title}" if spec.title else ""
        return [*notes, *([f"title = {quoted(title)}"] if title else []), *written(spec)]


def winner(found: Sweep, every: Iterable[Sequence[Row]], asked: Asked) -> Winner:
    """The best of the rows of a sweep, which come some at a time and are not kept.

    The spec's own design is tried too, where it lies in what is varied. The best is refined over
    those of its keys that were given as spans: from the best places by clouds of designs that draw
    together, from the best of these by an optimiser. Raises GenevaError, saying how near the
    designs come, where none keeps the bounds.
    """
    search = SweepSearch(found, asked.objective, asked.constraints)
    tally = Tally(search)
    for rows in every:
        tally.add(rows)
    if search.free and found.given is not None:  # a cloud comes near the spec's design, not to it
        tally.add([found.row(found.given)])
    places = closer(search, tally.places.best()) if search.free else tally.places.best()
    starts = [row for row in places if search.keeps(row)][:STARTS]
    if not starts:
        raise GenevaError(tally.none(places[0]))
    best = min((search.refined(row) for row in starts), key=search.cost)
    best = search.refined(best, CLOSE)  # onto the bounds that bind
    best = found.row(search.keys(best))  # built alone, which is what counts
    assert search.keeps(best), best
    values = dict(zip(found.names, best, strict=True))
    numbers = {name: float(v) for name, v in values.items() if is_number(v)}
    binding = tuple(c for c in asked.constraints if c.binds(numbers[c.name]))
    machine = found.machine(search.keys(best))
    also = found.of_best
    beside = dict(zip(also.names, also.of(machine), strict=True)) if also else {}
    return Winner(numbers, machine, tally.tried, tally.feasible, binding, beside)


def _said(value: Cell) -> str:
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.9g}" if is_number(value) else str(value)


class Tally:
    """What is kept of rows that go by: the best ``places``, and how near others come."""

    def __init__(self, search: SweepSearch) -> None:
        self.search = search
        self.tried = self.feasible = 0
        self.places = Places(search)
        self.nearness = Nearness(search.bounds)

    def add(self, rows: Sequence[Row]) -> None:
        """More rows."""
        self.tried += len(rows)
        self.feasible += sum(map(self.search.keeps, rows))
        self.places.add(rows)
        self.nearness.add(rows)

    def none(self, near: Row) -> str:
        """What to say where no design keeps the bounds; ``near`` breaks them least."""
        why = self.nearness.said() or [f"no design has a value of {self.search.name}"]
        values = [(c.name, near[i]) for i, c in self.search.bounds]
        if len(values) > 1 and all(is_number(value) for _, value in values):
            told = dict.fromkeys(f"{name} {value:.6g}" for name, value in values)
            why.append(f"the design that comes nearest to all has {', '.join(told)}")
        return f"--best: none of {self.tried:,} designs is feasible: {'; '.join(why)}"
