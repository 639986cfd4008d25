"""The space that wheels on a carrier take."""

from __future__ import annotations

from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError
from geneva_cli.verdict.checks.cranks import reach_mm
from geneva_cli.verdict.quantities.designs import Values


def envelope(model: PartsModel) -> Values:
    """Return the radius about the fixed axis that the wheels sweep, on a carrier."""
    if not model.mechanism.spec.is_flat:
        return {}
    try:
        outlines = model.outlines
    except GenevaError:  # ``parts.none`` gives the reason
        return {}
    return {"envelope_mm": model.mechanism.center_distance_mm + reach_mm(outlines)}
