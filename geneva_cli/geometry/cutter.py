"""Places along an outline that a round milling cutter cannot reach.

A cutter reaches all of an outline if the offset by its radius keeps that distance.
"""

from __future__ import annotations

import math

from geneva_cli.geometry.measure import at, directions
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.offsets import Closed, lines_and_arcs, offset
from geneva_cli.geometry.pieces import prepared
from geneva_cli.geometry.plates import Plate, plates
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line, Point
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.numerics.preferred import to_digits
from geneva_cli.numerics.roots import boundary
from geneva_cli.numerics.tolerances import SAME_CUT_MM
from geneva_cli.spec.rules import TOOL_MM, require_mm


def judged(drawing: Drawing, cutter_mm: float) -> tuple[str, list[str]]:
    """Return places that a cutter does not enter, "" if none, and notes on what else it leaves.

    Raises GenevaError for a diameter outside of TOOL_MM, and for outlines with cubics.
    """
    require_mm("--cutter", cutter_mm, TOOL_MM)
    stops, notes = list[str](), list[str]()
    for plate in dict.fromkeys(plates(drawing.solid)) if drawing.solid else ():
        _judge_plate(plate, 0.5 * cutter_mm, stops, notes)
    refused = f"--cutter {cutter_mm:g}: {'; '.join(stops)}" if stops else ""
    return refused, [f"--cutter {cutter_mm:g}: {text}" for text in notes]


def _judge_plate(plate: Plate, radius: float, stops: list[str], notes: list[str]) -> None:
    """Add narrow places, at most one per outline, and else round corners and narrow holes."""
    for i, original in enumerate((plate.outline, *plate.holes)):
        if isinstance(original, Circle):
            if i and original.radius < radius - SAME_CUT_MM:
                x, y = original.centre
                size = f"hole of {2.0 * original.radius:.6g} mm at x = {x:.6g}, y = {y:.6g}"
                notes.append(f"{size} in {plate.name}: narrower than the cutter; drill it")
            continue
        (cleaned,) = prepared(Drawing("", (original,))).shapes
        assert isinstance(cleaned, Contour)
        _pieces(cleaned)
        shape, outside = with_material_left(cleaned, i == 0), i == 0
        place = _blocked(shape, outside, radius)
        if place:
            # a micrometre's last digit moves with rounding; six decimals in mm are steady
            (x, y), hollow = (round(v, 6) + 0.0 for v in place[0]), place[1]
            what = f"an inner radius of {hollow:.5g} mm" if hollow else "a gap"
            most = 2.0 * _widest(shape, outside, radius)
            instead = f"use a cutter up to {most:.6g} mm" if most else "no cutter is small enough"
            stops.append(
                f"it does not enter {plate.name}, layer {shape.layer}, at x = {x:.5g}, "
                f"y = {y:.5g}: {what} is narrower; {instead}"
            )
            continue
        own = _pieces(shape)
        for k, piece in enumerate(own):
            after = own[(k + 1) % len(own)]
            turn = -math.remainder(directions(after)[0] - directions(piece)[1], math.tau)
            # less than 1e-4 mm of material is no corner
            if 0.0 < turn < math.pi and radius * (1.0 / math.cos(0.5 * turn) - 1.0) > 1e-4:
                x, y = piece.end
                notes.append(
                    f"it leaves a radius of {radius:.6g} mm in the corner of {plate.name}, layer "
                    f"{shape.layer}, at x = {x:.5g}, y = {y:.5g}"
                )


def _blocked(contour: Contour, outside: bool, radius: float) -> tuple[Point, float] | None:
    """Return a place that a cutter cannot reach, and the radius of a hollow arc there, or 0."""
    hollow = [p for p in _pieces(contour) if isinstance(p, Arc) and p.bulge < 0.0]
    tightest = min(hollow, key=lambda arc: arc.radius, default=None)
    if tightest and tightest.radius < radius - 0.5 * SAME_CUT_MM:
        return at(tightest, 0.5), tightest.radius
    try:
        # of an arc that just fits, half of SAME_CUT_MM is left
        offset(contour, outside, radius - SAME_CUT_MM)
    except Closed as error:
        return error.at, 0.0
    return None


def _widest(contour: Contour, outside: bool, radius: float) -> float:
    """Return the largest cutter that enters, as a radius to about three digits; 0 for none."""
    # 14 halvings give more than the three digits that are shown
    largest = boundary(lambda r: _blocked(contour, outside, r) is None, 0.0, radius, 14)
    if not largest:
        return 0.0
    near, below = (0.5 * to_digits(2.0 * largest, 3, way) for way in (round, math.floor))
    return near if _blocked(contour, outside, near) is None else below


def _pieces(contour: Contour) -> list[Line | Arc]:
    return lines_and_arcs(contour, "--cutter works on lines and arcs only: use --curves arcs")
