"""Plates for a shop: a fit coupon, all parts side by side on one bed, and each part by itself."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

from geneva_cli.drawings.sheet.composed import packed_apart
from geneva_cli.drawings.sheet.view import Block
from geneva_cli.geometry.measure import bounds_of
from geneva_cli.geometry.plates import Group, Member, Plate, Shell, Solid, lowered, solids
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Point, closed, polygon
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.parts import EdgedParts, Parts
from geneva_cli.parts.projection import Missing, alike, built_of, outlines_of, titled

# mm per side: the first suit a mill, the last a laser or a printer
CLEARANCES = (0.0, 0.02, 0.04, 0.06, 0.1, 0.15, 0.2, 0.3)
WALL, LEAST = 0.6, 2.0  # of material between holes: of the roller's radius, and at least in mm
WIDE, NEXT, DOT = 0.5, 0.75, 0.3  # of a number's height: a digit, pitch of digits, of a point
# strokes by the corners that they join: (0, 0) is the lower left one, (1, 2) the upper right
STROKES = {
    "a": ((0, 2), (1, 2)),
    "b": ((1, 2), (1, 1)),
    "c": ((1, 1), (1, 0)),
    "d": ((0, 0), (1, 0)),
    "e": ((0, 1), (0, 0)),
    "f": ((0, 2), (0, 1)),
    "g": ((0, 1), (1, 1)),
}
DIGITS = {
    **{"0": "abcdef", "1": "bc", "2": "abged", "3": "abgcd", "4": "fgbc"},
    **{"5": "afgcd", "6": "afgedc", "7": "abc", "8": "abcdefg", "9": "abcdfg"},
}


def coupon(parts: FlatParts) -> Drawing:
    """Return the coupon, its lower left corner the origin, with the roller's disc to its right."""
    sizes = parts.outlines.sizes
    own = sizes.half_width - sizes.roller
    r, pin = sizes.roller, sizes.pin
    clearances = _around(CLEARANCES, own)
    # mm by which a hole's diameter is below the pin's
    interferences = (0.0, 0.01, 0.02, 0.03, 0.05, 0.08, 0.1, 0.15)
    press_fit = parts.mechanism.spec.size.allowances.press_fit_mm
    presses = [press for press in _around(interferences, press_fit) if press < 2.0 * pin]
    wall, height = max(WALL * r, LEAST), 0.6 * r  # height of the numbers
    widest = r + clearances[-1]
    each = 2.0 * widest + wall
    holes: list[Contour | Circle] = []
    marks: list[Contour] = []
    up = wall
    if presses:
        for i, press in enumerate(presses):
            x = wall + widest + i * each
            marks += number(f"{press:g}", x, up, height)
            holes.append(Circle("BORE", (x, up + height + wall + pin), pin - 0.5 * press))
        up += height + 2.0 * (wall + pin)
    for i, clearance in enumerate(clearances):
        x = wall + widest + i * each
        marks += number(f"{clearance:g}", x, up, height)
        holes.append(_slot((x, up + height + wall + widest), r + clearance, 2.0 * r))
    width = wall + len(clearances) * each
    top = up + height + 2.0 * (wall + widest + r)
    corners = [(0.0, 0.0), (width, 0.0), (width, top), (0.0, top)]
    outline = polygon("COUPON", corners)
    centre = width + 10.0 + r, 0.5 * top  # 10 mm from the plate: wider than any cut
    disc = Circle("ROLLER", centre, r)
    bore = (Circle("BORE", centre, pin),) if pin else ()
    thick = sizes.wheel_thickness
    solid = Group(
        "fit coupon",
        (
            Member(Plate("coupon", "COUPON", outline, tuple(holes), 0.0, thick)),
            Member(Plate("roller", "ROLLER", disc, bore, 0.0, thick)),
        ),
    )
    title = titled(parts.mechanism, "fit coupon")
    return Drawing(title, (outline, *holes, disc, *bore, *marks), solid=solid)


