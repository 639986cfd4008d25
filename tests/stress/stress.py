"""Numerical stress against mpmath: `tests/stress/stress.py [--sample]`, part of `make stress`.

Every machine (the kinds of drive and the laws come from the program's registries) at the edge of
what a spec may hold. One row a machine and quantity, with the place where the program is worst:

- ``error``: in units in the last place of the quantity's own peak in that machine. For the angle
  of a peak, of the half motion angle; for the slot, of its farthest point from the wheel's axis.
- ``condition``: what one such unit of the problem itself moves there, in the same units: the
  largest of |dq/dx| ulp(x) for the input angle x, |dq/dp| ulp(p) for each value p of the drive
  (A, say) and, in the outer quarter of the motion, |dq/dx| ulp(entry angle). For a curved slot the
  entry angle counts everywhere: the law is laid over the motion from it. The angle of a peak moves
  by d(slope) / |second derivative| for d(slope) one unit of the slope's own peak, and by what one
  unit of p and of the engagement's mid-motion moves it. A slot also turns by one unit of the
  wheel's greatest angle.
- ``share``: error / max(1, condition), at most 16; else the exit status is 1.

A curved slot's motion angle is a difference (alpha0_deg from the natural angle), and as
ill-conditioned as alpha0_deg is near its limit. It has a row of its own, in units of the larger of
the two; position to jerk are then compared for the motion angle that the program has.

Nothing may warn, raise a floating-point flag, hold a NaN or change NumPy's settings.
"""

import argparse
import random
import sys
import time
import warnings
from functools import partial

import numpy as np
from exact.curved import chords, curved, law_files
from exact.fronts import FRONTS
from exact.laws import law_cases
from exact.others import OTHERS, others
from exact.rates import DIGITS
from exact.straight import arrays, ratio_files, several, straight
from exact.table import LIMIT, Table
from witness import LAWS as LAW_WITNESSES
from witness import SIGN, mp
from words import LAWS

from geneva_cli.motion.registry import DRIVES, GEARINGS


def missing():
    """List the kinds in the registries that have no witness."""
    # a gear sector is a straight slot and a straight line: test_gear_sector.py has its witness;
    # a carousel is a plain crank seen from its carrier: test_carousel.py; a rack has closed forms:
    # test_machines.py
    known = {*FRONTS, *OTHERS, *SIGN, "gear-sector", "carousel", "linear"}
    out = [f'drive kind "{kind}"' for kind in DRIVES if kind not in known]
    out += [f'gearing "{g}"' for g in GEARINGS if g not in known]
    return out + [f'law "{name}"' for name in LAWS if name not in LAW_WITNESSES]


def parts(sample):
    """The parts of the table: for each name a function that fills the table."""
    out = {}
    for kind in DRIVES:
        if kind in FRONTS:
            fits = getattr(FRONTS[kind], "fits", lambda *_: True)
            for gearing in [g for g in SIGN if any(fits(v, g, 3) for v in FRONTS[kind].few)]:
                out[f"{gearing}, {kind}"] = partial(straight, gearing=gearing, kind=kind)
            if FRONTS[kind].few != ((),) and not hasattr(FRONTS[kind], "fits"):
                out[f"external, {kind}, rollers"] = partial(several, kind=kind)
    for name, shape in law_cases(sample):
        which = f"curved, {name} {shape:g}"
        rng = random.Random(which)
        out[which] = partial(curved, rng=rng, name=name, shape=shape)
    for name in OTHERS:
        out[name] = partial(others, name=name)
    out["curved, table"] = law_files
    out["ratio file"] = ratio_files
    out["classic arrays"] = arrays
    for name in LAWS:
        out[f"chords, {name}"] = partial(chords, rng=random.Random(name), name=name)
    return out


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
