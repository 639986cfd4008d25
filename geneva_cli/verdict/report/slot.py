"""The section on curved slots: whether they drive the wheel positively under the spec's load."""

from __future__ import annotations

from geneva_cli.analysis.positive_drive import positive_drive
from geneva_cli.parts.proof import Proof
from geneva_cli.verdict.report.values import Values


def slot(proof: Proof) -> Values:
    """Where the wall that must push is cut away, and the distance of the slot's two branches."""
    mechanism = proof.mechanism
    drive = positive_drive(mechanism) if mechanism.law is not None else None
    return {
        "slot.positively_driven": not drive.loose_deg if drive else None,
        "slot.not_driven_share": drive.share if drive else None,
        "slot.branch_gap_mm": drive.gap_mm if drive else None,
        "slot.branch_gap_at_deg": drive.gap_at_deg if drive else None,
    }
