"""The axes that links turn about, and the one shaft of each.

All that turns about an axis is bored for the same shaft. A shaft of wheel or crank is as wide as
their own bores say; another is as wide as the link with the least room beside its bore allows. A
link without room for the shaft is one piece with it, and the shaft ends at its faces.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.shapes import Point
from geneva_cli.machine.layout import Joint, Link
from geneva_cli.parts.link_sizes import places

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

ON_SHAFTS = (Joint.SHAFT, Joint.PIN)


class Axis(NamedTuple):
    """An axis that links turn about: their names, where it is at input angle 0, if it stands."""

    names: tuple[str, ...]
    kinds: tuple[Joint, ...]
    at: Point
    stands: bool
    radius: float = 0.0  # of its shaft or pivot; 0 before that is known
    one_piece: frozenset[str] = frozenset()  # names of the links that have no bore for it


def axes(links: Iterable[Link], near: float) -> Iterator[Axis]:
    """Yield each axis once; ``near`` is the distance in mm within which two axes are one."""
    left: list[tuple[str, Joint, Array]] = [
        (link.name, kind, at)
        for link in links
        for at, kind in zip(places(link), link.kinds, strict=True)
        if kind in ON_SHAFTS
    ]
    while left:
        way = left[0][2]
        here = [one for one in left if bool(np.abs(one[2] - way).max() < near)]
        left = [one for one in left if not bool(np.abs(one[2] - way).max() < near)]
        z = complex(way[len(way) // 2])
        names, kinds, _ = zip(*here, strict=True)
        yield Axis(names, kinds, (z.real, z.imag), bool(np.abs(way - z).max() < near))
