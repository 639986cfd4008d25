"""The pins, washers, spacers and rollers between links.

Pins that stand in the frame belong to the frame, like shafts, and are omitted here.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array
from geneva_cli.parts.links.link_sizes import LinkSizes, places, point_at_zero


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
