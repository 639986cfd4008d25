"""Positive drive of curved slots under the spec's load."""

from __future__ import annotations

from typing import TYPE_CHECKING

from geneva_cli.analysis.positive_drive import positive_drive
from geneva_cli.drawings.model import PartsModel

if TYPE_CHECKING:
    from geneva_cli.verdict.report.values import Values


def slot(model: PartsModel) -> Values:
    """False if the wall that must push is cut away; None for straight slots."""
    drive = positive_drive(model.mechanism)
    return {"slot.positively_driven": not drive.loose_deg if drive else None}
