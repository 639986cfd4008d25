"""The bounds and the goal of a requirement that a batch can test."""

from __future__ import annotations

from geneva_cli.study.sweep.constraints import Constraint, Objective
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.names import in_batch


def known_bounds(target: Target) -> list[Constraint]:
    """The bounds on quantities that a batch can compute."""
    return [b for b in target.limits if in_batch([b.name])]


def known_sort(target: Target) -> Objective | None:
    """The goal by which rows are sorted, if a batch can compute it."""
    return target.sort if target.sort and in_batch([target.sort.name]) else None
