"""The bounds of a requirement that a batch can test, or that follow from the motion."""

from __future__ import annotations

from geneva_cli.study.goals import Objective
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.target import Target
from geneva_cli.verdict.quantities.names import in_batch, is_motion


def known_bounds(target: Target) -> list[Constraint]:
    """The bounds on quantities that a batch can compute."""
    return [b for b in target.limits if in_batch([b.name])]


def known_sort(target: Target) -> Objective | None:
    """The goal by which rows are sorted, if a batch can compute it."""
    return target.sort if target.sort and in_batch([target.sort.name]) else None


def of_motion(target: Target) -> Target | None:
    """The requirement reduced to its bounds on the motion, for a first search.

    Returns None if it has no other bounds, or if most families keep them. The loads of a machine
    take ten times as long, so they are not computed for a family without the required motion.
    """
    moved = tuple(b for b in target.bounds if is_motion(b.name))
    if not (target.strict and moved) or all(map(is_motion, target.quantities)):
        return None
    return target._replace(bounds=moved, sort=None)
