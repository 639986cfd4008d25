"""All families that may meet a requirement, for all numbers of slots, gearings and rollers.

If one motion angle is required, a family's free number has a closed form. If a range is required,
``best`` chooses the family's best machine.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise
from typing import TypeAlias

from geneva_cli.motion.records import families_of_kinds
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.study.synth.families.curved_slots import with_laws
from geneva_cli.study.synth.families.family import Family
from geneva_cli.study.synth.families.straight_slots import straight
from geneva_cli.study.target import Target

Kind: TypeAlias = Callable[[Target, Sequence[Gearing]], Iterator[Family]]


def kinds(target: Target) -> list[tuple[Kind, Target]]:
    """Independent groups of machines: straight slots, and laws, of each gearing; those of kinds.

    Each has some of the numbers of slots. If the target has wheels on a carrier: the carousels of
    each gearing.
    """
    some = [target._replace(z=z) for z in _groups(target.z)]
    each = [one._replace(gearings=(gearing,)) for gearing in target.gearings for one in some]
    if target.wheels:
        return [(kind, one) for kind in families_of_kinds("carrier") for one in each]
    alone = target.only_acceleration
    return [
        *((kind, one) for kind in families_of_kinds("alone") for one in some),
        *((_straight, one.by_bounds if alone else one) for one in each),
        *((with_laws, one._replace(laws=(law,))) for law in target.laws for one in each),
    ]


# Least numbers of slots in a group: a search of so many four-bars has its fewest samples for each
# (four_bar_search), so that groups find what one search of all does.
GROUP = 24


def _groups(z: tuple[int, ...]) -> list[tuple[int, ...]]:
    """Divide numbers of slots into as many groups of at least ``GROUP`` as there may be.

    >>> [len(group) for group in _groups(tuple(range(3, 80)))]
    [26, 26, 25]
    """
    count = max(len(z) // GROUP, 1)
    ends = [-(-len(z) * i // count) for i in range(count + 1)]
    return [z[i:j] for i, j in pairwise(ends)]


def families(kind: Kind, target: Target) -> Iterator[Family]:
    """The families of one kind that may meet the requirement."""
    wheels = [target.wheel(gearing, z) for gearing in target.gearings for z in target.z]
    yield from kind(target, wheels)


def _straight(target: Target, wheels: Sequence[Gearing]) -> Iterator[Family]:
    for wheel in wheels:
        yield from straight(target, wheel)
