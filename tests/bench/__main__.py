"""``python -m bench [SUBJECT] [--quick]`` in the tests' folder: run time against error."""

import argparse
import sys

from bench.run import SUBJECTS, bench_table, measure
from geneva_cli.output import show


def main() -> None:
    """Measure one subject or all, and print one table."""
    parser = argparse.ArgumentParser(prog="bench", description=__doc__)
    parser.add_argument("subject", nargs="?", default="all", choices=("all", *SUBJECTS))
    parser.add_argument("--quick", action="store_true", help="small sizes, seconds in all")
    parser.add_argument("-o", "--output", default="-")
    given = parser.parse_args()
    rows = []
    for name in SUBJECTS if given.subject == "all" else (given.subject,):
        about, found = measure(name, given.quick)
        rows += found
        if about.absent:
            print(f"{name}: not installed: {', '.join(about.absent)}", file=sys.stderr)
    show(bench_table(rows), given.output)


if __name__ == "__main__":
    main()
