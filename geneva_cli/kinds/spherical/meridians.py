"""The slots of a spherical wheel, as lines on its sphere."""

from __future__ import annotations

import math

from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.table import Table, rows_table


def meridians_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return the slots of a spherical wheel, one row for each: meridians of its sphere.

    Azimuths are about the wheel's axis, polar angles from it. Points are on the sphere.
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
