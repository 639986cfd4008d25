"""Shafts and pivots that carry only links: of an input crank, a rocker, a planet.

Fixed shafts end in the frame's lower face, like those of wheel and crank. A link on a shaft other
than the crank's lies in the lowest plane, so that nothing passes below it. A planet's shaft moves,
and joins the parts on it. Each shaft is as wide as the bores on its axis (``link_axes``). A link
without a bore is one piece with its shaft, which ends at the link's faces.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import NamedTuple

from geneva_cli.curves.plates import Member, Plate
from geneva_cli.kinematics.layout import Joint
from geneva_cli.layout.link_positions import same
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.link_axes import LinkAxis
from geneva_cli.parts.links import Links, placed_holes
from geneva_cli.parts.shafts import round_section, shaft, shaft_ends


class Ends(NamedTuple):
    """Ends of the shafts of wheel and crank, as far as links share them."""

    lowest: float  # the frame's lower face
    top: float  # the wheel's upper face
    stop: float | None = None  # height at which the crank's shaft ends above that face
    crank_has_one: bool = False  # the crank's shaft carries more than links: another function's
    wheel_has_one: bool = False


def link_shafts(
    mechanism: Mechanism, bars: Links, ends: Ends, others: Iterable[Member] = ()
) -> Iterator[Member]:
    """Yield the shafts at their positions at input angle 0.

    ``others`` are plates that turn with a link: the locking disc on a first crank. Raises
    GenevaError where a shaft's lower end is not below its upper one.
    """
    size, L, carried = mechanism.spec.size, mechanism.center_distance_mm, list(others)
    for axis in bars.axes:
        on_crank = same(axis.at, (L, 0.0), L)
        on_wheel = same(axis.at, (0.0, 0.0), L)
        if (on_crank and ends.crank_has_one) or (on_wheel and ends.wheel_has_one):
            continue
        heights = list(_heights(bars, axis, carried, L))
        low, high = min(low for low, _ in heights), max(high for _, high in heights)
        if axis.stands:
            what = "shaft" if Joint.SHAFT in axis.kinds else "pivot"
            whose = "crank" if on_crank else "wheel" if on_wheel else axis.names[0]
            low = ends.stop if on_crank and ends.stop is not None else ends.lowest
            high = ends.top if on_wheel else high
            low, high = shaft_ends(size, whose, low, high)
            yield Member(shaft(whose, round_section(size, axis.radius), (low, high), what), axis.at)
        elif len(axis.names) > 1 and Joint.PIN not in axis.kinds:  # ``link_pins`` has the pins
            plate = shaft(axis.names[0], round_section(size, axis.radius), (low, high))
            yield Member(plate._replace(name=f"shaft of {', '.join(axis.names)}"), axis.at)


def _heights(
    bars: Links, axis: LinkAxis, others: Iterable[Member], L: float
) -> Iterator[tuple[float, float]]:
    """Yield the heights, from and to, of the parts on an axis, with or without a bore."""
    for member in bars.cut:
        if isinstance(member.part, Plate) and member.part.name in axis.names:
            yield member.part.low, member.part.high
    for gear in bars.gears:
        if gear.name in axis.names and not gear.teeth.inside:
            yield gear.plate.low, gear.plate.high
    for member in others:
        if any(same(hole.centre, axis.at, L) for hole in placed_holes(member)):
            assert isinstance(member.part, Plate)
            yield member.part.low, member.part.high


def outside_links(shafts: Iterable[Member], bars: Links, L: float) -> Iterator[Member]:
    """Yield the shafts without the lengths that lie in links of one piece with them."""
    for member in shafts:
        if not isinstance(member.part, Plate):  # a turned one, in a machine without links
            yield member
            continue
        spans = [(member.part.low, member.part.high)]
        for plate in bars.one_piece(member.at, L):
            below = [(low, min(high, plate.low)) for low, high in spans]
            above = [(max(low, plate.high), high) for low, high in spans]
            spans = [(low, high) for low, high in below + above if high - low > SAME_LENGTH * L]
        for low, high in spans:
            yield member._replace(part=member.part._replace(low=low, high=high))
