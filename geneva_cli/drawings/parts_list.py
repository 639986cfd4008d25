"""All that is cut and turned: each part by itself, all on one bed, and their list.

The list has every pivot and dimension to rebuild the machine. Rows are parts, pivots, dimensions,
and parts that cannot be built, with the reason. Pivots are at input angle 0, with the wheel's axis
as origin and the crank's on the x axis. Mass and moment of inertia are of one part, in closed form,
about the axis that it turns on. That is the wheel's, the crank's or a roller's own axis, or a
link's first joint. The centroid is measured from there too, in the part's own frame. Coordinate z
is along the axis from the wheel's lower face, or on a sphere inwards from the wheel's outer face.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from functools import partial
from typing import NamedTuple, TypeAlias

from geneva_cli.drawings.sheet.paper import packed
from geneva_cli.drives.transmission import places
from geneva_cli.errors import GenevaError
from geneva_cli.geometry import plates
from geneva_cli.geometry.plates import Group, Member, Part, Plate, Shell, Solid
from geneva_cli.geometry.shapes import Box, bounds_of
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import Mechanism
from geneva_cli.motion.pivots import Dimension, Pivot
from geneva_cli.motion.registry import thing
from geneva_cli.parts.parts import EdgedParts, Parts, parts_of
from geneva_cli.parts.projection import Missing, alike, built_of, outlines_of, titled
from geneva_cli.parts.shafts.bores import listed
from geneva_cli.spec.defaults import roller_material, wheel_material
from geneva_cli.spec.schema import Points, fields
from geneva_cli.table import Reading, Table, rows_table

# columns of a row of each kind
KINDS = {
    "part": (
        *("name", "count", "material", "density_kgm3", "thickness_mm", "z_low_mm", "z_high_mm"),
        *("mass_kg", "inertia_kgm2", "centroid_x_mm", "centroid_y_mm", "size_x_mm", "size_y_mm"),
    ),
    "pivot": ("name", "x_mm", "y_mm"),
    "dimension": ("name", "value", "unit"),
    "missing": ("name", "why"),
}
ROWS = {Pivot: "pivot", Dimension: "dimension", Missing: "missing"}
Row: TypeAlias = dict[str, object]
# The columns from the most important one, for a window that has not room for all.
FIRST = ("row", "name", "value", "unit", "why", "count", "mass_kg", "size_x_mm", "size_y_mm")
NAMES = ("row", *dict.fromkeys(name for names in KINDS.values() for name in names))


def parts_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """Return a table with a row for each part, pivot, dimension, and part that cannot be built."""
    return parts_list(parts_of(mechanism))


def parts_list(parts: Parts) -> Table:
    """Return the list of parts of a machine, whose outlines may already be computed."""
    mechanism = parts.mechanism
    pivots = [p for p in mechanism.layout if isinstance(p, Pivot)]
    axes = mechanism.spec.wheel.axes(mechanism.center_distance_mm)
    rows = []
    for one in (*_parts(parts), *axes, *pivots, *_dimensions(parts)):
        if not isinstance(one, dict):
            one = {"row": ROWS[type(one)], **one._asdict()}
        rows.append([one.get(name) for name in NAMES])
    table = rows_table(NAMES, rows, mechanism.spec.title, mixed=True)
    return table.replaced(reading=Reading(FIRST))


def _parts(parts: Parts) -> Iterator[Row | Missing]:
    missing = list[Missing]()

    def rows(build: Callable[[], Parts]) -> Iterator[Row]:
        own = build()
        row = partial(part_rows, own.mechanism.spec, outside=own.outside_mm)
        kinds = alike(built_of(own.by_name(), missing))
        # a part whose walls are too thin for its edges has no mass
        yield from built_of(((kind[-1].name, partial(row, kind)) for kind in kinds), missing)

    yield from built_of(((name, partial(rows, build)) for name, build in parts.all_built), missing)
    yield from missing


def part_rows(spec: Spec, parts: Iterable[Part], outside: float | None = None) -> Iterator[Row]:
    """Yield a row for each kind of solid among some parts, with its count.

    On a sphere ``outside`` is the radius of the wheel's outer face, from which z counts inwards.
    """
    for kind in alike(parts):
        solid = kind[-1]
        is_rod = solid.layer in ("ROLLER", "SHAFT")
        material = (roller_material if is_rod else wheel_material)(spec)
        density = material.density_kgm3
        heights = {one.low for one in kind if not isinstance(one, Shell)}
        row = {"row": "part", "name": solid.name, "count": len(kind), "density_kgm3": density}
        row |= {"material": material.name, **_properties(solid, density, outside)}
        yield row if len(heights) < 2 else row | {"z_low_mm": None, "z_high_mm": None}


def _properties(solid: Solid, density: float, outside: float | None) -> Row:
    """Return heights, mass, inertia and size of a solid; in a flat machine also its centroid."""
    body = plates.mass_properties([solid], density)
    row: Row = {"mass_kg": body.mass_kg, "inertia_kgm2": body.inertia_kgm2}
    if isinstance(solid, Shell):
        low, high = solid.inner, solid.outer
        # how far it reaches along x and y
        ends = (1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)
        right, left, ahead, back = map(solid.reach, ends)
        wide, deep = right + left, ahead + back
    else:
        low, high = solid.low, solid.high
        x0, y0, x1, y1 = bounds_of(outlines_of(solid))
        wide, deep = x1 - x0, y1 - y0
    row |= {"thickness_mm": high - low, "size_x_mm": wide, "size_y_mm": deep}
    if outside is not None:
        low, high = outside - high, outside - low
    else:
        # a centroid within 1e-13 of a part's size of its axis is on it
        near = 1e-13 * max(wide, deep)
        x, y = (at if abs(at) > near else 0.0 for at in body.centroid_mm)
        row |= {"centroid_x_mm": x, "centroid_y_mm": y}
    return row | {"z_low_mm": low, "z_high_mm": high}


def _dimensions(parts: Parts) -> Iterator[Dimension | Missing]:
    mechanism = parts.mechanism
    spec, L = mechanism.spec, mechanism.center_distance_mm
    r, clear = mechanism.roller_radius_mm, spec.size.allowances.slot_clearance_mm
    yield Dimension("wheel", spec.wheel.NAME)
    yield Dimension("drive", spec.drive.NAME)
    if spec.drive_before:
        yield Dimension("drive before it", spec.drive_before.NAME)
    yield Dimension("slots", spec.wheel.z)
    yield Dimension(spec.wheel.DISTANCE, L, "mm")
    yield Dimension("roller radius", r, "mm")
    yield Dimension("slot width", 2.0 * (r + clear), "mm")
    if spec.size.edge_mm:
        kind = "rounding" if spec.size.edge_chamfer_mm is None else "chamfer"
        yield Dimension(f"{kind} of all edges", spec.size.edge_mm, "mm")
    with suppress(GenevaError):  # the rows of what cannot be built have the reason
        yield from listed(() if spec.no_parts else parts.built.screws)
    yield from (d for d in spec.wheel.layout if isinstance(d, Dimension))
    if own := thing(spec.wheel.NAME, "dimensions"):
        yield from own(parts)
    if mechanism.law is None and spec.drive.crank:
        yield from _straight(mechanism)
    else:
        if spec.drive.crank:
            yield Dimension("crank radius", mechanism.ratio * L, "mm")
        if spec.drive.crank or spec.drive.rollers > 1:
            yield Dimension("rollers, evenly", spec.drive.rollers)
    yield from _motions(mechanism)
    yield from (d for d in mechanism.layout if isinstance(d, Dimension))


def _straight(mechanism: Mechanism) -> Iterator[Dimension]:
    """Yield crank radius and angle of each roller on the crank, for straight slots."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    stations = places(spec.wheel, spec.drive, spec.given_distance_mm)
    m = spec.drive.rollers
    for i in range(max(len(stations), m)):
        station = stations[i % len(stations)]
        behind = station.crank_deg if len(stations) > 1 else 360.0 * i / m
        yield Dimension(f"roller {i + 1}: crank radius", station.ratio * L, "mm")
        yield Dimension(f"roller {i + 1}: behind the first", behind, "deg")


