"""Dimensions of bores with keyways, and of bolts on their circles, in the sheet's views."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from geneva_cli.curves.measure import at
from geneva_cli.curves.plates import Plate
from geneva_cli.curves.shapes import Circle, Contour, Shape
from geneva_cli.curves.sheet import CENTRE
from geneva_cli.drawings.sheet import sized
from geneva_cli.drawings.sheet.view import View, number, times
from geneva_cli.layout.keyways import key
from geneva_cli.outlines.wheel_hub import about_axis


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


def bored(view: View, bores: Sequence[Shape], radius: float, standard: str | None) -> None:
    """Draw a bore's diameter, and its keyway's size by a standard; a remark has its direction."""
    if not bores:
        return
    view.diameter([Circle("", (0.0, 0.0), radius)], sized.bore(view.fits, radius))
    if isinstance(bores[0], Contour):
        fitted = key(standard, radius)
        assert fitted is not None  # otherwise the bore would be a circle
        middle = at(bores[0].segments[3], 0.5)
        turn = math.degrees(math.atan2(middle[1], middle[0]))
        fit = " JS9" if view.fits.is_iso else ""
        text = f"keyway {fitted.width:g}{fit}, {number(2.0 * radius + fitted.in_hub)} over bore"
        view.note(middle, f"{text} ({standard})")
        view.remark(f"keyway at {number(turn, 2)}°, counterclockwise from the right")


def radius_of(bore: Shape) -> float:
    """Return a bore's radius, without its keyway."""
    if isinstance(bore, Circle):
        return bore.radius
    return math.hypot(*bore.segments[0].start)


def circle_of(view: View, screwed: Sequence[Circle]) -> None:
    """Draw the circles that bolts lie on, as centre lines."""
    for far in {round(math.hypot(*c.centre), 6) for c in screwed}:
        view.draw(Circle("", (0.0, 0.0), far), CENTRE)


def bolted(view: View, screwed: Sequence[Circle]) -> None:
    """Draw the diameters of the bolts' holes and of their circle."""
    if not screwed:
        return
    far = math.hypot(*screwed[0].centre)
    hole = sized.bore(view.fits, screwed[0].radius)
    view.diameter(screwed, times(len(screwed), f"{hole} on Ø {number(2.0 * far)}"))
    angles = [math.degrees(math.atan2(c.centre[1], c.centre[0])) for c in screwed]
    view.notes.append("holes at " + ", ".join(f"{number(angle, 2)}°" for angle in angles))
