"""A request for a sweep, read from options; its rows, counted, and those that a terminal shows."""

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.mechanism import build
from geneva_cli.specfile.reader import read
from geneva_cli.study.fields import Pick, Rows, cells_of, joined
from geneva_cli.study.fields import pick as pick_of
from geneva_cli.study.sweep import constraints
from geneva_cli.study.sweep.run import DEFAULT, ERROR, Sweep, plan, sweep, with_values
from geneva_cli.study.sweep.values import axis, refuse_twice
from geneva_cli.table import Table

# tables of quantities that depend on the sizes of the parts
OF_SIZES = ("parts", "strength", "life", "checks", "tolerance")


def request(
    path: str,
    vary: Sequence[str],
    settings: Sequence[str] = (),
    pick: str = "",
    random: int | None = None,
    seed: int | None = None,
    check: bool = False,
    subject_to: Sequence[str] = (),
    pareto: str = "",
    best: str = "",
    jobs: int | None = None,
) -> Sweep:
    """Return the sweep of these options. Raises GenevaError, naming the option that is wrong.

    ``settings``, texts ``KEY=VALUE``, replace keys of the spec.
    """
    if jobs is not None and jobs < 1:
        raise GenevaError(f"--jobs {cut(jobs)}: it must be at least 1")
    text = read(path, settings)
    many = random is not None or bool(best)
    axes = [axis(words, many) for words in vary]
    try:  # report an error in the file before errors in the options
        spec = text.spec()
    except GenevaError as error:
        middle = [a.values[len(a.values) // 2] for a in axes]
        try:  # a spec that is invalid on its own
            spec = with_values(text, [a.key for a in axes], middle).spec()
        except GenevaError:
            raise error from None
    if spec.outline.files:
        raise GenevaError(f"{spec.path}: [outline]: a sweep varies formulas, and turns no drawings")
    refuse_twice(axes, text.set_keys)
    if best and random is None and any(a.span for a in axes):
        random = 4096  # designs that --best scans
    if seed is not None and random is None:
        raise GenevaError(f"--seed {cut(seed)}: it needs --random N; a grid has no random draw")
    bounds = [constraints.constraint(text) for text in subject_to]
    if pareto and best:
        raise GenevaError("--pareto with --best: a front, or one design; choose one of them")
    option = "--best" if best else "--pareto"
    goals = [
        constraints.objective(one, option) for one in (best or pareto).split(",") if best or pareto
    ]
    names = [name.strip() for name in pick.split(",")] if pick else []
    if not names and not goals:
        names = list(DEFAULT)
    by = dict.fromkeys([o.name for o in goals], option)
    needed = [*by, *(c.name for c in bounds)]
    names += ["checks.passes", "checks.failed"] if check else []
    of_best, picks = (pick_of(names), needed) if best else (Pick(), [*needed, *names])
    swept = sweep(text, plan(axes, random, seed or 0), picks)
    constraints.refuse_unsound(
        bounds, dict.fromkeys(needed, "--subject-to") | by, "--vary or --set picks it"
    )
    return swept._replace(
        bounds=tuple(bounds),
        objectives=() if best else tuple(goals),
        goal=goals[0] if best else None,
        of_best=of_best,
        jobs=jobs,
        files=spec.files,
    )


class Outcome:
    """Counts of rows as they arrive: all, those that cannot be built, and those that are kept."""

    def __init__(self, sweep: Sweep) -> None:
        self.sweep = sweep
        self.all = self.failed = self.left = 0
        self._first = ""  # why the first of them cannot be built
        self.nearness = constraints.Nearness(sweep.bounds)
        self._unknown = [o.name for o in sweep.objectives]

    def rows(self, row_blocks: Iterable[Rows]) -> Iterator[Rows]:
        """The rows of the sweep, counted: all of them, or those that it chooses."""
        counted = self.counted(row_blocks)
        for block in self.sweep.chosen(counted) if self.sweep.chooses else counted:
            self.left += len(block)
            yield block

    def counted(self, row_blocks: Iterable[Rows]) -> Iterator[Rows]:
        """All rows, counted."""
        for rows in row_blocks:
            errors = [str(cell) for cell in cells_of(rows.columns[ERROR]) if cell is not None]
            self.all += len(rows)
            self.failed += len(errors)
            self._first = self._first or next(iter(errors), "")
            self.nearness.add(rows.numbers)
            known = [name for name in self._unknown if np.isfinite(rows.numbers(name)).any()]
            self._unknown = [name for name in self._unknown if name not in known]
            yield rows

    def notes(self) -> Iterator[str]:
        """Notes for the user besides the rows, or the best design."""
        sweep = self.sweep
        if self.failed:
            is_shown = not (sweep.chooses or sweep.goal)
            why = "column error says why" if is_shown else f"the first: {self._first}"
            yield f"{self.failed:,} of {self.all:,} designs cannot be built: {why}"
        if sweep.goal:
            return
        if self.all and not self.left:
            unknown = [f"no design has a value of {name}" for name in self._unknown]
            reasons = dict.fromkeys([*unknown, *self.nearness.phrases()])
            yield f"none of {self.all:,} rows is left: {'; '.join(reasons)}"
        if any(group.table.startswith(OF_SIZES) for group in sweep.pick.groups):
            from geneva_cli.parts.chosen import ByLoad, by_load

            with suppress(GenevaError):  # the spec may lack a varied key
                if words := ByLoad(by_load(build(sweep.text.spec())), {}).words:
                    name = {"<stdin>": "-"}.get(sweep.text.name, sweep.text.name)
                    yield (
                        f"note: each row has the sizes that its own load needs, the spec {words}; "
                        f"`geneva size {name}` writes those, so that they stay"
                    )


ROWS = 5  # the first rows, and as many of the best; up to twice as many are all shown


class Digest:
    """The first rows, the best rows and their count, updated as rows arrive in bounded memory.

    The best have the least, or the greatest, of the first goal of --pareto; without --pareto, the
    least of the first numeric quantity. ``place`` names the file with all rows.
    """

    def __init__(self, sweep: Sweep, place: str = "-o FILE.csv") -> None:
        self.sweep, self.place, self.count = sweep, place, 0
        self.goal = sweep.objectives[0] if sweep.objectives else None
        self.first, self.best = list[Rows](), list[Rows]()  # none yet, or one

    def add(self, rows: Rows) -> None:
        """Add rows, which are numbered in their order from 1."""
        numbers = np.arange(self.count, self.count + len(rows)) + 1
        rows, self.count = Rows({"row": numbers, **rows.columns}), self.count + len(rows)
        few = slice(2 * ROWS)
        self.first = [joined([*self.first, rows.taken(few)]).taken(few)]
        for name in () if self.goal else self.sweep.pick.names:  # the first with a number
            cells = cells_of(rows.columns[name])
            if any(constraints.is_number(cell) and not isinstance(cell, bool) for cell in cells):
                self.goal = self.goal or constraints.Objective(1.0, name)
        if self.goal:
            self.best = [self._best(joined([*self.best, self._best(rows)]))]

    def _best(self, rows: Rows) -> Rows:
        """The rows with the best values, the best first."""
        assert self.goal
        costs = self.goal.sign * rows.numbers(self.goal.name)
        order = np.argsort(costs, kind="stable")[:ROWS]
        return rows.taken(order[~np.isnan(costs[order])])

    def tables(self) -> Iterator[Table]:
        """One table with all rows if they are few; otherwise the first rows and the best."""
        titled = [(rows, "") for rows in self.first]
        if self.count > 2 * ROWS:
            title = f"The first {ROWS} rows. All {self.count:,} rows: {self.place}"
            titled = [(self.first[0].taken(slice(ROWS)), title)]
            titled += [(rows, f"The {len(rows)} rows with the {self.goal}") for rows in self.best]
        for rows, title in titled:
            columns = {name: cells_of(column) for name, column in rows.columns.items()}
            kept = {n: cells for n, cells in columns.items() if cells.count(None) < len(cells)}
            yield Table(tuple(kept), [*kept.values()], title=title)
