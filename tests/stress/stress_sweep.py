"""Sweeps against single designs, whatever varies: part of `make stress`.

    stress_sweep.py [--one-of N] [--pairs N] [--machine NAME]... [--seconds S] [--seed N]

For every machine (those of tests/sweep_keys.py) each numeric key varies alone, and is also a list
of equal values. These are all keys of wheel, drive and motion, and one of four keys of the other
tables, which all machines have; --one-of 1 takes all. Each machine draws its own, so that 43
machines together take each key some ten times: 35 minutes instead of 90. Some pairs of keys are
drawn, and vary together. Every quantity that a sweep computes as a batch is compared with that of
each design alone. One row a machine, then its differences; the exit status is 1 if there are any.
"""

import argparse
import math
import random
import sys
import time
import warnings

from sweep_keys import NAMES, apart, base, built, keys, off


def variations(spec, pairs, draw, one_of):
    """Yield the varied keys of one sweep after the other, and their values in each design."""
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
    """Count the sweeps of a machine, and list their differences from single designs."""
    spec, start, count, wrong = base(name), time.process_time(), 0, []
    for varied in variations(spec, pairs, random.Random(f"{name} {seed}"), one_of):
        wrong += [f"{varied}: {text}" for text in off(spec, varied)]
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
    chosen = parser.parse_args()
    warnings.simplefilter("error")
    print(f"{'machine':26}{'sweeps':>8}{'differ':>8}{'CPU s':>8}")
    differ = False
    for name in chosen.machine or NAMES:
        count, wrong, seconds = stressed(
            name, chosen.pairs, chosen.one_of, chosen.seconds, chosen.seed
        )
        print(f"{name:26}{count:>8}{len(wrong):>8}{seconds:>8.0f}", flush=True)
        print(*[f"  {text}" for text in wrong], sep="\n", end="\n" * bool(wrong))
        differ |= bool(wrong)
    sys.exit(differ)


if __name__ == "__main__":
    main()
