"""Cut sizes of the parts, and results of their whole turn."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError
from geneva_cli.verdict.quantities.groups import own_names

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def parts(model: PartsModel) -> Values:
    """Sizes of the parts; None without parts, with the reason in ``parts.none``.

    A sphere has the horn; its other sizes are angles, in the list of parts.
    """
    values: Values = dict.fromkeys(own_names("parts", "report.parts:parts"))
    return values | (_or_reason(model, _sizes) if model.mechanism.spec.has_parts else {})


def turned(model: PartsModel) -> Values:
    """Results of the parts' whole turn; None without it, with the reason in ``parts.none``."""
    values: Values = dict.fromkeys(own_names("parts", "report.parts:turned"))
    return values | (_or_reason(model, _turned) if model.mechanism.spec.is_turned else {})


def _or_reason(model: PartsModel, compute: Callable[[PartsModel], Values]) -> Values:
    try:
        return compute(model)
    except GenevaError as error:
        return {"parts.none": str(error)}


def _sizes(model: PartsModel) -> Values:
    horn: Values = {"parts.horn_mm": model.built.horn_mm}
    return horn | (cut_sizes(model) if model.mechanism.spec.is_flat else {})


def _turned(model: PartsModel) -> Values:
    parts, turn, output = model.parts, model.turn, model.mechanism.output
    gap = turn.smallest
    # the lock's play, in the unit of what the machine gives out
    play = {f"parts.dwell_play_{output.unit}": output.from_deg(turn.dwell.deg)}
    return {
        "parts.smallest_gap_mm": gap.mm if abs(gap.mm) > parts.contact else 0.0,
        "parts.smallest_gap_at_deg": gap.at_deg,
        **(play if parts.crank else {}),
    }


def cut_sizes(model: PartsModel) -> Values:
    """Cut sizes of flat parts."""
    outlines, size = model.outlines, model.outlines.sizes
    locked = bool(outlines.crank)
    return {
        "parts.rim_radius_mm": size.rim,
        "parts.slot_end_radius_mm": size.slot_end,
        "parts.lock_radius_mm": size.lock,
        "parts.recess_radius_mm": size.recess if locked else None,
        "parts.relief": outlines.relief if locked else None,
        "parts.wheel_bore_mm": 2.0 * size.wheel_bore,
        "parts.crank_bore_mm": 2.0 * size.crank_bore,
    }
