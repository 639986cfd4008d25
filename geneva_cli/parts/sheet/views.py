"""All views of a machine's sheet."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

from geneva_cli.curves.measure import bounds
from geneva_cli.curves.plates import Group, Member, Plate, plates
from geneva_cli.curves.shapes import Shape
from geneva_cli.parts import drawings
from geneva_cli.parts.built import Built
from geneva_cli.parts.first_pair import first_outlines
from geneva_cli.parts.gear_curves import required_gears
from geneva_cli.parts.gear_drawings import gear_shapes
from geneva_cli.parts.machine_drawing import machine_and_parts
from geneva_cli.parts.outlines import Outlines
from geneva_cli.parts.parts_list import plate_rows
from geneva_cli.parts.proof import Proof
from geneva_cli.parts.sheet import links, wheel
from geneva_cli.parts.sheet.crank import draw_arm, draw_assembly, draw_disc, draw_roller
from geneva_cli.parts.sheet.paper import scale_name
from geneva_cli.parts.sheet.standing import draw_frame, draw_groove, draw_shaft
from geneva_cli.parts.sheet.view import View, number

HUB = "crank's hub"  # stands on the disc
APART = {"WHEEL", "ARM"}  # layers of which each plate has a view


class Shown(NamedTuple):
    """What goes on a sheet, whatever its scale."""

    found: Outlines
    together: tuple[Shape, ...]
    rows: list[dict[str, Any]]  # the list of parts
    parts: Built
    first: Outlines | None
    groove: tuple[Shape, ...]  # flanks and pitch curve, of a cam
    gears: list[Shape]  # pitch curves and bores, of noncircular ones
    largest: float  # mm: a part's width or height
    area: float  # mm², of boxes about some of the parts: the views need more
    tolerance: float
    curves: str


def shown_on_sheet(found: Outlines, tolerance: float, curves: str) -> Shown:
    """What the views show, worked out once for all scales."""
    given, cam = found.assembly.given, found.assembly.rollers[0][0].groove is not None
    whole, parts = machine_and_parts(found, tolerance, curves)
    assert isinstance(whole.solid, Group)
    rows: list[dict[str, Any]] = list(plate_rows(given.spec, whole.solid))
    sizes = [row[f"size_{axis}_mm"] for row in rows for axis in "xy"]
    *_, lowest = _plates(parts.standing)
    apart = [bounds(plate.outline) for plate in plates(whole.solid) if plate.layer in APART]
    boxes = [*apart, bounds(lowest.outline)]
    return Shown(
        found,
        whole.shapes,
        rows,
        parts,
        first_outlines(given, parts.links),
        drawings.groove(found, tolerance, curves).shapes if cam else (),
        gear_shapes(Proof(given, found), tolerance, curves),
        max(sizes),
        sum((box.x1 - box.x0) * (box.y1 - box.y0) for box in boxes),
        tolerance,
        curves,
    )


def _plates(members: Iterable[Member]) -> list[Plate]:
    return [one.part for one in members if isinstance(one.part, Plate)]


def views(shown: Shown, scale: float) -> Iterator[View]:
    """A view of each part."""
    yield from _wheels(shown, scale)
    yield from _crank(shown, scale)
    yield from _links(shown, scale)
    yield from _standing(shown, scale)


def _wheels(shown: Shown, scale: float) -> Iterator[View]:
    """Wheels and locking discs, of two in series both."""
    for front, of in (("", shown.found), ("first ", shown.first)):
        if of is None:
            continue
        made = _view(shown, scale, f"{front}wheel", f"{front}wheel's hub")
        wheel.draw_wheel(made, of, shown.tolerance, shown.curves)
        yield made
        if of.crank:
            made = _view(
                shown,
                scale,
                *(f"{front}{name}" for name in ("locking disc", "locking sector", HUB)),
            )
            draw_disc(made, of)
            yield made


def _crank(shown: Shown, scale: float) -> Iterator[View]:
    """The arm, and the roller with its pin."""
    if shown.parts.arm:
        made = _view(shown, scale, "arm")
        draw_arm(made, shown.found, shown.parts.arm)
        yield made
    made = _view(shown, scale, "roller", "pin")
    draw_roller(made, shown.found)
    yield made


def _links(shown: Shown, scale: float) -> Iterator[View]:
    """Links, and gears by their pitch curves."""
    bars, given = shown.parts.links, shown.found.assembly.given
    for one in {member.part: member for member in bars.cut}.values():
        made = _view(shown, scale, one.part.name)
        links.draw_link(made, one, bars, given)
        yield made
    for gear in () if shown.first else bars.gears:
        made = _view(shown, scale, gear.name)
        links.draw_gear(made, gear)
        yield made
    if shown.gears:
        L, C = given.center_distance_mm, required_gears(given).distance_mm
        made = View("gears", scale)
        links.draw_gears(made, shown.gears, ((L, 0.0), (L + C, 0.0)))
        yield made


def _standing(shown: Shown, scale: float) -> Iterator[View]:
    """Shafts, and the plates that stand."""
    for plate in _plates(shown.parts.shafts):
        made = _view(shown, scale, plate.name, thick=False)
        draw_shaft(made, plate)
        yield made
    *grooved, lowest = _plates(shown.parts.standing)
    if shown.groove:
        made = _view(shown, scale, *(plate.name for plate in grooved), "groove")
        draw_groove(
            made, shown.groove, shown.found.sizes.half_width, grooved[0] if grooved else None
        )
        yield made
    made = _view(shown, scale, lowest.name)
    draw_frame(made, lowest)
    yield made


def _view(shown: Shown, scale: float, *names: str, thick: bool = True) -> View:
    """An empty view, under the names of some parts with their numbers in the list."""
    titles = [
        f"{i} {row['name']}" + f", t = {number(row['thickness_mm'])}" * thick
        for i, row in enumerate(shown.rows, 1)
        if row["name"] in names
    ]
    return View("; ".join(titles) or names[0], scale)


def together(shown: Shown, scale: float) -> View:
    """The machine put together."""
    made = View(f"together ({scale_name(scale)})", scale)
    draw_assembly(made, shown.found, shown.together)
    return made
