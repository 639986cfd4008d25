"""What a rack refuses, and which keys are a rack's only."""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.kinds.linear.motion import guided
from geneva_cli.motion.compatible import Conflict, is_set
from geneva_cli.motion.machine_spec import Spec


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of a rack's load; and of tables and keys that only a wheel on a shaft has."""
    load, turns = spec.load, spec.output.turns
    yield (
        turns & ((load.mass_kg != 0.0) | (load.force_N != 0.0)),
        ("load", "mass_kg"),
        "mass_kg and force_N are a rack's load; a wheel that turns has inertia_kgm2 and torque_Nm",
    )
    yield (
        (not turns) & ((load.inertia_kgm2 != 0.0) | (load.torque_Nm != 0.0)),
        ("load", "inertia_kgm2"),
        "inertia_kgm2 and torque_Nm are of a wheel that turns; a rack has mass_kg and force_N",
    )
    yield (
        not guided(spec) and load.guide_friction is not None,
        ("load", "guide_friction"),
        "guide_friction is of the guide of a rack that a plain crank or gears drive: remove it",
    )
    if turns:
        return
    yield (
        load.dwell_torque_Nm is not None,
        ("load", "dwell_torque_Nm"),
        "dwell_torque_Nm acts on a wheel's shaft, and is not available for a rack: remove it",
    )
    its = "is for a wheel on a shaft; a rack's load is mass_kg and force_N in [load]"
    yield (spec.mass, ("mass",), f"[[mass]] {its}")
    yield (is_set(spec.support), ("support",), f"[support] {its}")
    not_its = "is for a wheel on a shaft, and not available for a rack: remove it"
    for table in ("tolerance", "product"):
        yield (is_set(getattr(spec, table)), (table,), f"[{table}] {not_its}")
    shaft = "stiffness_Nm_rad damping_ratio wheel_diameter_mm wheel_overhang_mm wheel_span_mm"
    for table, keys in (("limits", "index_play_max_deg dwell_play_max_deg"), ("shaft", shaft)):
        values = getattr(spec, table)
        for key in keys.split():
            own = getattr(values, key)
            set_ = own is not None and own != getattr(type(values), key)
            yield (set_, (table, key), f"{key} {not_its}")
