"""Bounds such as ``dwell_s >= 0.8``, objectives such as ``min:acceleration.max``, Pareto fronts."""

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple, TypeGuard

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.numerics.arrays import Array, Mask, N, Whole, parameter
from geneva_cli.numerics.tolerances import keeps
from geneva_cli.verdict.quantities.quantity_names import WORDS, whole_name

BLOCK = 256  # rows of a front that are compared at once with all that are kept before them


class Constraint(NamedTuple):
    """A quantity that must be at least, or at most, a bound."""

    name: str
    sign: str  # <= or >=
    bound: float

    def __str__(self) -> str:
        return f"{self.name} {self.sign} {self.bound:.12g}"

    @property
    def span(self) -> tuple[float, float]:
        """The least and the greatest value that keep the bound."""
        return (self.bound, math.inf) if self.sign == ">=" else (-math.inf, self.bound)

    def kept(self, value: object) -> bool:
        """Return True for a number that keeps the bound, apart from rounding."""
        return is_number(value) and bool(self.kept_by(np.array([value], dtype=float))[0])

    def kept_by(self, values: Array) -> Mask:
        """True for the values (n,) that keep the bound, False for NaN."""
        must_be = "at least" if self.sign == ">=" else "at most"
        return np.asarray(keeps(parameter(values), must_be, self.bound))

    def margin(self, value: N) -> N:
        """The margin of values to the bound, relative to its size; negative outside."""
        margin = value - self.bound if self.sign == ">=" else self.bound - value
        return margin / (abs(self.bound) or 1.0)


def is_number(value: object) -> TypeGuard[float]:
    """Return True if a cell of a row holds a number; True and False are 1 and 0."""
    return isinstance(value, (int, float))


def constraint(text: str) -> Constraint:
    """Return the bound in a text such as ``"dwell_s >= 0.8"``, with its quantity's whole name."""
    number = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,2})?"
    match = re.fullmatch(rf"\s*([A-Za-z][\w.\-]*)\s*(<=|>=)\s*({number})\s*", text)
    if not match:
        raise GenevaError(
            f"--subject-to {cut(text.strip())!r}: it must be FIELD >= NUMBER or FIELD <= NUMBER, "
            'as "dwell_s >= 0.8"'
        )
    return Constraint(whole_name(match[1], "--subject-to"), match[2], float(match[3]))


class Nearness:
    """The distance of a sweep's designs from some bounds, updated as their rows arrive.

    For each bound ``kept`` counts the designs that keep it, and ``nearest`` is the value nearest to
    it, or NaN if no design has the quantity.
    """

    def __init__(self, bounds: Sequence[Constraint]) -> None:
        self.bounds = bounds
        self.kept = [0] * len(bounds)
        self.nearest = [math.nan] * len(bounds)

    def add(self, numbers: Callable[[str], Array]) -> None:
        """Count the rows that keep each bound, and keep the nearest values.

        ``numbers`` returns the numbers (n,) of a quantity, NaN for rows without one.
        """
        for k, c in enumerate(self.bounds):
            values = numbers(c.name)
            self.kept[k] += int(c.kept_by(values).sum())
            nearer = np.fmax if c.sign == ">=" else np.fmin  # of a NaN and a number the number
            self.nearest[k] = float(nearer.reduce(np.append(values, self.nearest[k])))

    def phrases(self) -> Iterator[str]:
        """A phrase for each bound: how many designs keep it, or the nearest value.

        Where no design keeps one bound, others may not have been computed.
        """
        none = all(map(math.isnan, self.nearest))
        for c, count, nearest in zip(self.bounds, self.kept, self.nearest, strict=True):
            if not math.isnan(nearest):
                near = "" if count else f" (nearest {nearest:.6g})"
                yield f"{c} is kept by {count:,}{near}"
            elif none:
                yield f"no design has a value of {c.name}"


def refuse_unsound(
    constraints: Sequence[Constraint], options: Mapping[str, str], instead: str
) -> None:
    """Raise GenevaError for bounds that no value keeps together, and for values that are words.

    ``options`` are the options that request quantities, by the quantities' names; ``instead`` says
    what would be right.
    """
    for low in constraints:
        for high in constraints:
            apart = low.sign == ">=" and high.sign == "<=" and low.bound > high.bound
            if apart and low.name == high.name:
                raise GenevaError(f"--subject-to: nothing is both {low} and {high}")
    for name, option in options.items():
        if name in WORDS:
            raise GenevaError(f"{option} {name}: a word has no order; {instead}")


class Objective(NamedTuple):
    """A quantity to minimise (sign 1) or to maximise (-1)."""

    sign: float
    name: str

    def __str__(self) -> str:
        return f"{'least' if self.sign > 0.0 else 'greatest'} {self.name}"


def objective(text: str, option: str) -> Objective:
    """Return the objective of ``min:acceleration.max``, with the whole name of its quantity."""
    sense, _, name = text.strip().partition(":")
    sign = {"min": 1.0, "max": -1.0}.get(sense)
    if sign is None or not name:
        raise GenevaError(
            f"{option} {cut(text.strip())}: it must be min:FIELD or max:FIELD, as "
            "min:acceleration.max"
        )
    return Objective(sign, whole_name(name, option))


def front(costs: Array) -> Whole:
    """The numbers of the rows of costs (n, d) on the Pareto front, ascending.

    A row is on it if no other is as good in all objectives and better in one. Rows with a NaN are
    left out. Equal rows stay together.
    """
    known = np.flatnonzero(~np.isnan(costs).any(axis=1))
    if not len(known):
        return known
    rows, same = np.unique(costs[known], axis=0, return_inverse=True)
    kept = np.zeros(len(rows), dtype=bool)
    for start in range(0, len(rows), BLOCK):
        # in lexicographic order nothing later dominates anything earlier
        block = rows[start : start + BLOCK]
        stays: Mask = np.logical_not(_as_good(block, rows[:start][kept[:start]]).any(axis=1))
        left = block[stays]
        stays[stays] = _as_good(left, left).sum(axis=1) <= 1  # as itself
        kept[start : start + BLOCK] = stays
    return known[kept[same.ravel()]]


def _as_good(rows: Array, by: Array) -> Mask:
    """Mask (n, m) of the pairs in which a row of ``by`` is as good or better in all costs."""
    return np.logical_and.reduce([x[:, None] >= y for x, y in zip(rows.T, by.T, strict=True)])
