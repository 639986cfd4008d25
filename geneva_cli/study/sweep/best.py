"""The best design of a sweep: a scan of all designs, then a local refinement."""

from collections.abc import Iterable, Sequence
from itertools import compress

import numpy as np

from geneva_cli.errors import GenevaError, clean, cut
from geneva_cli.numerics.arrays import Array, Whole
from geneva_cli.progress import Meter
from geneva_cli.spec.schema import TEXT_MAX
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.fields import Rows, joined, rows_of
from geneva_cli.study.sweep.constraints import Objective, is_number
from geneva_cli.study.sweep.request import Outcome
from geneva_cli.study.sweep.run import Sweep
from geneva_cli.study.synth.family_search import Zoom, sampled, zoom

MOST = 300  # designs of one run of the optimiser, far more than it needs with one or two keys
# The same where each design is computed alone, often with its parts: up to half a minute a run. It
# then has some three digits of the keys.
MOST_ALONE = 40
FAR = 1e3  # violation, or scaled cost, of a design that cannot be built
PLACES_MAX = 24  # that are kept and refined


def best_spec(outcome: Outcome, goal: Objective, row_blocks: Iterable[Rows]) -> list[str]:
    """Return the lines of a spec of the best design of a sweep; its rows are not kept.

    ``outcome`` counts the rows. The keys that vary in a span are refined: first by clouds of
    designs that shrink about the best places, then by an optimiser from the best of these.
    """
    sweep, feasible = outcome.sweep, 0
    search, found = _SweepSearch(sweep, goal), list[Rows]()
    for rows in outcome.counted(row_blocks):
        feasible += int((search.merits(rows)[0] == 0.0).sum())
        found = [search.foremost(joined([*found, rows]), 4 * PLACES_MAX)]
    places = search.closer(search.foremost(found[0], PLACES_MAX))
    starts = places.taken(search.merits(places)[0] == 0.0)
    if not len(starts):
        why = [*outcome.nearness.phrases()] or [f"no design has a value of {goal.name}"]
        raise GenevaError(f"--best: none of {outcome.all:,} designs is feasible: {'; '.join(why)}")
    # the best of them suffice; at last onto the bounds that bind
    first = range(min(len(starts), 3 if sweep.is_batched else 1))
    refined = joined([search.refined(starts.taken(np.array([i]))) for i in first])
    keys = search.refined(search.foremost(refined, 1), reach=2e-3).row(0)[: len(sweep.keys)]
    best = sweep.row(keys)  # computed again as a single design: this row is the result
    values = {n: float(v) for n, v in zip(sweep.names, best, strict=True) if is_number(v)}
    spec = (machine := sweep.machine(keys)).spec
    notes = [
        f"# The {goal} of {outcome.all:,} designs, {feasible:,} of them within the bounds: "
        f"{values[goal.name]:.9g}."
    ]
    for bound in sweep.bounds:
        # the optimiser leaves a bound that binds less than this
        binds = " (binds)" if bound.margin(values[bound.name]) <= 1e-6 else ""
        notes.append(f"# {bound}: {values[bound.name]:.9g}{binds}")
    for name, value in zip(sweep.of_best.names, sweep.of_best.of(machine), strict=True):
        if value is None or isinstance(value, bool):
            text = "none" if value is None else "yes" if value else "no"
        else:
            text = f"{value:.9g}" if is_number(value) else clean(str(value))
        notes.append(f"# {name}: {text}")
    if search.is_cut_short:
        alone = "" if sweep.is_batched else ", as each is computed alone"
        notes.append(
            f"# The search near the best ended after {search.most} designs{alone}: for more digits "
            "give a narrower range."
        )
    if spec.title:  # the spec's own title may describe what was varied
        title = f"The {goal}, varied from: {spec.title}"
        notes.append(f"title = {quoted(cut(title, TEXT_MAX))}")
    return [*notes, *spec_lines(spec)]


