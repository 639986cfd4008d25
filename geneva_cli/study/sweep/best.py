"""The best design of a sweep: a scan of all designs, then a local refinement."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from typing import NamedTuple, TypeAlias

import numpy as np

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.numerics.jet import Array
from geneva_cli.progress import Meter, tracked
from geneva_cli.spec.schema import TEXT_MAX
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.rows import Cell, Rows, rows_of
from geneva_cli.study.sweep.constraints import Nearness, is_number
from geneva_cli.study.sweep.request import Outcome, SweepRequest
from geneva_cli.study.sweep.values import Value

Row: TypeAlias = Sequence[Cell]

MOST = 300  # designs of one run of the optimiser, far more than it needs with one or two keys
# The same where each design is computed alone, often with its parts: up to half a minute a run. It
# then has some three digits of the keys.
MOST_ALONE = 40
FAR = 1e3  # violation, or scaled cost, of a design that cannot be built
PLACES_MAX = 24  # that are kept and refined


def best_spec(outcome: Outcome, row_blocks: Iterable[Rows]) -> list[str]:
    """Return the lines of a spec of the best design of a sweep; its rows are not kept.

    The spec's own design is tried too, if its values are among those varied. ``outcome`` counts the
    rows and the spec's own design. The keys that vary in a span are refined: first by clouds of
    designs that shrink about the best places, then by an optimiser from the best of these. Raises
    GenevaError if no design keeps the bounds; the message says how near the designs come.
    """
    request = outcome.request
    sweep, search = request.sweep, _SweepSearch(request)
    # a random sample comes near the spec's own design, but does not contain it
    own = sweep.own_values if search.free else None
    own_design = [] if own is None else [rows_of([sweep.row(own)])]
    places, nearness = _BestPlaces(search), Nearness(search.bounds)
    tried = feasible = 0
    for rows in outcome.counted(chain(row_blocks, own_design)):
        tried += len(rows)
        feasible += sum(map(search.keeps, rows))
        places.add(rows)
        nearness.add(rows.numbers)
    found = search.closer(places.best()) if search.free else places.best()
    starts = [row for row in found if search.keeps(row)]
    if not starts:
        raise GenevaError(_none(search, nearness, tried, found[0]))
    starts = starts[: 3 if sweep.is_batched else 1]  # the best of them suffice
    best = min((search.refined(row) for row in starts), key=search.cost)
    best = search.refined(best, reach=2e-3)  # onto the bounds that bind
    best = sweep.row(search.keys(best))  # computed again as a single design: this row is the result
    assert search.keeps(best), best
    values = {n: float(v) for n, v in zip(sweep.names, best, strict=True) if is_number(v)}
    word = "least" if search.sign > 0.0 else "greatest"
    count = (
        f"# The {word} {search.name} of {tried:,} designs, {feasible:,} of them within the bounds: "
        f"{values[search.name]:.9g}."
    )
    spec = (machine := sweep.machine(search.keys(best))).spec
    # the spec's own title may describe what was varied
    title = f"{word.capitalize()} {search.name}, varied from: {spec.title}" if spec.title else ""
    heading = [f"title = {quoted(cut(title, TEXT_MAX))}"] if title else []
    notes = _notes(request, values, machine)
    return [count, *notes, *search.left_out(), *heading, *spec_lines(spec)]


def _notes(request: SweepRequest, values: Mapping[str, float], machine: Mechanism) -> Iterable[str]:
    if anew := request.chosen_anew(machine):
        yield f"# sizes chosen anew: {anew}"
    for c in request.constraints:
        yield f"# {c}: {values[c.name]:.9g}{c.standing(values[c.name])}"
    for name, value in zip(request.of_best.names, request.of_best.of(machine), strict=True):
        if value is None or isinstance(value, bool):
            text = "none" if value is None else "yes" if value else "no"
        else:
            text = f"{value:.9g}" if is_number(value) else clean(str(value))
        yield f"# {name}: {text}"


def _none(search: _SweepSearch, nearness: Nearness, tried: int, near: Row) -> str:
    why = nearness.phrases() or [f"no design has a value of {search.name}"]
    values = [(c.name, near[i]) for i, c in search.bounds]
    if len(values) > 1 and all(is_number(value) for _, value in values):
        texts = dict.fromkeys(f"{name} {value:.6g}" for name, value in values)
        why.append(f"the design that comes nearest to all has {', '.join(texts)}")
    return f"--best: none of {tried:,} designs is feasible: {'; '.join(why)}"


class _SweepSearch:
    """The rows of a sweep for an optimiser, with free keys as fractions of their spans."""

    def __init__(self, request: SweepRequest) -> None:
        self.sweep, (self.sign, self.name) = request.sweep, request.objectives[0]
        names, axes = self.sweep.names, self.sweep.plan.axes
        self.at = names.index(self.name)
        self.bounds = [(names.index(c.name), c) for c in request.constraints]
        self.free = [i for i, a in enumerate(axes) if a.span]
        ends = [axes[i].values for i in self.free]
        self.low, self.high = np.array(ends, dtype=float).reshape(-1, 2).T
        self.most = MOST if self.sweep.is_batched else MOST_ALONE
        self.is_cut_short = False  # True once the optimiser has reached that number

    def keys(self, row: Row) -> list[Value]:
        return [v for v in row[: len(self.sweep.plan.axes)] if v is not None]

    def cost(self, row: Row) -> float:
        """The objective, signed so that it is minimised; infinite for a design that lacks it."""
        value = row[self.at]
        return self.sign * float(value) if is_number(value) else np.inf

    def keeps(self, row: Row) -> bool:
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

    def closer(self, rows: Sequence[Row]) -> list[Row]:
        """Refine each design by clouds that shrink about it, and return those near the best.

        Returns all designs unchanged if their quantities cannot be computed for a batch.
        """
        best = list(rows)
        if not self.sweep.is_batched:
            return best
        draw = np.random.default_rng(0)
        count = 48  # designs about each place in a round
        width = 0.25  # half of the cloud's, as a fraction of the span; 16 rounds take it to 1e-4
        for _ in tracked(range(16), "rounds", 16):
            steps = draw.uniform(-width, width, (len(best), count, len(self.free)))
            about = [
                self.moved(row, self.fractions(row) + step)
                for row, row_steps in zip(best, steps, strict=True)
                for step in row_steps
            ]
            drawn = [*self.sweep.rows_of(rows_of(about).columns)]
            clouds = [drawn[i * count : (i + 1) * count] for i in range(len(best))]
            best = [min((row, *c), key=self.merit) for row, c in zip(best, clouds, strict=True)]
            width *= 0.6
        best.sort(key=self.merit)
        least = self.cost(best[0])
        # clouds come far closer to a minimum than 1 %, so that a place above it is no rival
        return [row for row in best if self.cost(row) <= least + 0.01 * abs(least)]

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
        if not self.is_cut_short:
            return []
        alone = "" if self.sweep.is_batched else ", as each is computed alone"
        return [
            f"# The search near the best ended after {self.most} designs{alone}: for more digits "
            "give a narrower range."
        ]


class _Place(NamedTuple):
    """A choice of words and whole numbers, and the part of each span."""

    choice: tuple[Value, ...]
    parts: tuple[int, ...]


class _BestPlaces:
    """The best design of each choice of words and whole numbers, with one part of each span.

    A scan has few designs for each number of slots, so its best design may have the wrong number.
    Refining the best design of each number tells which is right.
    """

    def __init__(self, search: _SweepSearch) -> None:
        self.search = search
        self.rows: dict[_Place, Row] = {}

    def add(self, rows: Iterable[Row]) -> None:
        """Add rows; the first of equal rows stays."""
        for row in rows:
            place = self._place(row)
            best = self.rows.get(place)
            if best is None or self.search.merit(row) < self.search.merit(best):
                self.rows[place] = row
        if len(self.rows) > 8 * PLACES_MAX:
            self.rows = dict(self._foremost(4 * PLACES_MAX))

    def best(self) -> list[Row]:
        return [row for _, row in self._foremost(PLACES_MAX)]

    def _foremost(self, most: int) -> list[tuple[_Place, Row]]:
        """At most so many places, the best first: one of each choice before a second of any."""

        def merit(item: tuple[_Place, Row]) -> tuple[float, float]:
            return self.search.merit(item[1])

        items = sorted(self.rows.items(), key=merit)
        best = {place.choice: place for place, _ in reversed(items)}
        items.sort(key=lambda item: best[item[0].choice] != item[0])
        return sorted(items[:most], key=merit)

    def _place(self, row: Row) -> _Place:
        free = self.search.free
        if not free:  # no refinement follows
            return _Place((), ())
        # designs in different thirds of a span are in different places
        parts = np.minimum(self.search.fractions(row) * 3, 2).astype(int)
        keys = enumerate(self.search.keys(row))
        return _Place(tuple(v for i, v in keys if i not in free), tuple(parts.tolist()))
