"""A substitution that spreads samples about 0, near which functions change fastest.

The angle u with x = w sinh(u / w) gives the range within w of 0 as much length as the rest. Poles
at x = i w and -i w move to u = i w pi/2 and -i w pi/2. So the same number of samples gives more
digits. Near 0, u is x; with a large w it is x everywhere.

Source: D. Elliott, P. R. Johnston, "A sinh transformation for evaluating nearly singular boundary
element integrals", Int. J. Numer. Meth. Engng 62 (2005).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from geneva_cli.numerics.arrays import Array


def spread(x: Array, w: Array) -> Array:
    """u at places x."""
    u: Array = w * np.arcsinh(x / w)
    return u


def gathered(u: Array, w: Array) -> tuple[Array, Array]:
    """The places x at u, and their derivative by u.

    >>> import numpy as np
    >>> w = np.array([2.0, 1e3])
    >>> gathered(spread(np.array([6.0, 6.0]), w), w)[0].round(12)
    array([6., 6.])
    """
    sine = np.sinh(u / w)
    return w * sine, np.sqrt(1.0 + sine * sine)
