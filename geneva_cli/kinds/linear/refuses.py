"""What a rack refuses, which keys are a rack's only, and the check that needs no parts."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError
from geneva_cli.kinds.linear.motion import guided
from geneva_cli.motion.compatible import Conflict, is_set
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.spec.least_wall import wall_min

if TYPE_CHECKING:
    from geneva_cli.verdict.checks import Check


def refuses(spec: Spec) -> Iterator[Conflict]:
    """Rules of a rack's load; and of tables and keys that only a wheel on a shaft has."""
    load, turns = spec.load, spec.output.turns
    yield Conflict(
        turns & ((load.mass_kg != 0.0) | (load.force_N != 0.0)),
        ("load", "mass_kg"),
        "mass_kg and force_N are a rack's load; a wheel that turns has inertia_kgm2 and torque_Nm",
    )
    yield Conflict(
        (not turns) & ((load.inertia_kgm2 != 0.0) | (load.torque_Nm != 0.0)),
        ("load", "inertia_kgm2"),
        "inertia_kgm2 and torque_Nm are of a wheel that turns; a rack has mass_kg and force_N",
    )
    yield Conflict(
        not guided(spec) and load.guide_friction is not None,
        ("load", "guide_friction"),
        "guide_friction is of the guide of a rack that a plain crank or gears drive: remove it",
    )
    if turns:
        return
    yield Conflict(
        load.dwell_torque_Nm is not None,
        ("load", "dwell_torque_Nm"),
        "dwell_torque_Nm acts on a wheel's shaft, and is not available for a rack: remove it",
    )
    its = "is for a wheel on a shaft; a rack's load is mass_kg and force_N in [load]"
    yield Conflict(spec.mass, ("mass",), f"[[mass]] {its}")
    yield Conflict(is_set(spec.support), ("support",), f"[support] {its}")
    not_its = "is for a wheel on a shaft, and not available for a rack: remove it"
    for table in ("tolerance", "product"):
        yield Conflict(is_set(getattr(spec, table)), (table,), f"[{table}] {not_its}")
    shaft = "stiffness_Nm_rad damping_ratio wheel_diameter_mm wheel_overhang_mm wheel_span_mm"
    for table, keys in (("limits", "index_play_max_deg dwell_play_max_deg"), ("shaft", shaft)):
        values = getattr(spec, table)
        for key in keys.split():
            own = getattr(values, key)
            set_ = own is not None and own != getattr(type(values), key)
            yield Conflict(set_, (table, key), f"{key} {not_its}")


def rack_horn(names: Collection[str], mechanism: Mechanism) -> Iterator[Check]:
    """The wall between slot and recess of a rack that is locked."""
    if mechanism.output.turns:
        return
    from geneva_cli.kinds.linear.rack import rack_sizes
    from geneva_cli.verdict.checks import compared

    try:
        sizes = rack_sizes(mechanism)
    except GenevaError:
        return  # the check of the parts reports the error
    if sizes.lock:
        least = wall_min(mechanism.spec.size, mechanism.center_distance_mm)
        yield compared("rack_horn_mm", sizes.horn, "at least", least)
