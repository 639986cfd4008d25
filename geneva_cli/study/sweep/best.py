"""The best design of a sweep: a scan of all designs, then a local refinement."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.schema import TEXT_MAX
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.fields import Cell
from geneva_cli.study.sweep.best_search import Row, SweepSearch
from geneva_cli.study.sweep.constraints import Nearness, is_number
from geneva_cli.study.sweep.outcome import Outcome, Rows
from geneva_cli.study.sweep.places import BestPlaces, closer
from geneva_cli.study.sweep.request import SweepRequest


def best_spec(outcome: Outcome, row_blocks: Iterable[Rows]) -> list[str]:
    """Return the lines of a spec of the best design of a sweep; its rows are not kept.

    The spec's own design is tried too, if its values are among those varied. ``outcome`` counts the
    rows and the spec's own design. The keys that vary in a span are refined: first by clouds of
    designs that shrink about the best places, then by an optimiser from the best of these. Raises
    GenevaError if no design keeps the bounds; the message says how near the designs come.
    """
    request = outcome.request
    sweep = request.sweep
    search = SweepSearch(sweep, request.objectives[0], request.constraints)
    # a random sample comes near the spec's own design, but does not contain it
    own = sweep.own_values if search.free else None
    own_design = [] if own is None else [[sweep.row(own)]]
    tally = Tally(search)
    for rows in outcome.counted(chain(row_blocks, own_design)):
        tally.add(rows)
    places = closer(search, tally.places.best()) if search.free else tally.places.best()
    starts = [row for row in places if search.keeps(row)]
    if not starts:
        raise GenevaError(tally.none(places[0]))
    starts = starts[: 3 if sweep.is_batched else 1]  # the best of them suffice
    best = min((search.refined(row) for row in starts), key=search.cost)
    best = search.refined(best, reach=2e-3)  # onto the bounds that bind
    best = sweep.row(search.keys(best))  # computed again as a single design: this row is the result
    assert search.keeps(best), best
    values = {n: float(v) for n, v in zip(sweep.names, best, strict=True) if is_number(v)}
    return _lines(request, tally, values, sweep.machine(search.keys(best)))


def _lines(
    request: SweepRequest, tally: Tally, values: Mapping[str, float], machine: Mechanism
) -> list[str]:
    """A design as the lines of a spec file, with the result in comments above it."""
    sign, name = request.objectives[0]
    word = "least" if sign > 0.0 else "greatest"
    extra = zip(request.of_best.names, request.of_best.of(machine), strict=True)
    notes = [
        f"# The {word} {name} of {tally.tried:,} designs, {tally.feasible:,} of them within the "
        f"bounds: {values[name]:.9g}.",
        *[f"# {c}: {values[c.name]:.9g}{c.standing(values[c.name])}" for c in request.constraints],
        *[f"# {other}: {_text(value)}" for other, value in extra],
        *tally.search.left_out(),
    ]
    # the spec's own title may describe what was varied
    title = machine.spec.title and f"{word.capitalize()} {name}, varied from: {machine.spec.title}"
    title = cut(title, TEXT_MAX)
    return [*notes, *([f"title = {quoted(title)}"] if title else []), *spec_lines(machine.spec)]


def _text(value: Cell) -> str:
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return f"{value:.9g}" if is_number(value) else clean(str(value))


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
