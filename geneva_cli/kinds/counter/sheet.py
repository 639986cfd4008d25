"""The drawing sheet of a counter: dimensioned gears, section, list of items, title block."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.bores import bored, holes_of
from geneva_cli.drawings.sheet.content import (
    SheetContent,
    Views,
    mark_items,
    sheet_of,
    shown_on_sheet,
)
from geneva_cli.drawings.sheet.gears import draw_teeth
from geneva_cli.drawings.sheet.linked import flat_plates, shafted, titled
from geneva_cli.drawings.sheet.paper import scale_name
from geneva_cli.drawings.sheet.standing import draw_frame
from geneva_cli.drawings.sheet.view import View
from geneva_cli.geometry.plates import Member, plates
from geneva_cli.geometry.shapes import Circle
from geneva_cli.geometry.sheet import HIDDEN, OUTLINE, Sheet
from geneva_cli.kinds.counter.drawings import assembly
from geneva_cli.kinds.counter.parts import CounterParts
from geneva_cli.parts.written import length


def sheet(parts: CounterParts) -> Sheet:
    """Return the drawing sheet of a counter. Raises GenevaError where no scale fits on one."""
    spec = parts.mechanism.spec
    shown = shown_on_sheet(spec, parts.members, assembly(parts).shapes)
    views = Views(
        partial(_views, shown, parts), partial(_together, shown, parts), (0.0, parts.sizes.distance)
    )
    return sheet_of(spec, shown, views)


def _views(shown: SheetContent, parts: CounterParts, scale: float) -> Iterator[View]:
    """Yield a view of each part; a number wheel between two pinions has that of the driver too."""
    begin = titled(shown.rows, scale, parts)
    alone = "wheel" if len(parts.pinions) == 1 else ""
    for gear, member, fixed in (
        ("pinion", parts.pinions[-1], alone),
        ("driver", parts.driver, "crank"),
        ("number wheel", parts.number_wheels[0], ""),
    ):
        view = begin(*dict.fromkeys(plate.name for plate in plates(member.part)))
        _draw(view, parts, gear, member, fixed)
        yield view
    if len(parts.number_wheels) > 1:
        view = begin("number wheel's two teeth", "number wheel's rim")
        *_, two, rim = plates(parts.number_wheels[-1].part)
        view.draw_plate(two)
        view.draw_plate(rim)
        view.remark("teeth and rim as the driver's, with the number wheel's bore")
        yield view
    yield from shafted(begin, parts.shafts)
    for plate in flat_plates([parts.frame]):
        view = begin(plate.name)
        draw_frame(view, plate, (0.0, 0.0), "the pinions' axis")
        yield view


def _draw(view: View, parts: CounterParts, gear: str, member: Member, fixed: str) -> None:
    """Draw a gear's outlines, its teeth's circles and its bore; of the driver also the rim.

    ``fixed`` is the part of the spec that is fixed to its shaft; others turn on it.
    """
    own = plates(member.part)
    view.draw_all(dict.fromkeys(one for plate in own for one in (plate.outline, *plate.holes)))
    toothed = parts.mesh.gears[gear]
    view.cross((0.0, 0.0), toothed.teeth.tip)
    draw_teeth(view, toothed)
    bores = holes_of(own).bores
    if fixed:
        bored(view, bores, parts.mechanism.spec.size, fixed)
    else:
        circle = next(one for one in bores if isinstance(one, Circle))
        view.diameter([circle], sized.roller_bore(view.fits, parts.mechanism, circle.radius))
    if gear == "driver":
        rim = Circle("", (0.0, 0.0), parts.sizes.rim)
        view.diameter([rim], f"rim {sized.lock(view.fits, parts.mechanism, rim.radius)}")
    if gear == "pinion":
        wide = own[-1]
        view.remark(f"every second tooth is wide: {length(wide.high - own[0].low)}")


def _together(shown: SheetContent, parts: CounterParts, scale: float) -> View:
    """Return the view of the assembled counter, with the distance of its axes."""
    view = View(f"assembly ({scale_name(scale)})", scale)
    for shape in shown.together:
        view.draw(shape, HIDDEN if shape.layer == "FRAME" else OUTLINE)
    view.cross((0.0, 0.0), parts.sizes.pinion.tip)
    view.cross(parts.axis, parts.sizes.rim)
    view.linear((0.0, 0.0), parts.axis, 0.0, sized.plain(parts.sizes.distance, "L = "))
    mark_items(view, shown)
    return view
