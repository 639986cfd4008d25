"""The list of parts: what is cut and turned, and every pivot and dimension to rebuild it from.

Rows are parts, pivots (at input angle 0, the wheel's axis the origin and the crank's on the x
axis) and dimensions. Plates are as thick as the face is wide; masses and moments of inertia are of
outlines, by Green's theorem, about the shaft that a part turns with, a roller about its pin.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

from geneva_cli.curves.measure import Box, bounds
from geneva_cli.curves.moments import Moments, moments, total
from geneva_cli.curves.shapes import Shape
from geneva_cli.errors import GenevaError
from geneva_cli.machine.layout import Dimension, Pivot
from geneva_cli.machine.mechanism import Mechanism
from geneva_cli.machine.rollers import places
from geneva_cli.parts.arm import bolts, crank_arm, has_arm
from geneva_cli.parts.crank import crank_circles
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.wheel_inertia import wheel_plate
from geneva_cli.spec.schema import Points, fields
from geneva_cli.spec.tables import Material
from geneva_cli.table import Table, rows_table

MM = 1e-3  # metres
# what a row of each kind has
KINDS = {
    "part": (
        "name",
        "count",
        "material",
        "density_kgm3",
        "thickness_mm",
        "mass_kg",
        "inertia_kgm2",
        "size_x_mm",
        "size_y_mm",
    ),
    "pivot": ("name", "x_mm", "y_mm"),
    "dimension": ("name", "value", "unit"),
}
NAMES = ("row", *dict.fromkeys(name for names in KINDS.values() for name in names))


def parts_table(mechanism: Mechanism, tolerance_mm: float, samples: int | None) -> Table:
    """One row a part, a pivot, or a dimension."""
    return parts_list(Proof(mechanism))


def parts_list(proof: Proof) -> Table:
    """The same, of a machine whose outlines may be known; no parts where its sizes leave none."""
    mechanism = proof.mechanism
    found: list[dict[str, Any]] = []
    if mechanism.spec.is_flat:
        with suppress(GenevaError):  # the check of the parts says why there are none
            found += _parts(proof.found)
    found += [*_pivots(mechanism), *_dimensions(mechanism)]
    rows = [[row.get(name) for name in NAMES] for row in found]
    return rows_table(NAMES, rows, mechanism.spec.title, mixed=True)


def _parts(found: Outlines) -> Iterator[dict[str, Any]]:
    """The parts with flat outlines."""
    spec = found.plane.given.spec
    sizes, width, count = found.sizes, spec.size.face_width_mm, len(found.plane.rollers)
    wheel = wheel_plate(found)
    outer = 2.0 * sizes.outer
    box = _box([found.wheel])
    yield {
        **_made("wheel", 1, "wheel", spec.material_wheel, width),
        "mass_kg": wheel and wheel.mass_kg,
        "inertia_kgm2": wheel and wheel.inertia_kgm2,
        "size_x_mm": outer or box.x1 - box.x0,
        "size_y_mm": outer or box.y1 - box.y0,
    }
    if found.crank:
        bore = [s for s in crank_circles(found.plane, sizes) if s.layer == "BORE"]
        holes = [*bore, *bolts(found)]
        yield _plate("locking disc", found, found.crank, holes, width)
    if has_arm(found):
        with suppress(GenevaError):
            arm = crank_arm(found)
            holes = [arm.bore, *arm.pins, *arm.bolts]
            yield _plate("crank arm", found, [arm.outline], holes, width)
    for name, outside, inside in (
        ("roller", sizes.roller, sizes.pin),
        ("pin", sizes.pin, 0.0),
    ):
        if outside:
            yield _turned(name, count, spec.material_roller, width, outside, inside)


def _made(
    name: str, count: int, material: str, of: Material, thickness: float | None
) -> dict[str, Any]:
    return {
        "row": "part",
        "name": name,
        "count": count,
        "material": f"material.{material}",
        "density_kgm3": of.density_kgm3,
        "thickness_mm": thickness,
    }


def _plate(
    name: str,
    found: Outlines,
    contours: Sequence[Shape],
    holes: Sequence[Shape],
    thickness: float | None,
) -> dict[str, Any]:
    """A plate about the crank's axis, of the wheel's material."""
    material = found.plane.mechanism.spec.material_wheel
    whole = total(_positive(shape) for shape in contours)
    left = whole.less(total(_positive(shape) for shape in holes))
    per = None if thickness is None else material.density_kgm3 * thickness * MM
    box = _box(contours)
    return {
        **_made(name, 1, "wheel", material, thickness),
        "mass_kg": None if per is None else per * left.area * MM**2,
        "inertia_kgm2": None if per is None else per * left.polar * MM**4,
        "size_x_mm": box.x1 - box.x0,
        "size_y_mm": box.y1 - box.y0,
    }


def _turned(
    name: str, count: int, of: Material, length: float | None, outside: float, inside: float
) -> dict[str, Any]:
    """A ring or a pin, about its own axis; the values are of one."""
    row = _made(name, count, "roller", of, length)
    row |= {"size_x_mm": 2.0 * outside, "size_y_mm": 2.0 * outside}
    if length is not None:
        area = math.pi * (outside - inside) * (outside + inside)
        row["mass_kg"] = mass = of.density_kgm3 * length * area * MM**3
        row["inertia_kgm2"] = 0.5 * mass * (outside**2 + inside**2) * MM**2
    return row


def _positive(shape: Shape) -> Moments:
    """The moments of what a shape encloses, whichever way it runs."""
    found = moments(shape)
    return found if found.area >= 0.0 else Moments(*[-value for value in found])


def _box(shapes: Sequence[Shape]) -> Box:
    boxes = [bounds(shape) for shape in shapes]
    low, high = min, max
    return Box(
        low(b.x0 for b in boxes),
        low(b.y0 for b in boxes),
        high(b.x1 for b in boxes),
        high(b.y1 for b in boxes),
    )


def _pivots(mechanism: Mechanism) -> Iterator[dict[str, Any]]:
    L = mechanism.center_distance_mm
    own = mechanism.spec.drive.layout(mechanism.plan, mechanism.spec.wheel.SIGN)
    found = [p for p in own if isinstance(p, Pivot)]
    if mechanism.spec.wheel.FLAT:
        found = [Pivot("wheel axis", 0.0, 0.0), Pivot("crank axis", L, 0.0), *found]
    for one in found:
        yield {"row": "pivot", **one._asdict()}


def _dimensions(mechanism: Mechanism) -> Iterator[dict[str, Any]]:
    spec, L = mechanism.spec, mechanism.center_distance_mm
    r, clear = mechanism.roller_radius_mm, spec.size.slot_clearance_mm
    found = [
        Dimension("wheel", spec.wheel.NAME),
        Dimension("drive", spec.drive.NAME),
        Dimension("slots", spec.wheel.z),
        Dimension("centre distance" if spec.wheel.FLAT else "sphere's radius", L, "mm"),
        Dimension("roller radius", r, "mm"),
        Dimension("slot width", 2.0 * (r + clear), "mm"),
    ]
    found += [d for d in spec.wheel.layout if isinstance(d, Dimension)]
    if mechanism.law is None and spec.drive.CRANKED:
        found += _straight(mechanism)
    elif spec.drive.CRANKED:
        found.append(Dimension("crank radius", mechanism.ratio * L, "mm"))
        found.append(Dimension("rollers, evenly", spec.drive.rollers))
    elif spec.drive.rollers > 1:
        found.append(Dimension("rollers, evenly", spec.drive.rollers))
    found += _motions(mechanism)
    own = spec.drive.layout(mechanism.plan, spec.wheel.SIGN)
    found += [d for d in own if isinstance(d, Dimension)]
    for one in found:
        yield {"row": "dimension", **one._asdict()}


def _straight(mechanism: Mechanism) -> Iterator[Dimension]:
    """Of straight slots: each roller on the crank, and what the slots are off the centre by."""
    spec, L = mechanism.spec, mechanism.center_distance_mm
    every = places(spec)
    m = spec.drive.rollers
    for i in range(max(len(every), m)):
        place = every[i % len(every)]
        behind = place.crank_deg if len(every) > 1 else 360.0 * i / m
        yield Dimension(f"roller {i + 1}: crank radius", place.ratio * L, "mm")
        yield Dimension(f"roller {i + 1}: behind the first", behind, "deg")


def _motions(mechanism: Mechanism) -> Iterator[Dimension]:
    """Of each engagement of a period: the wheel's step and the input angles of its motion."""
    for i, one in enumerate(mechanism.engagements):
        name = f"engagement {i + 1}: " if len(mechanism.engagements) > 1 else ""
        yield Dimension(f"{name}wheel's step", mechanism.index_deg(i), "deg")
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
