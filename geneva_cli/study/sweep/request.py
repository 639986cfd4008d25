"""A request for a sweep, read from the options of the command line."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.columns import digest
from geneva_cli.specfile.reader import read
from geneva_cli.study.fields import Cell, Pick
from geneva_cli.study.fields import pick as pick_of
from geneva_cli.study.sweep.constraints import (
    Constraint,
    Objective,
    constraint,
    objective,
    refuse_contradictions,
    refuse_opposites,
    refuse_words,
)
from geneva_cli.study.sweep.plan import WHOLE, plan
from geneva_cli.study.sweep.plan import shard as share
from geneva_cli.study.sweep.run import DEFAULT, Sweep, blocks, sweep, with_values
from geneva_cli.study.sweep.values import axis, refuse_twice


class SweepRequest(NamedTuple):
    """A sweep, and the selection among its rows."""

    sweep: Sweep
    constraints: tuple[Constraint, ...]
    objectives: tuple[Objective, ...]
    jobs: int | None
    files: tuple[str, ...]  # that the spec is read from
    of_best: Pick  # quantities that are computed for the best design of --best only

    @property
    def chooses(self) -> bool:
        """Return True if only some of the rows are kept."""
        return bool(self.constraints or self.objectives)

    @property
    def key(self) -> str:
        """A digest of all that the rows depend on: the sweep, and the files of points."""
        return f"{self.sweep.key} {digest(self.inputs[1:])}"

    @property
    def inputs(self) -> tuple[str, ...]:
        """The input files: the spec, the points that it names, and files named by a varied word.

        A word that names no file is listed too, which is harmless.
        """
        folder = os.path.dirname(self.files[0])
        words = [v for a in self.sweep.plan.axes for v in a.values if isinstance(v, str)]
        return (*self.files, *(os.path.join(folder, word) for word in words))

    def blocks(self, done: int = 0) -> Iterator[list[list[Cell]]]:
        """All rows, in blocks; the first ``done`` rows are skipped."""
        return blocks(self.sweep, done, self.jobs)

    def chosen(self, row_blocks: Iterable[list[list[Cell]]]) -> Iterator[list[list[Cell]]]:
        """The rows that keep all bounds and, of these, the Pareto front."""
        names = self.sweep.names
        bounds = [(names.index(c.name), c) for c in self.constraints]
        kept = ([r for r in block if all(c.kept(r[i]) for i, c in bounds)] for block in row_blocks)
        if not self.objectives:
            yield from (block for block in kept if block)
            return
        from geneva_cli.study.sweep.front import front

        at = [names.index(o.name) for o in self.objectives]
        signs = [o.sign for o in self.objectives]
        rows, size = list[list[Cell]](), 0  # the front so far, its size, and the rows after it
        for block in kept:  # a row that the front dominates never returns
            rows += block
            if len(rows) >= 2 * size:  # not for a few rows more, if the front is long
                rows = [rows[i] for i in front(rows, at, signs)]
                size = len(rows)
        rows = [rows[i] for i in front(rows, at, signs)]
        if rows:
            yield rows


def request(
    path: str,
    vary: Sequence[str],
    settings: Sequence[str] = (),
    *,
    pick: str = "",
    random: int | None = None,
    seed: int | None = None,
    check: bool = False,
    subject_to: Sequence[str] = (),
    pareto: str = "",
    best: str = "",
    shard: str = "",
    jobs: int | None = None,
) -> SweepRequest:
    """Return the request of these options. Raises GenevaError, naming the option that is wrong.

    ``settings``, texts ``KEY=VALUE``, replace keys of the spec.
    """
    if jobs is not None and jobs < 1:
        raise GenevaError(f"--jobs {cut(jobs)}: it must be at least 1")
    text = read(path, settings)
    many = random is not None or bool(best)
    axes = [axis(words, many) for words in vary]
    try:  # report an error in the file before errors in the options
        files = text.spec().files
    except GenevaError as error:
        middle = [a.values[len(a.values) // 2] for a in axes]
        try:  # a spec that is invalid on its own
            files = with_values(text, axes, middle).spec().files
        except GenevaError:
            raise error from None
    refuse_twice(axes, text.set_keys)
    if best and random is None and any(a.span for a in axes):
        random = 4096  # designs that --best scans
    if seed is not None and random is None:
        raise GenevaError(f"--seed {cut(seed)}: it needs --random N; a grid has no random draw")
    bounds = [constraint(text) for text in subject_to]
    if pareto and best:
        raise GenevaError("--pareto with --best: a front, or one design; choose one of them")
    option = "--best" if best else "--pareto"
    texts = [best] if best else pareto.split(",") if pareto else []
    goals = [objective(one, option) for one in texts]
    part = share(shard) if shard else WHOLE
    if shard and goals:
        raise GenevaError("--shard: each shard has a front of its own; join all rows, then choose")
    names = [name.strip() for name in pick.split(",")] if pick else []
    if not names and not goals:
        names = list(DEFAULT)
    by = dict.fromkeys([o.name for o in goals], option)
    needed = [*by, *(c.name for c in bounds)]
    names += ["checks.passes", "checks.failed"] if check else []
    of_best, picks = (pick_of(names), needed) if best else (Pick(), [*needed, *names])
    swept = sweep(text, plan(axes, random, seed or 0), picks)._replace(shard=part)
    if not best:  # which needs all values of designs that break a bound
        swept = swept._replace(bounds=tuple(bounds))
    refuse_contradictions(bounds)
    refuse_opposites(goals)
    refuse_words(dict.fromkeys(needed, "--subject-to") | by, "--vary or --set picks it")
    return SweepRequest(swept, tuple(bounds), tuple(goals), jobs, files, of_best)
