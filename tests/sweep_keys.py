"""Sweeps of any numeric key compared with single designs: every machine, every quantity."""

import math

import numpy as np
from design_arrays import MACHINES, behind, drawn, machine
from words import law

from geneva_cli.drawings.model import PartsModel
from geneva_cli.errors import GenevaError
from geneva_cli.loads.cycle import cycle_of
from geneva_cli.loads.summary import summaries
from geneva_cli.motion.machine_spec import attribute
from geneva_cli.motion.many import TABLES, changed, many, may_vary
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.motion import Motion
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import (
    Load,
    Mass,
    Motor,
    Product,
    RollerMaterial,
    Shaft,
    Size,
    Support,
    Tolerance,
    WheelMaterial,
)
from geneva_cli.study.batches import known_columns
from geneva_cli.study.fields import values
from geneva_cli.verdict.quantities.groups import GROUPS
from geneva_cli.verdict.quantities.names import in_batch

GIVEN = {
    "load": Load(inertia_kgm2=0.3, torque_Nm=5.0, friction=0.1, dwell_torque_Nm=3.0),
    "size": Size(face_width_mm=10.0, slot_clearance_mm=0.01, lock_clearance_mm=0.02),
    "support": Support(friction=0.01, radius_mm=50.0, force_N=20.0),
    "motor": Motor(speed_variation=0.1, inertia_kgm2=0.01),
    "shaft": Shaft(
        stiffness_Nm_rad=2000.0,
        damping_ratio=0.02,
        wheel_diameter_mm=20.0,
        crank_diameter_mm=18.0,
        wheel_overhang_mm=30.0,
        wheel_span_mm=40.0,
        crank_overhang_mm=25.0,
        crank_span_mm=45.0,
        shear_stress_max_MPa=50.0,
    ),
    "material_wheel": WheelMaterial(stress_max_MPa=300.0, wear_mm3_Nm=1e-8),
    "material_roller": RollerMaterial(stress_max_MPa=300.0, dynamic_capacity_N=9000.0),
    "tolerance": Tolerance(center_distance_mm=0.02, slot_angle_deg=0.05),
    "product": Product(radius_mm=300.0, swing_Hz=3.0),
}
MORE = {
    "scca": machine(6, motion=Motion(law("scca", b=0.25, c=0.5, d=0.25))),
    "tuned": machine(6, motion=Motion(law("tuned", of="4-5-6-7", period_ratio=4.0))),
    "two cranks, slowed": behind(
        machine(8, rollers=2, crank_steps=(0, 3)), "side-crank", A=0.2
    ),  # whose parts are not built
    "unbalanced": machine(5, "carousel").replace(
        mass=(Mass("point", mass_kg=0.7, radius_mm=120.0, angle_deg=40.0),)
    ),
    "rack": machine(8, gearing="linear"),
}
SEVERAL = {"tolerance": Tolerance()}  # which has no keys for the places of cranks
# What replaces a part of ``GIVEN`` that a machine refuses.
OTHERS = {
    "two cranks": SEVERAL,
    "two cranks, slowed": SEVERAL,
    "rack": {
        **SEVERAL,
        "product": Product(),
        "load": Load(mass_kg=3.0, force_N=15.0, friction=0.1, guide_friction=0.1),
        "support": Support(),
        "shaft": Shaft(crank_diameter_mm=18.0, crank_overhang_mm=25.0, crank_span_mm=45.0),
    },
}
NAMES = (*MACHINES, *MORE)
TRIED = (4.0, 8.0, 0.3, 20.0, 60.0, 120.0, 0.0)  # values of keys that a spec leaves out
UNITS = 16 * np.finfo(float).eps
# Four times that after a root: of a horn's thickness, and of the wheel that a linkage drives.
ROOTS, FOURFOLD = ("strength.horn",), 4
UNBOUNDED = 1000.0  # N: a force without a peak; the load's torque gives it at a lever of 5 mm
MANY = 100  # the least number of quantities of a loaded machine that a batch computes
SUMS = 1e-12  # accuracy of sums, and of quantities that follow from them (load_summaries)
PLACE = 1e-6  # degrees: a peak is flat
# tables of studies, checks and parts, which no batch computes
SLOW = ("tolerance", "checks", "parts", "parts_list")
SHOWN = tuple(group for group in GROUPS if group.table not in SLOW)


def base(name):
    """A design of a machine that can be built, with a load, so that it has every quantity."""
    spec, rules = (MORE[name], []) if name in MORE else MACHINES[name]
    spec = spec.replace(**GIVEN | OTHERS.get(name, {}))
    varied = drawn(rules, 60, 7)
    every = ({key: rows[i].item() for key, rows in varied.items()} for i in range(60))
    return changed(spec, next(some for some in ({}, *every) if built(spec, some)))


