"""The rows with their parts turned, as a table."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from geneva_cli.machine.spec import Spec
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.synthesis.built import Built, built_together
from geneva_cli.study.synthesis.parts import MAYBE, YES
from geneva_cli.study.synthesis.rows import Candidate, Row
from geneva_cli.study.synthesis.search import FoundRows, search
from geneva_cli.study.synthesis.turns import same_turn
from geneva_cli.study.synthesis.wish import Wish
from geneva_cli.table import Table, rows_table
from geneva_cli.verdict.checks.registry import import_checks

NAMES = ("no", *Candidate._fields)
TURNED = 20  # rows whose parts are turned where nothing is said


def synthesis_table(
    wish: Wish, count: int = TURNED, buildable: bool = False, found: FoundRows | None = None
) -> Table:
    """One row a machine, numbered from 1, as ``turned`` gives them."""
    # what turning takes is imported while others search: the processes that turn then have it
    found = found or search(wish, import_checks if count else None)
    rows = [
        (one.no, *one.row.candidate, *one.row.asked)
        for one in turned(wish, found, count, buildable)
    ]
    what = "1 machine" if len(rows) == 1 else f"{len(rows)} machines"
    by = wish.sort or "lowest peak acceleration"
    title = f"{what}, {by} first" if len(rows) > 1 else what
    if buildable:
        title = (
            f"{title}, of {len(found.rows)}"
            if len(rows) != 1
            else f"1 machine of {len(found.rows)}"
        )
    return rows_table((*NAMES, *found.names), rows, f"{wish.words}: {title}.")


class Numbered(NamedTuple):
    """A row and its number, which it keeps where others are hidden."""

    no: int
    row: Row


def turned(
    wish: Wish, found: FoundRows, count: int = TURNED, buildable: bool = False
) -> Iterator[Numbered]:
    """The rows, the first ``count`` of them turned; ``buildable``: the first so many that pass.

    A row that was turned says yes, with sizes that pass, or no; others maybe, or no where that is
    plain without.
    """
    every = [Numbered(i, row) for i, row in enumerate(found.rows, 1)]
    among = every if buildable else every[:count]
    some = [one.row.spec for one in among if one.row.candidate.parts == MAYBE]
    shown = _built(some, fixed(wish), in_order=buildable)
    passed = 0
    for one in every:
        maybe = one.row.candidate.parts == MAYBE
        if buildable and (passed >= count or not maybe):
            continue
        row = one.row
        if maybe and (buildable or one.no <= count):
            row = with_result(row, next(shown))
        passed += row.candidate.parts == YES
        if not buildable or row.candidate.parts == YES:
            yield Numbered(one.no, row)


def _built(specs: Sequence[Spec], fixed: frozenset[str], in_order: bool) -> Iterator[Built]:
    """The specs turned, by all cores; those with the same turn at once.

    Those of a law, which take longest, are turned first, or all ``in_order``.
    """
    together: dict[Spec, list[int]] = {}
    for i, spec in enumerate(specs):
        together.setdefault(same_turn(spec), []).append(i)
    turned = [*together.values()]
    if not in_order:
        turned.sort(key=lambda members: specs[members[0]].motion is None)
    tasks = [[specs[i] for i in members] for members in turned]
    work = partial(built_together, fixed=fixed)
    done = mapped(work, tasks, min(len(tasks), cores()), "machines")
    results: dict[int, Built] = {}
    groups = iter(turned)
    for i in range(len(specs)):
        while i not in results:
            results |= zip(next(groups), next(done), strict=True)
        yield results.pop(i)


def with_result(row: Row, result: Built) -> Row:
    """A row whose parts were turned."""
    said = f"no: {result.trouble}" if result.trouble else YES
    return row._replace(spec=result.spec, candidate=row.candidate._replace(parts=said))


def fixed(wish: Wish) -> frozenset[str]:
    """The sizes that the wish's frame gives, and that stay as they are."""
    given = wish.frame.size.as_dict() if wish.frame else {}
    return frozenset(key for key, value in given.items() if value is not None)
