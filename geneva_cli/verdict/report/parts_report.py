"""Cut sizes and list of the parts, and results of their whole turn."""

from __future__ import annotations

from collections.abc import Callable

from geneva_cli.drawings.parts_list import FIRST, KINDS, parts_list
from geneva_cli.errors import GenevaError
from geneva_cli.parts.parts import Parts
from geneva_cli.table import Reading, rows_table
from geneva_cli.verdict.quantities.batch_designs import Values


def parts(of: Parts) -> Values:
    """Sizes of the parts, or the reason in ``none`` why there are none.

    A sphere has the horn; its other sizes are angles, in the list of parts.
    """
    return _or_reason(of, _sizes) if of.mechanism.spec.has_parts else {}


def turned(parts: Parts) -> Values:
    """Results of the parts' whole turn, or the reason in ``none`` why there is no turn."""
    return _or_reason(parts, _turned) if parts.mechanism.spec.is_turned else {}


def _or_reason(parts: Parts, compute: Callable[[Parts], Values]) -> Values:
    try:
        return compute(parts)
    except GenevaError as error:
        return {"none": str(error)}


def _sizes(parts: Parts) -> Values:
    horn: Values = {"horn_mm": parts.built.horn_mm}
    return horn | (cut_sizes(parts) if parts.mechanism.spec.is_flat else {})


def _turned(parts: Parts) -> Values:
    turn, output = parts.turned.turn, parts.mechanism.output
    gap = turn.smallest
    # the lock's play, in the unit of what the machine gives out
    play = {f"dwell_play_{output.unit}": output.from_deg(turn.dwell.deg)}
    return {
        "smallest_gap_mm": gap.mm if abs(gap.mm) > parts.contact else 0.0,
        "smallest_gap_at_deg": gap.at_deg,
        **(play if parts.locked else {}),
    }


def cut_sizes(parts: Parts) -> Values:
    """Cut sizes of flat parts."""
    outlines, size = parts.outlines, parts.outlines.sizes
    locked = bool(outlines.crank)
    return {
        "rim_radius_mm": size.rim,
        "slot_end_radius_mm": size.slot_end,
        "lock_radius_mm": size.lock,
        "recess_radius_mm": size.recess if locked else None,
        "relief": outlines.relief if locked else None,
        "wheel_bore_mm": 2.0 * size.wheel_bore,
        "crank_bore_mm": 2.0 * size.crank_bore,
    }


def parts_list_tables(parts: Parts) -> Values:
    """The three tables; None for one without rows, such as the pivots of a spherical wheel."""
    rows = parts_list(parts).to_rows()
    values: Values = {}
    for kind, names in KINDS.items():
        own = [[row[name] for name in names] for row in rows if row["row"] == kind]
        table = rows_table(names, own, mixed=True).replaced(reading=Reading(FIRST))
        values[kind] = table if own else None
    return values
