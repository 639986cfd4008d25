"""Numerical stress against mpmath: `tests/stress/stress.py [--sample]`, part of `make stress`.

Every machine (the kinds of drive and the laws come from the program's registries) at the edge of
what a spec may hold. One row a machine and quantity, with the place where the program is worst:

- ``error``: in units in the last place of the quantity's own peak in that machine. For the angle
  of a peak, of the half motion angle; for the slot, of its farthest point from the wheel's axis.
- ``condition``: what one such unit of the problem itself moves there, in the same units: the
  largest of |dq/dx| ulp(x) for the input angle x or, where they are greater, the angles of entry,
  exit and mid-motion; and of what one unit of each number of the spec moves. The angle of a peak
  moves by d(slope) / |second derivative| for d(slope) one unit of the slope's own peak, or what
  one unit of a number moves the slope by. A slot also turns by one unit of the wheel's angle.
- ``share``: error / max(1, condition), at most 16; else the exit status is 1.

Nothing may warn, raise a floating-point flag, hold a NaN or change NumPy's settings.
"""

import argparse
import math
import random
import sys
import time
import warnings
from functools import partial

import machine_witness
import numpy as np
from exact.cases import MACHINES, PLANE
from exact.machines import machines, read
from exact.table import DIGITS, LIMIT, Table, strictly
from witness import LAWS as LAW_WITNESSES
from witness import SIGN, mp, to_radians
from words import LAWS

from geneva_cli.errors import GenevaError
from geneva_cli.motion.registry import DRIVES, GEARINGS
from geneva_cli.parts.slots.slot_profile import flanks, nodes


def missing():
    """List the kinds in the registries that have no witness."""
    # a gear sector is a straight slot and a straight line: test_gear_sector.py has its witness;
    # a carousel is a plain crank seen from its carrier: test_carousel.py; a rack has closed forms:
    # test_machines.py
    names = {word for name in MACHINES for word in name.split(", ")}
    known = {*names, *SIGN, "gear-sector", "carousel", "linear"}
    out = [f'drive kind "{kind}"' for kind in DRIVES if kind not in known]
    out += [f'gearing "{g}"' for g in GEARINGS if g not in known]
    return out + [f'law "{name}"' for name in LAWS if name not in LAW_WITNESSES]


def parts(sample):
    """The parts of the table: for each name a function that fills the table."""
    out = {name: partial(machines, name=name) for name in MACHINES}
    for name in LAWS:
        out[f"chords, {name}"] = partial(chords, rng=random.Random(name), name=name)
    return out


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
    got, *_ = strictly(flanks, mechanism, x)
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


def fill(table, part, sample):
    """Add one part; floating-point flags are errors in the program's own work."""
    before = np.geterr()
    with mp.workdps(DIGITS), warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("error")
        part(table, sample)
    if np.geterr() != before:
        table.fault(f"NumPy's settings changed: {before} to {np.geterr()}")


def run(sample):
    """Return the whole table, with faults and missing witnesses."""
    table = Table()
    for name, part in parts(sample).items():
        start = time.perf_counter()
        fill(table, part, sample)
        print(f"# {name}: {time.perf_counter() - start:.0f} s, {table.count} values so far",
              file=sys.stderr)  # fmt: skip
    for what in missing():
        table.fault(f"{what}: no witness; write one in tests/stress/exact")
    return table


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--sample", action="store_true", help="a few machines of every kind")
    table = run(parser.parse_args().sample)
    table.print()
    for what in table.faults:
        print(f"fault: {what}")
    for row, w in table.over.items():
        print(f"over {LIMIT:g}: {', '.join(row)}: {w}")
    sys.exit(bool(table.faults or table.over))


if __name__ == "__main__":
    main()
