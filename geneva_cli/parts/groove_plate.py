"""The plate with a cam-Geneva's groove, as three plates that are stacked.

On a base lie a ring and an island with the groove between them, as deep as the roller is thick. A
shop that mills it out of one piece uses the same outlines. The crank's axis is the origin. The bore
is that of the crank's shaft, and four holes mount the plate.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.curves.drawing import Drawing
from geneva_cli.curves.plates import Group, Member, Plate, plates
from geneva_cli.curves.shapes import Circle, Contour
from geneva_cli.errors import GenevaError
from geneva_cli.parts.centre_marks import centre_marks
from geneva_cli.parts.drawings import groove
from geneva_cli.parts.groove import groove_curve
from geneva_cli.parts.link_drawings import titled
from geneva_cli.parts.links import Links, drawn_links
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.sizes import even

HOLES, RIM = "BORE", 1.5  # of the roller's radius: rim around the groove, where it fits
MOUNTS = 4
SAMPLES = 3601  # input angles of a turn: the error of the farthest point is quadratic in them
TOLERANCE = 1e-3  # mm, of the flanks by default: that of a drawing


def groove_plate(
    parts: Outlines, tolerance: float, curves: str, bars: Links | None = None
) -> Drawing:
    """Return outline, both flanks, bore and holes, with centre marks.

    ``bars`` are the machine's links, if they are known. Raises GenevaError for a machine without a
    groove, and where the plate meets the wheel's shaft.
    """
    title = f"{titled(parts.assembly.mechanism)}: groove plate"
    flanks = groove(parts, tolerance, curves)
    outer, inner, pitch = (shape for shape in flanks.shapes if isinstance(shape, Contour))
    stack = _plates(parts, outer, inner, bars or drawn_links(parts.assembly.mechanism, parts))
    base, ring, _ = stack
    holes = [hole for hole in base.holes if isinstance(hole, Circle)]
    shapes = (base.outline, *ring.holes[:1], inner, *holes, pitch, *centre_marks(holes))
    return Drawing(title, shapes, solid=Group(title, tuple(map(Member, stack))))


def groove_members(
    parts: Outlines,
    bars: Links | None = None,
    tolerance: float = TOLERANCE,
    curves: str = "arcs",
) -> list[Member]:
    """Return the plates at their positions in the machine; none without a groove."""
    if parts.assembly.rollers[0][0].groove is None:
        return []
    solid = groove_plate(parts, tolerance, curves, bars).solid
    assert solid is not None
    return [Member(plate, (parts.assembly.L, 0.0)) for plate in plates(solid)]


def _plates(
    parts: Outlines, one: Contour, other: Contour, bars: Links
) -> tuple[Plate, Plate, Plate]:
    """Return base, ring and island from the two flanks."""
    L = parts.assembly.L
    inner, outer = sorted((one, other), key=_reach)
    follower = next(
        m.part for m in bars.joined if isinstance(m.part, Plate) and m.part.name.endswith("groove")
    )
    far, rim = _reaches(parts)
    mount, at = even(0.25 * rim), far + 0.5 * rim
    mounts = [
        Circle(HOLES, (at * math.cos(turn), at * math.sin(turn)), mount)
        for turn in (math.tau * (k + 0.5) / MOUNTS for k in range(MOUNTS))
    ]
    shaft = bars.shaft((L, 0.0), L)
    bore = [Circle(HOLES, (0.0, 0.0), shaft)] if shaft else []
    edge = Circle("FRAME", (0.0, 0.0), far + rim)
    low, high = follower.low, follower.high
    floor = low - parts.sizes.arm_thickness
    return (
        Plate("groove plate's base", "FRAME", edge, (*bore, *mounts), floor, low),
        Plate("groove plate's ring", "FRAME", edge, (outer, *mounts), low, high),
        Plate("groove plate's island", "FRAME", inner, tuple(bore), low, high),
    )


def require_groove_plate(parts: Outlines) -> None:
    """Raise GenevaError, naming the key, where a groove leaves no space for its plate."""
    if parts.assembly.rollers[0][0].groove is not None:
        _reaches(parts)


def _reaches(parts: Outlines) -> tuple[float, float]:
    """Return the groove's reach from the crank's axis, and the width of the rim around it, mm.

    Raises GenevaError, naming the key, where the wheel's hub leaves no space for the rim.
    """
    sizes, far = parts.sizes, _farthest(parts)
    wall = sizes.wall_min
    space = parts.assembly.L - max(sizes.wheel_bore, sizes.wheel_hub) - wall - far
    rim = min(max(RIM * sizes.roller, 4.0 * wall), space)
    if rim < 4.0 * wall:
        raise GenevaError(
            f"--part groove-plate: the groove reaches {far:.4g} mm and leaves {space:.4g} mm up to "
            "the wheel's hub, less than four times wall_min_mm; reduce roller, wheel_hub_mm or "
            "wheel_bore_mm",
            ("size", "wheel_hub_mm"),
        )
    return far, rim


def _farthest(parts: Outlines) -> float:
    """Return the groove's reach from the crank's axis: its farthest middle and half its width.

    There a flank is normal to the ray. The result does not depend on the drawing's tolerance.
    """
    guide = parts.assembly.rollers[0][0].groove
    assert guide is not None  # otherwise there is no plate
    at, _ = groove_curve(guide, parts.assembly.L, 0.0)(np.linspace(0.0, 360.0, SAMPLES))
    return float(np.hypot(*at.T).max()) + parts.sizes.half_width


def _reach(flank: Contour) -> float:
    """Return the distance of a flank's farthest end from the crank's axis."""
    return max(math.hypot(*piece.start) for piece in flank.segments)
