"""The first of two wheels in series, as a machine of its own: its spec, and what loads need of it.

It turns the second's crank shaft, and bears the greatest torque in it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError
from geneva_cli.loads.strength.part_loads import PartLoads, single_loads
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.tolerances import sizes_from
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sized_by_load import Stressed, equivalent_Nm, shaft_and_key_hold, stressed
from geneva_cli.parts.sizes import Sizes
from geneva_cli.spec.tables import Load, Size


def first_spec(mechanism: Mechanism, first: tuple[int, float]) -> Spec:
    """Return the spec of the first wheel and its crank, with the sizes that it shares.

    ``first`` is its number of slots, and its distance from its own crank.
    """
    spec, size = mechanism.spec, mechanism.spec.size
    shared = ("process", "slot_clearance_mm", "lock_clearance_mm", "press_fit_mm", "shaft_fit_mm")
    own = Size(
        center_distance_mm=first[1],
        roller_radius_mm=mechanism.roller_radius_mm,
        wheel_thickness_mm=size.link_thickness_mm,
        arm_thickness_mm=size.link_thickness_mm,
        arm_bore_mm=size.link_bore_mm,
        lock_bolts=0,  # the link below its disc has no holes for them
        **{key: vars(size)[key] for key in (*shared, "pin_gap_mm", "pin_mm")},
    )
    torque = single_loads(mechanism).crank_Nm if spec.is_loaded else 0.0
    return Spec(
        External(first[0]),
        Crank(n_rpm=spec.drive.n_rpm),
        size=own,
        load=Load(torque_Nm=torque if math.isfinite(torque) else 0.0),
        shaft=spec.shaft.replace(wheel_diameter_mm=None, crank_diameter_mm=None),
        material_wheel=spec.material_wheel,
        material_roller=spec.material_roller,
    )


@lru_cache(maxsize=16)
def first_sizes(
    mechanism: Mechanism, sized: Callable[[Mechanism, PartLoads], tuple[Assembly, Sizes] | None]
) -> tuple[float, float, float] | None:
    """Return what the load needs of a first wheel and its crank; None without either.

    That is the thickness of both, and the radii of the roller's pin and of the crank's shaft, mm.
    """
    first = mechanism.first_wheel
    spec = None if first is None else first_spec(mechanism, first)
    if spec is None or not spec.is_loaded:
        return None
    try:
        loads = single_loads(build(spec))  # which no bore changes
    except GenevaError:
        return None  # the check of the parts reports the error

    def dimensions(size: Size) -> Stressed | None:
        try:
            flat = sized(build(spec.replace(size=size)), loads)
        except GenevaError:
            return None  # the check of the parts reports the error
        return stressed(*flat) if flat else None

    size = spec.size.replace(crank_bore_mm=0.0)
    parts = usual = dimensions(size)
    if usual is None or math.isnan(usual.arm.length):  # a crank without a pin has no arm
        return None
    reach = float(usual.arm.length - usual.arm.hole)
    size = size.replace(wheel_thickness_mm=usual.contact)  # no bore changes it either
    # half of the arm is left as a wall
    for d in sizes_from(usual.crank_shaft.diameter, reach, bores=True):
        one = dimensions(size.replace(arm_bore_mm=size.arm_bore_mm or d))
        if one:
            parts = one
            moment = equivalent_Nm(spec, one.crank_shaft, loads.crank_N, loads.crank_Nm)
            fixed = spec.size.arm_bore_mm is not None
            if fixed or shaft_and_key_hold(spec, "crank", one, moment, loads.crank_Nm):
                break
    assert parts is not None
    thick = max(parts.contact, float(parts.arm.thickness))
    return thick, 0.5 * parts.pin, 0.5 * parts.crank_shaft.diameter
