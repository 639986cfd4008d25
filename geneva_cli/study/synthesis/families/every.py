"""All families that may meet a requirement, for all numbers of slots, gearings and rollers.

If one motion angle is required, a family's free number has a closed form. If a range is required,
``best`` chooses the family's best machine.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

from geneva_cli.machine import registry
from geneva_cli.machine.wheels.gearing import Gearing
from geneva_cli.study.synthesis.families import below
from geneva_cli.study.synthesis.families.curved import with_laws
from geneva_cli.study.synthesis.families.family import Family
from geneva_cli.study.synthesis.families.four_bars import four_bars
from geneva_cli.study.synthesis.families.straight import straight
from geneva_cli.study.synthesis.families.two_numbers import two_numbers
from geneva_cli.study.synthesis.wish import Wish

# For a limit of peak acceleration alone, the lowest peak of each drive is added to the list.
Kind: TypeAlias = Callable[[Wish, Sequence[Gearing], list[float]], Iterator[Family]]


def kinds(wish: Wish) -> list[tuple[Kind, Wish]]:
    """Independent kinds of machines: all four-bars; straight slots, and laws, of each gearing."""
    first, last = (
        (below.straight, below.with_laws) if wish.only_acceleration else (_straight, _laws)
    )
    each = [wish._replace(gearings=(gearing,)) for gearing in wish.gearings]
    return [
        (_four_bars, wish),
        *((first, one) for one in each),
        *((last, one._replace(laws=(law,))) for law in wish.laws for one in each),
    ]


def longest_first(wish: Wish) -> list[int]:
    """The numbers of the kinds in the order in which two processes finish them soonest.

    Four-bars come first, then the laws of the first gearing; the fastest come last.
    """
    wheels, laws = len(wish.gearings), len(wish.laws)
    straight = [1, *range(wheels, 1, -1)]
    curved = range(1 + wheels, 1 + wheels * (1 + laws))
    others = [i for i in curved if (i - 1) % wheels]
    return [0, *curved[::wheels], *straight[:2], *others, *straight[2:]]


def families(kind: Kind, wish: Wish, reached: list[float]) -> Iterator[Family]:
    """The families of one kind that may meet the requirement."""
    wheels = [registry.gearing(gearing)(z) for gearing in wish.gearings for z in wish.z]
    yield from kind(wish, wheels, reached)


def _straight(wish: Wish, wheels: Sequence[Gearing], reached: list[float]) -> Iterator[Family]:
    for wheel in wheels:
        yield from straight(wish, wheel)
    yield from two_numbers(wish, wheels)


def _four_bars(wish: Wish, wheels: Sequence[Gearing], reached: list[float]) -> Iterator[Family]:
    yield from four_bars(wish, wheels)


def _laws(wish: Wish, wheels: Sequence[Gearing], reached: list[float]) -> Iterator[Family]:
    yield from with_laws(wish, wheels)