def built(spec, values_of_keys):
    """The machine with these values of keys; None if it is refused."""
    try:
        return build(changed(spec, values_of_keys))
    except GenevaError:
        return None


def keys(spec):
    """The numeric keys of a spec that a batch may vary: whether whole, and the spec's own value."""
    return {
        f"{table}.{field.key}": (int in field.types, spec.table(table)[field.key])
        for table in TABLES
        for field in _fields(spec, table)
        if may_vary(spec, f"{table}.{field.key}")
    }


def _fields(spec, table):
    held = vars(spec)[attribute(table)]
    if held is None:
        return []
    return [*fields(type(held)), *(fields(type(held.law)) if table == "motion" else ())]


def apart(spec, key):
    """Two values of a key that both make a machine, the spec's own first if it has one."""
    whole, own = keys(spec)[key]
    for start in (own, *TRIED):
        if isinstance(start, int | float):
            for step in (0.04, -0.04):
                other = start + math.copysign(1, step) if whole else start + step * (start or 0.25)
                pair = [int(x) if whole else float(x) for x in (start, other)]
                if all(built(spec, {key: value}) for value in pair):
                    return pair
    return None


def every_key(spec):
    """Two values of each key that a batch may vary, which together make two machines."""
    varied = {}
    for key in keys(spec):
        pair = apart(spec, key)
        if pair and built(spec, {k: b for k, (_, b) in varied.items()} | {key: pair[1]}):
            varied[key] = pair
    return varied


def quantities(mechanism):
    """The quantities of a single design, and the greatest sizes of its loads."""
    every = summaries(cycle_of(mechanism)).items() if mechanism.spec.is_loaded else ()
    bounded = {load: one for load, one in every if None not in (one.max, one.min)}
    sizes = {f"loads.{load}.size": max(one.max, -one.min) for load, one in bounded.items()}
    return sizes | values(PartsModel(mechanism), SHOWN)


def off(spec, varied):
    """List the differences of a sweep's quantities from those of single designs, in words.

    A quantity that the batch lacks, or that is NaN there, is computed for each design alone.
    """
    count = len(next(iter(varied.values())))
    batch = many(spec, {key: np.array(row) for key, row in varied.items()})
    assert not batch.refused.any(), varied
    singles = [
        quantities(built(spec, {key: row[i] for key, row in varied.items()})) for i in range(count)
    ]
    assert batch.machine.designs == count
    together = known_columns(batch.machine, [name for name in singles[0] if in_batch([name])])
    rows = {
        name: np.broadcast_to(np.reshape(row, -1), (count,))
        for name, row in together.items()
        if row is not None and name in singles[0]
    }
    assert len(rows) > MANY
    return [
        f"{name} of design {i}: {row[i]:.17g}, alone {one[name]}"
        for name, row in rows.items()
        for i, one in enumerate(singles)
        if not _agrees(name, float(row[i]), one, 1 if spec.drive.ONE_ARM else FOURFOLD)
    ]


def _agrees(name, value, single, times):
    if math.isnan(value):
        return True
    alone = single[name]
    if math.isinf(value) or alone is None:
        return math.isinf(value) and alone is None
    group, _, own = name.rpartition(".")
    if own.endswith("at_deg"):
        return abs(value - alone) <= PLACE or _is_level(single, group, own)
    near = UNITS * (FOURFOLD if group in ROOTS else times)
    if own in ("min", "max") and single.get(f"{group}.size", single.get(f"{group}.max")) is None:
        # beside a place without a bound: p v of a matched slot varies by 42 units in the last place
        # from one double to the next about its least value
        near = UNITS * FOURFOLD
    if own in ("mean", "rms") or group in ("sizing", "life"):
        near = SUMS
    return abs(value - alone) <= near * max(abs(alone), _size(name, single))


def _size(name, single):
    """The scale of a signed value's error: its curve's peak, a radian for an angle, or 1."""
    group, _, own = name.rpartition(".")
    if own.endswith("_deg"):
        return math.degrees(1.0)
    if "share" in own or own == "margin":
        return 1.0
    if group.startswith("shock") and own in ("jump", "force_N", "moment_Nms"):
        # a root of a path length: its relative rounding grows as the root becomes smaller
        return abs(single[name] / single[f"{group}.jump"]) if single[name] else 0.0
    if own == "drag_Nm":  # a difference of two loads
        return single.get("loads.wheel_torque_Nm.size") or 0.0
    peak = single.get(f"{group}.size") or single.get(f"{group}.max")
    return UNBOUNDED if peak is None and group.endswith("_N") else peak or 0.0


def _is_level(single, group, own):
    """True if a curve has its extreme in several places or none: if it is 0 or unbounded."""
    return not single.get(f"{group}.{'min' if own == 'min_at_deg' else 'max'}")
