"""The table of a synthesis, with the parts of its first rows turned, and a row as a spec."""

from __future__ import annotations

import math
from functools import partial
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.progress import tracked
from geneva_cli.spec.load_limits import LIMITED
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.built import Built, built, passes
from geneva_cli.study.synth.fast_parts import MAYBE, YES
from geneva_cli.study.synth.group_search import buildable_rows
from geneva_cli.study.synth.machine_rows import Candidate, MachineRow
from geneva_cli.study.synth.synth_search import TURNED, Ranking, search
from geneva_cli.study.target import Target
from geneva_cli.table import Table, rows_table

# keys of [limits] and what they bound
_LIMITED = {
    **LIMITED,
    "pressure_angle_max_deg": "sizes.pressure_angle_max_deg",
    "product_acceleration_max_m_s2": "product.acceleration_m_s2.max",
}
NAMES = ("no", *Candidate._fields)


def synthesis_table(
    target: Target, count: int = TURNED, buildable: bool = False, ranking: Ranking | None = None
) -> Table:
    """One row for each machine, numbered from 1, as ``turned`` returns them."""
    ranking = ranking or search(target)
    rows = [
        (one.no, *one.row.candidate, *one.row.extra) for one in turned(ranking, count, buildable)
    ]
    what = "1 machine" if len(rows) == 1 else f"{len(rows)} machines"
    first = str(target.sort or "") or f"lowest peak acceleration{' in rad/s2' * target.timed}"
    title = f"{what}, {first} first" if len(rows) > 1 else what
    if buildable:
        title = f"{title}{',' * (len(rows) > 1)} of {len(ranking.rows)}"
    if not rows:
        title = f"none of {len(ranking.rows)} machines passes"
    return rows_table((*NAMES, *ranking.requested.names), rows, f"{target.words}: {title}.")


class Numbered(NamedTuple):
    """A row and its number, which does not change if others are hidden."""

    no: int
    row: MachineRow


def turned(ranking: Ranking, count: int = TURNED, buildable: bool = False) -> list[Numbered]:
    """The rows, the first ``count`` of them turned; with ``buildable`` only those that pass.

    A turned row says yes, with sizes that pass, or no. Others say maybe, or no if that is known
    without turning. A row that fails may be replaced, under its number, by the best machine of its
    family that passes: if it is itself a replacement, or if only passing rows are requested. The
    replacement keeps the number, and stands where its own quantities belong.
    """
    every = [Numbered(i, row) for i, row in enumerate(ranking.rows, 1)]
    maybe = [one for one in every if one.row.candidate.parts == MAYBE]
    if not buildable:
        maybe = [one for one in maybe if one.no <= count]
    work = partial(built, fixed=_fixed(ranking.target))
    done = mapped(work, [one.row.spec for one in maybe], min(len(maybe), cores()), "machines")
    done = tracked(done, "machines turned", len(maybe))
    results: dict[int, MachineRow] = {}
    passed, last = 0, len(every)
    for one in maybe:
        if buildable and passed >= count:
            last = one.no
            break
        results[one.no] = _with_result(one.row, next(done))
        passed += results[one.no].candidate.parts == YES
    again = {
        no: row
        for no, row in results.items()
        if row.is_impossible and (buildable or row.is_replacement)
    }
    if buildable:
        # rows that cannot be built, of families without a buildable row
        able = {row.family for row in ranking.rows if not row.is_impossible}
        stuck = (one for one in every[:last] if one.row.is_impossible)
        again |= {one.no: one.row for one in stuck if one.row.family not in able}
    others = _others(ranking, again)
    results |= others
    shown = [one._replace(row=results.get(one.no, one.row)) for one in every]
    if buildable:
        shown = [one for one in shown if one.row.candidate.parts == YES]
    else:
        shown = [one for one in shown if one.no not in again or one.no in others]
    shown.sort(key=lambda one: ranking.rank(one.row))  # a replacement is worse than the row it had
    return shown[:count] if buildable else shown


def _others(ranking: Ranking, failing: dict[int, MachineRow]) -> dict[int, MachineRow]:
    work = partial(_other, ranking._replace(rows=[]))
    done = mapped(work, failing.values(), min(len(failing), cores()), "machines")
    done = tracked(done, "alternatives", len(failing))
    return {no: row for no, row in zip(failing, done, strict=True) if row}


