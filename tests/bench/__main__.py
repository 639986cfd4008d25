"""``python -m bench [SUBJECT] [--quick]`` in the tests' folder: run time against error."""

import argparse

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
        rows += measure(name, given.quick)[1]
    show(bench_table(rows), given.output)


if __name__ == "__main__":
    main()
