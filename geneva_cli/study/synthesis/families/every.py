"""The families that may grant a wish, for every number of slots, gearing and number of rollers.

Where the wish is one motion angle, a family's free number follows in closed form. Where it is a
range, the family's best is taken: what that is, is ``best``'s to say.
"""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.machine import registry
from geneva_cli.study.synthesis.families.below import below
from geneva_cli.study.synthesis.families.curved import with_laws
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.families.four_bars import four_bars
from geneva_cli.study.synthesis.families.straight import straight
from geneva_cli.study.synthesis.wish import Wish


def families(wish: Wish, reached: list[float]) -> Iterator[Family]:
    """All families that may grant a wish.

    Of a wish for a peak acceleration alone, peaks that are as low as a drive brings them go to
    ``reached``.
    """
    wheels = [registry.gearing(gearing)(z) for gearing in wish.gearings for z in wish.z]
    if wish.only_acceleration:
        yield from below(wish, wheels, reached)
        return
    for wheel in wheels:
        yield from straight(wish, wheel)
    yield from four_bars(wish, wheels)
    yield from with_laws(wish, wheels)
