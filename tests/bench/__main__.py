"""``python -m bench [SUBJECT ...]`` in the tests' folder: run time against error.

Without a subject it measures the kernels against their rivals, in five minutes; with ``--full`` all
subjects, each for longer, in an hour.
"""

import argparse
import os

from bench import plots
from bench.run import SHORT, SUBJECTS, bench_table, measure
from geneva_cli.output import show


def main() -> None:
    """Measure some subjects, and print one table; with -o also a plot of each beside it."""
    parser = argparse.ArgumentParser(prog="bench", description=__doc__)
    parser.add_argument("subjects", nargs="*", choices=(*SUBJECTS, []), metavar="SUBJECT")
    parser.add_argument("--quick", action="store_true", help="small sizes, seconds in all")
    parser.add_argument("--full", action="store_true", help="all subjects, an hour")
    parser.add_argument("-o", "--output", default="-")
    given = parser.parse_args()
    rows = []
    for name in given.subjects or (SUBJECTS if given.full else SHORT):
        subject, own = measure(name, given.quick, 1.0 if given.full else 0.2)
        rows += own
        if given.output != "-":
            plots.write(subject, own, os.path.join(os.path.dirname(given.output), f"{name}.svg"))
    show(bench_table(rows), given.output)


if __name__ == "__main__":
    main()