def _other(ranking: Ranking, row: MachineRow) -> MachineRow | None:
    """The best machine of a row's family that passes a full turn, other than the row's own."""
    sizes = _fixed(ranking.target)

    def turn(maybe: MachineRow, like: MachineRow | None) -> MachineRow | None:
        own = ranking.in_turn(maybe)
        if own is None or own.moves_as(row):
            return None
        if like:
            spec = own.spec.replace(size=like.spec.size)
            return _with_result(own, Built(spec, "")) if passes(spec) else None
        result = built(own.spec, sizes)
        return None if result.trouble else _with_result(own, result)

    return buildable_rows(ranking.target, [row.family], turn)[0] if row.family else None


def _with_result(row: MachineRow, result: Built) -> MachineRow:
    entry = f"no: {result.trouble}" if result.trouble else YES
    return row._replace(spec=result.spec, candidate=row.candidate._replace(parts=entry))


def _fixed(target: Target) -> frozenset[str]:
    """The sizes that the requirement's frame gives, which do not change."""
    sizes = target.frame.size.as_dict() if target.frame else {}
    return frozenset(key for key, value in sizes.items() if value is not None)


def chosen(
    ranking: Ranking, number: int, buildable: bool = False, count: int = TURNED
) -> tuple[MachineRow, str]:
    """Row ``number``, and the text of its spec with comments, as ``turned`` shows it.

    The parts are turned through a whole turn, unless they are known to be impossible. A row that
    ``turned`` shows without turning it keeps its numbers, even if its parts fail. Raises
    GenevaError if there is no such row.
    """
    if not 1 <= number <= len(ranking.rows):
        raise GenevaError(f"--write {cut(number)}: the table has rows 1 to {len(ranking.rows)}")
    row = ranking.rows[number - 1]
    if not row.is_impossible:
        row = _with_result(row, built(row.spec, _fixed(ranking.target)))
    if row.is_impossible and (buildable or (row.is_replacement and number <= count)):
        row = _other(ranking, row) or row
    row = row._replace(spec=with_limits(ranking.requested, row.spec))
    return row, commented(ranking.target, number, row)


def with_limits(target: Target, spec: Spec) -> Spec:
    """The spec with each requirement that a key of ``[limits]`` can hold, so that checks hold it.

    Of a requirement and a limit of the frame the stricter one stays.
    """
    bounds = list(target.limits)
    for name, span in target.spans.items():
        timing = f"timing.{'cycle_s' if name == 'cycle' else name}"
        bounds += [Constraint(timing, ">=", span.low), Constraint(timing, "<=", span.high)]
    own, limits = spec.limits.as_dict(), dict[str, float]()
    for key, name in _LIMITED.items():
        sign, stricter = (">=", max) if "_min" in key else ("<=", min)
        asked = [bound.bound for bound in bounds if (bound.name, bound.sign) == (name, sign)]
        asked = [bound for bound in (*asked, own[key]) if bound and 0.0 < bound < math.inf]
        if asked:
            limits[key] = stricter(asked)
    return spec.replace(limits=spec.limits.replace(**limits))


def commented(target: Target, number: int, machine: MachineRow) -> str:
    """The text of a spec from synthesis, with comments."""
    row = machine.candidate
    slots = f"{row.drive}, {row.law}" if row.law else row.drive
    title = f"{target.words}: {row.z} slots, {row.gearing}, {slots}"
    names = ("velocity_max", "acceleration_max", "acceleration_entry", "jerk_max", "power_max")
    costs = [f"{name} {getattr(row, name):.7g}" for name in names]
    lines = [
        f"title = {quoted(title)}",
        "",
        f"# Row {number} of `geneva synth`. It moves for {row.motion_deg:.7g} deg of the input and",
        f"# rests for {row.dwell_deg:.7g}: tau = {row.tau:.7g}, k = {row.k:.7g}.",
        f"# Invariants: {', '.join(costs[:3])},",
        f"# {', '.join(costs[3:])}.",
    ]
    if machine.trouble:
        lines.append(f"# Warning: its parts cannot be built: {machine.trouble}.")
    return "\n".join([*lines, *spec_lines(machine.spec)]) + "\n"
