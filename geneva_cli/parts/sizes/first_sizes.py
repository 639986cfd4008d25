"""Default sizes under a load of the first of two wheels in series, and of its crank.

The first wheel carries the second's crank. Its load is taken to be constant: the greatest torque in
the shaft of that crank, so that no place of the roller is loaded less than it is. Then it is a
machine of its own, sized as any other.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import TypeAlias

from geneva_cli.drives.crank import Crank
from geneva_cli.errors import GenevaError
from geneva_cli.loads.strength.part_loads import PartLoads, single_loads
from geneva_cli.motion.drive import FirstWheel
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.motion.wheels.external import External
from geneva_cli.numerics.preferred import bores_from
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.sizes.holds import shaft_holds_both
from geneva_cli.parts.sizes.plain_sizes import FirstSizes, Sizes
from geneva_cli.parts.sizes.stressed import Stressed, stressed
from geneva_cli.spec.tables import Load, Size

Sized: TypeAlias = Callable[[Mechanism, PartLoads], tuple[Assembly, Sizes] | None]


def first_spec(mechanism: Mechanism, first: FirstWheel) -> Spec:
    """Return the spec of the first wheel and its crank, with the sizes that it shares."""
    spec, size = mechanism.spec, mechanism.spec.size
    shared = Size(
        center_distance_mm=first.distance_mm,
        roller_radius_mm=mechanism.roller_radius_mm,
        process=size.process,
        slot_clearance_mm=size.slot_clearance_mm,
        lock_clearance_mm=size.lock_clearance_mm,
        press_fit_mm=size.press_fit_mm,
        shaft_fit_mm=size.shaft_fit_mm,
        pin_gap_mm=size.pin_gap_mm,
        pin_mm=size.pin_mm,
        wheel_thickness_mm=size.link_thickness_mm,
        arm_thickness_mm=size.link_thickness_mm,
        arm_bore_mm=size.link_bore_mm,
        lock_bolts=0,  # the link below its disc has no holes for them
    )
    torque = single_loads(mechanism).crank_Nm if spec.is_loaded else 0.0
    return Spec(
        External(first.z),
        Crank(n_rpm=spec.drive.n_rpm),
        size=shared,
        load=Load(torque_Nm=torque if math.isfinite(torque) else 0.0),
        shaft=spec.shaft.replace(wheel_diameter_mm=None, crank_diameter_mm=None),
        material_wheel=spec.material_wheel,
        material_roller=spec.material_roller,
    )


@lru_cache(maxsize=16)
def first_sizes(mechanism: Mechanism, sized: Sized) -> FirstSizes | None:
    """Return what the load needs of a first wheel and its crank; None without load or first wheel.

    ``sized`` sizes a machine by its load, for that of the second wheel asks for the first one's.
    The crank is a link, with the bore of a link: larger ones are tried until its shaft holds.
    """
    first = mechanism.first_wheel
    spec = None if first is None else first_spec(mechanism, first)
    if spec is None or not spec.is_loaded:
        return None
    size, parts = spec.size.replace(crank_bore_mm=0.0), None
    try:
        loads = single_loads(build(spec))  # which no bore changes
    except GenevaError:
        return None  # the check of the parts reports the error
    usual = _stressed(spec.replace(size=size), sized, loads)
    if usual is None or math.isnan(usual.arm.length):  # a crank without a pin has no arm
        return None
    reach = float(usual.arm.length - usual.arm.hole)
    size = size.replace(wheel_thickness_mm=usual.contact)  # no bore changes it either
    for d in bores_from(usual.crank_shaft.diameter, reach):  # half of it is left as a wall
        tried = spec.replace(size=size.replace(arm_bore_mm=size.arm_bore_mm or d))
        parts = _stressed(tried, sized, loads) or parts
        if parts and (
            size.arm_bore_mm
            or shaft_holds_both(tried, "crank", parts.crank_shaft, loads.crank_N, loads.crank_Nm)
        ):
            break
    parts = parts or usual
    thick = max(parts.contact, float(parts.arm.thickness))
    return FirstSizes(thick, 0.5 * parts.pin, 0.5 * parts.crank_shaft.diameter)


def _stressed(spec: Spec, sized: Sized, loads: PartLoads) -> Stressed | None:
    try:
        flat = sized(build(spec), loads)
    except GenevaError:
        return None  # the check of the parts reports the error
    return stressed(*flat) if flat else None
