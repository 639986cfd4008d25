"""A fit coupon: the roller's slot in steps of clearance, and the pin's hole in steps of press fit.

Cut it from the wheel's plate on the machine that will cut the wheel; the roller's disc lies next to
it. It shows by hand which ``slot_clearance_mm`` runs and which ``press_fit_mm`` holds. The numbers
are lines on a layer to engrave, of seven strokes as on a digital clock.
"""

from __future__ import annotations

from collections.abc import Iterator

from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.plates import Group, Member, Plate
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Point, closed, polygon
from geneva_cli.parts.flat_parts import FlatParts
from geneva_cli.parts.projection import titled

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
    """Return an upright slot of half a width, from the centre of its lower end."""
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
