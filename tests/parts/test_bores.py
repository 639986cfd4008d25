"""Bores with a flat or six sides: their shapes, their walls, and where they are refused."""

import math

import pytest
from drawing_witness import polygon
from repo import DESIGNS
from shapely.affinity import rotate
from shapely.geometry import Point

from geneva_cli import Design, External, Size, load
from geneva_cli.geometry.plates import in_place, moments, plates
from geneva_cli.geometry.shapes import Contour
from geneva_cli.parts.shafts.bores import bore_of


def of(**size):
    return Design(External(6), size=Size(**size))


def bore(design, part):
    """The bore of a part, which is its only contour besides the outline."""
    _, shape = [s for s in design.drawing(part).shapes if isinstance(s, Contour)]
    return shape


def row(design, name):
    return next(c for c in design.checks if c.name == name)


@pytest.mark.parametrize("direction", [0.0, 1.0, 4.0])
@pytest.mark.parametrize(
    ("size", "inside"),
    [
        # d²/4 (pi - acos x + x sqrt(1 - x²)), x = 1 - 2 depth/d: a circle less a segment
        ({"wheel_bore": "D"}, 25.0 * (math.pi - math.acos(0.8) + 0.8 * 0.6)),
        ({"wheel_bore": "D", "wheel_flat_mm": 2.0}, 25.0 * (math.pi - math.acos(0.6) + 0.6 * 0.8)),
        ({"wheel_bore": "hex"}, 100.0 * math.sqrt(3.0) / 2.0),
    ],
)
def test_their_area(size, inside, direction):
    shape = bore_of(Size(**size), "wheel", 5.0).shape("BORE", direction)
    assert abs(moments(shape).area) == pytest.approx(inside, rel=1e-12)
    # the first piece faces the direction, at right angles
    (x, y), (u, v) = shape.segments[0].start, shape.segments[0].end
    assert math.remainder(math.atan2(y + v, x + u) - direction, math.tau) == pytest.approx(0.0)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("shape", ["D", "hex"])
def test_walls_are_those_of_the_shape(shape):
    """In arm, disc and wheel, by shapely's distances of polygons."""
    design = of(
        crank_bore=shape, wheel_bore=shape, crank_bore_mm=10.0, wheel_bore_mm=70.0, arm_hub_mm=14.0
    )
    arm, disc, wheel = (
        [polygon(s, 1e-6) for s in design.drawing(name).shapes if isinstance(s, Contour)]
        for name in ("arm", "crank", "wheel")
    )
    # 2000 chords an arc are within 1e-5 mm of it
    own = min(outline.exterior.distance(hole) for outline, hole in (arm, disc))
    assert row(design, "arm_wall_mm").value == pytest.approx(own, abs=1e-4)
    wall = wheel[0].exterior.distance(wheel[1])
    assert row(design, "dial_wall_mm").value == pytest.approx(wall, abs=2e-3)


def face(shape):
    return polygon(shape, 1e-6)


@pytest.mark.long
@pytest.mark.parametrize("bore", ["D", "hex", "DIN 6885-1"])
@pytest.mark.parametrize(
    ("design", "axis", "names"),
    [
        ("elliptical-gears", "crank", {"arm", "locking disc", "driven gear"}),
        ("gear-sector", "wheel", {"wheel", "wheel gear"}),
        ("epicyclic-z4", "crank", {"locking disc", "carrier"}),
        ("slider-crank", "crank", {"crank"}),
    ],
)
def test_all_that_turns_with_a_shaft_is_held_by_it(design, axis, names, bore):
    """Placed at input 0: the shaft fits all bores, and turned by 20 degrees it fits none.

    A shaft with a keyway is round: its keyway meets that of each bore.
    """
    key = f"size.{axis}_keyway={bore}" if bore.startswith("DIN") else f"size.{axis}_bore={bore}"
    made = load(str(DESIGNS / f"{design}.toml"), (key,))
    flat = made.parts.flat
    at = (0.0, 0.0) if axis == "wheel" else (made.mechanism.center_distance_mm, 0.0)
    placed_plates = [plate for _, plate in in_place(flat.members)]
    steps = [plate for plate in placed_plates if plate.layer == "SHAFT"]
    held = set()
    for plate in placed_plates:
        for hole in plate.holes if plate.layer != "SHAFT" else ():
            if not isinstance(hole, Contour) or hole.layer != "BORE":
                continue
            opening, middle = face(hole), 0.5 * (plate.low + plate.high)
            (step,) = [
                one
                for one in steps
                if one.low < middle < one.high
                and opening.contains(Point(*at))
                and face(one.outline).contains(Point(*at))
            ]
            section = face(step.outline)
            held.add(plate.name)
            assert opening.buffer(1e-4).contains(section)
            if bore.startswith("DIN"):
                far = max(math.dist(at, p) for p in section.exterior.coords)
                circle = Point(*at).buffer(far, quad_segs=500)
                ways = opening.difference(circle), circle.difference(section)
                # without slivers of chords between
                middles = [way.buffer(-1e-2).centroid for way in ways]
                angles = [math.atan2(p.y - at[1], p.x - at[0]) for p in middles]
                assert math.remainder(angles[0] - angles[1], math.tau) == pytest.approx(0, abs=1e-3)
            else:
                turned = rotate(section, 20.0, origin=at)
                assert turned.difference(opening).area > 0.01
    assert held == names


@pytest.mark.sampled(2)
@pytest.mark.parametrize("shape", ["D", "hex"])
def test_a_bore_in_a_hub_leaves_a_wall(shape):
    """A corner of a hexagon of 12 mm is 12/sqrt(3) mm from the axis."""
    deep = {"D": 6.0, "hex": 12.0 / math.sqrt(3.0)}[shape]
    design = of(wheel_bore=shape, wheel_bore_mm=12.0, wheel_hub_mm=15.0)
    assert row(design, "wheel_bore_wall_mm").value == pytest.approx(7.5 - deep)
    usual = of(wheel_bore=shape, wheel_hub_mm=20.0)
    assert row(usual, "wheel_bore_wall_mm").passes
    wheel, hub = plates(design.drawing("wheel").solid)
    assert hub.holes == wheel.holes
