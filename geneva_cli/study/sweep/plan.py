"""The designs of a sweep by number: all of a grid, or a random sample of it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from geneva_cli.errors import GenevaError, cut
from geneva_cli.numerics.jet import Array
from geneva_cli.study.rows import Column, Rows
from geneva_cli.study.sweep.values import POINTS_MAX, Value, VariedKey

BLOCK = 16384  # designs of a batch; a power of two, which keeps a Sobol sequence balanced


class SweepPlan(NamedTuple):
    """The designs of a sweep, numbered from 0; the last key varies fastest in a grid.

    ``random`` is the size of the random sample, 0 for the whole grid; ``seed`` is its seed.
    """

    axes: tuple[VariedKey, ...]
    random: int = 0
    seed: int = 0

    def __len__(self) -> int:
        return self.random or math.prod(len(a.values) for a in self.axes)

    def middle(self) -> tuple[Value, ...]:
        """The design with the middle value of each key."""
        return _values([a.between(np.array([0.5])) for a in self.axes])[0]

    def sample(self, most: int) -> Iterator[tuple[Value, ...]]:
        """At most ``most`` designs spread over the sweep, the first one included."""
        count = min(most, len(self))
        if self.random:
            yield from self.rows(0, count)
            return
        for i in range(count):
            at = i * len(self) // count
            yield from self.rows(at, at + 1)

    def rows(self, start: int, stop: int) -> list[tuple[Value, ...]]:
        """The values of the keys of the designs ``start`` to ``stop - 1``."""
        return _values(self.columns(start, stop))

    def columns(self, start: int, stop: int) -> list[Column]:
        """The values of each key in the designs ``start`` to ``stop - 1``."""
        if self.random:
            points = _sobol(len(self.axes), self.seed, start, stop).T
            return [a.between(x) for a, x in zip(self.axes, points, strict=True)]
        columns, numbers = list[Column](), np.arange(start, stop)
        for a in reversed(self.axes):
            numbers, at = np.divmod(numbers, len(a.values))
            columns.append(a.column(at))
        return columns[::-1]


def _values(columns: Sequence[Column]) -> list[tuple[Value, ...]]:
    return [tuple(value for value in row if value is not None) for row in Rows(columns)]


def _sobol(dimensions: int, seed: int, start: int, stop: int) -> Array:
    """Points of a scrambled Sobol sequence, which fill the cube more evenly than random ones."""
    from geneva_cli.numerics.sobol import Sobol

    # Whole blocks are drawn: a shard must get the same points as the whole run.
    first = start - start % BLOCK
    sequence = Sobol.scrambled(dimensions, seed)
    points = np.hstack([sequence.points(k, BLOCK) for k in range(first, stop, BLOCK)])
    return points.T[start - first : stop - first]


def plan(axes: Sequence[VariedKey], random: int | None, seed: int) -> SweepPlan:
    """Return the plan of a sweep. Raises GenevaError, naming the option, for an invalid one."""
    if not axes:
        raise GenevaError("--vary is missing; say what varies, as --vary drive.A=0..0.9:0.1")
    if random is not None and not 1 <= random <= POINTS_MAX:
        raise GenevaError(f"--random {cut(random)}: it must be at least 1, at most {POINTS_MAX:,}")
    keys_max = 32  # each is a dimension of the Sobol sequence
    if random and len(axes) > keys_max:
        raise GenevaError(f"--random: {len(axes)} keys vary; at most {keys_max} can")
    if not 0 <= seed < 2**32:
        raise GenevaError(f"--seed {cut(seed)}: it must be at least 0 and below 2**32")
    planned = SweepPlan(tuple(axes), random or 0, seed)
    size = math.prod(len(a.values) for a in axes)
    if not random and size > POINTS_MAX:
        raise GenevaError(
            f"--vary: {size:,} designs in all; at most {POINTS_MAX:,}: fewer values, or "
            "--random N of them"
        )
    return planned


class Shard(NamedTuple):
    """One of several equal parts of a sweep, counted from 1."""

    number: int = 1
    of: int = 1

    def span(self, length: int) -> tuple[int, int]:
        """The first of ``length`` designs in this shard, and the one after its last.

        All shards together are the sweep.
        """
        return length * (self.number - 1) // self.of, length * self.number // self.of


WHOLE = Shard()


def shard(text: str) -> Shard:
    """Return the shard that ``3/16`` names. Raises GenevaError for another text."""
    number, _, of = text.partition("/")
    if not (number.isdecimal() and of.isdecimal() and 1 <= int(number) <= int(of) <= POINTS_MAX):
        raise GenevaError(f"--shard {cut(text)}: it must be NUMBER/OF from 1/OF to OF/OF, as 3/16")
    return Shard(int(number), int(of))
