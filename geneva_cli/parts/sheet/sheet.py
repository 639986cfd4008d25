"""The drawing sheet of a machine: its parts with dimensions, the list of items and a title block.

The views have one scale, of the standard's the largest with which all goes on one sheet: 1:1 or
less up to A1, more only as long as A3 will do. The machine put together is drawn at half of it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

from geneva_cli.curves.measure import bounds
from geneva_cli.curves.plates import Group, Plate, plates
from geneva_cli.curves.shapes import Shape
from geneva_cli.curves.sheet import Sheet
from geneva_cli.errors import GenevaError
from geneva_cli.machine.layout import Dimension, Pivot
from geneva_cli.machine.spec import Spec
from geneva_cli.parts import drawings
from geneva_cli.parts.arm import CrankArm, crank_arm, has_arm
from geneva_cli.parts.first_pair import first_outlines
from geneva_cli.parts.frame import LAYER as STANDING
from geneva_cli.parts.links import drawn_links
from geneva_cli.parts.machine_drawing import machine
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.parts_list import plate_rows
from geneva_cli.parts.shafts import SHAFT
from geneva_cli.parts.sheet import points, wheel
from geneva_cli.parts.sheet.crank import (
    draw_arm,
    draw_assembly,
    draw_disc,
    draw_roller,
)
from geneva_cli.parts.sheet.pack import packed
from geneva_cli.parts.sheet.paper import (
    BLOCK,
    FORMATS,
    LEFT,
    MARGIN,
    SCALES,
    PaperSize,
    frame,
    scale_name,
    smaller,
    table,
    title_block,
)
from geneva_cli.parts.sheet.standing import draw_frame, draw_groove, draw_shaft
from geneva_cli.parts.sheet.view import Block, View, number
from geneva_cli.spec.tables import Material

ENLARGED = FORMATS[:2]  # what is used above 1:1
HUB = "crank's hub"  # stands on the disc
APART = {"WHEEL", "ARM"}  # layers of which each plate has a view
ASSEMBLED = 2.0  # how much smaller the machine is drawn than its parts
GENERAL = "ISO 2768-m"  # tolerances of what has none of its own
ITEMS = (12.0, 50.0, 14.0, 20.0, 24.0, 60.0)  # mm: columns of the list of items
LINKS = (60.0, 36.0, 20.0)  # and of that of pivots and links


class Shown(NamedTuple):
    """What goes on a sheet, whatever its scale."""

    found: Outlines
    together: tuple[Shape, ...]
    rows: list[dict[str, Any]]  # the list of parts
    arm: CrankArm | None
    first: Outlines | None
    groove: tuple[Shape, ...]  # flanks and pitch curve, of a cam
    shafts: list[Plate]
    standing: list[Plate]  # the frame comes last
    area: float  # mm², of boxes about some of the parts: the views need more
    tolerance: float
    curves: str


def sheet(found: Outlines, tolerance: float, curves: str) -> Sheet:
    """The drawing sheet of a machine. Raises GenevaError where no scale brings it on one."""
    shown = _shown(found, tolerance, curves)
    fixed = [*points.tables(found, tolerance), *_links(found)]
    largest = 2.0 * (found.sizes.outer or found.sizes.rim)

    def blocks(scale: float) -> list[Block]:
        return [*(view.block() for view in _views(shown, scale)), *fixed]

    return on_paper(found.assembly.given.spec, shown.rows, largest, blocks, shown.area)


def on_paper(
    spec: Spec,
    rows: list[dict[str, Any]],
    largest: float,
    blocks: Callable[[float], list[Block]],
    area: float = 0.0,
) -> Sheet:
    """The sheet of blocks to the largest scale with which all go on one; ``rows`` are its items.

    ``largest`` is the longest of what is drawn, mm, and ``area``, mm², what some of it needs at
    least. Raises GenevaError where none does.
    """
    for scale in SCALES:
        formats = ENLARGED if scale > 1.0 else FORMATS
        width, height = formats[-1].width, formats[-1].height
        if scale * largest > width or scale * scale * area > width * height:
            continue
        drawn = blocks(scale)
        for paper in formats:
            made = _composed(spec, paper, scale, rows, drawn)
            if made is not None:
                return made
    raise GenevaError(
        "--part sheet: the parts and their tables do not go on one A1 sheet; a coarser "
        "--tolerance makes shorter tables"
    )


def _shown(found: Outlines, tolerance: float, curves: str) -> Shown:
    given, cam = found.assembly.given, found.assembly.rollers[0][0].groove is not None
    whole = machine(found, tolerance, curves)
    assert isinstance(whole.solid, Group)
    every = [one.part for one in whole.solid.members if isinstance(one.part, Plate)]
    standing = [plate for plate in every if plate.layer == STANDING]
    apart = [plate for plate in plates(whole.solid) if plate.layer in APART]
    boxes = [bounds(plate.outline) for plate in (*apart, standing[-1])]
    return Shown(
        found,
        whole.shapes,
        list(plate_rows(given.spec, whole.solid)),
        crank_arm(found) if has_arm(found) else None,
        first_outlines(given, drawn_links(given, found)),
        drawings.groove(found, tolerance, curves).shapes if cam else (),
        [plate for plate in every if plate.layer == SHAFT],
        standing,
        sum((box.x1 - box.x0) * (box.y1 - box.y0) for box in boxes),
        tolerance,
        curves,
    )


def _views(shown: Shown, scale: float) -> Iterator[View]:
    """A view of each part."""
    found = shown.found

    def view(*names: str) -> View:
        titles = [
            f"{i} {row['name']}, t = {number(row['thickness_mm'])}"
            for i, row in enumerate(shown.rows, 1)
            if row["name"] in names
        ]
        return View("; ".join(titles) or names[0], scale)

    for front, of in (("", found), ("first ", shown.first)):
        if of is None:
            continue
        made = view(f"{front}wheel", f"{front}wheel's hub")
        wheel.draw_wheel(made, of, shown.tolerance, shown.curves)
        yield made
        if of.crank:
            made = view(*(f"{front}{name}" for name in ("locking disc", "locking sector", HUB)))
            draw_disc(made, of)
            yield made
    if shown.arm:
        made = view("arm")
        draw_arm(made, found, shown.arm)
        yield made
    made = view("roller", "pin")
    draw_roller(made, found)
    yield made
    for plate in shown.shafts:
        made = view(plate.name)
        draw_shaft(made, plate)
        yield made
    *grooved, lowest = shown.standing
    if shown.groove:
        made = view(*(plate.name for plate in grooved), "groove")
        draw_groove(made, shown.groove, found.sizes.half_width, grooved[0] if grooved else None)
        yield made
    made = view(lowest.name)
    draw_frame(made, lowest)
    yield made
    half = smaller(scale, ASSEMBLED)
    made = View(f"together ({scale_name(half)})", half)
    draw_assembly(made, found, shown.together)
    yield made


def _composed(
    spec: Spec,
    paper: PaperSize,
    scale: float,
    rows: list[dict[str, Any]],
    blocks: list[Block],
) -> Sheet | None:
    """All on one sheet; None where it has no room."""
    materials = [_material(spec.material_wheel), _material(spec.material_roller)]
    fields = {
        "scale": scale_name(scale),
        "mass": f"{_rounded(sum(r['mass_kg'] * r['count'] for r in rows))} kg",
        "material": materials[0] if len(set(materials)) == 1 else "see list",
        "tolerances": GENERAL,
        "units": "mm, degrees",
        "size": paper.name,
        "sheet": "1/1",
    }
    names = ", ".join(str(row["name"]) for row in rows)
    head = spec.title or f"Geneva wheel of {spec.wheel.z} slots"
    right, low = paper.width - MARGIN, MARGIN
    corner = title_block(fields, head, names).moved(right - BLOCK, low)
    items = _items(rows, materials)
    items = items.moved(right - items.width, corner.y1)
    area = LEFT, MARGIN, right, paper.height - MARGIN
    placed = packed(blocks, [corner, items], area)
    if placed is None:
        return None
    every = [corner, items, *placed]
    return Sheet(
        head,
        paper.width,
        paper.height,
        scale,
        (*frame(paper), *(s for b in every for s in b.shapes)),
        tuple(label for b in every for label in b.labels),
        tuple(m for b in every for m in b.measures),
    )


def _items(rows: list[dict[str, Any]], materials: list[str]) -> Block:
    """The list of items (ISO 7573), from below."""
    own = {"material.wheel": materials[0], "material.roller": materials[1]}
    lines = [
        (
            str(i),
            str(row["name"]),
            str(row["count"]),
            number(row["thickness_mm"]),
            _rounded(row["mass_kg"]),
            own[row["material"]],
        )
        for i, row in enumerate(rows, 1)
    ]
    heading = ("item", "part", "count", "t", "kg each", "material")
    return table((), [heading, *lines], ITEMS)


def _links(found: Outlines) -> list[Block]:
    """Pivots and lengths of what drives the crank."""
    given = found.assembly.given
    layout = given.spec.drive.layout(given.plan, given.spec.wheel.SIGN)
    rows = [("drive", "x or value", "y or unit")]
    rows += [(p.name, number(p.x_mm), number(p.y_mm)) for p in layout if isinstance(p, Pivot)]
    rows += [
        (d.name, number(d.value) if isinstance(d.value, (int, float)) else d.value, d.unit)
        for d in layout
        if isinstance(d, Dimension)
    ]
    return [table((), rows, LINKS)] if len(rows) > 1 else []


def _material(of: Material) -> str:
    """Steel where nothing else is said, or else the density that is given."""
    usual = type(of)()
    same = (of.youngs_modulus_GPa, of.poisson_ratio, of.density_kgm3) == (
        usual.youngs_modulus_GPa,
        usual.poisson_ratio,
        usual.density_kgm3,
    )
    return "steel" if same else f"{of.density_kgm3:g} kg/m³"


def _rounded(mass: float) -> str:
    """Four digits, and no exponent."""
    return number(float(f"{mass:.4g}"), 9)
