"""Machines of design_arrays.py under random loads, and a dense scan of their loads."""

import numpy as np
from design_arrays import MACHINES, drawn

from geneva_cli.loads.contact import NEAR_CUSP, NEVER_NEGATIVE, SQUARED
from geneva_cli.loads.instant import QUANTITIES
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.load_functions import LoadFunctions
from geneva_cli.loads.load_peaks import LoadSummary, load_summaries
from geneva_cli.motion.batch import taken
from geneva_cli.motion.many import many
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
    """Some designs of a machine, each under a random load."""
    spec, rules = MACHINES[name]
    spec = spec.replace(load=LOAD.replace(**changes), size=spec.size.replace(face_width_mm=10.0))
    kept = [rule for rule in CARRIED if rule[0] not in {f"load.{key}" for key in changes}]
    varied = drawn([*rules, *kept], n, seed)
    return spec, varied, many(spec, varied)


def dense_means(cycle, name, parts=2000):
    """Mean and root mean square of a quantity over a period, by Gauss's rule in many parts."""
    node, weight = np.polynomial.legendre.leggauss(20)
    edges = np.linspace(0.0, 1.0, parts + 1)
    half = 0.5 * np.diff(edges)[:, None]
    s = 0.5 * (edges[1:] + edges[:-1])[:, None] + half * node
    sums = np.zeros(2)

    def both(engagement, stretch, x):
        value = cycle.moving(engagement, x.ravel(), [name], stretch).reshape(x.shape)
        value = np.abs(value) if name in NEVER_NEGATIVE else value  # told as a size
        return np.stack((value, value * value))

    for engagement, stretch in cycle.stretches:
        a, b = stretch.start, stretch.end
        if engagement.slot.curved and 0.0 in (a, b):  # a parabola to mid-motion, as beside it
            gap = NEAR_CUSP * (engagement.exit_deg if b else engagement.entry_deg)
            a, b = (gap if end == 0.0 else end for end in (a, b))
            beside = both(engagement, stretch, gap * np.array([1.0, 2.0, 3.0]))
            for k, values in enumerate(beside):
                inwards = np.polyint(np.polyfit([1.0, 2.0, 3.0], values, 2))
                sums[k] += abs(gap) * np.polyval(inwards, 1.0)
        x = a + (b - a) * s * s * (3.0 - 2.0 * s)  # roots at its ends are smooth
        rate = (b - a) * 6.0 * s * (1.0 - s) * half * weight
        sums += (both(engagement, stretch, x) * rate).sum(axis=(1, 2))
    mean, square = sums / cycle.mechanism.period_deg
    return mean, np.sqrt(square)


def beyond(batch, places, seed, names=NAMES, ends=None):
    """The excess of a scan over a quantity's extremes, over its size: (designs, names).

    ``ends`` are the extremes, by default those of all ``names`` computed together. The scan has one
    random place in each of ``places`` equal parts of the motion.
    """
    random = np.random.default_rng(seed)
    machine, n = batch.machine, len(batch.which)
    together = ends or load_summaries(machine, names, means=False)
    out = np.full((n, len(names)), -np.inf)
    for engagement in machine.engagements:
        for i in range(0, n, BLOCK):
            part = slice(i, min(i + BLOCK, n))
            here, case = taken((engagement, load_case(machine)), part)
            a, b = (np.reshape(x, (-1, 1)) for x in (here.entry_deg, here.exit_deg))
            share = (np.arange(places) + random.random((part.stop - i, places))) / places
            x = np.asfortranarray(a + (b - a) * np.clip(share, 1e-9, 1.0 - 1e-9))
            load = LoadFunctions(here, case, names)
            with np.errstate(all="ignore"):
                instant = load.at(x, slice(0, len(x)))[0]
            for k, name in enumerate(names):
                one = LoadSummary(*[v if v is None else v[part] for v in together[name]])
                out[part, k] = np.maximum(out[part, k], _passed(instant, name, one, x.shape))
    return out


def _passed(here, name, one, shape):
    row = QUANTITIES[name](here)
    value = np.broadcast_to(row.value.c[0], shape)
    lost = False if row.margin is None else row.margin.c[0] <= 0.0
    there = np.isfinite(value) & ~np.asarray(lost)
    if name in SQUARED:
        value = np.sqrt(np.maximum(value, 0.0))
    most = np.where(there, value, -np.inf).max(axis=1)
    least = np.where(there, value, np.inf).min(axis=1)
    size = np.maximum(np.maximum(abs(most), abs(least)), np.finfo(float).tiny)
    # designs without such a value have infinite ones
    with np.errstate(invalid="ignore", over="ignore"):
        over = np.maximum(most - one.max, one.min - least) / size
    over = np.where(np.isnan(over), np.inf, over)  # an extreme that is NaN is missed, too
    return np.where(there.any(axis=1), over, -np.inf)
