"""What shafts of links carry, and the gaps of round parts to the links that they pass.

Each plane below the wheel's has one link, or gears. Through it pass the wheel's hub and shaft,
spacers on pins that join links of distant planes, pivots and spacers on the frame where another
drive is below, and the crank's shaft, which leaves the machine below all links, or above.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from itertools import product
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle, Contour
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array, value_or
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import gear_plane, links_at, same, turn_deg
from geneva_cli.parts.links.links import LinkAxis, Links, joined, placed_holes, places
from geneva_cli.parts.outlines.outlines import Outlines, wheel_hub_length
from geneva_cli.parts.shafts.arm_and_shafts import bore_at, wheel_shaft_ends
from geneva_cli.parts.shafts.bores import Bore, bore_of
from geneva_cli.parts.sizes import Span


def carried(bars: Links, axis: LinkAxis, others: Iterable[Member], L: float) -> list[Span]:
    """Return the faces of links, gears and ``others`` that turn with a link, on an axis."""
    turning, names = [plate for plate in bars.plates if plate.name in axis.names], {*axis.names}
    for member in others:
        if any(same(hole.centre, axis.at, L) for hole in placed_holes(member)):
            turning.append(member.plate)
            names.discard(member.part.name)
    gears = (gear.plate for gear in bars.gears if gear.part.name in names)
    turning += (gear for gear in gears if gear.bore)
    return [(plate.low, plate.high) for plate in turning]


def outside_links(shafts: Iterable[Member], bars: Links, L: float) -> Iterator[Member]:
    """Yield the shafts without the lengths that lie in links of one piece with them."""
    for member in shafts:
        spans = [(member.plate.low, member.plate.high)]
        for plate in bars.one_piece(member.at, L):
            below = [(low, min(high, plate.low)) for low, high in spans]
            above = [(max(low, plate.high), high) for low, high in spans]
            spans = [(low, high) for low, high in below + above if high - low > SAME_LENGTH * L]
        for low, high in spans:
            yield member._replace(part=member.plate._replace(low=low, high=high))


class Meeting(NamedTuple):
    """The least gap between a link and a part that passes through its plane."""

    gap: float  # mm, negative where they overlap
    input_deg: float
    link: str
    passing: str


class Round(NamedTuple):
    """A round part below the wheel: the heights between which it may meet links, and its path."""

    name: str
    low: float
    high: float
    path: Array | complex  # complex positions, one at each input angle, or one for all
    radius: float
    carries: Iterable[str] = ()  # names of the links that turn on it


def planes(
    parts: Outlines, bars: Links, spacers: Iterable[Member] = ()
) -> tuple[Meeting | None, Meeting | None]:
    """Return the least gap in a whole turn between links and what passes through their planes.

    The second gap is that of the crank's shaft to its bearings, None where it is free.
    """
    mechanism, sizes, near = parts.assembly.full, bars.sizes, SAME_LENGTH * parts.assembly.L
    turn = turn_deg(mechanism)  # the error of a gap is quadratic in their distance
    every, on_wheel = links_at(mechanism, turn), _on_wheel(parts)
    links, met = [link for link in every if not link.radius_mm], list[Meeting]()
    if not mechanism.first_wheel:
        for gear, link in zip(bars.gears, (one for one in every if one.radius_mm), strict=True):
            met += _to_gear(gear.plate, link, on_wheel, turn, near)
    shaft, overlaps = _crank_shaft(parts, links, bars, turn)
    low = value_or(mechanism.spec.size.crank_shaft_low_mm, math.inf)  # to which the spec extends it
    rounds = [*on_wheel, *_posts(parts, bars, spacers), shaft._replace(low=min(shaft.low, low))]
    for path, both in joined(links, near):  # spacers on pins
        names = [link.name for link in both]
        span = sizes.span(both[-1].plane)[1], sizes.span(both[0].plane)[0]
        rounds.append(Round(f"the pin of {' and '.join(names)}", *span, path, sizes.ring, names))
    for link, one in product(links, rounds):
        if link.name not in one.carries and _overlap(sizes.span(link.plane), one) > near:
            met.append(_meeting(bars, link, one, turn))
    through = parts.sizes.crank_bore > 0.0  # the locking disc
    return min(met, default=None), None if through else min(overlaps, default=None)


def _overlap(span: Span, one: Round) -> float:
    """Return the height that a plane shares with a round part, negative where it shares none."""
    return min(span[1], one.high) - max(span[0], one.low)


def crank_stop(parts: Outlines, bars: Links) -> float | None:
    """Return the height at which a link stops the crank's shaft downwards; None if none does."""
    turn = turn_deg(parts.assembly.full)
    links = [link for link in links_at(parts.assembly.full, turn) if not link.radius_mm]
    shaft, overlaps = _crank_shaft(parts, links, bars, turn)
    return shaft.low if next(overlaps, None) else None


