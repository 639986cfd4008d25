"""What the numbers of a report rest on: speed, clearances, load and limits, as they are given."""

from __future__ import annotations

from geneva_cli.parts.proof import Proof
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import Limits, Load, RollerMaterial, Shaft, WheelMaterial
from geneva_cli.verdict.report.values import Values

INPUTS = "inputs."
HELD_BY = f"{INPUTS}wheel.held_by"
ECHOED = {  # what the numbers below rest on, besides the machine's own shape
    "drive": ("n_rpm",),
    "size": (
        "process",
        "slot_clearance_mm",
        "lock_clearance_mm",
        "press_fit_mm",
        "face_width_mm",
        "pin_held",
        "pin_gap_mm",
        "lock_edge_mm",
    ),
    "load": tuple(key.key for key in fields(Load)),
    "shaft": tuple(key.key for key in fields(Shaft)),
    "material.wheel": tuple(key.key for key in fields(WheelMaterial)),
    "material.roller": tuple(key.key for key in fields(RollerMaterial)),
    "limits": tuple(key.key for key in fields(Limits)),
}


def input_names() -> tuple[str, ...]:
    """The names of the keys that a report repeats."""
    keys = (f"{INPUTS}{table}.{key}" for table, names in ECHOED.items() for key in names)
    return (HELD_BY, *keys)


def inputs(proof: Proof) -> Values:
    """What was asked."""
    spec = proof.mechanism.spec
    allowed = {"size": spec.size.allowances._asdict()}  # of the process, where a key is left out
    values: Values = {HELD_BY: spec.wheel.held_by}
    for table, names in ECHOED.items():
        given = spec.table(table) | allowed.get(table, {})
        values |= {f"{INPUTS}{table}.{key}": given[key] for key in names}
    return values
