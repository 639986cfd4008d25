"""Sweeps against single designs, whatever varies: part of `make stress`.

    stress_sweep.py [--pairs N] [--machine NAME]... [--seconds S] [--seed N]

Of every machine (those of tests/sweep_keys.py) every numeric key varies alone, and is given as a
list of equal values; of all pairs of keys some are drawn, and vary together. Every quantity that a
sweep has of arrays is held against that of each design alone. One row a machine; what differs
follows it, and the exit status is then 1.
"""

import argparse
import math
import random
import sys
import time

from sweep_keys import NAMES, apart, base, built, keys, off


def variations(spec, pairs, seed):
    """What varies, one sweep after the other: keys, and their values in each design."""
    known = {key: pair for key in keys(spec) if (pair := apart(spec, key))}
    for key, (own, other) in known.items():
        yield {key: [own, other]}
        yield {key: [own, own, own]}
    draw = random.Random(seed)
    for _ in range(pairs):
        some = {key: known[key] for key in draw.sample(sorted(known), 2)}
        rows = [dict(zip(some, row, strict=True)) for row in zip(*some.values(), strict=True)]
        if all(built(spec, row) for row in rows):
            yield some


def stressed(name, pairs, seconds=math.inf, seed=5):
    """How many sweeps of a machine were held against single designs, and what differs."""
    spec, start, count, wrong = base(name), time.process_time(), 0, []
    for varied in variations(spec, pairs, seed):
        wrong += [f"{varied}: {said}" for said in off(spec, varied)]
        count += 1
        if time.process_time() - start > seconds:
            break
    return count, wrong, time.process_time() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--pairs", type=int, default=20, help="of each machine's keys")
    parser.add_argument("--machine", action="append", choices=NAMES)
    parser.add_argument("--seconds", type=float, default=math.inf, help="for each machine, of CPU")
    parser.add_argument("--seed", type=int, default=5, help="of the pairs drawn")
    asked = parser.parse_args()
    print(f"{'machine':26}{'sweeps':>8}{'differ':>8}{'CPU s':>8}")
    differ = False
    for name in asked.machine or NAMES:
        count, wrong, seconds = stressed(name, asked.pairs, asked.seconds, asked.seed)
        print(f"{name:26}{count:>8}{len(wrong):>8}{seconds:>8.0f}", flush=True)
        print(*[f"  {said}" for said in wrong], sep="\n", end="\n" * bool(wrong))
        differ |= bool(wrong)
    sys.exit(differ)


if __name__ == "__main__":
    main()
