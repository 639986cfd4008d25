"""The views of frame, hubs and shafts, and dimensions of bores and bolts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.view import View, grouped, times
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Arc, Circle, Contour, Shape, at, bounds, polygon
from geneva_cli.geometry.sheet import CENTRE, OUTLINE
from geneva_cli.numerics.tolerances import SAME_ON_SHEET
from geneva_cli.parts.parts import mounts_of
from geneva_cli.parts.shafts.bores import Bore, around, bore_of, radius_of, section_note
from geneva_cli.spec.tables import Size
from geneva_cli.spec.written import length, number


def draw_frame(
    view: View, plate: Plate, screws: Mapping[Circle, str], axis_name: str = "the wheel's axis"
) -> View:
    """Draw the frame: its size, and diameter and position of each hole from the axis.

    ``screws`` has the texts of holes for screws, without those for mounting.
    """
    view.draw_all((plate.outline, *plate.holes))
    holes = [hole for hole in plate.holes if isinstance(hole, Circle)]
    # the axis may have no hole
    first = [(ORIGIN, holes[0].radius)] if holes else []
    for centre, radius in dict([*first, *((h.centre, h.radius) for h in holes)]).items():
        view.cross(centre, radius)
    box = bounds(plate.outline)
    up = 0.5 * math.pi
    where = f"from {axis_name} to a hole"
    view.places((hole.centre for hole in holes), ORIGIN, (f"across, {where}", f"up, {where}"))
    corner = (box.x0, box.y0)
    if holes:
        to_left, to_low = length(-box.x0), length(-box.y0)
        view.linear(corner, ORIGIN, 0.0, to_left, f"from the left edge to {axis_name}")
        view.linear(corner, ORIGIN, up, to_low, f"from the lower edge to {axis_name}")
    view.linear(corner, (box.x1, box.y0), 0.0, length(box.x1 - box.x0), "wide")
    view.linear(corner, (box.x0, box.y1), up, length(box.y1 - box.y0), "high")
    texts_of = {hole: sized.bore(view.fits, hole.radius) for hole in holes}
    texts_of |= {hole: sized.screw_hole(hole.radius) for hole in mounts_of(plate)}
    texts_of |= screws
    for text, some in grouped((texts_of[hole], hole) for hole in holes):
        places = ", ".join(f"({length(x)}, {length(y)})" for _, (x, y), _ in some)
        view.diameter(some, text, f"at {places} from {axis_name}")
    assert isinstance(plate.outline, Contour)
    arcs = [piece for piece in plate.outline.segments if isinstance(piece, Arc)]
    if arcs:  # of one radius but for rounding, which may show in the last decimal
        view.of_arcs(arcs, times(len(arcs), sized.plain(arcs[0].radius, "R ")))
    return view


def draw_hub(view: View, hub: Plate) -> None:
    """Draw the diameter of a hub that is already drawn."""
    radius = around(hub.outline)
    whole = Circle(hub.layer, ORIGIN, radius)
    view.diameter([whole], f"{hub.name} {sized.plain(2.0 * radius, 'Ø ')}")


def draw_shaft(view: View, shaft: Plate) -> View:
    """Draw a shaft from the side; a hexagon has no fit, as its corners are free."""
    long, radius = shaft.thickness, around(shaft.outline)
    corners = [(0.0, -radius), (long, -radius), (long, radius), (0.0, radius)]
    view.draw(polygon("", corners), OUTLINE)
    view.centre_line((0.0, 0.0), (long, 0.0))
    view.linear((0.0, -radius), (long, -radius), 0.0, length(long))
    has_corners = radius > radius_of(shaft.outline) + SAME_ON_SHEET
    size = sized.plain(2.0 * radius, "Ø ") if has_corners else sized.shaft(view.fits, radius)
    view.linear((0.0, -radius), (0.0, radius), 0.5 * math.pi, size)
    note = section_note(shaft.outline)
    if note:
        view.notes.append(note if view.fits.turned.is_iso else note.replace(" P9", ""))
    return view


def holes_of(plates: Iterable[Plate]) -> tuple[list[Shape], list[Circle]]:
    """Return the bores of plates on one axis, and their other round holes, such as bolts."""
    bores, bolts = dict[Shape, None](), dict[Circle, None]()
    for hole in (hole for plate in plates for hole in plate.holes if hole.layer == "BORE"):
        if isinstance(hole, Circle) and math.hypot(*hole.centre) != 0.0:
            bolts[hole] = None
        else:
            bores[hole] = None
    return list(bores), list(bolts)


def bored(view: View, bores: Sequence[Shape], size: Size, part: str) -> None:
    """Draw the diameter of a part's bore, and what else its shape needs; a note has its angle."""
    if not bores:
        return
    shape = bores[0]
    form = Bore(radius_of(shape))
    if isinstance(shape, Contour):
        # without the rounding errors of the sum, which would choose another key
        form = bore_of(size, part, round(form.radius - 0.5 * size.allowances.shaft_fit_mm, 9))
    if form.form != "hex":
        cut = form.radius + form.loose
        view.diameter([Circle("", ORIGIN, cut)], sized.bore(view.fits, cut))
    if isinstance(shape, Contour):
        x, y = at(shape.segments[0], 0.5)
        note = form.note if view.fits.is_iso else form.note.replace(" JS9", "")
        view.note((x, y), note)
        turn, what = math.degrees(math.atan2(y, x)), note.split()[0].rstrip(",")
        view.notes.append(f"{what} at {number(turn, 2)}°, counterclockwise from the right")


def circle_of(view: View, screwed: Sequence[Circle]) -> None:
    """Draw the circles that bolts lie on, as centre lines."""
    for far in {round(math.hypot(*c.centre), 6) for c in screwed}:
        view.draw(Circle("", (0.0, 0.0), far), CENTRE)


def bolted(view: View, screwed: Sequence[Circle], tapped: bool = False) -> None:
    """Draw the diameters of the bolts' holes and of their circle."""
    if not screwed:
        return
    far = math.hypot(*screwed[0].centre)
    hole = sized.screw_hole(screwed[0].radius, tapped)
    view.diameter(screwed, times(len(screwed), f"{hole} on Ø {length(2.0 * far)}"))
    angles = [math.degrees(math.atan2(c.centre[1], c.centre[0])) for c in screwed]
    view.notes.append("holes at " + ", ".join(f"{number(angle, 2)}°" for angle in angles))
