"""The frame: one plate with a hole for every shaft that stands, and four to mount it by.

It lies below all that moves; a plate above the wheel is drilled alike. In the machine's frame, the
wheel's axis the origin and the crank's on the x axis. Holes have the size of their shafts: what a
bush or a bearing needs is for who chooses it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress

import numpy as np

from geneva_cli.curves.belt import belt
from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.plates import Member, Plate
from geneva_cli.curves.shapes import Circle, Point
from geneva_cli.errors import GenevaError
from geneva_cli.machine.layout import Joint
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.arm import has_arm, shaft_bore
from geneva_cli.parts.centre_marks import centre_marks
from geneva_cli.parts.gear_drawings import gear_bores, gear_span
from geneva_cli.parts.groove_plate import TOLERANCE, groove_members
from geneva_cli.parts.link_drawings import titled
from geneva_cli.parts.link_positions import links_at
from geneva_cli.parts.link_sizes import places
from geneva_cli.parts.links import Links, drawn_links, placed_holes
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.sizes import even, thicknesses, wall_min

NAME, LAYER, HOLES = "frame", "FRAME", "BORE"
SAME = 1e-9  # of the centre distance: places nearer to each other are one
ANGLES = 720  # input angles at which it is seen which joints stand


def frame(proof: Proof, tolerance: float, curves: str) -> Drawing:
    """The frame as it is drilled, with centre marks."""
    plate = frame_plate(proof)
    holes = [hole for hole in plate.holes if isinstance(hole, Circle)]
    shapes = (plate.outline, *holes, *centre_marks(holes))
    return Drawing(f"{titled(proof.mechanism)}: frame", shapes, solid=plate)


def frame_plate(
    proof: Proof, fixed: list[Member] | None = None, bars: Links | None = None
) -> Plate:
    """The frame; ``fixed`` are the plates with a groove that it carries, ``bars`` the links.

    Both are worked out where they are not known. Raises GenevaError where wheel and crank stand in
    no one plane.
    """
    mechanism = proof.mechanism
    if not mechanism.spec.wheel.FLAT:
        raise GenevaError(
            f'--part frame: the shafts of gearing = "{mechanism.spec.wheel.NAME}" cross, and stand '
            "in no one plate"
        )
    found = proof.found if mechanism.spec.is_flat else None
    bars = bars or drawn_links(mechanism, found)
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    known = list(_bores(proof, found, bars))
    holes = [
        Circle(HOLES, at, max((r for c, r in known if same(c, at, L)), default=even(L / 20.0)))
        for at in standing(mechanism)
    ]
    if fixed is None:
        fixed = groove_members(found, bars) if found else []
    holes += [*_fixed(bars), *_mounted(fixed, L)]
    wall = wall_min(size, L)
    eye = max(L / 20.0, 3.0 * wall)
    low, high = (
        [pick(c.centre[k] + way * c.radius for c in holes) + 3.0 * way * eye for k in (0, 1)]
        for way, pick in ((-1.0, min), (1.0, max))
    )
    corners = [(x, y) for x in (low[0], high[0]) for y in (low[1], high[1])]
    outline = belt(LAYER, [Circle(LAYER, corner, eye) for corner in corners])
    holes += [Circle(HOLES, corner, even(0.4 * eye)) for corner in corners]
    lows = [one.part.low for one in fixed if isinstance(one.part, Plate)]
    if mechanism.spec.drive.gears:
        lows.append(gear_span(proof)[0])
    top = min([_lowest(mechanism, found, bars), *lows]) - size.washer_mm
    return Plate(NAME, LAYER, outline, tuple(holes), top - thicknesses(size, L).arm, top)


def standing_plates(
    found: Outlines, bars: Links, tolerance: float = TOLERANCE, curves: str = "arcs"
) -> Iterator[Member]:
    """A cam's groove plate, unless there is no room for one, and the frame, where they are."""
    fixed: list[Member] = []
    with suppress(GenevaError):  # --part groove-plate says why
        fixed = groove_members(found, bars, tolerance, curves)
    yield from fixed
    yield Member(frame_plate(Proof(found.assembly.given, found), fixed, bars))


