"""The stress's table: the worst place of each machine's each quantity."""

import math
from typing import NamedTuple

import numpy as np
from witness import mp

from geneva_cli.output import show
from geneva_cli.table import rows_table

LIMIT = 16.0
DIGITS = 120  # A within 1e-12 of 1 costs a fourth derivative four times 12 of them, and more


class Worst(NamedTuple):
    """The worst place of one row."""

    error: float = 0.0
    condition: float = 0.0
    share: float = -1.0
    where: str = ""


class Table:
    """Rows by (machine, quantity): the worst place of each."""

    def __init__(self):
        self.rows, self.count, self.faults = {}, 0, []

    def add(self, row, error, condition, where):
        """``error`` (arrays or numbers) with its condition; where[i] or where says the place."""
        error, condition = np.atleast_1d(error), np.broadcast_to(condition, np.shape(error))
        condition = np.atleast_1d(condition)
        self.count += error.size
        share = error / np.maximum(1.0, condition)
        i = int(np.argmax(np.where(np.isnan(share), np.inf, share)))
        if not share[i] <= self.rows.setdefault(row, Worst()).share:
            place = where if isinstance(where, str) else where[i]
            self.rows[row] = Worst(float(error[i]), float(condition[i]), float(share[i]), place)

    def fault(self, what):
        self.faults.append(what)

    def print(self):
        rows = [
            (*row, f"{w.error:.3g}", f"{w.condition:.3g}", f"{w.share:.3g}", w.where)
            for row, w in sorted(self.rows.items(), key=lambda item: item[0][0])
        ]
        names = ("machine", "quantity", "error", "condition", "share", "where")
        show(rows_table(names, rows), "-", "csv")

    @property
    def over(self):
        return {row: w for row, w in self.rows.items() if not w.share <= LIMIT}


def ulps(got, exact, unit):
    """Sizes of got - exact, each in ``unit``; NaN stays NaN."""
    return np.array(
        [
            float(abs(mp.mpf(float(v)) - e) / unit) if math.isfinite(v) else math.nan
            for v, e in zip(got, exact, strict=True)
        ]
    )


def strictly(f, *arguments):
    """The program's own part of the work: every floating-point flag is an error there."""
    with np.errstate(all="raise"):
        return f(*arguments)


def unit(peak):
    return math.ulp(float(peak))
