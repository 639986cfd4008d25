"""Drawings of the parts, each in its own frame; ``machine_drawing`` assembles them.

Layers WHEEL, CRANK, ARM, LINK, GROOVE and BORE are cut. ROLLER is a circle. PITCH is the path of
rollers, and the pitch curve of gears. CENTER has marks. HUB shows a hub, which is a separate part.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.curves import fit
from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.measure import turned
from geneva_cli.curves.shapes import Arc, Contour, Line, Segment, Shape, closed, joined
from geneva_cli.errors import GenevaError
from geneva_cli.machine.engagement import Engagement
from geneva_cli.parts.arm import bolts, crank_arm
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.crank import crank_circles
from geneva_cli.parts.link_drawings import titled
from geneva_cli.parts.outlines import Outlines, slot_walls
from geneva_cli.parts.plates import arm_plate, crank_group, wheel_part
from geneva_cli.parts.shafts import crank_hub
from geneva_cli.parts.walls.ways import parallel
from geneva_cli.parts.wheel import wheel_circles, wheel_contour
from geneva_cli.parts.wheel_hub import wheel_hub

PITCH = "PITCH"


def wheel(parts: Outlines, tolerance: float, curves: str) -> Drawing:
    """Return the wheel; its axis is the origin, and x is along the first slot."""
    contour, *circles = wheel_shapes(parts, tolerance, curves)
    solid = wheel_part(parts, contour)
    return Drawing(_title(parts, "wheel"), (contour, *circles), solid=solid)


def crank(parts: Outlines, tolerance: float, curves: str) -> Drawing:
    """Return the crank in the wheel's plane; its axis is the origin, x is to the first roller."""
    return Drawing(_title(parts, "crank"), tuple(crank_shapes(parts)), solid=crank_group(parts))


def arm(parts: Outlines, tolerance: float, curves: str) -> Drawing:
    """Return the crank arm below the wheel's plane: outline, bore, holes for pins and bolts."""
    solid = arm_plate(parts, crank_arm(parts))
    return Drawing(_title(parts, "arm"), (solid.outline, *solid.holes), solid=solid)


def slot(parts: Outlines, tolerance: float, curves: str) -> Drawing:
    """Return the first slot, closed along the rim, and the roller's path in it."""
    engagement = parts.assembly.slots[0][0]
    walls = _walls(parts, engagement, tolerance, curves)
    start, end = walls.segments[0].start, walls.segments[-1].end
    back = math.atan2(start[1], start[0]) - math.atan2(end[1], end[0])
    level = abs(math.hypot(*start) - math.hypot(*end)) < 1e-9 * parts.assembly.L
    rim: Segment = Arc(end, start, math.tan(0.25 * back)) if level else Line(end, start)
    pitch = pitch_lines(parts.assembly, engagement, tolerance, curves)
    return Drawing(_title(parts, "slot"), (closed("WHEEL", [*walls.segments, rim]), *pitch))


def groove(parts: Outlines, tolerance: float, curves: str) -> Drawing:
    """Return both flanks of a cam-Geneva's fixed groove all round, about the crank's axis."""
    guide = parts.assembly.rollers[0][0].groove
    if guide is None:
        kind = parts.assembly.full.spec.drive.NAME
        raise GenevaError(
            f'--part groove, groove-plate: kind = "{kind}" has no groove; "cam" has one'
        )
    from geneva_cli.parts.groove import groove_curve

    motion = guide.motion
    ends = (motion.entry_deg, motion.exit_deg, motion.entry_deg + 360.0)
    shapes = []
    for layer, side in (("GROOVE", 1.0), ("GROOVE", -1.0), (PITCH, 0.0)):
        curve = groove_curve(guide, parts.assembly.L, side * parts.sizes.half_width)
        pieces: list[Segment] = []
        for a, b in zip(ends, ends[1:], strict=False):
            pieces += fit.KINDS[curves](curve, a, b, tolerance)
        shapes.append(closed(layer, pieces))
    return Drawing(_title(parts, "groove"), tuple(shapes))


def _title(parts: Outlines, part: str) -> str:
    name = titled(parts.assembly.mechanism)
    return f"{name}: {part}" if part else name


def wheel_shapes(
    parts: Outlines, tolerance: float, curves: str
) -> tuple[Contour, *tuple[Shape, ...]]:
    """Return the wheel's outline, and its circles."""
    assembly, sizes = parts.assembly, parts.sizes
    hub = wheel_hub(assembly, sizes)
    circles = [*wheel_circles(assembly, sizes), *([hub.outline] if hub else [])]
    return (_outline(parts, tolerance, curves), *circles)


def _outline(parts: Outlines, tolerance: float, curves: str) -> Contour:
    """Return the wheel's outline, with slot walls in the requested tolerance and curves."""
    if _as_turned(parts, tolerance, curves):
        return parts.wheel
    walls = {slot: _walls(parts, slot, tolerance, curves) for slot in parts.slots}
    return wheel_contour(parts.assembly, parts.sizes, walls)


def _walls(parts: Outlines, slot: Engagement, tolerance: float, curves: str) -> Contour:
    """Return the walls of a slot: of the full turn, unless other or finer curves are requested."""
    if _as_turned(parts, tolerance, curves):
        return parts.slots[slot]
    return slot_walls(parts.assembly, parts.sizes, slot, tolerance, curves)


def _as_turned(parts: Outlines, tolerance: float, curves: str) -> bool:
    """Return True if the requested curves are those that the full turn uses."""
    return curves == "arcs" and tolerance == parts.fine


def crank_shapes(parts: Outlines) -> list[Shape]:
    """Return the locking disc or its sectors, with their holes, and the rollers."""
    hub = crank_hub(parts)
    circles = [*crank_circles(parts.assembly, parts.sizes), *([hub.outline] if hub else [])]
    return [*parts.crank, *circles, *bolts(parts)]


def pitch_lines(
    assembly: Assembly, engagement: Engagement, tolerance: float, curves: str
) -> list[Contour]:
    """Return the slot's pitch curve; of a pair of slots, both.

    Where the roller returns on the same path, it is the first half.
    """
    apart, engagement = engagement.apart, engagement.through
    line = _pitch_line(assembly, engagement, tolerance, curves)
    return [turned(line, -apart), turned(line, apart)] if apart else [line]


def _pitch_line(
    assembly: Assembly, engagement: Engagement, tolerance: float, curves: str
) -> Contour:
    at = np.array([engagement.entry_deg, 0.0])
    x, y = engagement.slot(at, 0)
    if not engagement.slot.curved:
        mouth, end = assembly.L * np.column_stack((x.c[0], y.c[0] + 0.0 * at))
        ends = [(float(p[0]), float(p[1])) for p in (mouth, end)]
        return Contour(PITCH, (Line(*ends),), closed=False)
    pieces: list[Segment] = []
    for a, b in ((engagement.entry_deg, 0.0), (0.0, engagement.exit_deg)):
        pieces += fit.KINDS[curves](parallel(assembly, engagement, 0.0, b > 0.0), a, b, tolerance)
    return Contour(PITCH, joined(pieces), closed=False)