def lowest(standing: Sequence[Member]) -> float:
    """The lower face of the frame, the last of the plates that stand."""
    frame = standing[-1].part
    assert isinstance(frame, Plate)
    return frame.low


def standing(mechanism: Mechanism) -> Iterator[Point]:
    """Where shafts stand in the frame, each once: the wheel's, the crank's, what drives it."""
    L, turns = mechanism.center_distance_mm, mechanism.spec.drive.turns
    seen = [(0.0, 0.0), (L, 0.0)]
    if mechanism.spec.drive.gears:
        seen.append((L + mechanism.spec.drive.gears.distance_mm, 0.0))
    yield from seen
    for link in links_at(mechanism, np.linspace(-180.0 * turns, 180.0 * turns, ANGLES * turns + 1)):
        for joint, kind in zip(places(link), link.kinds, strict=True):
            middle = complex(joint[len(joint) // 2])  # input angle 0
            at = middle.real, middle.imag
            stands = bool(np.abs(joint - middle).max() < SAME * L)
            known = any(same(at, one, L) for one in seen)
            if stands and kind in (Joint.SHAFT, Joint.PIN) and not known:
                seen.append(at)
                yield at


def _bores(proof: Proof, found: Outlines | None, bars: Links) -> Iterator[tuple[Point, float]]:
    """Places and radii of the shafts' bores in what they carry."""
    mechanism = proof.mechanism
    shaft, L = mechanism.spec.shaft, mechanism.center_distance_mm
    if found and found.sizes.wheel_bore:
        yield (0.0, 0.0), found.sizes.wheel_bore
    if found and (has_arm(found) or found.sizes.crank_bore):
        yield (L, 0.0), shaft_bore(found) if has_arm(found) else found.sizes.crank_bore
    for x, given in ((0.0, shaft.wheel_diameter_mm), (L, shaft.crank_diameter_mm)):
        if given is not None:
            yield (x, 0.0), 0.5 * given
    for member in bars.cut:
        yield from ((hole.centre, hole.radius) for hole in placed_holes(member))
    yield from ((gear.at, gear.bore) for gear in bars.gears if gear.bore)
    if mechanism.spec.drive.gears:
        yield from ((at, r) for at, r in gear_bores(proof) if r)


def _fixed(bars: Links) -> Iterator[Circle]:
    """The holes by which what stands, as a guide or a gear, is screwed to the frame."""
    for member in bars.cut:
        if isinstance(member.part, Plate) and member.part.name in bars.standing:
            yield from placed_holes(member)
    for gear in bars.gears:
        for hole in gear.bolts:
            (x, y), (u, v) = gear.at, hole.centre
            yield Circle(HOLES, (x + u, y + v), hole.radius)


def _mounted(members: list[Member], L: float) -> Iterator[Circle]:
    """The holes that mount plates about the crank's axis, once."""
    holes = dict.fromkeys(hole for one in members for hole in placed_holes(one))
    yield from (hole for hole in holes if not same(hole.centre, (L, 0.0), L))


def _lowest(mechanism: Mechanism, found: Outlines | None, bars: Links) -> float:
    """The lowest place of what moves, along the axis."""
    size, L = mechanism.spec.size, mechanism.center_distance_mm
    under = [one.part.low for one in (*bars.cut, *bars.joined) if isinstance(one.part, Plate)]
    under += [gear.plate.low for gear in bars.gears]
    arm = thicknesses(size, L).arm if found and has_arm(found) else 0.0
    return min([*under, -size.pin_gap_mm - arm])


def same(p: Point, q: Point, L: float) -> bool:
    """Whether two places are one, with the centre distance L."""
    return abs(complex(*p) - complex(*q)) < SAME * L
