"""A sweep's request, read from the command line's options."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut
from geneva_cli.specfile.points import digest
from geneva_cli.specfile.reader import Text, read
from geneva_cli.study.fields import Cell
from geneva_cli.study.goals import Objective, objective, refuse_opposites
from geneva_cli.study.sweep.constraints import (
    Constraint,
    constraint,
    refuse_contradictions,
    refuse_words,
)
from geneva_cli.study.sweep.plan import WHOLE, plan
from geneva_cli.study.sweep.plan import shard as share
from geneva_cli.study.sweep.run import DEFAULT, Sweep, blocks, sweep, with_values
from geneva_cli.study.sweep.values import VariedKey, axis, refuse_twice

DRAWN = 4096  # designs that --best looks at where nothing else is said


class Request(NamedTuple):
    """A sweep, and what of it is to be kept."""

    sweep: Sweep
    constraints: tuple[Constraint, ...]
    objectives: tuple[Objective, ...]
    jobs: int | None
    files: tuple[str, ...]  # that the spec is read from

    @property
    def chooses(self) -> bool:
        """Whether only some of the rows are kept."""
        return bool(self.constraints or self.objectives)

    @property
    def key(self) -> str:
        """What the rows depend on, as one word: the sweep, and points in files."""
        return f"{self.sweep.key} {digest(self.inputs[1:])}"

    @property
    def inputs(self) -> tuple[str, ...]:
        """The files that are read: the spec, points that it names, and what a varied word names.

        A word that names no file is among them, and does no harm there.
        """
        folder = os.path.dirname(self.files[0])
        words = [v for a in self.sweep.plan.axes for v in a.values if isinstance(v, str)]
        return (*self.files, *(os.path.join(folder, word) for word in words))

    def blocks(self, done: int = 0) -> Iterator[list[list[Cell]]]:
        """All rows, some at a time; ``done`` are there already."""
        return blocks(self.sweep, done, self.jobs)

    def chosen(self, every: Iterable[list[list[Cell]]]) -> Iterator[list[list[Cell]]]:
        """The rows that keep all bounds and, of these, that no other beats."""
        names = self.sweep.names
        bounds = [(names.index(c.name), c) for c in self.constraints]
        kept = ([r for r in block if all(c.kept(r[i]) for i, c in bounds)] for block in every)
        if not self.objectives:
            yield from (block for block in kept if block)
            return
        from geneva_cli.study.sweep.front import front

        at = [names.index(o.name) for o in self.objectives]
        signs = [o.sign for o in self.objectives]
        found: list[list[Cell]] = []
        for block in kept:  # what a row of an earlier block beats is kept no longer
            rows = [*found, *block]
            found = [rows[i] for i in front(rows, at, signs)]
        if found:
            yield found

    def best(self, every: Iterable[list[list[Cell]]]) -> list[str]:
        """The best design, refined, as the lines of a spec."""
        from geneva_cli.study.sweep.best import Asked, winner

        asked = Asked(self.objectives[0], self.constraints)
        return winner(self.sweep, every, asked).lines(asked)


def request(
    path: str,
    vary: Sequence[str],
    given: Sequence[str] = (),
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
) -> Request:
    """What these options ask for. Raises GenevaError, naming the option, for what cannot be."""
    if jobs is not None and jobs < 1:
        raise GenevaError(f"--jobs {cut(jobs)}: it must be at least 1")
    text = read(path, given)
    many = random is not None or bool(best)
    axes = [axis(words, many) for words in vary]
    try:  # what is wrong with the file is said before what is asked of it
        files = text.spec().files
    except GenevaError as error:
        files = _files(text, axes, error)
    refuse_twice(axes, text.set_keys)
    if best and random is None and any(a.span for a in axes):
        random = DRAWN
    if seed is not None and random is None:
        raise GenevaError(f"--seed {cut(seed)}: it needs --random N; a grid has no random draw")
    bounds = [constraint(text) for text in subject_to]
    wanted = _objectives(pareto, best)
    part = share(shard) if shard else WHOLE
    if shard and wanted:
        raise GenevaError("--shard: each shard has a front of its own; join all rows, then choose")
    names = [name.strip() for name in pick.split(",")] if pick else []
    if not names and not wanted:
        names = list(DEFAULT)
    asked = [o.name for o in wanted] + [c.name for c in bounds]
    by = dict.fromkeys([c.name for c in bounds], "--subject-to")
    by |= dict.fromkeys([o.name for o in wanted], "--best" if best else "--pareto")
    every, later = (asked, names) if best else ([*asked, *names], None)
    found = sweep(text, plan(axes, random, seed or 0), every, check, by, later)
    found = found._replace(shard=part)
    whole = dict(zip(every, found.asked, strict=False))
    constraints = tuple(c._replace(name=whole[c.name]) for c in bounds)
    refuse_contradictions(constraints)
    objectives = tuple(o._replace(name=whole[o.name]) for o in wanted)
    refuse_opposites(objectives)
    options = {whole[a]: option for a, option in by.items()}
    refuse_words(options, "--vary or --set picks it")
    return Request(found, constraints, objectives, jobs, files)


def _files(text: Text, axes: Sequence[VariedKey], error: GenevaError) -> tuple[str, ...]:
    """The files of a spec that is not valid alone: what it lacks may be a key that is varied."""
    try:
        return with_values(text, axes, [a.values[len(a.values) // 2] for a in axes]).spec().files
    except GenevaError:
        raise error from None


def _objectives(pareto: str, best: str) -> list[Objective]:
    if pareto and best:
        raise GenevaError("--pareto with --best: a front, or one design; choose one of them")
    if best:
        return [objective(best, "--best")]
    return [objective(text, "--pareto") for text in pareto.split(",")] if pareto else []
