"""The search for machines that meet a requirement, with their costs, the best first."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from typing import NamedTuple

from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.wheels.classic import rollers_max
from geneva_cli.progress import tracked
from geneva_cli.spec.load_limits import LIMITED
from geneva_cli.study.fields import Pick
from geneva_cli.study.pool import cores, mapped
from geneva_cli.study.rows import Cell, rows_of
from geneva_cli.study.sweep.constraints import Constraint, Nearness, is_number
from geneva_cli.study.synth.families.family import natural_deg
from geneva_cli.study.synth.families.straight_slots import MOST
from geneva_cli.study.synth.group_search import all_kinds, replacement_rows, with_batch_values
from geneva_cli.study.synth.machine_rows import MachineRow
from geneva_cli.study.target import TURNS, Target
from geneva_cli.verdict.quantities.quantity_names import in_batch

TURNED = 20  # rows whose parts are turned by default


class Ranking(NamedTuple):
    """The rows that meet a requirement, in order, and the requirement itself."""

    rows: list[MachineRow]
    target: Target  # with its bounds on times as ranges
    requested: Target

    def rank(self, row: MachineRow) -> tuple[object, ...]:
        """The sort key of a row."""
        return _rank(self.requested, row)

    def in_turn(self, row: MachineRow) -> MachineRow | None:
        """A row with the requested quantities; None if it breaks a bound on them."""
        if not self.requested.names:
            return row
        try:
            return _bounded(self.requested, with_batch_values(self.requested.names, [row]))[0]
        except GenevaError:
            return None


def search(target: Target) -> Ranking:
    """The machines that meet the requirement, in order; no part has been turned yet.

    Raises GenevaError, saying what is within reach, if there is none.
    """
    narrowed = target.with_times()
    narrowed.refuse_contradictions()
    by_kind = all_kinds(narrowed, target.names)
    # the error message says how near they come
    if target.acceleration_max is None and not any(kind.keeps for kind in by_kind):
        by_kind = all_kinds(target, target.names, how_near=True)
    every = [row for kind in by_kind for row in kind.rows]
    if not every:
        if target.acceleration_max is not None:
            return search(target.by_bounds)  # its message says how near they come
        raise GenevaError(_out_of_reach(target, [e for kind in by_kind for e in kind.errors]))
    ranked = _ranked(target, every)
    limits = _frame_limits(target)
    if limits and narrowed.motion_for(1) and any(row.breaks_limit for row in ranked):
        # rows of the same kinds whose machines keep the frame's limits too
        which = [any(row.breaks_limit for row in kind.rows) for kind in by_kind]
        strict = narrowed._replace(bounds=(*narrowed.bounds, *limits))
        found = all_kinds(strict, target.names, which=which)
        within = [row for kind in found for row in kind.rows if not row.breaks_limit]
        with suppress(GenevaError):  # none keeps the bounds as well
            ranked = _with_replacements(ranked, _ranked(target, within))
        ranked.sort(key=partial(_rank, target))
    ranking = Ranking(ranked, narrowed, target)
    others = map(ranking.in_turn, replacement_rows(narrowed, ranked[:TURNED], ranked))
    ranked.extend(row for row in others if row)
    ranked.sort(key=ranking.rank)
    return ranking


def _ranked(target: Target, rows: list[MachineRow]) -> list[MachineRow]:
    rows = _worthwhile(target, _bounded(target, rows) if target.names else rows)
    rows.sort(key=partial(_rank, target))
    return _first_of_each(rows, linkages=in_batch(target.quantities))


def _rank(target: Target, row: MachineRow) -> tuple[object, ...]:
    """The sort key of a row: the goal's quantity, then peaks, equal in 12 digits."""
    one = row.candidate
    first: tuple[object, ...] = ()
    if target.sort:
        value = row.extra[target.names.index(target.sort.name)]
        # texts, and unknown values, come behind the numbers
        is_known = is_number(value)
        first = (0, _in_12_digits(_first(target, row))) if is_known else (1, str(value))
    peaks = _in_12_digits(one.peak), _in_12_digits(one.jerk_max)
    return (*first, *peaks, one.rollers, one.z, one.gearing, one.drive)


def _in_12_digits(x: float) -> float:
    return float(f"{x:.12g}")


def _first(target: Target, row: MachineRow) -> float:
    """The first number of the sort key, least first; NaN if there is none."""
    if not target.sort:
        return row.candidate.peak
    value = row.extra[target.names.index(target.sort.name)]
    return target.sort.sign * float(value) if is_number(value) else math.nan


def _worthwhile(target: Target, machines: list[MachineRow]) -> list[MachineRow]:
    """The rows without machines of two numbers that are hardly better than one of one number."""
    one = [row for row in machines if not row.candidate.of_two_numbers]

    def beaten(row: MachineRow) -> bool:
        own, value = row.candidate, _first(target, row)
        least_gain = 0.01 * abs(value)  # over a machine of one number
        return any(
            (nearest or not value < _first(target, other) - least_gain)
            for other in one
            if (own.z, own.rollers, own.law) == (other.candidate.z, other.candidate.rollers, None)
            and (
                own.drive == other.candidate.drive
                or (own.gearing == other.candidate.gearing and not other.candidate.is_driven)
            )
        )

    nearest = target.with_times().any_motion and not target.sort
    return [row for row in machines if not (row.candidate.of_two_numbers and beaten(row))]


