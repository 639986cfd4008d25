"""The axes that links turn about, with one shaft for each.

All that turns about an axis is bored for the same shaft. The shafts of wheel and crank are as wide
as their own bores. Another shaft is as wide as the tightest link on it allows. A link that is too
small for the bore is one piece with the shaft, which ends at the link's faces.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.links.link_sizes import places, point_at_zero
from geneva_cli.parts.shafts.shaft_bores import ShaftBore


class LinkAxis(NamedTuple):
    """An axis that links turn about: their names and joints, and its position at input angle 0."""

    names: tuple[str, ...]
    kinds: tuple[Joint, ...]
    at: Point
    stands: bool  # it does not move with the input angle
    bore: ShaftBore = ShaftBore()  # for its shaft or pivot; of radius 0 until that is known
    one_piece: frozenset[str] = frozenset()  # names of the links that have no bore for it

    @property
    def radius(self) -> float:
        """Radius of its bore."""
        return self.bore.bore.radius


def axes(links: Iterable[Link], near: float) -> Iterator[LinkAxis]:
    """Yield each axis once; ``near`` is the distance, mm, below which two axes are one."""
    left: list[tuple[str, Joint, Array]] = [
        (link.name, kind, at)
        for link in links
        for at, kind in zip(places(link), link.kinds, strict=True)
        if kind in (Joint.SHAFT, Joint.PIN)
    ]
    while left:
        path = left[0][2]
        here = [one for one in left if bool(np.abs(one[2] - path).max() < near)]
        left = [one for one in left if not bool(np.abs(one[2] - path).max() < near)]
        at = point_at_zero(path)
        names, kinds, _ = zip(*here, strict=True)
        yield LinkAxis(names, kinds, at, bool(np.abs(path - complex(*at)).max() < near))
