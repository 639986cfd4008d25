"""Cutters: against closed forms, and against shapely's opening of what is to be cut away."""

import math

import pytest
import repo
from drawing_witness import polygon

from geneva_cli.design import load
from geneva_cli.geometry.offsets import judged
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.shapes import Circle, Line, about, closed
from geneva_cli.geometry.sheet import Drawing


def notched(angle):
    """A block with a notch of straight walls, each corner in it at an angle in degrees."""
    lean = 8.0 / math.tan(math.radians(180.0 - angle)) if angle != 90.0 else 0.0
    points = [(0, 0), (40, 0), (40, 20), (30 + lean, 20), (30, 12), (10, 12), (10 - lean, 20)]
    points = [(float(x), float(y)) for x, y in [*points, (0, 20)]]
    sides = [Line(p, q) for p, q in zip(points, [*points[1:], points[0]], strict=True)]
    return Plate("block", "ARM", closed("ARM", sides), (), 0.0, 1.0)


def keyed(width, depth=3.0, bore=6.0):
    """A washer with a keyway in its bore."""
    y, x = 0.5 * width, bore + depth
    edge = math.sqrt(bore * bore - y * y)
    half = math.asin(y / bore)
    hole = closed(
        "BORE",
        [
            about((0.0, 0.0), bore, half, math.tau - 2.0 * half),
            Line((edge, -y), (x, -y)),
            Line((x, -y), (x, y)),
            Line((x, y), (edge, y)),
        ],
    )
    return Plate("washer", "ARM", Circle("ARM", (0.0, 0.0), 15.0), (hole,), 0.0, 1.0)


def missed(plate, radius):
    """The area to be cut away that no cutter covers, mm²: shapely's opening of the free space."""
    outline = polygon(plate.outline)
    around = outline.buffer(9.0, 512)  # round: no corner of it is to be cut
    holes = [polygon(hole) for hole in plate.holes if not isinstance(hole, Circle)]
    return sum(
        space.difference(space.buffer(-radius, 64).buffer(radius, 64)).area
        for space in (around.difference(outline), *holes)
    )


@pytest.mark.parametrize(
    ("plate", "cutter", "corners"),
    [
        (notched(90.0), 2.0, 2),
        (notched(120.0), 4.0, 2),
        (keyed(4.0), 2.0, 2),
        (keyed(8.0), 2e-4, 0),
    ],
)
def test_corners_that_stay_round_are_named(plate, cutter, corners):
    refused, left = judged(Drawing("", (), solid=plate), cutter)
    assert not refused
    assert len([text for text in left if "leaves a radius of" in text]) == corners
    if corners:
        assert missed(plate, 0.5 * cutter) > 0.1


@pytest.mark.parametrize(("width", "cutter"), [(4.0, 4.2), (8.0, 8.5)])
def test_a_keyway_narrower_than_the_cutter_is_refused(width, cutter):
    refused, _ = judged(Drawing("", (), solid=keyed(width)), cutter)
    assert refused.endswith(f"a gap is narrower; use a cutter up to {width:g} mm")


@pytest.mark.long
def test_the_verdict_on_a_part():
    design = load(str(repo.DESIGNS / "two-pins-z4.toml"))
    refused, left = design.cutter("crank", 6.0)
    assert not refused
    assert len([text for text in left if "leaves a radius of 3 mm" in text]) == 2
    refused, _ = design.cutter("wheel", 30.0)
    width = 2.0 * design.parts.outlines.sizes.half_width
    assert refused.endswith(f"is narrower; use a cutter up to {width:g} mm")