class _SweepSearch:
    """The rows of a sweep for an optimiser, with free keys as fractions of their spans."""

    def __init__(self, sweep: Sweep, goal: Objective) -> None:
        self.sweep, self.goal = sweep, goal
        free = {a.key: a.values for a in sweep.plan.axes if a.span}
        self.free = [*free]
        self.low, self.high = np.array([*free.values()], dtype=float).reshape(-1, 2).T
        self.most = MOST if sweep.is_batched else MOST_ALONE
        self.is_cut_short = False  # True once the optimiser has reached that number

    def margins(self, rows: Rows) -> Array:
        """The relative margins to the bounds (b, n); -FAR for a design without the quantity."""
        bounds = self.sweep.bounds
        each = [np.nan_to_num(c.margin(rows.numbers(c.name)), nan=-FAR) for c in bounds]
        return np.reshape(each, (len(each), len(rows)))

    def merits(self, rows: Rows) -> tuple[Array, Array]:
        """Violations of the bounds, 0 where they are kept apart from rounding, and costs.

        The costs are the objective (n,), signed so that it is minimised; infinite without it.
        """
        costs = np.nan_to_num(self.goal.sign * rows.numbers(self.goal.name), nan=np.inf)
        kept = np.isfinite(costs)
        for c in self.sweep.bounds:
            kept &= c.kept_by(rows.numbers(c.name))
        short = np.maximum(0.0, -self.margins(rows)).sum(axis=0) + FAR * np.isinf(costs)
        return np.where(kept, 0.0, np.maximum(short, 1e-9)), costs

    def fractions(self, rows: Rows) -> Array:
        """The free keys of designs as fractions of their spans (n, k): 0 is low, 1 is high."""
        here = [rows.numbers(key) for key in self.free]
        return (np.reshape(here, (len(here), len(rows))).T - self.low) / (self.high - self.low)

    def foremost(self, rows: Rows, most: int) -> Rows:
        """The best designs, one of each choice of words and whole numbers before a second of any.

        A scan has few designs for each number of slots, so its best one may have the wrong number:
        the best of each number is refined. So is the best in each third of a span.
        """
        violations, costs = self.merits(rows)
        order = np.lexsort((costs, violations))
        if self.free:
            kept = [key in self.sweep.keys and key not in self.free for key in rows.columns]
            choices = [tuple(compress(row, kept)) for row in rows]
            thirds = np.minimum(self.fractions(rows) * 3.0, 2.0).astype(int).tolist()
            places = [*zip(choices, map(tuple, thirds), strict=True)]
            order = _first_of_each(order, places)
            first = _first_of_each(order, choices)
            some = np.concatenate((first, order[~np.isin(order, first)]))[:most]
            order = some[np.lexsort((costs[some], violations[some]))]
        return rows.taken(order[:most])

    def closer(self, rows: Rows) -> Rows:
        """Refine each design by clouds that shrink about it, and return those near the best.

        Returns all designs unchanged if their quantities cannot be computed for a batch.
        """
        if not (self.free and self.sweep.is_batched):
            return rows
        draw, every = np.random.default_rng(0), np.arange(len(rows))

        def cloud(number: int) -> Array:
            return draw.uniform(-1.0, 1.0, (48, len(self.free)))

        def evaluate(of: Whole, at: Array) -> tuple[Array, Array]:
            return self.merits(self.sweep.rows_of(self.moved(rows.taken(of), at)))

        # half a span wide at first; 16 rounds take it to 1e-4
        near = Zoom(cloud, 0.25, 0.6, 16)
        found = zoom(evaluate, sampled(evaluate, every, self.fractions(rows)), near, keep=1)
        found = found.take(np.lexsort((found.cost, found.violation)))
        # clouds come far closer to a minimum than 1 %, so that a place above it is no rival
        found = found.take(found.cost <= found.cost[0] + 0.01 * abs(found.cost[0]))
        return self.sweep.rows_of(self.moved(rows.taken(found.of), found.at))

    def moved(self, rows: Rows, at: Array) -> Rows:
        """The keys of designs, with the free ones at the fractions (n, k)."""
        values = self.low + np.clip(at, 0.0, 1.0) * (self.high - self.low)
        free = dict(zip(self.free, values.T, strict=True))
        return Rows({key: free.get(key, rows.columns[key]) for key in self.sweep.keys})

    def refined(self, first: Rows, reach: float = 0.05) -> Rows:
        """The best design among the first one and all that the optimiser evaluates from there.

        ``reach`` is the optimiser's first step as a fraction of the spans.
        """
        if not self.free:
            return first
        from scipy.optimize import NonlinearConstraint, minimize

        meter = Meter("designs near the best", self.most)
        scale = abs(self.merits(first)[1][0]) or 1.0
        evaluated: dict[bytes, Rows] = {}

        def rows(x: Array) -> Rows:
            place = x.tobytes()
            if place not in evaluated:
                keys = self.moved(first, x[None]).row(0)
                evaluated[place] = rows_of(self.sweep.names, [self.sweep.row(keys)])
                meter.report(len(evaluated))
            return evaluated[place]

        def cost(x: Array) -> float:
            return min(float(self.merits(rows(x))[1][0]) / scale, FAR)

        def margins(x: Array) -> Array:
            return self.margins(rows(x))[:, 0]

        rounding = 1e-13  # fraction of a bound, so that rounding does not leave a design outside
        bounds = [NonlinearConstraint(margins, rounding, np.inf)] if self.sweep.bounds else []
        minimize(
            cost,
            self.fractions(first)[0],
            method="COBYQA",
            bounds=[(0.0, 1.0)] * len(self.free),
            constraints=bounds,
            # a bound that binds is met to the last step
            options={"maxfev": self.most, "initial_tr_radius": reach, "final_tr_radius": 1e-12},
        )
        meter.close()
        self.is_cut_short |= len(evaluated) >= self.most
        kept = [r for r in (first, *evaluated.values()) if self.merits(r)[0][0] == 0.0]
        inside = [r for r in kept if (self.margins(r) >= 0.0).all()]
        return min(inside or kept, key=lambda r: float(self.merits(r)[1][0]))


def _first_of_each(order: Whole, groups: Sequence[object]) -> Whole:
    """The first number in ``order`` of each group; ``groups`` has that of each number."""
    first: dict[object, int] = {}
    for i in order.tolist():
        first.setdefault(groups[i], i)
    return np.array([*first.values()])
