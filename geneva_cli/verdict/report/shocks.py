"""The blows of the roller at the worst of the tolerances, and what the wheel is off by them."""

from __future__ import annotations

from geneva_cli.analysis.blows import Blow, entry_blow, reversal_blow
from geneva_cli.analysis.change_of_sides import lasting_drag_Nm
from geneva_cli.analysis.loads.carried import inertia_kgm2
from geneva_cli.parts.proof import Proof
from geneva_cli.verdict.report.values import Values


def shocks(proof: Proof) -> Values:
    """At entry with R/L wrong, and where the roller changes sides; None where there is none.

    ``drag_Nm`` is the torque that must be added for it to stay on one wall.
    """
    mechanism = proof.mechanism
    coasts = inertia_kgm2(mechanism.spec) > 0.0
    return {
        **_blow("shock.entry", entry_blow(mechanism)),
        **_blow("shock.reversal", reversal_blow(mechanism)),
        "shock.reversal.drag_Nm": lasting_drag_Nm(mechanism) if coasts else None,
    }


def _blow(name: str, blow: Blow | None) -> Values:
    fields: Values = {f"{name}.{field}": None for field in Blow._fields}
    return fields if blow is None else {f"{name}.{k}": v for k, v in blow._asdict().items()}
