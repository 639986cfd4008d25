"""The drawing sheet of a machine: dimensioned parts, the list of items and a title block.

The assembled machine and its section are drawn at the scale of the parts, or at half of it.
"""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.curves.sheet import Sheet
from geneva_cli.drawings.machine_drawing import machine
from geneva_cli.drawings.sheet import links, points
from geneva_cli.drawings.sheet.composed import at_scales, on_paper
from geneva_cli.drawings.sheet.content import section, shown_on_sheet
from geneva_cli.drawings.sheet.paper import table
from geneva_cli.drawings.sheet.view import Block
from geneva_cli.drawings.sheet.views import together, views
from geneva_cli.kinematics.layout import Dimension, Pivot
from geneva_cli.layout.written import length, quantity
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.parts.flat_parts import FlatParts


def sheet(parts: FlatParts) -> Sheet:
    """Return the drawing sheet of a machine. Raises GenevaError where no scale fits on one."""
    mechanism, L = parts.mechanism, parts.mechanism.center_distance_mm
    shown = shown_on_sheet(mechanism.spec, parts.members, machine(parts).shapes)
    tolerance = parts.tolerance or 0.0
    fixed = [
        *points.tables(parts.outlines, tolerance),
        *points.gear_tables(mechanism, tolerance),
        *links.round_parts(parts.links.joined, mechanism),
        *layout(mechanism),
    ]

    def blocks(scale: float) -> Iterator[list[Block]]:
        apart = [view.block() for view in views(shown, parts, scale)]
        yield from at_scales(
            [*apart, *fixed],
            scale,
            lambda s: together(shown, parts, s),
            lambda s: section(shown, (0.0, L), s),
        )

    return on_paper(mechanism.spec, shown.rows, shown.largest, blocks, shown.area)


def layout(mechanism: Mechanism) -> list[Block]:
    """Return a table of pivots and lengths of the drive in front of the crank, if any."""
    own = mechanism.layout
    rows = [("drive", "x or value", "y or unit")]
    rows += [(p.name, length(p.x_mm), length(p.y_mm)) for p in own if isinstance(p, Pivot)]
    rows += [
        (d.name, *((d.value, d.unit) if isinstance(d.value, str) else quantity(d.value, d.unit)))
        for d in own
        if isinstance(d, Dimension)
    ]
    return [table((), rows, (60.0, 36.0, 20.0))] if len(rows) > 1 else []  # mm
