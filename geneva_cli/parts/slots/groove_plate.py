"""The plate with a cam-Geneva's groove, as three plates that are stacked.

On a base lie a ring and an island with the groove between them, as deep as the roller is thick. A
shop that mills it out of one piece uses the same outlines. The crank's axis is the origin. The bore
is that of the crank's shaft, and four holes mount the plate.
"""

from __future__ import annotations

import math

import numpy as np

from geneva_cli.errors import GenevaError
from geneva_cli.geometry import fit
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Circle, Contour, Layer, closed
from geneva_cli.parts.assembly import Assembly
from geneva_cli.parts.links.links import Links
from geneva_cli.parts.outlines.outlines import Outlines
from geneva_cli.parts.outlines.wheel_circles import about_axis
from geneva_cli.parts.shafts.screws import screw_through
from geneva_cli.parts.shafts.shaft_bores import bore_at
from geneva_cli.parts.sizes import Sizes
from geneva_cli.parts.slots.groove import groove_curve

BELOW = 2  # planes below the wheel: that of the groove, below the crank
MOUNTS = 4


def groove_lines(
    parts: Outlines, tolerance: float | None, curves: str
) -> tuple[Contour, Contour, Contour]:
    """Return both flanks of the groove all round, about the crank's axis, and its pitch curve.

    Raises GenevaError for a machine without a groove.
    """
    guide = parts.assembly.rollers[0][0].groove
    if guide is None:
        kind = parts.assembly.full.spec.drive.NAME
        raise GenevaError(
            f'--part groove, groove-plate: kind = "{kind}" has no groove; "cam" has one'
        )
    # the flanks are within 0.001 mm by default, as a drawing's
    motion, fine = guide.motion, 1e-3 if tolerance is None else tolerance
    ends = (motion.entry_deg, motion.exit_deg, motion.entry_deg + 360.0)

    def line(layer: Layer, side: float) -> Contour:
        curve = groove_curve(guide, parts.assembly.L, side * parts.sizes.half_width)
        pairs = zip(ends, ends[1:], strict=False)
        return closed(
            layer, [piece for a, b in pairs for piece in fit.KINDS[curves](curve, a, b, fine)]
        )

    return line("GROOVE", 1.0), line("GROOVE", -1.0), line("PITCH", 0.0)


def groove_base(parts: Outlines, bars: Links) -> Plate:
    """Return the base below the groove, with its holes.

    ``bars`` are the links of the machine. Raises GenevaError where it meets the wheel's shaft.
    """
    assert bars.sizes is not None  # the crank is a link
    L = parts.assembly.L
    far, rim = groove_reaches(parts.assembly, parts.sizes)
    screw, at = screw_through(0.5 * rim), far + 0.5 * rim
    mounts = [
        Circle("BORE", (at * math.cos(turn), at * math.sin(turn)), 0.5 * screw.through)
        for turn in (math.tau * (k + 0.5) / MOUNTS for k in range(MOUNTS))
        if screw
    ]
    shaft = bars.shaft((L, 0.0), L)
    if shaft:  # which turns in the base
        shaft = bore_at(parts.assembly.full, (L, 0.0), shaft).bore.around
    bore = [Circle("BORE", (0.0, 0.0), shaft + bars.sizes.loose)] if shaft else []
    edge = Circle("FRAME", (0.0, 0.0), far + rim)
    high, _ = bars.sizes.span(BELOW)
    low = high - parts.sizes.arm_thickness
    if parts.assembly.full.spec.drive_before:  # it fills its plane: another drive is below it
        low, _ = bars.sizes.span(BELOW + 1)
    return Plate("groove plate's base", "FRAME", edge, (*bore, *mounts), low, high)


def groove_stack(
    base: Plate, bars: Links, flanks: tuple[Contour, Contour]
) -> tuple[Plate, Plate, Plate]:
    """Return base, ring and island; ``flanks`` are those of the groove."""
    assert bars.sizes is not None
    inner, outer = sorted(flanks, key=_reach)
    low, high = bars.sizes.span(BELOW)
    bore = about_axis(base.holes)
    mounts = (hole for hole in base.holes if hole not in bore)
    return (
        base,
        Plate("groove plate's ring", "FRAME", base.outline, (outer, *mounts), low, high),
        Plate("groove plate's island", "FRAME", inner, bore, low, high),
    )


def groove_reaches(assembly: Assembly, sizes: Sizes) -> tuple[float, float]:
    """Return the groove's reach from the crank's axis, and the width of the rim around it, mm."""
    far, wall = _farthest(assembly, sizes), sizes.wall_min
    space = assembly.L - max(sizes.wheel_bore, sizes.wheel_hub) - wall - far
    # where it fits, the rim around the groove is 1.5 roller radii wide
    rim = min(max(1.5 * sizes.roller, 4.0 * wall), space)
    if rim < 4.0 * wall:
        raise GenevaError(
            f"--part groove-plate: the groove reaches {far:.4g} mm and leaves {space:.4g} mm up to "
            "the wheel's hub, less than four times wall_min_mm. Reduce roller, wheel_hub_mm or "
            "wheel_bore_mm",
            ("size", "wheel_hub_mm"),
        )
    return far, rim


def _farthest(assembly: Assembly, sizes: Sizes) -> float:
    """Return the groove's reach from the crank's axis: its farthest middle and half its width."""
    guide = assembly.rollers[0][0].groove
    assert guide is not None  # otherwise there is no plate
    # 3601 angles of a turn: the error of the farthest point is quadratic in their distance
    at, _ = groove_curve(guide, assembly.L, 0.0)(np.linspace(0.0, 360.0, 3601))
    return float(np.hypot(*at.T).max()) + sizes.half_width


def _reach(flank: Contour) -> float:
    """Return the distance of a flank's farthest end from the crank's axis."""
    return max(math.hypot(*piece.start) for piece in flank.segments)
