"""Drawings of the parts, each in its own frame; ``machine_drawing`` assembles them.

Layers WHEEL, CRANK, ARM, LINK, GROOVE and BORE are cut. ROLLER is a circle. PITCH is the path of
rollers, and the pitch curve of gears without teeth. HUB shows a hub, which is a separate part.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import bounds, turned
from geneva_cli.geometry.plates import Group, Member, Plate, in_place
from geneva_cli.geometry.shapes import Arc, Contour, Line, Segment, closed, joined
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.motion.engagement import Engagement
from geneva_cli.parts.arm import arm_plate, crank_arm
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.parts import EdgedParts
from geneva_cli.parts.projection import drawing_of, once, outlines_of, shapes, titled


def wheel(parts: EdgedParts) -> Drawing:
    """Return the wheel or rack; x is along the first slot.

    The origin is the wheel's axis, or the roller's at mid-motion of a rack.
    """
    return drawing_of(parts.mechanism, parts.mechanism.output.noun, parts.wheel.part)


def crank(parts: EdgedParts) -> Drawing:
    """Return the crank in the wheel's plane; its axis is the origin, x is to the first roller."""
    return drawing_of(parts.mechanism, "crank", parts.crank_without_arm.part)


def arm(parts: FlatParts) -> Drawing:
    """Return the crank arm below the wheel's plane: outline, bore, holes for pins and bolts."""
    # without an arm the error says why
    solid = parts.arm_plate or arm_plate(parts.outlines, crank_arm(parts.outlines))
    title = titled(parts.mechanism, "arm")
    return Drawing(title, (solid.outline, *solid.holes), solid=solid)


def slot(parts: FlatParts) -> Drawing:
    """Return the first slot, closed along the rim, and the roller's path in it."""
    assembly = parts.outlines.assembly
    engagement = assembly.slots[0][0]
    walls = parts.walls(engagement)
    start, end = walls.segments[0].start, walls.segments[-1].end
    back = math.atan2(start[1], start[0]) - math.atan2(end[1], end[0])
    level = abs(math.hypot(*start) - math.hypot(*end)) < 1e-9 * assembly.L
    rim: Segment = Arc(end, start, math.tan(0.25 * back)) if level else Line(end, start)
    outline = closed("WHEEL", [*walls.segments, rim])
    return Drawing(titled(parts.mechanism, "slot"), (outline, *pitch_lines(parts, engagement)))


def groove(parts: FlatParts) -> Drawing:
    """Return both flanks of a cam-Geneva's fixed groove all round, about the crank's axis."""
    return Drawing(titled(parts.mechanism, "groove"), parts.groove)


def links(parts: FlatParts) -> Drawing:
    """Return every link and sliding block once, one above the other, each in its own frame."""
    mechanism, bars = parts.mechanism, parts.links
    if not bars.cut:
        raise GenevaError(
            f'--part links: kind = "{mechanism.spec.drive.NAME}" has no links: '
            + (
                "its crank is --part arm"
                if mechanism.spec.drive.ONE_ARM
                else "--part parts lists what it has"
            )
        )
    # links side by side are 0.05 of the centre distance apart
    members = tuple(_side_by_side(bars.plates, 0.05 * mechanism.center_distance_mm))
    title = titled(mechanism, "links")
    return Drawing(title, tuple(shapes(members)), solid=Group(title, members))


def _side_by_side(plates: Iterable[Plate], between: float) -> Iterator[Member]:
    top = 0.0
    for plate in dict.fromkeys(plates):
        box = bounds(plate.outline)
        # moved itself, so that the kerf finds its outlines in the drawing
        ((_, moved),) = in_place([Member(plate, (0.0, top - box.y0))])
        yield Member(moved)
        top += box.y1 - box.y0 + between


def frame(parts: EdgedParts) -> Drawing:
    """Return the frame as it is drilled."""
    return drawing_of(parts.mechanism, "frame", parts.frame.part)


def gears(parts: EdgedParts) -> Drawing:
    """Return all gears with bores and bolts, and the line of centres.

    The crank's axis is the origin. Raises GenevaError for a machine without gears.
    """
    from geneva_cli.parts.gears.gear_curves import required_gears
    from geneva_cli.parts.gears.gear_pair import FINE

    mechanism, name = parts.mechanism, "gears"
    round_only = mechanism.spec.drive.round_gears and not mechanism.spec.gears
    if not round_only:
        pair = required_gears(mechanism)
        if mechanism.spec.size.gear_module_mm is None:
            name = "pitch curves of the gears"
            parts = parts.finer(FINE[parts.curves] * pair.distance_mm)
    members = *parts.round_gears, *parts.gear_pair
    about_crank = _moved(members, -mechanism.center_distance_mm)
    drawn = tuple(once(shapes(about_crank)))
    title, ends = titled(mechanism, name), [one.at for one in about_crank]
    line = Contour("PITCH", (Line(min(ends), max(ends)),), closed=False)
    return Drawing(title, (*drawn, line), solid=Group(title, members))


def _moved(members: Iterable[Member], x: float) -> tuple[Member, ...]:
    return tuple(one._replace(at=(one.at[0] + x, one.at[1])) for one in members)


def groove_plate(parts: FlatParts) -> Drawing:
    """Return outline, both flanks, bore and holes of the groove's plate.

    The crank's axis is the origin. Raises GenevaError for a machine without a groove, and where the
    plate meets the wheel's shaft.
    """
    *_, pitch = parts.groove
    title = titled(parts.mechanism, "groove plate")
    stack = Group(title, tuple(Member(one.part) for one in parts.groove_plate))
    return Drawing(title, (*outlines_of(stack), pitch), solid=stack)


def pitch_lines(parts: FlatParts, engagement: Engagement) -> list[Contour]:
    """Return the slot's pitch curve; of a pair of slots, both.

    Where the roller returns on the same path, it is the first half.
    """
    apart = engagement.apart
    line = _pitch_line(parts, engagement.through)
    return [turned(line, -apart), turned(line, apart)] if apart else [line]


def _pitch_line(parts: FlatParts, engagement: Engagement) -> Contour:
    assembly = parts.outlines.assembly
    fine = 1e-3 if parts.tolerance is None else parts.tolerance  # mm, as a drawing's
    at = np.array([engagement.entry_deg, 0.0])
    x, y = engagement.slot(at, 0)
    if not engagement.slot.curved:
        mouth, end = assembly.L * np.column_stack((x.c[0], y.c[0] + 0.0 * at))
        ends = [(float(p[0]), float(p[1])) for p in (mouth, end)]
        return Contour("PITCH", (Line(*ends),), closed=False)
    from geneva_cli.geometry import fit
    from geneva_cli.parts.outlines.path_walls import parallel

    pieces: list[Segment] = []
    for a, b in ((engagement.entry_deg, 0.0), (0.0, engagement.exit_deg)):
        path = parallel(assembly, engagement, 0.0, b > 0.0)
        pieces += fit.KINDS[parts.curves](path, a, b, fine)
    return Contour("PITCH", joined(pieces), closed=False)
