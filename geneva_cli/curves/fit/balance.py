"""The fewest pieces that serve, where the error of each piece is its own affair.

Neither search is one of ``numerics.roots``: how many pieces there must be is a whole number, which
each try predicts from its errors, and where they meet is many unknowns.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from geneva_cli.curves.fit.path import PIECES_MAX, TARGET, CurvePath, respread

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

ROUNDS = 10  # of moving the places of one count
ATTEMPTS = 40
ALIKE = 1.02  # the worst weight over the mean, below which moving places is no use
HOPELESS = 1.25  # the same, where there are too few anyway
FLOOR = 0.05  # of the mean weight: an inflection needs pieces too
NEEDED = 0.5  # a number of pieces whose weights add up to less is tried with one piece less
MANY = 1000  # pieces past which the last half per cent is not worth another attempt
SPARE = 0.005

Fit = TypeVar("Fit")


def balanced(
    path: CurvePath,
    errors: Callable[[Array], Array],
    proof: Callable[[Array], Fit | None],
    order: float,
    density: Array,
) -> Fit:
    """The proof of the fewest pieces that stay within the path's tolerance.

    ``errors`` are those of the pieces between places, mm; that of one piece goes with its length
    to the power of ``order``. ``proof`` looks at them densely: the pieces, or None where they
    do not serve after all. ``density`` (in each cell of the survey) says where pieces are needed,
    as a first guess.

    Raises GenevaError where no number of pieces that is allowed serves.
    """
    best, count, good, too_few, more = None, 1, PIECES_MAX + 1, 0, 1
    for _ in range(ATTEMPTS):
        if count > PIECES_MAX:
            break
        first = path.spread(density, count, FLOOR)
        places, root = _spread(path, errors, order, first, count == too_few + 1)
        need = float(root.sum())
        found = proof(places) if root.max() <= 1.0 else None
        if found is not None:
            best, good = found, count
            count = min(max(int(np.ceil(need)), too_few + 1), good - 1)
        else:
            too_few = count
            count = max(int(np.ceil(need)), count + more)
            count, more = min(count, (too_few + good) // 2 if best else count), 2 * more
        spare = SPARE * good if good > MANY else NEEDED
        if best is not None and (good - too_few <= max(1.0, spare) or need > good - spare):
            break
    if best is None:
        raise path.too_fine()
    return best


def _spread(
    path: CurvePath, errors: Callable[[Array], Array], order: float, places: Array, last: bool
) -> tuple[Array, Array]:
    """The places with errors as alike as they get, and the weights: 1 where an error just does.

    With ``last`` set, the first ones that serve will do.
    """
    target, best, least = TARGET * path.tolerance, (places, places), np.inf
    for _ in range(ROUNDS):
        root = np.maximum(errors(places) / target, 1e-300) ** (1.0 / order)
        worst, mean = root.max(), root.mean()
        if worst < least:
            best, least = (places, root), worst
        if worst <= 1.0:
            done = last or worst <= ALIKE * mean
        else:
            done = mean > 1.0 and worst <= HOPELESS * mean
        if done:
            break
        places = respread(places, root, FLOOR)
    return best
