"""The parts that ``geneva profile`` writes: as tables of points, and as drawings to cut."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from geneva_cli.errors import GenevaError, cut, nearest
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.table import Table, rows_table

if TYPE_CHECKING:
    from geneva_cli.curves.shapes import Drawing
    from geneva_cli.parts.outlines import Outlines

# parts that are tables of points, where no drawing is asked for, and parts that are drawn
TABLES = ("slot", "gears", "groove")
DRAWINGS = ("slot", "wheel", "crank", "assembly", "groove")
PARTS = ("slot", "wheel", "crank", "assembly", "gears", "groove")
SAMPLES_MAX = 1_000_000


def is_table(mechanism: Mechanism, part: str, drawn: bool) -> bool:
    """Whether a part is written as a table; ``drawn`` where the format is a drawing's.

    Raises GenevaError for a part that is not known, or is no drawing.
    """
    if part not in PARTS:
        raise GenevaError(
            f"--part {cut(part)}: it must be one of {', '.join(PARTS)}{nearest(part, PARTS)}"
        )
    if drawn and part not in DRAWINGS:
        raise GenevaError(
            f"--part {part} is a table of points; write it as .csv or .json, and "
            f"{', '.join(DRAWINGS)} as drawings"
        )
    spherical = part == "wheel" and not mechanism.spec.wheel.FLAT
    return not drawn and (part in TABLES or spherical)


def part_table(mechanism: Mechanism, part: str, tolerance_mm: float, samples: int | None) -> Table:
    """A part's points: for a chord tolerance, or ``samples`` evenly in the input angle.

    Raises GenevaError for a part that the machine does not have.
    """
    if samples is not None and not 2 <= samples <= SAMPLES_MAX:
        raise GenevaError(f"--samples {cut(samples)}: must be at least 2, at most {SAMPLES_MAX}")
    if part == "slot":
        from geneva_cli.parts.slot_profile import profile_table

        return profile_table(mechanism, tolerance_mm, samples)
    if part == "gears":
        from geneva_cli.parts.gear_curves import gears_table

        return gears_table(mechanism, samples)
    if part == "groove":
        from geneva_cli.parts.groove import groove_table

        return groove_table(mechanism, samples)
    return meridians_table(mechanism)


def meridians_table(mechanism: Mechanism) -> Table:
    """The slots of a spherical wheel: meridians of its sphere, one row a slot.

    Angles are about the wheel's axis (azimuth) and from it (polar); points on the sphere.
    """
    engagement, spec = mechanism.engagements[0], mechanism.spec
    mouth, bottom = (engagement.slot(x, 0)[0].c[0] for x in (engagement.entry_deg, 0.0))
    L = mechanism.center_distance_mm
    names = ["slot", "azimuth_deg", "mouth_polar_deg", "bottom_polar_deg"]
    names += [f"{end}_{axis}_mm" for end in ("mouth", "bottom") for axis in "xyz"]
    rows = []
    for k in range(spec.wheel.z):
        azimuth = 2.0 * math.pi * k / spec.wheel.z
        row = [k + 1, math.degrees(azimuth), math.degrees(mouth), math.degrees(bottom)]
        for polar in (mouth, bottom):
            across = L * math.sin(polar)
            row += [across * math.cos(azimuth), across * math.sin(azimuth), L * math.cos(polar)]
        rows.append(row)
    return rows_table(names, rows)


def part_drawing(found: Outlines, part: str, tolerance_mm: float, curves: str) -> Drawing:
    """A part as contours of lines and arcs, or ("cubics") of lines, arcs and cubics."""
    from geneva_cli.parts import drawings as drawn

    of: dict[str, Callable[[Outlines, float, str], Drawing]] = {
        "slot": drawn.slot,
        "wheel": drawn.wheel,
        "crank": drawn.crank,
        "assembly": drawn.assembly,
        "groove": drawn.groove,
    }
    return of[part](found, tolerance_mm, curves)
