"""Sweeps against single designs, whatever varies: part of `make stress`.

    stress_sweep.py [--one-of N] [--pairs N] [--machine NAME]... [--seconds S] [--seed N]

Of every machine (those of tests/sweep_keys.py) numeric keys vary alone, and are given as lists of
equal values: all of the wheel, drive and motion, and one of four of the other tables, whose keys
all machines have; --one-of 1 takes all. Each machine draws its own, so that 43 machines together
take each key some ten times: 35 minutes instead of 90. Of all pairs of keys some are drawn, and
vary together. Every quantity that a sweep has of arrays is held against that of each design alone.
One row a machine; what differs follows it, and the exit status is then 1.
"""

import argparse
import math
import random
import sys
import time
import warnings

from sweep_keys import NAMES, apart, base, built, keys, off


def variations(spec, pairs, draw, one_of):
    """What varies, one sweep after the other: keys, and their values in each design."""
    known = {key: pair for key in keys(spec) if (pair := apart(spec, key))}
    common = sorted(key for key in known if not key.startswith(("wheel.", "drive.", "motion.")))
    left_out = {*common} - {*draw.sample(common, math.ceil(len(common) / one_of))}
    for key, (own, other) in known.items():
        if key not in left_out:
            yield {key: [own, other]}
            yield {key: [own, own, own]}
    for _ in range(pairs):
        some = {key: known[key] for key in draw.sample(sorted(known), 2)}
        rows = [dict(zip(some, row, strict=True)) for row in zip(*some.values(), strict=True)]
        if all(built(spec, row) for row in rows):
            yield some


def stressed(name, pairs, one_of, seconds=math.inf, seed=5):
    """How many sweeps of a machine were held against single designs, and what differs."""
    spec, start, count, wrong = base(name), time.process_time(), 0, []
    for varied in variations(spec, pairs, random.Random(f"{name} {seed}"), one_of):
        wrong += [f"{varied}: {said}" for said in off(spec, varied)]
        count += 1
        if time.process_time() - start > seconds:
            break
    return count, wrong, time.process_time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--one-of", type=int, default=4, help="keys that every machine has")
    parser.add_argument("--pairs", type=int, default=20, help="of each machine's keys")
    parser.add_argument("--machine", action="append", choices=NAMES)
    parser.add_argument("--seconds", type=float, default=math.inf, help="for each machine, of CPU")
    parser.add_argument("--seed", type=int, default=5, help="of the keys and pairs drawn")
    asked = parser.parse_args()
    warnings.simplefilter("error")
    print(f"{'machine':26}{'sweeps':>8}{'differ':>8}{'CPU s':>8}")
    differ = False
    for name in asked.machine or NAMES:
        count, wrong, seconds = stressed(name, asked.pairs, asked.one_of, asked.seconds, asked.seed)
        print(f"{name:26}{count:>8}{len(wrong):>8}{seconds:>8.0f}", flush=True)
        print(*[f"  {said}" for said in wrong], sep="\n", end="\n" * bool(wrong))
        differ |= bool(wrong)
    sys.exit(differ)


if __name__ == "__main__":
    main()
