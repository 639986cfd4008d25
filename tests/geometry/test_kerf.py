"""Cuts with a kerf or a cutter: against closed forms, and shapely's offsets and openings."""

import math

import pytest
import repo
from drawing_witness import polygon, vertices
from hypothesis import given, settings
from hypothesis import strategies as st
from sampling import some
from shapely.geometry import LinearRing

from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.offsets import judged, offset, paths
from geneva_cli.geometry.plates import Plate, plates
from geneva_cli.geometry.shapes import Arc, Circle, Line, about, closed
from geneva_cli.geometry.shapes import polygon as corners
from geneva_cli.geometry.sheet import Drawing

SAGITTA = 1e-4  # mm, of the chords that shapely is given
MICRON = 1e-3  # mm, what a cut piece may be off by


def cut(path, outside, kerf):
    """What a beam of this width leaves inside a path, or takes away along one in a hole."""
    return polygon(path).buffer(-0.5 * kerf if outside else 0.5 * kerf, quad_segs=48)


def require_cut(shape, outside, kerf, corner=0.0):
    """The path does not cross itself, and what is cut is the shape within a micrometre.

    ``corner``: how much more is left in a corner that stands in.
    """
    path = offset(shape, outside, 0.5 * kerf)
    assert LinearRing(vertices(path, SAGITTA)).is_simple
    nominal, made = polygon(shape), cut(path, outside, kerf)
    inner, outer = (nominal, made) if outside else (made, nominal)
    assert outer.buffer(MICRON).contains(inner)
    assert inner.buffer(MICRON + corner).contains(outer)
    return path


@pytest.mark.sampled(12)
@pytest.mark.parametrize("layer", ["WHEEL", "CRANK", "ARM"])
@pytest.mark.parametrize("name", ["turret", "press-curved", "internal-z6", "offset-slots"])
def test_parts_of_machines(name, layer):
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    for plate in plates(design.drawing(layer.lower(), 0.01, "arcs").solid):
        for shape in (plate.outline, *plate.holes):
            if not isinstance(shape, Circle):
                # a relief's corners stand in, at a right angle or less
                corner = 0.2 if layer == "CRANK" else 0.0
                require_cut(shape, shape is plate.outline, 0.2, corner=corner)


def tried(corners, kerf, outside):
    """The path of an outline about the origin, of distances and bulges of its corners: it leaves
    them, or is refused. How it ended, in a word; `fuzz_kerf.py` tries many."""
    count = len(corners)
    at = [
        (r * math.cos(math.tau * i / count), r * math.sin(math.tau * i / count))
        for i, (r, _) in enumerate(corners)
    ]
    pairs = zip(at, [*at[1:], at[0]], corners, strict=True)
    shape = closed(
        "WHEEL", [Arc(p, q, b) if abs(b) > 0.01 else Line(p, q) for p, q, (_, b) in pairs]
    )
    if not LinearRing(vertices(shape, 1e-3)).is_simple:
        return "no outline"
    try:
        path = offset(shape, outside, 0.5 * kerf)
    except GenevaError:
        return "refused"
    assert LinearRing(vertices(path, SAGITTA)).is_simple
    nominal, made = polygon(shape), cut(path, outside, kerf)
    inner, outer = (nominal, made) if outside else (made, nominal)
    # of a corner as sharp as d, shapely's chords leave a tip of SAGITTA² cot(d/2)
    assert inner.difference(outer.buffer(MICRON)).area < MICRON**2
    return "path"


@pytest.mark.long
@settings(max_examples=some(60, 25))
@given(
    st.lists(st.tuples(st.floats(5.0, 30.0), st.floats(-0.5, 0.7)), min_size=3, max_size=9),
    st.floats(0.05, 4.0),
    st.booleans(),
)
def test_no_path_crosses_itself(corners, kerf, outside):
    """Of outlines with any corners."""
    tried(corners, kerf, outside)


@pytest.mark.parametrize(
    ("shape", "outside", "most"),
    [
        (Circle("BORE", (1.0, 2.0), 3.0), False, 6.0),
        # a slot 2 wide with a round end, and one with a square end
        (closed("WHEEL", [
            Line((10.0, 1.0), (10.0, 9.0)), Line((10.0, 9.0), (-10.0, 9.0)),
            Line((-10.0, 9.0), (-10.0, -9.0)), Line((-10.0, -9.0), (10.0, -9.0)),
            Line((10.0, -9.0), (10.0, -1.0)), Line((10.0, -1.0), (0.0, -1.0)),
            about((0.0, 0.0), 1.0, -0.5 * math.pi, -math.pi), Line((0.0, 1.0), (10.0, 1.0)),
        ]), True, 2.0),
        (corners("WHEEL", ((10.0, 1.0), (10.0, 9.0), (-10.0, 9.0), (-10.0, -9.0), (10.0, -9.0),
                           (10.0, -1.0), (0.0, -1.0), (0.0, 1.0))), True, 2.0),
        # horns whose tips nearly touch, 1 apart
        (corners("WHEEL", ((0.0, 0.0), (10.0, 0.0), (10.0, 6.0), (5.5, 6.0), (9.0, 5.0), (9.0, 1.0),
                           (1.0, 1.0), (1.0, 5.0), (4.5, 6.0), (0.0, 6.0))), True, 1.0),
    ],
)  # fmt: skip
def test_a_cut_that_does_not_fit_in_is_refused(shape, outside, most):
    solid = Plate("part", "WHEEL", shape, (), 0.0, 1.0)
    if not outside:
        solid = Plate("part", "WHEEL", Circle("WHEEL", (0.0, 0.0), 50.0), (shape,), 0.0, 1.0)
    drawing = Drawing("part", (shape,), solid=solid)
    with pytest.raises(GenevaError, match="use a narrower one"):
        paths(drawing, most + 0.02)
    assert paths(drawing, 0.99 * most - 0.02).solid is None


def notched(angle):
    """A block with a notch of straight walls, each corner in it at an angle in degrees."""
    lean = 8.0 / math.tan(math.radians(180.0 - angle)) if angle != 90.0 else 0.0
    points = [(0, 0), (40, 0), (40, 20), (30 + lean, 20), (30, 12), (10, 12), (10 - lean, 20)]
    return Plate("block", "ARM", corners("ARM", [*points, (0, 20)]), (), 0.0, 1.0)


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
    ("plate", "cutter", "count"),
    [
        (notched(90.0), 2.0, 2),
        (notched(120.0), 4.0, 2),
        (keyed(4.0), 2.0, 2),
        (keyed(8.0), 2e-4, 0),
    ],
)
def test_corners_that_stay_round_are_named(plate, cutter, count):
    refused, left = judged(Drawing("", (), solid=plate), cutter)
    assert not refused
    assert len([text for text in left if "leaves a radius of" in text]) == count
    if count:
        assert missed(plate, 0.5 * cutter) > 0.1


@pytest.mark.parametrize(("width", "cutter"), [(4.0, 4.2), (8.0, 8.5)])
def test_a_keyway_narrower_than_the_cutter_is_refused(width, cutter):
    refused, _ = judged(Drawing("", (), solid=keyed(width)), cutter)
    assert refused.endswith("a gap is narrower; use a smaller one")
    refused, _ = judged(Drawing("", (), solid=keyed(width)), 0.99 * width)
    assert not refused
