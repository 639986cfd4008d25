"""The gaps, in a whole turn, between links and what passes through their planes.

Each plane below the wheel's has one link, and the arm has its own check. What passes through is
round: the wheel's hub and shaft in the first plane, the spacer on a pin that joins links of planes
farther apart, the crank's shaft between the planes in which it carries something. That shaft gets
out below all links, or above through the locking disc: where it gets neither way, nobody can say
how it is carried.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.shapes import Contour
from geneva_cli.machine.layout import Joint, Link
from geneva_cli.parts.arm import has_arm
from geneva_cli.parts.link_pins import joined
from geneva_cli.parts.link_positions import links_at
from geneva_cli.parts.link_sizes import LinkSizes, places
from geneva_cli.parts.links import SAME, drawn_links
from geneva_cli.parts.outlines import Outlines

if TYPE_CHECKING:
    from geneva_cli.numerics.jet import Array

LOOKS = 1440  # input angles in a turn: between two of them a gap changes by its square


class Meeting(NamedTuple):
    """The least gap between a link and something that passes through its plane."""

    gap: float  # mm, negative where they overlap
    input_deg: float
    link: str
    passing: str


class Round(NamedTuple):
    """Something round that passes through a plane."""

    name: str
    plane: int
    way: Array  # complex, at each input angle
    radius: float


class Planes(NamedTuple):
    """The least gap of all in a whole turn, and that of the crank's shaft to its bearings."""

    nearest: Meeting | None
    way_out: Meeting | None  # None where it is free


def planes(found: Outlines) -> Planes:
    """The least gaps between links and what passes through their planes.

    Raises GenevaError where the sizes leave no links.
    """
    given = found.assembly.given
    turns = given.spec.drive.turns
    turn = np.linspace(-180.0 * turns, 180.0 * turns, LOOKS * turns + 1)
    links = [link for link in links_at(given, turn) if not link.radius_mm]
    if not links:
        return Planes(None, None)
    made = drawn_links(given, found)
    assert made.sizes is not None
    outlines = {
        plate.name: plate.outline for plate in made.plates if isinstance(plate.outline, Contour)
    }
    shaft = _Shaft(found, links, outlines, made.sizes)
    passing = [*_passing(found, links, made.sizes, turn), *shaft.between()]
    met = [
        _meeting(link, outlines[link.name], one, turn)
        for link in links
        for one in passing
        if one.plane == link.plane
    ]
    out = shaft.way_out(turn)
    blocked = out if out is not None and out.gap < 0.0 else None
    return Planes(min(met, default=None), blocked)


def _passing(found: Outlines, links: list[Link], sizes: LinkSizes, turn: Array) -> Iterator[Round]:
    hub = found.sizes.wheel_hub  # without one the wheel's shaft ends in the wheel
    if found.assembly.sign > 0.0 and hub:
        yield Round("the wheel's hub", 1, 0.0 * turn, hub)
    for one in joined(links, SAME * found.assembly.L):
        for plane in range(min(one.planes) + 1, max(one.planes)):
            if plane not in one.planes:
                name = f"the pin of {' and '.join(one.names)}"
                yield Round(name, plane, one.way, sizes.ring)


class _Shaft:
    """The crank's shaft: the planes in which it carries something, 0 being the wheel's."""

    def __init__(
        self,
        found: Outlines,
        links: list[Link],
        outlines: dict[str, Contour],
        sizes: LinkSizes,
    ) -> None:
        L = found.assembly.L
        self.links, self.outlines = links, outlines
        self.way = places(links[0])[0] * 0.0 + L
        self.carries: set[int] = set()
        bores = [sizes.crank_shaft or 0.0]
        for link in links:
            at, kind = places(link)[0], link.kinds[0]
            if kind is Joint.SHAFT and np.abs(at - L).max() < SAME * L:
                self.carries.add(link.plane)
                bores.append(sizes.bore(math.inf, L, on_crank=True))
        if has_arm(found):
            self.carries.add(1)
        self.through = found.sizes.crank_bore > 0.0  # the wheel's plane, with the locking disc
        if self.through:
            self.carries.add(0)
        self.radius = max(bores)

    def _in(self, plane: int) -> Round:
        return Round("the crank's shaft", plane, self.way, self.radius)

    def between(self) -> Iterator[Round]:
        """The planes that the shaft must cross."""
        if self.carries:
            for plane in range(min(self.carries) + 1, max(self.carries)):
                if plane not in self.carries:
                    yield self._in(plane)

    def way_out(self, turn: Array) -> Meeting | None:
        """The shaft's least gap on the better way to its bearings; None if it meets nothing."""
        if not self.carries or self.through:
            return None
        deepest = max(self.carries)
        met = [
            _meeting(link, self.outlines[link.name], self._in(link.plane), turn)
            for link in self.links
            if link.plane > deepest
        ]
        return min(met, default=None)


def _meeting(link: Link, outline: Contour, one: Round, turn: Array) -> Meeting:
    joints = places(link)
    ahead = joints[1] - joints[0]
    size = np.abs(ahead)
    unit = np.where(size > 0.0, ahead / np.where(size > 0.0, size, 1.0), 1.0)
    own = (one.way - joints[0]) / unit
    gaps = Polyarc([outline]).signed(np.column_stack((own.real, own.imag))) - one.radius
    least = int(np.argmin(gaps))
    return Meeting(float(gaps[least]), float(turn[least]), link.name, one.name)
