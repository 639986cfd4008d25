"""What shafts of links carry, and the gaps of round parts to the links that they pass.

Each plane below the wheel's has one link, or gears. Through it pass the wheel's hub and shaft,
spacers on pins that join links of distant planes, pivots and spacers on the frame where another
drive is below, and the crank's shaft, which leaves the machine below all links, or above.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.plates import Member, Plate
from geneva_cli.geometry.shapes import Circle, Contour
from geneva_cli.motion.pivots import Joint, Link
from geneva_cli.numerics.arrays import Array
from geneva_cli.numerics.tolerances import SAME_LENGTH
from geneva_cli.parts.assembly import gear_plane, links_at, same, turn_deg
from geneva_cli.parts.links.links import LinkAxis, Links, LinkSizes, joined, placed_holes, places
from geneva_cli.parts.outlines.outlines import Outlines, wheel_hub_length
from geneva_cli.parts.shafts.arm_and_shafts import bore_at, wheel_shaft_ends
from geneva_cli.parts.shafts.bores import bore_of
from geneva_cli.parts.sizes import Span


def carried(bars: Links, axis: LinkAxis, others: Iterable[Member], L: float) -> list[Span]:
    """Return the faces of links, gears and ``others`` that turn with a link, on an axis."""
    found = [plate for plate in bars.plates if plate.name in axis.names]
    names = {*axis.names}
    for member in others:
        if any(same(hole.centre, axis.at, L) for hole in placed_holes(member)):
            assert isinstance(member.part, Plate)
            found.append(member.part)
            names.discard(member.part.name)
    for gear in bars.gears:
        if gear.plate.name in names and not gear.teeth.inside:
            found.append(gear.plate)
    return [(plate.low, plate.high) for plate in found]


def outside_links(shafts: Iterable[Member], bars: Links, L: float) -> Iterator[Member]:
    """Yield the shafts without the lengths that lie in links of one piece with them."""
    for member in shafts:
        assert isinstance(member.part, Plate)
        spans = [(member.part.low, member.part.high)]
        for plate in bars.one_piece(member.at, L):
            below = [(low, min(high, plate.low)) for low, high in spans]
            above = [(max(low, plate.high), high) for low, high in spans]
            spans = [(low, high) for low, high in below + above if high - low > SAME_LENGTH * L]
        for low, high in spans:
            yield member._replace(part=member.part._replace(low=low, high=high))


class Meeting(NamedTuple):
    """The least gap between a link and a part that passes through its plane."""

    gap: float  # mm, negative where they overlap
    input_deg: float
    link: str
    passing: str


class Round(NamedTuple):
    """A round part that passes through some planes."""

    name: str
    planes: set[int]
    path: Array | complex  # complex positions, one at each input angle, or one for all
    radius: float


def planes(
    parts: Outlines, bars: Links, spacers: Iterable[Member] = ()
) -> tuple[Meeting | None, Meeting | None]:
    """Return the least gap in a whole turn between links and what passes through their planes.

    The second gap is that of the crank's shaft to its bearings, None where it is free.
    """
    mechanism, L = parts.assembly.full, parts.assembly.L
    turn = turn_deg(mechanism)  # the error of a gap is quadratic in their distance
    every = links_at(mechanism, turn)
    met = list(_gears(parts, bars, [link for link in every if link.radius_mm], turn))
    links = [link for link in every if not link.radius_mm]
    carries, shaft, overlaps = _crank_shaft(parts, links, bars, turn)
    low = mechanism.spec.size.crank_shaft_low_mm
    ends = math.inf if low is None else low + SAME_LENGTH * L
    reached = {link.plane for link in links if bars.sizes.span(link.plane)[1] > ends}
    rounds = [*_on_wheel(parts, links, bars.sizes), *_posts(parts, bars, spacers)]
    for path, both in joined(links, SAME_LENGTH * L):  # spacers on pins
        name = f"the pin of {' and '.join(link.name for link in both)}"
        between = {*range(both[0].plane + 1, both[-1].plane)} - {link.plane for link in both}
        rounds.append(Round(name, between, path, bars.sizes.ring))
    if carries:  # the shaft in the planes that it must cross, or that the spec extends it to
        crossed = {*range(min(carries) + 1, max(carries | reached) + 1)}
        rounds.append(shaft._replace(planes=crossed - carries))
    for link in links:
        met += [_meeting(bars, link, one, turn) for one in rounds if link.plane in one.planes]
    through = parts.sizes.crank_bore > 0.0  # the locking disc
    return min(met, default=None), None if through else min(overlaps, default=None)


def crank_stop(parts: Outlines, bars: Links) -> float | None:
    """Return the height at which a link stops the crank's shaft downwards; None if none does."""
    mechanism = parts.assembly.full
    turn = turn_deg(mechanism)
    links = [link for link in links_at(mechanism, turn) if not link.radius_mm]
    carries, _, overlaps = _crank_shaft(parts, links, bars, turn)
    if next(overlaps, None) is None:
        return None
    return bars.sizes.span(max(carries))[0] if max(carries) else -bars.sizes.gap


