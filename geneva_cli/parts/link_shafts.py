"""Shafts and pivots that carry links alone: an input crank's, a rocker's, a planet's.

Those that stand end in the frame's lower face, as the wheel's and the crank's do. A link on one
that is not the crank's lies in the lowest plane, so that nothing passes below it. A planet's shaft
moves, and joins what is on it. Each is as wide as the bore of the links on it; a link without a
bore is one piece with its shaft.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import Circle, Point
from geneva_cli.machine.layout import Joint
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.link_positions import SAME, links_at, same
from geneva_cli.parts.link_sizes import places
from geneva_cli.parts.links import Links, placed_holes
from geneva_cli.parts.shafts import SHAFT
from geneva_cli.parts.sizes import thicknesses

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

ON_SHAFTS = (Joint.SHAFT, Joint.PIN)
ANGLES = 720  # input angles at which it is seen which axes stand


class Axis(NamedTuple):
    """An axis that links turn about: their names, where it is at input angle 0, if it stands."""

    names: tuple[str, ...]
    kinds: tuple[Joint, ...]
    at: Point
    stands: bool


def link_shafts(
    mechanism: Mechanism,
    bars: Links,
    lowest: float,
    stop: float | None = None,
    crank_has_one: bool = False,
    wheel_has_one: bool = False,
) -> Iterator[Member]:
    """The shafts at their places at input angle 0.

    ``lowest`` is the frame's lower face, ``stop`` where the crank's shaft ends above it;
    ``crank_has_one`` where that carries more than links, and is not one of these, as the wheel's.
    """
    L = mechanism.center_distance_mm
    for axis in axes(mechanism):
        on_crank = same(axis.at, (L, 0.0), L)
        on_wheel = same(axis.at, (0.0, 0.0), L)
        if (on_crank and crank_has_one) or (on_wheel and wheel_has_one):
            continue
        if axis.stands:
            what = "shaft" if Joint.SHAFT in axis.kinds else "pivot"
            whose = "crank" if on_crank else "wheel" if on_wheel else axis.names[0]
            low = stop if on_crank and stop is not None else lowest
            high = thicknesses(mechanism.spec.size, L).wheel if on_wheel else None
            yield from _through(bars, f"{whose}'s {what}", axis, L, low, high)
        elif len(axis.names) > 1 and Joint.PIN not in axis.kinds:  # those have their pin
            yield from _through(bars, f"shaft of {', '.join(axis.names)}", axis, L)


def axes(mechanism: Mechanism) -> Iterator[Axis]:
    """The axes of a machine's links, each once."""
    turns, near = mechanism.spec.drive.turns, SAME * mechanism.center_distance_mm
    turn = np.linspace(-180.0 * turns, 180.0 * turns, ANGLES * turns + 1)
    left: list[tuple[str, Joint, Array]] = [
        (link.name, kind, at)
        for link in links_at(mechanism, turn)
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


def _through(
    bars: Links,
    name: str,
    axis: Axis,
    L: float,
    low: float | None = None,
    high: float | None = None,
) -> Iterator[Member]:
    """The shaft through the bores of the links on an axis, from ``low``, or the lowest of them, up
    to ``high``, or the highest.

    There is none where none has a bore.
    """
    radii, heights = [], []
    for member in bars.cut:
        plate = member.part
        if not isinstance(plate, Plate) or plate.name not in axis.names:
            continue
        bored = [h.radius for h in placed_holes(member) if same(h.centre, axis.at, L)]
        radii += bored
        heights += [plate.low, plate.high if bored else plate.low]
    for gear in bars.gears:
        if gear.name in axis.names and gear.bore:
            radii.append(gear.bore)
            heights += [gear.plate.low, gear.plate.high]
    if radii:
        bottom = min(heights) if low is None else low
        outline = Circle(SHAFT, (0.0, 0.0), radii[0])
        top = max(heights) if high is None else high
        yield Member(Plate(name, SHAFT, outline, (), bottom, top), axis.at)