def _motions(mechanism: Mechanism) -> Iterator[Dimension]:
    from geneva_cli.motion.timing import timings

    output = mechanism.output
    for i, one in enumerate(mechanism.engagements):
        name = f"engagement {i + 1}: " if len(mechanism.engagements) > 1 else ""
        step = timings(mechanism)[i].step
        yield Dimension(f"{name}{output.noun}'s step", step, output.unit)
        yield Dimension(f"{name}input at mid-motion", one.mid_deg, "deg")
        yield Dimension(f"{name}entry, from mid-motion", one.entry_deg, "deg")
        yield Dimension(f"{name}exit, from mid-motion", one.exit_deg, "deg")
    law = mechanism.law
    if law is not None:
        yield Dimension("law", law.NAME)
        for field in fields(type(law)):
            value = getattr(law, field.attribute)
            if isinstance(value, Points):
                value = value.file
            if value is not None:
                yield Dimension(f"law's {field.key}", value)


APART = 5.0  # mm between parts, and round them


def plate(parts: EdgedParts) -> Drawing:
    """Return all parts, each as often as the machine has it, in front of and right of the origin.

    Raises GenevaError for a part that cannot be built.
    """
    built = (part for _, build in parts.by_name() for part in build())
    every = (one for part in built for one in plates.solids(part))
    whole = [one for one in every if not isinstance(one, Shell)]
    title = titled(parts.mechanism, "plate")
    solid = Group(title, tuple(_laid(whole)))
    return Drawing(title, outlines_of(solid), solid=solid)


