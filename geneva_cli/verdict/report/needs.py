"""The keys that unknown values of strength and life need."""

from __future__ import annotations

from geneva_cli.drawings.model import PartsModel
from geneva_cli.verdict.report.values import Values
from geneva_cli.verdict.strength import REASONS, strength


def needs(model: PartsModel) -> Values:
    """A line for each set of keys."""
    return {"strength.needs": tuple(strength(model.mechanism).missing(tuple(REASONS)))}
