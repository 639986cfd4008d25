"""Random machines turned through a whole turn: `tests/stress/stress_outline.py --runs 2000`.

Every number of slots comes first, some two minutes; then each machine takes about a second. Each is
compared with polygons at some positions. Refused machines are counted, with their reasons. The exit
status is 1 if one fails, or if more than a quarter are refused.
"""

import argparse
import random
import sys
import traceback
from collections import Counter

from test_full_turn import random_case, turns_as_polygons_do
from test_outline import made

from geneva_cli.errors import GenevaError
from geneva_cli.parts.turn.full_turn import full_turn


def every_number_of_slots() -> int:
    """Count the external and internal wheels of 3 to 24 slots at default sizes that do not fit."""
    bad = 0
    for z in range(3, 25):
        for gearing in ("external", "internal"):
            for clearance in (0.0, 0.01, 0.1):
                sizes = {"slot_clearance_mm": clearance, "lock_clearance_mm": clearance}
                parts = made(z, gearing, roller_radius_mm=1.0, **sizes)
                turn = full_turn(parts)
                # inside, a wall with clearance runs a little past the foot of its perpendicular
                if turn.smallest.mm < -parts.close or turn.driving.mm < clearance - 1e-5:
                    print("gap", z, gearing, clearance, turn.smallest, turn.driving)
                    bad += 1
    return bad


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("--runs", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    refused: Counter[str] = Counter()
    bad, loose = every_number_of_slots(), 0
    for seed in range(options.seed, options.seed + options.runs):
        case = random_case(random.Random(seed))
        try:
            turns = turns_as_polygons_do(case)
        except Exception:
            traceback.print_exc()
            print("seed", seed, case)
            bad += 1
            continue
        if turns is None:
            try:
                made(**case)
            except GenevaError as error:
                refused[str(error)[:40]] += 1
        loose += turns is False
        made.cache_clear()
    for reason, count in refused.most_common():
        print(count, reason)
    print(f"{options.runs} machines, {bad} bad, {loose} loose, {refused.total()} refused")
    return int(bad > 0 or refused.total() > options.runs // 4)


if __name__ == "__main__":
    sys.exit(main())