def _laid(whole: list[Plate]) -> list[Member]:
    """Return parts at z = 0 side by side, on a square bed that is as small as they allow."""
    boxes = [bounds_of(outlines_of(one)) for one in whole]
    side = math.sqrt(sum((x1 - x0 + APART) * (y1 - y0 + APART) for x0, y0, x1, y1 in boxes))
    # the bed grows by a tenth until all parts fit
    while (moves := packed(boxes, (), Box(0.0, 0.0, side, side), APART)) is None:
        side *= 1.1
    flat = (one._replace(low=0.0, high=one.thickness) for one in whole)
    return [*map(Member, flat, moves)]


class SinglePart(NamedTuple):
    """A kind of part: its name and number, thickness in mm, and drawing with its solid."""

    name: str
    copies: int  # in the machine
    thickness_mm: float
    is_cut: bool  # True for a flat part that is cut out of a plate
    drawing: Drawing


def single_parts(
    parts: Parts, tolerance_mm: float, curves: str
) -> tuple[list[SinglePart], list[Missing]]:
    """Return every kind of part, with curves as in ``part_drawing``, and those without a drawing.

    A shell of a sphere has a solid and no outline.
    """
    missing, out = list[Missing](), list[SinglePart]()
    built = (build().within(tolerance_mm, curves) for _, build in parts.all_built)
    every = [part for one in built for part in built_of(one.by_name(), missing)]
    for solid, *others in alike(every):
        title = titled(parts.mechanism, solid.name)
        thickness = solid.outer - solid.inner if isinstance(solid, Shell) else solid.thickness
        shapes = () if isinstance(solid, Shell) else outlines_of(solid)
        drawing = Drawing(title, shapes, solid=solid, tolerance=tolerance_mm)
        cut = isinstance(solid, Plate) and is_cut(solid)
        out.append(SinglePart(solid.name, 1 + len(others), thickness, cut, drawing))
    return out, missing


def is_cut(plate: Plate) -> bool:
    """Return True for a part that is cut out of a plate; others are turned or bought."""
    return plate.layer in ("WHEEL", "CRANK", "ARM", "LINK", "GROOVE", "FRAME")
