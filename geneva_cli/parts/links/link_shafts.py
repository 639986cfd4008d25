"""Shafts and pivots that carry only links: of an input crank, a rocker, a planet.

Fixed shafts end in the frame's lower face, like those of wheel and crank. A link on a shaft other
than the crank's lies in the lowest plane, so that nothing passes below it. A planet's shaft moves,
and joins the parts on it. Each shaft is as wide as the bores on its axis (``link_pins``). A link
without a bore is one piece with its shaft, which ends at the link's faces.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from geneva_cli.geometry.plates import Member, Plate, Stack, between
from geneva_cli.geometry.shapes import Point
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Joint
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.links.link_positions import same
from geneva_cli.parts.links.links import Links, placed_holes
from geneva_cli.parts.shafts.shaft import Ends, Seat, Shaft, seat_of, shaft_ends

if TYPE_CHECKING:
    from geneva_cli.parts.links.links import LinkAxis


def link_shafts(
    mechanism: Mechanism, bars: Links, ends: Ends, on: Callable[[Point], tuple[Seat, ...]]
) -> Iterator[Shaft]:
    """Yield the shafts and pivots that carry only links, at input angle 0.

    ``on`` returns the parts on the axis at a point.
    """
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    for axis in bars.axes:
        on_crank = same(axis.at, (L, 0.0), L)
        on_wheel = same(axis.at, (0.0, 0.0), L)
        if (on_crank and ends.crank_has_one) or (on_wheel and ends.wheel_has_one):
            continue
        seats = on(axis.at)
        low, high = seats[0].low, max(seat.high for seat in seats)
        bore, direction = axis.bore.bore, axis.bore.direction
        if axis.stands:
            turns = Joint.SHAFT in axis.kinds
            whose = "crank" if on_crank else "wheel" if on_wheel else axis.names[0]
            low = ends.stop if on_crank and ends.stop is not None else ends.lowest
            high = ends.top if on_wheel else high
            low, high = shaft_ends(size, whose, low, high)
            name = f"{whose}'s {'shaft' if turns else 'pivot'}"
            yield Shaft(name, whose, bore, seats, low, high, axis.at, direction, turns=turns)
        elif len(axis.names) > 1 and Joint.PIN not in axis.kinds:  # ``link_pins`` has the pins
            name = f"shaft of {', '.join(axis.names)}"
            yield Shaft(name, axis.names[0], bore, seats, low, high, axis.at, turns=False)


def carried(bars: Links, axis: LinkAxis, others: Iterable[Member], L: float) -> Iterator[Seat]:
    """Yield the links and gears on an axis, with or without a bore.

    A link is fixed on the shaft of its first joint, and turns on others. ``others`` are plates
    that turn with a link: a first wheel, whose gear is no part then, and the locking disc on a
    first crank.
    """
    yield from (
        seat_of(bar.part, same(bar.at, axis.at, L) and Joint.SHAFT in axis.kinds)
        for bar in bars.cut
        if isinstance(bar.part, Plate) and bar.part.name in axis.names
    )
    on_axis = [
        seat_of(member.part)
        for member in others
        if any(same(hole.centre, axis.at, L) for hole in placed_holes(member))
    ]
    yield from on_axis
    names = {*axis.names} - {seat.part for seat in on_axis}
    for gear in bars.gears:
        if gear.name in names and not gear.teeth.inside:
            yield seat_of(gear.plate, not gear.teeth.fixed)


def links_to_fix(bars: Links, mechanism: Mechanism) -> Iterator[str]:
    """Yield the links and gears that turn with a shaft, but that nothing holds on it."""
    for axis in bars.axes:
        if axis.bore.bore.is_plain:
            seats = carried(bars, axis, (), mechanism.center_distance_mm)
            yield from (s.part for s in seats if s.held and s.part not in axis.one_piece)


def outside_links(shafts: Iterable[Member], bars: Links, L: float) -> Iterator[Member]:
    """Yield the shafts without the lengths that lie in links of one piece with them."""
    for member in shafts:
        assert isinstance(member.part, Plate | Stack)
        spans = [(member.part.low, member.part.high)]
        for plate in bars.one_piece(member.at, L):
            below = [(low, min(high, plate.low)) for low, high in spans]
            above = [(max(low, plate.high), high) for low, high in spans]
            spans = [(low, high) for low, high in below + above if high - low > SAME_LENGTH * L]
        for low, high in spans:
            yield member._replace(part=between(member.part, low, high))
