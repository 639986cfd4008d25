"""Dimensions of bores with keyways, and of bolts on their circles, in the sheet's views."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.view import View, times
from geneva_cli.geometry.measure import at
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import ORIGIN, Circle, Contour, Point, Shape
from geneva_cli.geometry.sheet import CENTRE
from geneva_cli.parts.outlines.wheel_hub import about_axis
from geneva_cli.parts.shafts.bores import Bore, bore_in, radius_of
from geneva_cli.spec.tables import Size
from geneva_cli.spec.written import length, number


class Holes(NamedTuple):
    """The round holes of plates on one axis: bores about it, and others, such as bolts."""

    bores: tuple[Shape, ...]
    bolts: tuple[Circle, ...]


def holes_of(plates: Iterable[Plate]) -> Holes:
    """Return the bores and bolts of plates that lie on each other, each once."""
    holes = [hole for plate in plates for hole in plate.holes if hole.layer == "BORE"]
    bores = dict.fromkeys(about_axis(holes))
    bolts = (hole for hole in holes if isinstance(hole, Circle) and hole not in bores)
    return Holes(tuple(bores), tuple(dict.fromkeys(bolts)))


def bored(view: View, bores: Sequence[Shape], size: Size, part: str, axis: Point = ORIGIN) -> None:
    """Draw the diameter of a part's bore, and what else its shape needs; a remark has its angle.

    The bores are about the part's own origin, which is drawn at ``axis``.
    """
    for shape in bores[:1]:
        form: Bore = Bore(radius_of(shape))
        if isinstance(shape, Contour):
            form = bore_in(size, part, shape).cut
        if form.is_round:
            view.diameter([Circle("", axis, form.radius)], sized.bore(view.fits, form.radius))
        if isinstance(shape, Contour):
            x, y = at(shape.segments[0], 0.5)
            turn = math.degrees(math.atan2(y, x))
            note = form.note if view.fits.is_iso else form.note.replace(" JS9", "")
            view.note((x + axis[0], y + axis[1]), note)
            what = note.split()[0].rstrip(",")
            view.remark(f"{what} at {number(turn, 2)}°, counterclockwise from the right")


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
