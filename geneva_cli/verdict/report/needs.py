"""The keys that unknown values of strength and life need."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.drawings.model import PartsModel
from geneva_cli.verdict.strength import REASONS, strength

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def needs(model: PartsModel) -> Values:
    """A line for each set of keys."""
    return {"strength.needs": tuple(strength(model.mechanism).missing(tuple(REASONS)))}
