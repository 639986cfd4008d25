"""A Geneva stop: where it blocks the crank, and the contact there."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError
from geneva_cli.outlines.stop import wheel_stop
from geneva_cli.verdict.quantities.groups import own_names

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def stop(model: PartsModel) -> Values:
    """The stops of a crank; None without a convex face, or without parts."""
    values: Values = dict.fromkeys(own_names("stop", "report.stop:stop"))
    if not (model.mechanism.spec.wheel.stopped and model.mechanism.spec.is_flat):
        return values
    try:
        outlines = model.outlines
    except GenevaError:  # ``parts.none`` gives the reason
        return values
    stops = wheel_stop(outlines)
    assert stops is not None  # the wheel has a convex face
    from geneva_cli.loads.strength.stop import stop_contact

    contact = stop_contact(model.mechanism, stops.lever_mm, outlines.sizes.rim)
    named = {
        "turns": stops.turns,
        "first_deg": stops.first_deg,
        "last_deg": stops.last_deg,
        "overlap_mm": stops.overlap_mm,
        "lever_mm": stops.lever_mm,
        **contact._asdict(),
    }
    return {f"stop.{name}": value for name, value in named.items()}