def _crank_shaft(
    parts: Outlines, links: list[Link], bars: Links, turn: Array
) -> tuple[set[int], Round, Iterator[Meeting]]:
    """Return the planes, 0 the wheel's, of parts on the crank's shaft; it; overlaps below them."""
    L, sizes, machine = parts.assembly.L, bars.sizes, parts.assembly.full
    carries = {1} if parts.has_arm else set[int]()
    for link in links:
        on_axis = np.abs(places(link)[0] - L).max() < SAME_LENGTH * L
        if link.kinds[0] is Joint.SHAFT and on_axis:
            carries.add(link.plane)
    if machine.spec.gears and machine.gear_shaft == machine.crank_shaft:
        carries.add(gear_plane(machine))
    if parts.sizes.crank_bore > 0.0:  # it passes the locking disc
        carries.add(0)
    radius = sizes.crank_shaft or bars.shaft((L, 0.0), L)
    wide = bore_at(machine, (L, 0.0), radius).around
    shaft = Round("the crank's shaft", set(), complex(L), wide)
    below = (link for link in links if link.plane > max(carries, default=math.inf))
    met = (_meeting(bars, link, shaft, turn) for link in below)
    return carries, shaft, (one for one in met if one.gap < 0.0)


def _gears(parts: Outlines, bars: Links, gears: list[Link], turn: Array) -> Iterator[Meeting]:
    """Yield the gaps of gears to the wheel's hub and shaft, which pass through their plane."""
    if parts.assembly.full.first_wheel:
        return
    for gear, link in zip(bars.gears, gears, strict=True):
        away = np.abs(places(link)[0])
        on_shaft = bool(away.max() < SAME_LENGTH * parts.assembly.L)
        # a shaft fills the gear's bore, a hub does not
        own = gear.bore
        wide = own._replace(radius=own.radius + own.loose).around
        for one in _on_wheel(parts, [link], bars.sizes):
            if not one.planes or (on_shaft and one.radius <= wide):
                continue
            gaps = away + (wide - one.radius) if on_shaft else away - gear.outer - one.radius
            least = int(np.argmin(gaps))
            yield Meeting(float(gaps[least]), float(turn[least]), gear.plate.name, one.name)


def _posts(parts: Outlines, bars: Links, spacers: Iterable[Member]) -> Iterator[Round]:
    """Yield the pivots and spacers between the frame and links, in the planes of a drive below."""
    mechanism, L = parts.assembly.full, parts.assembly.L
    lowest, links = gear_plane(mechanism), links_at(mechanism, np.zeros(1))
    planes = {link.name: link.plane for link in links}
    below = {plane for plane in planes.values() if plane >= lowest}
    for axis in bars.axes:
        own = same(axis.at, (0.0, 0.0), L) or same(axis.at, (L, 0.0), L)  # of wheel or crank
        if axis.stands and not own and max(planes[name] for name in axis.names) < lowest:
            name = f"the pivot of {axis.names[0]}"
            yield Round(name, below, complex(*axis.at), axis.bore.radius)
    for one in spacers:
        assert isinstance(one.part, Plate) and isinstance(one.part.outline, Circle)
        radius = one.part.outline.radius
        yield Round(f"the {one.part.name}", below, complex(*one.at), radius)


def _on_wheel(parts: Outlines, links: list[Link], sizes: LinkSizes) -> Iterator[Round]:
    """Yield the wheel's hub in the planes that it reaches, and its shaft in those below."""
    if parts.assembly.sign < 0.0:
        return
    size, bore = parts.assembly.mechanism.spec.size, parts.sizes.wheel_bore
    shaft = bore_of(size, "wheel", bore).around if bore else 0.0
    hub = parts.sizes.wheel_hub if size.has_hub("wheel") else 0.0
    reach = -wheel_hub_length(size, parts.sizes)
    low, _ = wheel_shaft_ends(parts, -math.inf)
    left, near = {link.plane for link in links}, SAME_LENGTH * parts.assembly.L
    for name, radius, end in (("hub", hub, reach), ("shaft", shaft, low)):
        planes = {plane for plane in left if radius and end < sizes.span(plane)[1] - near}
        left -= planes
        yield Round(f"the wheel's {name}", planes, 0j, radius)


def _meeting(bars: Links, link: Link, one: Round, turn: Array) -> Meeting:
    """Return the least gap between a link's outline and a round part, over the input angles."""
    outline = next(plate.outline for plate in bars.plates if plate.name == link.name)
    assert isinstance(outline, Contour)
    joints = places(link)
    ahead = joints[1] - joints[0]
    size = np.abs(ahead)
    unit = np.where(size > 0.0, ahead / np.where(size > 0.0, size, 1.0), 1.0)
    own = (one.path - joints[0]) / unit
    gaps = Polyarc([outline]).signed(np.column_stack((own.real, own.imag))) - one.radius
    least = int(np.argmin(gaps))
    return Meeting(float(gaps[least]), float(turn[least]), link.name, one.name)
