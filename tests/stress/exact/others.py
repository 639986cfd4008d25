"""What is no machine: the closed form on arrays as l nears 1, and a slot's chords."""

import math

import machine_witness
from witness import mp, to_radians

from exact.cases import PLANE
from exact.machines import read
from exact.table import LIMIT, strictly
from geneva_cli.errors import GenevaError
from geneva_cli.parts.slots.slot_profile import nodes, slot


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
