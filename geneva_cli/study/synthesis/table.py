"""The table of a synthesis, with the parts of its first rows turned."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from typing import NamedTuple

from geneva_cli.machine.spec import Spec
from geneva_cli.progress import tracked
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.synthesis.built import Built, built_together, passes
from geneva_cli.study.synthesis.elsewhere import elsewhere
from geneva_cli.study.synthesis.parts import MAYBE, YES
from geneva_cli.study.synthesis.rows import Candidate, Row
from geneva_cli.study.synthesis.search import TURNED, FoundRows, search
from geneva_cli.study.synthesis.target import Target
from geneva_cli.study.synthesis.turns import Turns, same_turn
from geneva_cli.table import Table, rows_table
from geneva_cli.verdict.checks.registry import import_checks

NAMES = ("no", *Candidate._fields)


def synthesis_table(
    target: Target, count: int = TURNED, buildable: bool = False, found: FoundRows | None = None
) -> Table:
    """One row for each machine, numbered from 1, as ``turned`` returns them."""
    # the processes that turn need these imports, which are loaded while others search
    found = found or search(target, import_checks if count else None)
    rows = [(one.no, *one.row.candidate, *one.row.asked) for one in turned(found, count, buildable)]
    what = "1 machine" if len(rows) == 1 else f"{len(rows)} machines"
    first = str(target.sort or "") or f"lowest peak acceleration{' in rad/s2' * target.timed}"
    title = f"{what}, {first} first" if len(rows) > 1 else what
    if buildable:
        title = f"{title}{',' * (len(rows) > 1)} of {len(found.rows)}"
    if not rows:
        title = f"none of {len(found.rows)} machines is found to pass"
    return rows_table((*NAMES, *found.asked.names), rows, f"{target.words}: {title}.")


class Numbered(NamedTuple):
    """A row and its number, which does not change if others are hidden."""

    no: int
    row: Row


def turned(found: FoundRows, count: int = TURNED, buildable: bool = False) -> list[Numbered]:
    """The rows, the first ``count`` of them turned; with ``buildable`` only those that pass.

    A turned row says yes, with sizes that pass, or no. Others say maybe, or no if that is known
    without turning. A row that fails may be replaced, under its number, by the best machine of its
    family that passes: if it stands in for another one, or if only passing rows are wanted.
    """
    every = [Numbered(i, row) for i, row in enumerate(found.rows, 1)]
    maybe = [one for one in every if one.row.candidate.parts == MAYBE]
    if not buildable:
        maybe = [one for one in maybe if one.no <= count]
    built = _built([one.row.spec for one in maybe], fixed(found.target), in_order=buildable)
    results: dict[int, Row] = {}
    passed, last = 0, len(every)
    for one in maybe:
        if buildable and passed >= count:
            last = one.no
            break
        results[one.no] = with_result(one.row, next(built))
        passed += results[one.no].candidate.parts == YES
    again = {no: r for no, r in results.items() if r.cannot_be and (buildable or r.stands_in)}
    if buildable:
        again |= _stuck(every[:last], found)
    others = _others(found, again)
    results |= others
    shown = [one._replace(row=results.get(one.no, one.row)) for one in every]
    if buildable:
        shown = [one for one in shown if one.row.candidate.parts == YES]
    else:
        shown = [one for one in shown if one.no not in again or one.no in others]
    return shown[:count] if buildable else shown


def _stuck(every: Sequence[Numbered], found: FoundRows) -> dict[int, Row]:
    """The rows that cannot be built, and for which no other stands in."""
    able = {row.family for row in found.rows if not row.cannot_be}
    return {no: row for no, row in every if row.cannot_be and row.family not in able}


def _others(found: FoundRows, failing: dict[int, Row]) -> dict[int, Row]:
    """For rows that fail, by their numbers, the best machines of their families that pass."""
    work = partial(other, found._replace(rows=[]))
    done = mapped(work, failing.values(), min(len(failing), cores()), "machines")
    done = tracked(done, "others looked for", len(failing))
    return {no: row for no, row in zip(failing, done, strict=True) if row}


def other(found: FoundRows, row: Row) -> Row | None:
    """The best machine of a row's family that passes a full turn, other than the row's own."""
    turns, given = Turns(), fixed(found.target)

    def turn(maybe: Row, like: Row | None) -> Row | None:
        own = found.in_turn(maybe)
        if own is None or own.moves_as(row):
            return None
        if like:
            spec = own.spec.replace(size=like.spec.size)
            return with_result(own, Built(spec, "")) if passes(spec, turns) else None
        (result,) = built_together([own.spec], given, turns)
        return None if result.trouble else with_result(own, result)

    return elsewhere(found.target, [row.family], turn)[0] if row.family else None


def _built(specs: Sequence[Spec], fixed: frozenset[str], in_order: bool) -> Iterator[Built]:
    """The specs turned on all cores; those with the same turn are turned once.

    Machines of a law, which take longest, are turned first, unless ``in_order``.
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
    done = tracked(done, "machines turned", len(tasks))
    results: dict[int, Built] = {}
    groups = iter(turned)
    for i in range(len(specs)):
        while i not in results:
            results |= zip(next(groups), next(done), strict=True)
        yield results.pop(i)


def with_result(row: Row, result: Built) -> Row:
    """A row with the result of turning its parts."""
    said = f"no: {result.trouble}" if result.trouble else YES
    return row._replace(spec=result.spec, candidate=row.candidate._replace(parts=said))


def fixed(target: Target) -> frozenset[str]:
    """The sizes that the requirement's frame gives, which do not change."""
    given = target.frame.size.as_dict() if target.frame else {}
    return frozenset(key for key, value in given.items() if value is not None)
