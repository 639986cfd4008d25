"""Cutters and dog bones: against shapely's opening of what is to be cut away, of polygons."""

import math

import pytest
import repo
from drawing_witness import polygon
from shapely.ops import unary_union

from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.cutter import faults, freed
from geneva_cli.geometry.plates import Plate, plates
from geneva_cli.geometry.shapes import Arc, Circle, Line, about, closed

OFF = 5e-3  # mm², on outlines some mm long: chords, and shapely's own arcs of 64 to a quarter


def free_space(plate):
    """What is to be cut away round and in a plate."""
    outline = polygon(plate.outline)
    around = outline.buffer(9.0, 512)  # round: no corner of it is to be cut
    holes = [polygon(hole) for hole in plate.holes if not isinstance(hole, Circle)]
    return [around.difference(outline), *holes]


def missed(plate, radius):
    """The area to be cut away that no cutter inside it covers, mm²: shapely's opening.

    The cutter is narrower by 1 %: one that just fits into the chords of its own bite is lost.
    """
    reach = 0.99 * radius
    return sum(
        space.difference(space.buffer(-reach, 64).buffer(reach, 64)).area
        for space in free_space(plate)
    )


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


def boned(plate, radius, works=lambda piece, layer: False):
    by = freed(plate, radius, 0.5, works)
    return plate._replace(
        outline=by.get(plate.outline, plate.outline),
        holes=tuple(by.get(hole, hole) for hole in plate.holes),
    )


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("plate", "radius"),
    [(notched(90.0), 1.0), (notched(120.0), 2.0), (keyed(4.0), 1.0), (keyed(8.0, 2.0), 1.25)],
)
def test_dog_bones_let_the_cutter_everywhere_and_the_mate_in(plate, radius):
    with_them = boned(plate, radius)
    assert missed(plate, radius) > 0.1 > OFF > missed(with_them, radius)
    before, after = (unary_union(free_space(one)) for one in (plate, with_them))
    assert before.difference(after).area < OFF  # all that was free still is
    # of each corner a disc through it takes no more than half of itself
    assert 0.0 < after.difference(before).area < 2.0 * 0.5 * math.pi * radius**2
    assert [fault.stops for fault in faults(plate, radius)] == [False, False]
    assert not list(faults(with_them, radius))


def test_no_cutter_comes_into_the_bone_of_an_acute_corner():
    """Its mouth is narrower than itself: of walls 2 phi apart, r cos 2phi to a side."""
    (fault,) = faults(boned(notched(70.0), 1.5), 1.5)
    assert fault.stops
    assert "a gap is narrower" in fault.text


def test_a_bone_that_has_no_room_is_refused():
    with pytest.raises(GenevaError, match="shorter than a dog bone"):
        boned(keyed(4.0), 1.6)  # two of 2.26 mm on a floor of 4
    with pytest.raises(GenevaError, match="so near to another wall that its bite, 2 mm wide, wou"):
        boned(keyed(4.0, 0.9), 1.0)  # sides of 1.24 mm are shorter than a bite of 1.41
    near = keyed(4.0)._replace(outline=Circle("ARM", (0.0, 0.0), 9.8))
    with pytest.raises(GenevaError, match="leaves less than wall_min_mm to another outline"):
        boned(near, 1.0)


@pytest.fixture(scope="module")
def two_pins():
    """A locking disc whose sector reliefs have corners, and its dog bones."""
    design = load(str(repo.DESIGNS / "two-pins-z4.toml"))
    model = design.parts
    return design, model, design.drawing("crank", dog_bones_mm=6.0)


def test_the_disc_locks_where_it_did(two_pins):
    """The arcs of the locking circle are the very same, and the solid is what is drawn."""
    design, model, freed_drawing = two_pins
    lock = model.outlines.sizes.lock

    def locking(drawing):
        (disc,) = (s for s in drawing.shapes if s.layer == "CRANK")
        return disc, [
            s
            for s in disc.segments
            if isinstance(s, Arc) and abs(s.radius - lock) < 1e-9 and math.hypot(*s.centre) < 1e-9
        ]

    plain, arcs = locking(design.drawing("crank"))
    disc, same = locking(freed_drawing)
    assert same == arcs
    assert len(disc.segments) == len(plain.segments) + 2
    assert disc in [plate.outline for plate in plates(freed_drawing.solid)]
    # each corner loses a bite of the disc of 6 mm: between none and half of it
    bite = polygon(plain).area - polygon(disc).area
    assert 0.0 < bite < 2.0 * 0.5 * math.pi * 9.0


@pytest.mark.long
def test_the_verdict_on_a_part(two_pins):
    design, model, _ = two_pins
    refused, left = design.cutter("crank", 6.0)
    assert not refused
    corners = [text for text in left if "leaves a radius of 3 mm" in text]
    assert len(corners) == 2
    assert design.cutter("crank", 6.0, dog_bones=True) == (
        "",
        [text for text in left if text not in corners],
    )
    refused, _ = design.cutter("wheel", 30.0)
    width = 2.0 * model.outlines.sizes.half_width
    assert refused.endswith(f"is narrower; use a cutter up to {width:g} mm")
