"""The best design of a sweep: a scan of all designs, then a local refinement."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.fields import Cell, Pick
from geneva_cli.study.sweep.best_search import Row, SweepSearch
from geneva_cli.study.sweep.constraints import Constraint, Nearness, Objective, is_number
from geneva_cli.study.sweep.places import BestPlaces, closer
from geneva_cli.study.sweep.run import Sweep


class SearchGoal(NamedTuple):
    """The objective of a search, and the bounds that a design must keep.

    ``also`` are quantities that are computed for the best design only.
    """

    objective: Objective
    constraints: tuple[Constraint, ...]
    also: Pick


class Winner(NamedTuple):
    """The best design: its numbers by name, its machine, and counts of the search."""

    values: dict[str, float]
    mechanism: Mechanism
    tried: int
    feasible: int
    binding: tuple[Constraint, ...]
    extra: dict[str, Cell]  # the quantities of --pick and --check, which do not steer the search

    def lines(self, goal: SearchGoal) -> list[str]:
        """The design as the lines of a spec file, with the result in comments above it."""
        name = goal.objective.name
        word = "least" if goal.objective.sign > 0.0 else "greatest"
        notes = [
            f"# The {word} {name} of {self.tried:,} designs, {self.feasible:,} of them within the "
            f"bounds: {self.values[name]:.9g}.",
            *[
                f"# {c}: {self.values[c.name]:.9g}{c.standing(self.values[c.name])}"
                for c in goal.constraints
            ],
            *[f"# {name}: {_text(value)}" for name, value in self.extra.items()],
        ]
        spec = self.mechanism.spec
        # the spec's own title may describe what was varied
        title = f"{word.capitalize()} {name}, varied from: {spec.title}" if spec.title else ""
        return [*notes, *([f"title = {quoted(title)}"] if title else []), *spec_lines(spec)]


def winner(sweep: Sweep, row_blocks: Iterable[Sequence[Row]], goal: SearchGoal) -> Winner:
    """Return the best design of a sweep, whose rows come in blocks and are not kept.

    The spec's own design is tried too, if its values are among those varied. The keys that vary in
    a span are refined: first by clouds of designs that shrink about the best places, then by an
    optimiser from the best of these. Raises GenevaError if no design keeps the bounds; the message
    says how near the designs come.
    """
    search = SweepSearch(sweep, goal.objective, goal.constraints)
    tally = Tally(search)
    for rows in row_blocks:
        tally.add(rows)
    # a random sample comes near the spec's own design, but does not contain it
    if search.free and sweep.own_values is not None:
        tally.add([sweep.row(sweep.own_values)])
    places = closer(search, tally.places.best()) if search.free else tally.places.best()
    starts = [row for row in places if search.keeps(row)][:3]  # the best of them suffice
    if not starts:
        raise GenevaError(tally.none(places[0]))
    best = min((search.refined(row) for row in starts), key=search.cost)
    best = search.refined(best, reach=2e-3)  # onto the bounds that bind
    best = sweep.row(search.keys(best))  # computed again as a single design: this row is the result
    assert search.keeps(best), best
    values = dict(zip(sweep.names, best, strict=True))
    numbers = {name: float(v) for name, v in values.items() if is_number(v)}
    binding = tuple(c for c in goal.constraints if c.binds(numbers[c.name]))
    machine = sweep.machine(search.keys(best))
    extra = dict(zip(goal.also.names, goal.also.of(machine), strict=True))
    return Winner(numbers, machine, tally.tried, tally.feasible, binding, extra)


def _text(value: Cell) -> str:
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.9g}" if is_number(value) else str(value)


class Tally:
    """The best design of each place and the distance of all designs from the bounds, row by row."""

    def __init__(self, search: SweepSearch) -> None:
        self.search = search
        self.tried = self.feasible = 0
        self.places = BestPlaces(search)
        self.nearness = Nearness(search.bounds)

    def add(self, rows: Sequence[Row]) -> None:
        """Count rows, and keep the best of each place."""
        self.tried += len(rows)
        self.feasible += sum(map(self.search.keeps, rows))
        self.places.add(rows)
        self.nearness.add(rows)

    def none(self, near: Row) -> str:
        """The error message for a sweep in which no design keeps the bounds.

        ``near`` is the row that breaks them least.
        """
        why = self.nearness.phrases() or [f"no design has a value of {self.search.name}"]
        values = [(c.name, near[i]) for i, c in self.search.bounds]
        if len(values) > 1 and all(is_number(value) for _, value in values):
            texts = dict.fromkeys(f"{name} {value:.6g}" for name, value in values)
            why.append(f"the design that comes nearest to all has {', '.join(texts)}")
        return f"--best: none of {self.tried:,} designs is feasible: {'; '.join(why)}"