def _out_of_reach(target: Target, errors: list[str]) -> str:
    """The error message if no machine was found: what would be within reach."""
    counts = target.counts
    m = target.rollers or next((int(m) for m in counts if m >= 1.0), 1)
    motion = target.motion_for(m)
    most = max(
        rollers_max(natural_deg(target.wheel(g, z))) for z in target.z for g in target.gearings
    )
    if motion is None:
        return f"--rollers {m}: they jam on every requested wheel; at most {most}"
    if target.rollers is None and m > most:
        return (
            f"{target.words}: out of reach: it takes {m} rollers, but straight slots carry at "
            f"most {most} here. No curved slots or cam with so many can be built"
        )
    if motion.low * m >= 360.0:
        return (
            f"{target.words}: {m} motions of {motion.low:.7g} deg leave no dwell in a turn of 360. "
            f"With {m} rollers a motion must be below {360.0 / m:.7g} deg (tau below 1)"
        )
    if max(counts) < 1.0:
        return (
            f"{target.words}: out of reach: a wheel rests so long only behind a first wheel. That "
            f"turns the crank once in {TURNS[0]} to {TURNS[-1]} turns: none of these rests so long"
        )
    first = f"; the first says: {errors[0]}" if errors else ""
    if target.wheels:
        return (
            f"{target.words}: out of reach on a carrier: its wheels have straight radial slots, "
            "whose number gives the motion. Several wheels share one finger, and each must leave "
            f"it before the next one arrives{first}"
        )
    if not target.output.turns:
        return (
            f"{target.words}: out of reach of a rack: no drive goes beyond A or eccentricity "
            f"{MOST}{first}"
        )
    return (
        f"{target.words}: out of reach with {'one roller' if m == 1 else f'{m} rollers'}: curved "
        "slots turn an internal wheel at most half as fast as the crank"
        + (f", and no drive goes beyond A or eccentricity {MOST}" if m == 1 else "")
        + f"; use more slots or a longer motion{first}"
    )


def _frame_limits(target: Target) -> tuple[Constraint, ...]:
    """The frame's limits as bounds; the lock's load is equal in all machines of a wheel."""
    values = target.frame.limits.as_dict() if target.frame else {}
    return tuple(
        Constraint(name, ">=" if "_min" in key else "<=", float(values[key]))
        for key, name in LIMITED.items()
        if values.get(key) is not None
    )


def _kind(row: MachineRow) -> tuple[object, ...]:
    one = row.candidate
    return one.gearing, one.z, one.drive, one.law, one.fixed, one.rollers


def _first_of_each(rows: Sequence[MachineRow], linkages: bool = False) -> list[MachineRow]:
    """The first row of every kind, or the first that may be built if that one cannot."""
    kept: list[MachineRow] = []
    can_be: dict[object, bool] = {}  # by kind, whether one of the kept rows may be built
    for i, row in enumerate(rows):
        own = i if linkages and row.candidate.crank_mm is None else _kind(row)
        if own not in can_be or (not can_be[own] and not row.is_impossible):
            kept.append(row)
            can_be[own] = not row.is_impossible
    return kept


def _with_replacements(rows: Sequence[MachineRow], kept: Sequence[MachineRow]) -> list[MachineRow]:
    """The rows, with those that break a limit replaced by rows ``kept`` of their kind."""
    broken = {_kind(row) for row in rows if row.breaks_limit}
    instead = [row for row in kept if _kind(row) in broken and not row.breaks_limit]
    mended = {_kind(row) for row in instead}
    return [*(row for row in rows if _kind(row) not in mended), *instead]


def _bounded(target: Target, rows: Sequence[MachineRow]) -> list[MachineRow]:
    names = target.names
    alone = [row.spec for row in rows if not row.extra]
    rest = mapped(partial(_values, Pick(names)), alone, min(cores(), len(alone)), "machines")
    rest = tracked(rest, "machines computed", len(alone))
    values = [row.extra or next(rest) for row in rows]
    known = [(row, cells) for row, cells in zip(rows, values, strict=True) if cells is not None]
    nearness = Nearness([(names.index(b.name), b) for b in target.bounds])
    if known:
        nearness.add(rows_of([cells for _, cells in known]).numbers)
    kept = [
        row._replace(extra=cells)
        for row, cells in known
        if all(b.kept(cells[i]) for i, b in nearness.bounds)
    ]
    if not kept:
        raise GenevaError(f"--subject-to: {_how_near(nearness, len(rows))}")
    return kept


def _values(of: Pick, spec: Spec) -> tuple[Cell, ...] | None:
    try:
        return tuple(of.of(build(spec)))
    except GenevaError:  # parts that cannot be drawn have no quantities
        return None


def _how_near(nearness: Nearness, count: int) -> str:
    """The bounds that none of the machines keeps, and how near one is; or that none keeps all."""
    phrases = [
        f"{b} (not known)" if nearest is None else f"{b} (nearest {nearest:.6g})"
        for (_, b), kept, nearest in zip(
            nearness.bounds, nearness.kept, nearness.nearest, strict=True
        )
        if not kept
    ]
    if not phrases:
        phrases = [str(b) for _, b in nearness.bounds]
        phrases[-1] += " at once"
    return f"none of {count} machines that keep all other bounds keeps {' and '.join(phrases)}"
