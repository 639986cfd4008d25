"""The fit coupon as its files have it: widths, what lies in what, and the numbers beside."""

import ezdxf
import ezdxf.path
import pytest
import repo
from shapely.geometry import LineString, Point, Polygon

from geneva_cli.design import load
from geneva_cli.drawings.coupon import CLEARANCES, DIGITS, STROKES
from geneva_cli.output import draw

FLAT = 0.01  # mm, of chords; ends of arcs and quarters of circles are kept
SAME = 1e-9  # mm


def read(path):
    """Polygons, circles as (centre, radius), and strokes, by layers."""
    found = {}
    for entity in ezdxf.readfile(path).modelspace():
        points = [(p.x, p.y) for p in ezdxf.path.make_path(entity).flattening(FLAT)]
        layer = entity.dxf.layer
        shape = LineString(points) if layer == "ENGRAVE" else Polygon(points)
        found.setdefault(layer, []).append(shape)
    return found


def written(tmp_path, name, kerf=None, settings=()):
    design = load(str(repo.DESIGNS / f"{name}.toml"), settings)
    drawn = design.drawing("coupon", kerf_mm=kerf)
    draw(drawn, str(tmp_path / "coupon.dxf"))
    return design.parts.sizes, read(tmp_path / "coupon.dxf")


@pytest.mark.sampled(6)
@pytest.mark.parametrize("kerf", [None, 0.2])
@pytest.mark.parametrize("name", ["turret", "internal-z6", "four-bar-z4"])
def test_slots_are_wider_than_the_disc_by_their_clearance(tmp_path, name, kerf):
    """What a beam leaves on the true size, half its width on either side of its path."""
    sizes, found = written(tmp_path, name, kerf)
    half = 0.5 * kerf if kerf else 0.0
    _, *slots = sorted(found["COUPON"], key=lambda shape: -shape.area)
    (disc,) = found["ROLLER"]
    radius = 0.5 * (disc.bounds[2] - disc.bounds[0]) - half
    assert radius == pytest.approx(sizes.roller, abs=SAME)
    widths = sorted(s.bounds[2] - s.bounds[0] + 2.0 * half for s in slots)
    own = sizes.half_width - sizes.roller
    wanted = sorted({*CLEARANCES, round(own, 3)})
    assert widths == pytest.approx([2.0 * (radius + c) for c in wanted], abs=SAME)
    # the disc has a way to go in each
    assert all(s.bounds[3] - s.bounds[1] + 2.0 * half > 3.99 * sizes.roller for s in slots)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("kerf", [None, 1.0])
@pytest.mark.parametrize("name", ["turret", "three-slots"])
def test_everything_has_its_place(tmp_path, name, kerf):
    """Holes lie in the plate, apart from each other and from numbers; the disc lies beside it."""
    _, found = written(tmp_path, name, kerf)
    outline, *slots = sorted(found["COUPON"], key=lambda shape: -shape.area)
    (disc,) = found["ROLLER"]
    *bores, bore = sorted(found["BORE"], key=lambda shape: shape.centroid.x)
    assert disc.contains(bore)
    assert disc.distance(outline) > 5.0
    holes = [*slots, *bores]
    assert all(outline.exterior.distance(hole) > 1.0 and outline.contains(hole) for hole in holes)
    for i, one in enumerate(holes):
        assert all(one.distance(other) > 1.0 for other in holes[:i])
    for stroke in found["ENGRAVE"]:
        assert outline.contains(stroke)
        assert min(stroke.distance(hole) for hole in holes) > 0.2


def test_holes_for_the_pin_become_smaller(tmp_path):
    sizes, found = written(tmp_path, "turret")
    bores = sorted(found["BORE"], key=lambda shape: shape.centroid.x)[:-1]
    across = [b.bounds[2] - b.bounds[0] for b in bores]
    assert across == sorted(across, reverse=True)
    assert across[0] == pytest.approx(2.0 * sizes.pin, abs=SAME)
    assert across[-1] == pytest.approx(2.0 * sizes.pin - 0.15, abs=SAME)


def test_numbers_read_as_they_should():
    """Where strokes are lit, in a picture of three columns and five rows."""
    pictures = {
        "2": ("###", "..#", "###", "#..", "###"),
        "9": ("###", "#.#", "###", "..#", "###"),
        "7": ("###", "..#", "..#", "..#", "..#"),
    }
    for digit, rows in pictures.items():
        lit = [LineString(STROKES[stroke]) for stroke in DIGITS[digit]]
        for j, row in enumerate(rows):
            for i, mark in enumerate(row):
                at = Point(0.5 * i, 2.0 - 0.5 * j)
                assert (min(at.distance(line) for line in lit) < 1e-9) == (mark == "#"), digit
