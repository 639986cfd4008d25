"""Options of the stress runs over many designs of every machine."""

import argparse
import math

from design_arrays import MACHINES


def options(doc):
    """Return ``designs``, ``machine``, ``seconds`` and ``seed`` of the command line.

    The first line of ``doc`` is the title of its help.
    """
    parser = argparse.ArgumentParser(description=doc.split("\n")[0])
    parser.add_argument("--designs", type=int, default=20_000, help="of each machine")
    parser.add_argument("--machine", action="append", choices=list(MACHINES))
    parser.add_argument("--seconds", type=float, default=math.inf, help="for each machine, of CPU")
    parser.add_argument("--seed", type=int, default=12, help="of the designs drawn")
    chosen = parser.parse_args()
    chosen.machine = chosen.machine or list(MACHINES)
    return chosen
