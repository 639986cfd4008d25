"""What is no machine: the closed form on arrays as l nears 1, and a slot's chords."""

import math
from functools import partial

import machine_witness
import numpy as np
from witness import SIGN, mp, taylor, to_radians

from exact.cases import PLANE
from exact.compared import NAMES
from exact.machines import read
from exact.table import LIMIT, strictly, ulps, unit
from geneva_cli.errors import GenevaError
from geneva_cli.motion.wheels import classic
from geneva_cli.parts.slots.slot_profile import nodes, slot


def closed(g, l, a):
    """The wheel's angle by the crank's."""
    return mp.arg(1 - g * l * mp.expj(-g * a))


def arrays(table, sample):
    """The closed form as l nears 1, where 1 - 2 l cos a + l² is all rounding."""
    for k in range(1, 16):
        for gearing, g in SIGN.items():
            l = 1.0 - 10.0**-k
            rest = 1.0 - l  # exact (Sterbenz)
            scale = math.degrees(rest)
            x = [scale * t for t in (0.1, 0.3, 0.5, 1 / math.sqrt(3), 0.7, 1.0, 1.7, 3, 10, 100)]
            x = sorted(v for v in [*x, 1e-3, 0.1, 1.0, 10.0, 80.0] if v < 90.0)
            if g < 0:
                x = sorted({*x, *[180.0 - v for v in x]})
            x = np.array([*[-v for v in x[::-1]], 0.0, *x])
            at = partial(closed, g, mp.mpf(l))
            exact = [taylor(at, to_radians(v), 5) for v in x]
            got = strictly(partial(classic.derivatives, float(g), l, rest), x, (0, 1, 2, 3))
            place = [f"l=1-1e-{k} at {v:.17g}" for v in x]
            for n, name in enumerate(NAMES):
                values = [e[n] for e in exact]
                u = unit(max(abs(v) for v in values))
                slope = np.array([abs(float(e[n + 1])) for e in exact])
                bend = np.array([abs(float(e[n + 2])) for e in exact])
                step = np.radians([math.ulp(v) for v in x])
                # at the line of centres the slope is 0, and the bend is what moves it
                c = np.maximum(slope, bend * step / 2.0) * step / u
                row = (f"classic arrays, {gearing}, l to 1", name)
                table.add(row, ulps(got[n], values, u), c, place)


def chords(table, sample, rng, name):
    """The slot's chords for a tolerance: really nearer than it, or refused in clear words."""
    for L in (1.0,) if sample else (1e-6, 1.0, 100.0, 1e6):
        for tolerance in (1.0, 1e-3) if sample else (1.0, 1e-3, 1e-6, 1e-9):
            # the finest tolerances on the largest wheels take minutes to be refused
            if L / tolerance <= 1e9:
                chord_case(table, name, L, tolerance, rng)


def chord_case(table, name, L, tolerance, rng):
    where = f"z=6 L={L:g} tolerance={tolerance:g}"
    text = PLANE.format(6, "external", "kind = 'crank'")
    mechanism = read(f"{text}\nmotion.law = '{name}'\nsize.center_distance_mm = {L!r}")
    try:
        x = strictly(nodes, mechanism, tolerance)
    except GenevaError as error:
        if "--tolerance" not in str(error):
            table.fault(f"chords {name} {where}: refused without naming --tolerance: {error}")
        return
    got = strictly(slot, mechanism, x).centre
    (w,) = machine_witness.motions(mechanism.spec)
    for i in rng.sample(range(len(x) - 1), min(len(x) - 1, 12)):
        a, b = (mp.mpc(*got[k].tolist()) for k in (i, i + 1))
        for t in (0.21, 0.44, 0.5, 0.57, 0.83):  # not the sixteenths that the program looks at
            at = to_radians(x[i]) + (to_radians(x[i + 1]) - to_radians(x[i])) * t
            p = L * w.path(at) * mp.expj(-w.wheel(at))
            along = (p - a) * mp.conj(b - a) / abs(b - a) if b != a else 0
            share = min(max(along.real / abs(b - a), 0), 1) if b != a else 0
            off = float(abs(p - a - share * (b - a)))
            # in units of the tolerance, which 16 ulp of the slot's size may blur
            blur = 16 * math.ulp(L) / tolerance
            table.add(
                (f"chords, {name}", "tolerance"), LIMIT * (off / tolerance - blur), 0.0, where
            )