def _around(usual: tuple[float, ...], own: float) -> list[float]:
    """Return usual steps and the spec's own, to a micrometre; beyond the usual also steps about it.

    >>> _around((0.0, 0.3), 0.02), _around((0.0, 0.3), 0.4)
    ([0.0, 0.02, 0.3], [0.0, 0.3, 0.4, 0.5])
    """
    about = (0.75, 1.25) if own > usual[-1] else ()
    return sorted({*usual, round(own, 3), *(round(own * part, 2) for part in about)})


def _slot(low: Point, half: float, length: float) -> Contour:
    (x, y), top = low, low[1] + length
    return closed(
        "COUPON",
        [
            Line((x + half, y), (x + half, top)),
            Arc((x + half, top), (x - half, top), 1.0),
            Line((x - half, top), (x - half, y)),
            Arc((x - half, y), (x + half, y), 1.0),
        ],
    )


def number(text: str, x: float, y: float, height: float) -> Iterator[Contour]:
    """Yield the strokes of a number above a level y, with its middle at x.

    >>> len(list(number("0.1", 0.0, 0.0, 1.0)))  # six strokes, a point and two
    9
    """
    long = sum(DOT if c == "." else NEXT for c in text) - (NEXT - WIDE)
    left = x - 0.5 * long * height
    for c in text:
        if c == ".":
            at = left - 0.5 * (NEXT - WIDE - DOT) * height
            yield _stroke((at - 0.05 * height, y), (at + 0.05 * height, y))
            left += DOT * height
            continue
        for stroke in DIGITS[c]:
            ends = STROKES[stroke]
            a, b = ((left + i * WIDE * height, y + 0.5 * j * height) for i, j in ends)
            yield _stroke(a, b)
        left += NEXT * height


def _stroke(a: Point, b: Point) -> Contour:
    return Contour("ENGRAVE", (Line(a, b),), closed=False)


APART = 5.0  # mm between parts, and round them


def plate(parts: EdgedParts) -> Drawing:
    """Return all parts, each as often as the machine has it, in front of and right of the origin.

    Raises GenevaError for a part that cannot be built.
    """
    every = (one for _, build in parts.turned.by_name() for part in build() for one in solids(part))
    whole = [one for one in every if not isinstance(one, Shell)]
    title = titled(parts.mechanism, "plate")
    solid = Group(title, tuple(_laid(whole)))
    return Drawing(title, outlines_of(solid), solid=solid)


def _laid(whole: list[Plate]) -> list[Member]:
    """Return parts at z = 0 side by side, on a square bed that is as small as they allow."""
    blocks = [Block(*bounds_of(outlines_of(one)), (), ()) for one in whole]
    side = math.sqrt(sum((b.width + APART) * (b.height + APART) for b in blocks))
    placed = None
    while placed is None:
        area = (0.0, 0.0, side, side)
        placed = packed_apart(blocks, (), area, lambda b: -b.width * b.height, APART)
        # the bed grows by a tenth until all parts fit
        side *= 1.1
    return [
        Member(lowered(one), (block.x0 - before.x0, block.y0 - before.y0))
        for one, before, block in zip(whole, blocks, placed, strict=True)
    ]


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
    missing = list[Missing]()
    built = (build().within(tolerance_mm, curves) for _, build in parts.all_built)
    every = [part for one in built for part in built_of(one.by_name(), missing)]
    return [_single(parts, kind[0], len(kind), tolerance_mm) for kind in alike(every)], missing


def _single(parts: Parts, solid: Solid, count: int, tolerance_mm: float) -> SinglePart:
    title = titled(parts.mechanism, solid.name)
    shapes = () if isinstance(solid, Shell) else outlines_of(solid)
    thickness = solid.outer - solid.inner if isinstance(solid, Shell) else solid.thickness
    drawing = Drawing(title, shapes, solid=solid, tolerance=tolerance_mm)
    cut = isinstance(solid, Plate) and is_cut(solid)
    return SinglePart(solid.name, count, thickness, cut, drawing)


def is_cut(plate: Plate) -> bool:
    """Return True for a part that is cut out of a plate; others are turned or bought."""
    return plate.layer in ("WHEEL", "CRANK", "ARM", "LINK", "GROOVE", "FRAME")
