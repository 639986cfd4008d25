"""Quantities of the stops of a crank."""

from __future__ import annotations

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.stop.parts import stop_contact, wheel_stop
from geneva_cli.parts.parts import Parts
from geneva_cli.verdict.quantities.designs import Values


def stop(parts: Parts) -> Values:
    """Return the stops of a crank, where the wheel has a convex face."""
    if not (parts.mechanism.spec.wheel.stopped and parts.mechanism.spec.is_flat):
        return {}
    try:
        outlines = parts.outlines
    except GenevaError:  # ``parts.none`` gives the reason
        return {}
    stops = wheel_stop(outlines)
    assert stops is not None  # the wheel has a convex face
    contact = stop_contact(parts.mechanism, stops.lever_mm, outlines.sizes.rim)
    return {
        "turns": stops.turns,
        "first_deg": stops.first_deg,
        "last_deg": stops.last_deg,
        "overlap_mm": stops.overlap_mm,
        "lever_mm": stops.lever_mm,
        **contact._asdict(),
    }
