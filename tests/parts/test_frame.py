"""The frame: a hole for every shaft that reaches it, and for nothing else."""

import cmath
import math
from functools import cache

import numpy as np
import pytest
import repo
from drawing_witness import polygon
from shapely.affinity import rotate, translate
from shapely.geometry import Point

from geneva_cli import load
from geneva_cli.geometry.plates import in_place
from geneva_cli.geometry.shapes import Circle
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.sized_by_load import stressed

# The pivots of the parts list whose shafts reach the frame, of each kind of drive. The crank of a
# side-crank ends above the input crank, and the wheel's shaft of the four-bar above the wheel.
STANDING = {
    "turret": ["wheel axis", "crank axis"],
    "side-crank-z6": ["wheel axis", "input crank axis"],
    "four-bar-z4": ["crank axis", "rocker axis"],
    "slider-crank": ["wheel axis", "crank axis"],
    "epicyclic-z4": ["wheel axis", "crank axis"],
    "geneva-pair": ["wheel axis", "crank axis", "first crank axis"],
    "noncircular-gears": ["wheel axis", "crank axis", "driver gear axis"],
}
MOUNTS = 4


@cache
def made(name):
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    proof = design.parts
    return design, proof, design.drawing("frame")


def rows(design, row):
    table = design.part_table("parts").to_rows()
    return {one["name"]: one for one in table if one["row"] == row}


LEVERS = [
    ("turret", {}),
    ("cam-geneva", {"arm_thickness_mm": 15.0}),
    ("epicyclic-z4", {"link_thickness_mm": 12.0}),
    ("geneva-pair", {"link_bore_mm": 4.0}),
    ("turret", {"wheel_hub_mm": 30.0, "wheel_hub_length_mm": 40.0}),
    ("four-bar-z4", {"link_thickness_mm": 20.0}),
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("name", "size"), LEVERS)
def test_forces_on_shafts_have_their_levers_to_the_bearings_as_built(name, size):
    """From the middle of the wheel to that of the frame."""
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    for key, value in size.items():
        design = design.with_(f"size.{key}", value)
    parts, own = design.parts.flat, stressed(*machine_sizes(design.mechanism))
    middle, frame = 0.5 * parts.outlines.sizes.wheel_thickness, parts.frame.part
    bars = {one.part.name: one.part for one in parts.shafts if one.part.low <= frame.low}
    stressed_shafts = {"wheel's shaft": own.wheel_shaft, "crank's shaft": own.crank_shaft}
    assert bars.keys() & stressed_shafts.keys()
    for name in bars.keys() & stressed_shafts.keys():
        bearing = 0.5 * (frame.low + frame.high)
        assert stressed_shafts[name].overhang == pytest.approx(middle - bearing, rel=1e-12)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", STANDING)
def test_a_hole_for_every_shaft_that_reaches_it(name):
    design, _, drawing = made(name)
    holes = [shape for shape in drawing.shapes if isinstance(shape, Circle)]
    pivots = rows(design, "pivot")
    # two screws hold a guide or a bridge besides, and four a gear
    guide = {"slider-crank": 2, "epicyclic-z4": 4, "side-crank-z6": 2}.get(name, 0)
    mounts = 0 if name == "geneva-pair" else MOUNTS  # it is too small for M1.6
    assert len(holes) == len(STANDING[name]) + guide + mounts
    for pivot, hole in zip(STANDING[name], holes, strict=False):
        at = pivots[pivot]["x_mm"], pivots[pivot]["y_mm"]
        assert hole.centre == pytest.approx(at, abs=1e-9)


def outline_at(link, plate, index):
    """The outline of a link where its joints are, as chords."""
    places = [complex(x[index], y[index]) for x, y in link.joints]
    ahead = places[1] - places[0]
    turned = rotate(polygon(plate.outline, 1e-3), cmath.phase(ahead), (0, 0), use_radians=True)
    return translate(turned, places[0].real, places[0].imag)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("A", [-0.6, 0.3, None])
def test_a_bridge_bears_the_crank_of_a_side_crank(A):
    """Its bore and the shaft are on one axis, and its posts stand beside all that turns.

    The links are placed by their joints, by shapely, at 73 input angles.
    """
    design = made("side-crank-z6")[0]
    design = design.with_("drive.A", A) if A else design
    flat, L = design.parts.flat, design.mechanism.center_distance_mm
    (bridge,), frame = flat.framed.bridge, flat.frame.part
    (crank,) = [one for one in flat.shafts if one.part.name == "crank's shaft"]
    bore, *screws = bridge.part.holes
    assert bridge.at == crank.at == (L, 0.0)
    assert bore.radius == crank.part.outline.radius
    assert crank.part.high == bridge.part.high == bridge.part.low + frame.high - frame.low
    below = [plate for member in flat.members for _, plate in in_place([member])]
    turning = [one for one in below if one.layer in ("WHEEL", "CRANK", "ARM", "ROLLER", "LINK")]
    assert bridge.part.low == max(one.high for one in turning)
    posts = [one for one in flat.framed.spacers if one.part.name == "spacer of the bearing bridge"]
    assert [(one.part.low, one.part.high) for one in posts] == 2 * [(frame.high, bridge.part.low)]
    at = np.linspace(-180.0, 180.0, 73)
    links = {link.name: link for link in links_at(design.mechanism, at)}
    plates_of = {one.part.name: one.part for one in flat.links.cut if one.part.name in links}
    assert plates_of.keys() == {"coulisse", "input crank"}
    rim = max(math.hypot(*piece.start) for piece in flat.outlines.wheel.segments)
    arm = max(math.hypot(*pin.centre) for pin in flat.arm.pins) + flat.arm.eye
    for post, screw in zip(posts, screws, strict=True):
        assert post.at == (L, screw.centre[1])
        ring = Point(*post.at).buffer(post.part.outline.radius)
        assert math.hypot(*post.at) - post.part.outline.radius > rim
        assert abs(post.at[1]) - post.part.outline.radius > max(arm, flat.outlines.sizes.lock)
        for name, plate in plates_of.items():
            gaps = (outline_at(links[name], plate, i).distance(ring) for i in range(len(at)))
            assert min(gaps) > 0.5
    lever = stressed(*machine_sizes(design.mechanism)).crank_shaft.overhang
    middle = 0.5 * (bridge.part.low + bridge.part.high) - 0.5 * flat.outlines.sizes.wheel_thickness
    assert lever == pytest.approx(middle, rel=1e-12)


@pytest.mark.long
@pytest.mark.parametrize(
    ("name", "keys", "said"),
    [
        ("side-crank-z6", (), ""),
        ("turret", (), ""),
        ("four-bar-z4", (), "the wheel's shaft has no bearing: it ends at 0 mm, above the frame"),
        ("side-crank-z6", ("crank_shaft_high_mm=40",), "the crank's shaft has no bearing"),
    ],
)
def test_a_shaft_that_nothing_bears_is_said(name, keys, said):
    """As a warning, and on the sheet at the shaft."""
    design = load(str(repo.DESIGNS / f"{name}.toml"), [f"size.{key}" for key in keys])
    texts = [str(text) for text in design.warnings if text.name == "no-bearing"]
    assert len(texts) == bool(said)
    assert all(said in text for text in texts)
    noted = [label.text for label in design.sheet(0.05).texts]
    assert noted.count("no bearing: hold it from above") == bool(said)
