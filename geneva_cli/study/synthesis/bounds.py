"""The bounds of a wish: those that are known of many machines together, and soonest."""

from __future__ import annotations

from geneva_cli.study.quantities import in_batch, is_motion
from geneva_cli.study.sweep.constraints import Constraint
from geneva_cli.study.synthesis.wish import Wish


def known_bounds(wish: Wish) -> list[Constraint]:
    """The bounds on quantities that ``together`` knows."""
    return [b for b in wish.limits if in_batch([b.name])]


def of_motion(wish: Wish) -> Wish | None:
    """The wish with those of its bounds alone that follow from the motion, and any machine that
    keeps them; None where they are all that it asks for, or most families keep them.

    What loads a machine has takes ten times as long: it need not be asked of a family of which none
    moves as wished.
    """
    moved = tuple(b for b in wish.bounds if is_motion(b.name))
    if not (wish.strict and moved) or all(map(is_motion, wish.named)):
        return None
    return wish._replace(bounds=moved, sort=None)
