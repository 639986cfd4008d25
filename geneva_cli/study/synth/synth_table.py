"""The rows that a search found as a table, the first of them turned, and a row as a spec."""

from __future__ import annotations

import math
from functools import partial
from typing import NamedTuple

from geneva_cli.errors import GenevaError, cut
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.progress import tracked
from geneva_cli.spec.tables import LIMITED
from geneva_cli.specfile.writer import quoted, spec_lines
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synth.built import built
from geneva_cli.study.synth.machine_rows import Candidate, MachineRow, rows
from geneva_cli.study.synth.suiting import MAYBE, YES
from geneva_cli.study.synth.synth_search import (
    TURNED,
    Ranking,
    bounded,
    search,
    with_batch_values,
)
from geneva_cli.study.target import Target
from geneva_cli.table import Table, rows_table

# keys of [limits] and what they bound
_LIMITED = {
    **LIMITED,
    "pressure_angle_max_deg": "sizes.pressure_angle_max_deg",
    "product_acceleration_max_m_s2": "product.acceleration_m_s2.max",
}
NAMES = ("no", *Candidate._fields)
HALVINGS = 5  # of the numbers between a machine that fails in its turn and the plain crank's


def synthesis_table(target: Target, count: int = TURNED, buildable: bool = False) -> Table:
    """One row for each machine, numbered from 1, as ``turned`` returns them."""
    ranking = search(target)
    shown = [
        (one.no, *one.row.candidate, *one.row.extra) for one in turned(ranking, count, buildable)
    ]
    what = "1 machine" if len(shown) == 1 else f"{len(shown)} machines"
    first = str(target.sort or "") or f"lowest peak acceleration{' in rad/s2' * target.timed}"
    title = f"{what}, {first} first" if len(shown) > 1 else what
    if buildable:
        title = f"{title}{',' * (len(shown) > 1)} of {len(ranking.rows)}"
    if not shown:
        title = f"none of {len(ranking.rows)} machines passes"
    return rows_table((*NAMES, *target.names), shown, f"{target.words}: {title}.")


class Numbered(NamedTuple):
    """A row and its number, which does not change if others are hidden."""

    no: int
    row: MachineRow


def turned(ranking: Ranking, count: int = TURNED, buildable: bool = False) -> list[Numbered]:
    """The rows, the first ``count`` of them turned; with ``buildable`` the first that pass.

    A turned row says yes, with sizes that pass, or no. Others say maybe, or no if that is known
    without turning. With ``buildable`` a row that fails is replaced, under its number, by a machine
    of its family that passes, and stands where its own quantities belong.
    """
    every = [Numbered(i, row) for i, row in enumerate(ranking.rows, 1)]
    maybe = [one for one in every if one.row.candidate.parts == MAYBE]
    if not buildable:
        maybe = [one for one in maybe if one.no <= count]
    work = partial(_turned, ranking._replace(rows=[]), buildable)
    done = mapped(work, [one.row for one in maybe], min(len(maybe), cores()), "machines")
    results: dict[int, MachineRow] = {}
    passed = 0
    for one, row in zip(maybe, tracked(done, "machines turned", len(maybe)), strict=True):
        results[one.no] = row
        passed += row.candidate.parts == YES
        if buildable and passed >= count:
            break
    if not buildable:
        return [one._replace(row=results.get(one.no, one.row)) for one in every]
    shown = [Numbered(no, row) for no, row in results.items() if row.candidate.parts == YES]
    return sorted(shown, key=lambda one: ranking.rank(one.row))


def _turned(ranking: Ranking, buildable: bool, row: MachineRow) -> MachineRow:
    """A row with sizes that pass a full turn, or with the checks that fail.

    With ``buildable`` a machine that fails is replaced by one of its family that passes, between it
    and that which moves as the plain crank does.
    """
    sizes = ranking.target.frame.size.as_dict() if ranking.target.frame else {}
    fixed = frozenset(key for key, value in sizes.items() if value is not None)

    def with_result(row: MachineRow) -> MachineRow:
        spec, trouble = built(row.spec, fixed)
        entry = f"no: {trouble}" if trouble else YES
        return row._replace(spec=spec, candidate=row.candidate._replace(parts=entry))

    out, family = row if row.trouble else with_result(row), row.family
    if not (buildable and out.trouble and family and family.is_free and len(family.plain) == 1):
        return out
    (low,), (high,), (plain,) = family.low, family.high, family.plain
    is_high = abs(high - plain) > abs(low - plain)  # the end that is farther from the plain crank
    fails, passing = (high, max(low, plain)) if is_high else (low, min(high, plain))
    if not math.isnan(family.best):
        fails = family.best
    for _ in range(HALVINGS):
        middle = 0.5 * (fails + passing)
        spec, own = family.at((middle,)), None
        for other in rows(ranking.target, [(spec, family)], []) if spec else ():
            try:
                (kept,) = bounded(
                    ranking.requested, with_batch_values(ranking.requested.names, [other])
                )
            except GenevaError:
                continue
            own = with_result(kept) if not kept.trouble else None
        if own and not own.trouble:
            out, passing = own, middle
        else:
            fails = middle
    return out


def chosen(ranking: Ranking, number: int, buildable: bool = False) -> tuple[MachineRow, str]:
    """Row ``number``, and the text of its spec with comments, as ``turned`` shows it.

    The parts are turned through a whole turn, unless they are known to be impossible.
    """
    if not 1 <= number <= len(ranking.rows):
        raise GenevaError(f"--write {cut(number)}: the table has rows 1 to {len(ranking.rows)}")
    row = _turned(ranking._replace(rows=[]), buildable, ranking.rows[number - 1])
    row = row._replace(spec=with_limits(ranking.requested, row.spec))
    return row, commented(ranking.target, number, row)


def with_limits(target: Target, spec: Spec) -> Spec:
    """The spec with each requirement that a key of ``[limits]`` can hold, so that checks hold it.

    Of a requirement and a limit of the frame the stricter one stays.
    """
    bounds = list(target.bounds)
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