def _crank_shaft(
    parts: Outlines, links: Iterable[Link], bars: Links, turn: Array
) -> tuple[Round, Iterator[Meeting]]:
    """Return the crank's shaft between the parts on it, and its overlaps with links below them."""
    L, sizes, machine = parts.assembly.L, bars.sizes, parts.assembly.full
    on_axis = dict[str, float]()  # the lower faces of the links that it carries
    for link in links:
        if link.kinds[0] is Joint.SHAFT and np.abs(places(link)[0] - L).max() < SAME_LENGTH * L:
            on_axis[link.name] = sizes.span(link.plane)[0]
    lows = [*on_axis.values()]
    if machine.spec.gears and machine.gear_shaft == machine.crank_shaft:
        lows.append(sizes.span(gear_plane(machine))[0])
    lows += [sizes.span(1)[0]] if parts.has_arm else []
    lows += [-sizes.gap] if parts.sizes.crank_bore > 0.0 else []  # it passes the locking disc
    wide = bore_at(machine, (L, 0.0), sizes.crank_shaft or bars.shaft((L, 0.0), L)).around
    span = min(lows, default=-math.inf), max(lows, default=-math.inf)
    shaft = Round("the crank's shaft", *span, complex(L), wide, on_axis)
    below = (link for link in links if sizes.span(link.plane)[0] < shaft.low)
    met = (_meeting(bars, link, shaft, turn) for link in below)
    return shaft, (one for one in met if one.gap < 0.0)


def _to_gear(
    plate: Plate, link: Link, rounds: Iterable[Round], turn: Array, near: float
) -> Iterator[Meeting]:
    """Yield the gaps of a gear to the wheel's hub and shaft."""
    away, own = np.abs(places(link)[0]), plate.bore or Bore(0.0)
    on_shaft, outline = bool(away.max() < near), plate.outline
    # a shaft fills the gear's bore, a hub does not
    wide = own._replace(radius=own.radius + own.loose).around
    outer = outline.radius if isinstance(outline, Circle) else link.radius_mm
    for one in rounds:
        meets = _overlap((plate.low, plate.high), one) > near
        if meets and not (on_shaft and one.radius <= wide):
            gaps = away + (wide if on_shaft else -outer) - one.radius
            least = int(np.argmin(gaps))
            yield Meeting(float(gaps[least]), float(turn[least]), plate.name, one.name)


def _posts(parts: Outlines, bars: Links, spacers: Iterable[Member]) -> Iterator[Round]:
    """Yield the pivots and spacers between the frame and links, in the planes of a drive below."""
    mechanism, L = parts.assembly.full, parts.assembly.L
    lowest = gear_plane(mechanism)
    planes = {link.name: link.plane for link in links_at(mechanism, np.zeros(1))}
    below = -math.inf, bars.sizes.span(lowest)[1]
    for axis in bars.axes:
        own = same(axis.at, (0.0, 0.0), L) or same(axis.at, (L, 0.0), L)  # of wheel or crank
        if axis.stands and not own and max(planes[name] for name in axis.names) < lowest:
            name = f"the pivot of {axis.names[0]}"
            yield Round(name, *below, complex(*axis.at), axis.bore.radius)
    for one in spacers:
        assert isinstance(one.plate.outline, Circle)
        yield Round(f"the {one.part.name}", *below, complex(*one.at), one.plate.outline.radius)


def _on_wheel(parts: Outlines) -> list[Round]:
    """Return the wheel's hub and shaft below it; none of an internal wheel."""
    size, bore = parts.assembly.mechanism.spec.size, parts.sizes.wheel_bore
    shaft = bore_of(size, "wheel", bore).around if bore else 0.0
    hub = parts.sizes.wheel_hub if size.has_hub("wheel") else 0.0
    ends = -wheel_hub_length(size, parts.sizes), wheel_shaft_ends(parts, -math.inf)[0]
    rows = zip(("hub", "shaft"), ends, (hub, shaft), strict=True)
    outside = parts.assembly.sign > 0.0
    return [Round(f"the wheel's {name}", low, 0.0, 0j, r) for name, low, r in rows if r and outside]


def _meeting(bars: Links, link: Link, one: Round, turn: Array) -> Meeting:
    """Return the least gap between a link's outline and a round part, over the input angles."""
    outline = next(plate.outline for plate in bars.plates if plate.name == link.name)
    assert isinstance(outline, Contour)
    joints = places(link)
    own = (one.path - joints[0]) * np.exp(-1j * np.angle(joints[1] - joints[0]))
    gaps = Polyarc([outline]).signed(np.column_stack((own.real, own.imag))) - one.radius
    least = int(np.argmin(gaps))
    return Meeting(float(gaps[least]), float(turn[least]), link.name, one.name)
