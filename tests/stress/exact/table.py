"""The stress's table: the worst place of each machine's each quantity."""

import math
from typing import NamedTuple

import numpy as np
from witness import mp

LIMIT = 16.0


class Worst(NamedTuple):
    """The worst place of one row."""

    error: float = 0.0
    condition: float = 0.0
    share: float = -1.0
    where: str = ""


class Table:
    """Rows by (machine, quantity), the program's worst and the textbook's."""

    def __init__(self):
        self.ours, self.textbook, self.count = {}, {}, 0
        self.faults = []

    def add(self, row, error, condition, where, textbook=None):
        """``error`` (arrays or numbers) with its condition; where[i] or where says the place."""
        error, condition = np.atleast_1d(error), np.broadcast_to(condition, np.shape(error))
        condition = np.atleast_1d(condition)
        self.count += error.size
        for kept, e in ((self.ours, error), (self.textbook, textbook)):
            if e is None:
                continue
            e = np.atleast_1d(e)
            share = e / np.maximum(1.0, condition)
            if kept is self.textbook:
                share = np.where(np.isnan(share), -1.0, share)
            i = int(np.argmax(np.where(np.isnan(share), np.inf, share)))
            best = kept.setdefault(row, Worst())
            if not share[i] <= best.share:
                place = where if isinstance(where, str) else where[i]
                kept[row] = Worst(float(e[i]), float(condition[i]), float(share[i]), place)

    def fault(self, what):
        self.faults.append(what)

    def print(self):
        head = ("machine", "quantity", "error", "condition", "share", "textbook", "its share")
        lines = []
        for row, w in sorted(self.ours.items(), key=lambda item: item[0][0]):
            t = self.textbook.get(row)
            book = (f"{t.error:.3g}", f"{t.share:.3g}") if t else ("-", "-")
            cells = (*row, f"{w.error:.3g}", f"{w.condition:.3g}", f"{w.share:.3g}", *book)
            lines.append((*cells, w.where))
        widths = [max(len(x[i]) for x in [head, *lines]) for i in range(7)]
        for line in [(*head, "where"), *lines]:
            cells = [
                c.ljust(n) if i < 2 else c.rjust(n)
                for i, (c, n) in enumerate(zip(line, widths, strict=False))
            ]
            print("  ".join([*cells, line[7]]).rstrip())

    @property
    def over(self):
        return {row: w for row, w in self.ours.items() if not w.share <= LIMIT}


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
