"""Machines of design_arrays.py under loads of their own, and a scan that knows no search."""

import numpy as np
from design_arrays import MACHINES, drawn

from geneva_cli.analysis.loads.contact import contact
from geneva_cli.analysis.loads.cycle import Cycle
from geneva_cli.analysis.loads.loaded_many import Loaded, look
from geneva_cli.analysis.loads.loaded_many import machine as of
from geneva_cli.analysis.loads.many import summaries_of_many
from geneva_cli.analysis.loads.quantities import QUANTITIES, SQUARED
from geneva_cli.machine.many import many, taken
from geneva_cli.spec.tables import Load

LOAD = Load(inertia_kgm2=1.0, friction=0.1)
CARRIED = [
    ("load.inertia_kgm2", 0.0, 3.0),
    ("load.torque_Nm", 0.0, 30.0),
    ("load.efficiency", 0.5, 1.0),
    ("load.friction", 0.0, 0.3),
    ("drive.n_rpm", 5.0, 100.0),
    ("size.face_width_mm", 5.0, 20.0),
]
NAMES = ("pin_force_N", "sliding_m_s", "input_torque_Nm", "contact_stress_MPa")
BLOCK = 512  # designs scanned together


def loaded(name, n, seed, **changes):
    """Some designs of a machine, all under loads of their own."""
    spec, rules = MACHINES[name]
    spec = spec.replace(load=LOAD.replace(**changes), size=spec.size.replace(face_width_mm=10.0))
    kept = [rule for rule in CARRIED if rule[0] not in {f"load.{key}" for key in changes}]
    varied = drawn([*rules, *kept], n, seed)
    return spec, varied, many(spec, varied)


def beyond(found, places, seed):
    """By what share of a quantity's size places of a scan pass its extremes: (designs, NAMES).

    One place anywhere in each of so many equal parts of the motion, others in each design.
    """
    random = np.random.default_rng(seed)
    machine, n = found.machine, len(found.which)
    together = summaries_of_many(machine, NAMES, told=())
    out = np.full((n, len(NAMES)), -np.inf)
    for engagement in machine.engagements:
        for i in range(0, n, BLOCK):
            part = slice(i, min(i + BLOCK, n))
            some = taken(of(engagement, Cycle(machine).given, NAMES, {}), part)
            here, given, _ = some
            a, b = (np.reshape(x, (-1, 1)) for x in (here.entry_deg, here.exit_deg))
            share = (np.arange(places) + random.random((part.stop - i, places))) / places
            x = np.asfortranarray(a + (b - a) * np.clip(share, 1e-9, 1.0 - 1e-9))
            load = Loaded(some, NAMES)
            with np.errstate(all="ignore"):
                found_ = look(load.kinds, given, contact(here, x, reactions=False), None).instant
            for k, name in enumerate(NAMES):
                one = type(together[name])(*[v if v is None else v[part] for v in together[name]])
                out[part, k] = np.maximum(out[part, k], _passed(found_, name, one, x.shape))
    return out


def _passed(here, name, one, shape):
    row = QUANTITIES[name](here)
    value = np.broadcast_to(row.value.c[0], shape)
    lost = False if row.room is None else row.room.c[0] <= 0.0
    there = np.isfinite(value) & ~np.asarray(lost)
    if name in SQUARED:
        value = np.sqrt(np.maximum(value, 0.0))
    most = np.where(there, value, -np.inf).max(axis=1)
    least = np.where(there, value, np.inf).min(axis=1)
    size = np.maximum(np.maximum(abs(most), abs(least)), np.finfo(float).tiny)
    over = np.maximum(most - one.max, one.min - least) / size
    return np.where(there.any(axis=1), over, -np.inf)
