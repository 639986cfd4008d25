"""The pins, washers, spacers and rollers between links, and the axes of links.

Pins that stand in the frame belong to the frame, like shafts, and are omitted here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle, Point
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.links.link_sizes import LinkSizes, places, point_at_zero
from geneva_cli.parts.shafts.shaft_bores import ShaftBore


class SharedJoint(NamedTuple):
    """Links that share a joint at all input angles: the joint's path, their names and planes."""

    path: Array  # complex points
    names: tuple[str, ...]
    planes: tuple[int, ...]


def joined(links: Iterable[Link], near: float) -> list[SharedJoint]:
    """Return the pin joints of several links: those nearer than ``near`` mm at all angles."""
    all_pins = [
        (link, at)
        for link in links
        for at, kind in zip(places(link), link.kinds, strict=True)
        if kind in (Joint.PIN, Joint.SLIDE)
    ]
    shared: list[SharedJoint] = []
    for i, (link, at) in enumerate(all_pins):
        others = [other for other, there in all_pins[i + 1 :] if np.abs(at - there).max() < near]
        if others:
            both = sorted((link, *others), key=lambda one: one.plane)
            names, planes = zip(*((one.name, one.plane) for one in both), strict=True)
            shared.append(SharedJoint(at, names, planes))
    return shared


def pins(links: Iterable[Link], sizes: LinkSizes, near: float) -> Iterator[Member]:
    """Yield each pin that joins links, with the washers and spacers on it."""
    for one in joined(links, near):
        where = point_at_zero(one.path)
        spans = [sizes.span(plane) for plane in one.planes]
        origin = (0.0, 0.0)
        hole = Circle("LINK", origin, sizes.pin + sizes.loose)
        pin = Circle("ROLLER", origin, sizes.pin)
        name = " and ".join(one.names)
        yield Member(Plate(f"pin of {name}", "ROLLER", pin, (), spans[-1][0], spans[0][1]), where)
        for (high, _), (_, low) in zip(spans, spans[1:], strict=False):
            if high > low:
                ring = Circle("LINK", origin, sizes.ring)
                what = "washer" if high - low <= sizes.washer else "spacer"
                yield Member(Plate(f"{what} of {name}", "LINK", ring, (hole,), low, high), where)


def rollers(
    links: Iterable[Link], sizes: LinkSizes, roller: float, pin_radius: float
) -> Iterator[Member]:
    """Yield rollers below the wheel's plane: a first wheel's, with its pin, and a groove's."""
    if not pin_radius:
        return
    bored = pin_radius + sizes.loose
    pin, hole, whole = (Circle("ROLLER", (0.0, 0.0), r) for r in (pin_radius, bored, roller))
    for link in links:
        for at, kind in zip(places(link), link.kinds, strict=True):
            where = point_at_zero(at)
            if kind is Joint.ROLLER and link.plane > 1:
                low, high = sizes.span(link.plane - 1)
                below = sizes.span(link.plane)[0]
                yield Member(
                    Plate(f"{link.name}'s roller", "ROLLER", whole, (hole,), low, high), where
                )
                yield Member(Plate(f"{link.name}'s pin", "ROLLER", pin, (), below, high), where)
            if kind is Joint.CARRIED:
                low, high = sizes.span(link.plane + 1)
                yield Member(
                    Plate("roller in the groove", "ROLLER", whole, (hole,), low, high), where
                )


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
