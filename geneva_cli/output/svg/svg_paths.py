"""Shapes as elements of an SVG, in plain coordinates.

y points up in a drawing, and down in SVG. Coordinates are negated rather than transformed, since
programs of cutting machines ignore transforms.
"""

from __future__ import annotations

from geneva_cli.geometry.measure import halved
from geneva_cli.geometry.shapes import Circle, Contour, Cubic, Line, Point, Segment, Shape


def element(shape: Shape) -> str:
    """The element of a circle or a contour."""
    if isinstance(shape, Circle):
        (x, y), r = shape.centre, shape.radius
        return f'<circle cx="{number(x)}" cy="{number(-y)}" r="{number(r)}"/>\n'
    return f'<path d="{path(shape)}"/>\n'


def path(contour: Contour) -> str:
    """A contour as the data of a path."""
    segments = contour.segments
    words = [f"M {point(segments[0].start)}"]
    if contour.closed and isinstance(segments[-1], Line):
        segments = segments[:-1]  # Z draws the last line; drawn here it would have no length there
    # Bulges of 150, 210 and 300 degrees. Near a half turn the radius determines the centre badly,
    # near a whole turn the chord does.
    split = [halved(one, lambda bulge: 0.7673 < bulge < 1.3032 or bulge > 3.7) for one in segments]
    words += [_command(part) for parts in split for part in parts]
    return " ".join(words) + (" Z" if contour.closed else "")


def _command(segment: Segment) -> str:
    if isinstance(segment, Line):
        return f"L {point(segment.end)}"
    if isinstance(segment, Cubic):
        return "C " + " ".join(map(point, segment[1:]))
    radius, large, down = number(segment.radius), abs(segment.bulge) > 1.0, segment.bulge < 0.0
    return f"A {radius},{radius} 0 {large:d} {down:d} {point(segment.end)}"


def place(p: Point) -> str:
    """A point as two attributes."""
    return f'x="{number(p[0])}" y="{number(-p[1])}"'


def point(p: Point) -> str:
    """A point in a path."""
    return f"{number(p[0])},{number(-p[1])}"


def number(value: float) -> str:
    """A number with fixed decimals, without an exponent or a negative zero."""
    text = f"{value:.9f}"
    return text if text.strip("-0.") else text.lstrip("-")
