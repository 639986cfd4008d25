"""What differs between the directions of a machine that turns both ways."""

from __future__ import annotations

import math

from geneva_cli.motion.both_ways import every_way
from geneva_cli.parts.parts import Parts, parts_of
from geneva_cli.table import rows_table
from geneva_cli.verdict.quantities.designs import Values
from geneva_cli.verdict.quantities.groups import REPORT, values


def both_ways(parts: Parts) -> Values:
    """Each number of the report that differs by direction; None if there are no such numbers.

    Places are left out, and what needs the parts: they are the same parts.
    """
    groups = [group for group in REPORT if not group.makes_parts and group.own]
    rows: list[tuple[str, float, float]] = []
    for backwards in every_way(parts.mechanism)[1:]:
        back = values(groups, parts_of(backwards))
        for name, one in values(groups, parts).items():
            other = back[name]
            if name.endswith("_deg") or not (isinstance(one, float) and isinstance(other, float)):
                continue
            # searches end within 1e-9 of a peak, and in any unit here 1e-12 is rounding
            if not math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-12):
                rows.append((name, one, other))
    return {"both_ways": rows_table(("quantity", "forwards", "backwards"), rows) if rows else None}
