"""Wall time of whole runs, as a user waits for them: `make bench-start`.

Every run is paired with one of the baseline right before it (geneva_cli.bench.timing_pairs).
"""

import os
import statistics
import sys

import repo
from repo import GENEVA

from geneva_cli.bench.timing_pairs import median_ratio, process_seconds

PAIRS = 40
BUDGET = 1.05
DESIGNS = str(repo.DESIGNS)
COMPLETE = {
    "_GENEVA_COMPLETE": "complete_bash",
    "COMP_WORDS": "geneva ta",
    "COMP_CWORD": "1",
}


def paired(baseline, command, environment, pairs):
    """Times of baseline and command, alternating; one more pair before them warms the caches."""
    found = [
        (process_seconds(baseline, os.environ), process_seconds(command, environment))
        for _ in range(pairs + 1)
    ]
    return found[1:]


def python(code):
    return [sys.executable, "-c", code]


def design(name):
    return os.path.join(DESIGNS, name)


TABLE = "geneva table --z 6"
BASELINE = python("import typer")
RUNS = {
    "python -c pass": python("pass"),
    "python -c 'import typer' (against itself)": BASELINE,
    TABLE: [GENEVA, "table", "--z", "6"],
    "geneva table --z 3..12 --format csv": [GENEVA, "table", "--format", "csv"],
    "geneva --help": [GENEVA, "--help"],
    "geneva table --help": [GENEVA, "table", "--help"],
    "completion of geneva ta": [GENEVA],
    "geneva peaks (straight slots)": [GENEVA, "peaks", design("press-straight.toml")],
    "geneva peaks (curved slots)": [GENEVA, "peaks", design("press-curved.toml")],
    "geneva peaks (law from a file)": [GENEVA, "peaks", design("table-law.toml")],
    "geneva motion (361 rows)": [GENEVA, "motion", design("press-straight.toml")],
    "python -c 'import numpy'": python("import numpy"),
}


def main():
    width = max(map(len, RUNS))
    print(f"{PAIRS} pairs of whole processes, output to a pipe; medians, and of the pairs' ratios")
    print(f"{'':{width}}  {'ms':>6}  {'import typer':>12}  {'ratio':>6}")
    ratios = {}
    for name, command in RUNS.items():
        environment = os.environ | COMPLETE if name.startswith("completion") else os.environ
        pairs = paired(BASELINE, command, environment, PAIRS)
        ratios[name] = median_ratio(pairs)
        base, own = (1e3 * statistics.median(times) for times in zip(*pairs, strict=True))
        print(f"{name:{width}}  {own:6.1f}  {base:12.1f}  {ratios[name]:6.3f}", flush=True)
    verdict = "met" if ratios[TABLE] <= BUDGET else "NOT met"
    print(f"\nbudget: {TABLE} takes at most {BUDGET} times `import typer`: {verdict}")


if __name__ == "__main__":
    main()
