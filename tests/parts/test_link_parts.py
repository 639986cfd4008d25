"""Links as plates: their holes are where the machine's joints are, and blocks stay in slots."""

import csv
import io
import math

import numpy as np
import pytest
import repo
from shapely import affinity
from shapely.geometry import LineString
from typer.testing import CliRunner
from words import Drive, Keys, Spec, Wheel

from geneva_cli import load
from geneva_cli.cli.app import app
from geneva_cli.design import Design
from geneva_cli.drawings.single_parts import single_parts
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.hole_walls import plate_wall
from geneva_cli.geometry.mass import mass_properties
from geneva_cli.geometry.shapes import Circle
from geneva_cli.motion.pivots import Joint
from geneva_cli.parts.links.link_positions import links_at
from geneva_cli.parts.links.links import drawn_links
from geneva_cli.spec.tables import Shaft, Size

# rounding of a few sines of lengths of some hundred mm
NEAR = 1e-10
NAMES = {
    "side-crank-z6": {"input crank", "coulisse", "coulisse's block"},
    "two-rollers-side-crank": {"input crank", "coulisse", "coulisse's block"},
    "four-bar-z4": {"crank", "coupler", "rocker"},
    "slider-crank": {"crank", "rod", "guide", "guide's block"},
    "epicyclic-z4": {"carrier", "planet's arm"},
    "epicyclic-soft-z6": {"carrier", "planet's arm"},
    "geneva-pair": {"first crank"},
    "cam-geneva": {"crank", "crank's block"},
}


@pytest.fixture(params=NAMES)
def made(request):
    design = load(str(repo.DESIGNS / f"{request.param}.toml"))
    found = design.parts.outlines if design.spec.is_flat else None
    return request.param, design, drawn_links(design.mechanism, found)


def shown(name, part):
    run = CliRunner().invoke(
        app, ["profile", str(repo.DESIGNS / f"{name}.toml"), "--part", part, "--format", "csv"]
    )
    assert run.exit_code == 0, run.output
    return list(csv.DictReader(io.StringIO(run.stdout)))


def holes(plate):
    return [complex(*hole.centre) for hole in plate.holes if isinstance(hole, Circle)]


def test_every_link_is_cut(made):
    name, _, links = made
    assert {plate.name for plate in links.plates} == NAMES[name]
    for plate in links.plates:
        # a wall all round, which the defaults leave: at least a quarter of a hole's radius
        least = min(hole.radius for hole in plate.holes if isinstance(hole, Circle))
        assert plate_wall(plate) > 0.25 * least


def test_holes_are_where_the_joints_are(made):
    """Each link moved so that it lies on its first two joints has its other holes on the rest."""
    _, design, links = made
    L, turn = design.mechanism.center_distance_mm, np.linspace(-180.0, 180.0, 17)
    plates = {plate.name: plate for plate in links.plates}
    for link in links_at(design.mechanism, turn):
        if link.radius_mm:
            continue
        bored = holes(plates[link.name])
        joints = [x + 1j * y + 0.0 * turn for x, y in link.joints]
        unit = (joints[1] - joints[0]) / np.abs(joints[1] - joints[0])
        for joint, kind in zip(joints, link.kinds, strict=True):
            own = (joint - joints[0]) / unit
            if kind in (Joint.PIN, Joint.ROLLER):
                assert min(np.abs(own - z).max() for z in bored) < NEAR * L, link.name


def test_blocks_stay_in_their_slots(made):
    """At every input angle, in shapely's polygons."""
    _, design, links = made
    turn = np.linspace(-180.0, 180.0, 721)
    plates = {plate.name: plate for plate in links.plates}
    for link in links_at(design.mechanism, turn):
        slides = [i for i, kind in enumerate(link.kinds) if kind in (Joint.SLIDE, Joint.CARRIED)]
        own = plates[link.name].holes if slides else ()
        slots = [hole for hole in own if not isinstance(hole, Circle)]
        assert len(slots) == len(slides)
        for i, slot in zip(slides, slots, strict=True):
            joints = [x + 1j * y + 0.0 * turn for x, y in link.joints]
            way = np.abs(joints[i] - joints[0])
            ends = [s.centre for s in slot.segments if hasattr(s, "bulge")]
            half = next(s.radius for s in slot.segments if hasattr(s, "bulge"))
            # round ends of slot and block are polygons of chords, inside by 1e-5 of the radius
            room = LineString(ends).buffer(half * 1.0001, 64)
            (block,) = [p for p in links.plates if p.name == f"{link.name}'s block"]
            reach = [s.centre for s in block.outline.segments if hasattr(s, "bulge")]
            along = complex(*ends[1]) / abs(complex(*ends[1]))
            own = LineString(reach).buffer(half, 64)
            own = affinity.rotate(own, math.degrees(np.angle(along)), (0.0, 0.0))
            for d in (way.min(), way.mean(), way.max()):
                at = d * along
                assert room.contains(affinity.translate(own, at.real, at.imag))
            # and the slot is no longer than it must be, by a hole's width
            assert abs(ends[0][0] - ends[1][0]) < np.ptp(way) + 4.0 * half


LENGTHS = {
    "four-bar-z4": {
        ("crank", 0, 1): "crank a",
        ("coupler", 0, 1): "coupler b",
        ("coupler", 0, 2): "roller from A",
        ("rocker", 0, 1): "rocker c",
    },
    "slider-crank": {
        ("crank", 0, 1): "crank a",
        ("rod", 0, 1): "rod b",
        ("rod", 0, 2): "roller from A",
    },
    "side-crank-z6": {("input crank", 0, 1): "input crank r"},
    "epicyclic-z4": {("carrier", 0, 1): "carrier R0"},
    "geneva-pair": {("first crank", 0, 1): "first crank radius"},
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", LENGTHS)
def test_the_drawing_has_the_lengths_of_the_list(name):
    """The circles that ``--part links`` writes, against the dimensions that ``--part parts`` does,
    from which test_parts_list.py rebuilds the wheel's angle.
    """
    rows = shown(name, "parts")
    numbers = {r["name"]: r["value"] for r in rows if r["row"] == "dimension"}
    pieces = shown(name, "links")
    links = [r["name"] for r in rows if r["row"] == "part" and r["name"] in NAMES[name]]
    contours, of = {}, -1
    for piece in pieces:
        if piece["layer"] == "LINK":
            of = max(of, int(piece["contour"]))
        elif piece["kind"] == "circle":
            centre = complex(float(piece["center_x_mm"]), float(piece["center_y_mm"]))
            contours.setdefault(of, []).append(centre)
    drawn = dict(zip(links, contours.values(), strict=True))
    for (link, i, j), dimension in LENGTHS[name].items():
        bores = drawn[link]
        # a shaft's bore is listed after the pins'
        length = sorted(abs(a - b) for k, a in enumerate(bores) for b in bores[:k])
        assert min(abs(x - float(numbers[dimension])) for x in length) < 1e-9, (link, i, j)


@pytest.mark.sampled(3)
def test_rows_of_the_list(made):
    """A row each, with its mass and its place along the axis; planes do not overlap."""
    name, _, links = made
    rows = {r["name"]: r for r in shown(name, "parts") if r["row"] == "part"}
    for plate in links.plates:
        row = rows[plate.name]
        mass = mass_properties(plate, 7850.0).mass_kg
        assert float(row["mass_kg"]) == pytest.approx(mass, rel=1e-12)
        assert (float(row["z_low_mm"]), float(row["z_high_mm"])) == (plate.low, plate.high)
    spans = sorted({(p.low, p.high) for p in links.plates})
    assert all(a[1] <= b[0] + 1e-9 for a, b in zip(spans, spans[1:], strict=False))
    assert spans[-1][1] <= 0.0


@pytest.mark.parametrize("name", ["side-crank-z6", "four-bar-z4", "slider-crank"])
def test_pins_are_turned_from_the_rollers_material(name):
    """Those between links as that of the roller: no plate is as thick as a pin is long."""
    design = load(str(repo.DESIGNS / f"{name}.toml"))
    parts, _ = single_parts(design.parts, 0.1, "arcs")
    pins = {one.name for one in parts if one.name.startswith("pin")}
    assert pins > {"pin"}
    assert not pins & {one.name for one in parts if one.is_cut}
    rows = {row["name"]: row for row in design.part_table("parts").to_rows()}
    assert {rows[pin]["material"] for pin in pins} == {"material.roller"}


def four_bar(**size):
    keys = Keys("four-bar", 40.0, 90.0, 100.0, 100.0, 161.51903573811165, -36.13836508095113)
    return Design.of(
        Spec(Wheel(4), Drive("four-bar"), keys | {"entry_deg": 123.3}, size=Size(**size))
    )


def test_sizes_as_given():
    design = four_bar(
        roller_radius_mm=2.0,
        link_pin_mm=8.0,
        link_bore_mm=14.0,
        link_width_mm=20.0,
        link_thickness_mm=5.0,
        washer_mm=0.5,
    )
    links = drawn_links(design.mechanism, design.parts.outlines)
    crank = next(p for p in links.plates if p.name == "crank")
    assert sorted(2.0 * hole.radius for hole in crank.holes) == [8.0, 14.0]
    rocker = next(p for p in links.plates if p.name == "rocker")
    assert {round(2.0 * s.radius, 9) for s in rocker.outline.segments if hasattr(s, "bulge")} == {
        20.0
    }
    assert [(p.low, p.high) for p in links.plates] == [
        pytest.approx(z) for z in ((-10.5, -5.5), (-5.0, 0.0), (-16.0, -11.0))
    ]
    rings = {p.part.name: p.part for p in links.joined if len(p.part.holes)}
    assert {(n, round(p.thickness, 9)) for n, p in rings.items()} == {
        ("washer of coupler and crank", 0.5),
        ("spacer of coupler and rocker", 6.0),
    }


def test_the_crank_is_bored_for_its_shaft():
    keys = Keys("slider-crank", 40.0, 100.0, 80.0, 90.0)
    design = Design.of(
        Spec(Wheel(8), Drive("slider-crank"), keys, shaft=Shaft(crank_diameter_mm=15.0))
    )
    links = drawn_links(design.mechanism, design.parts.outlines)
    assert 7.5 in {hole.radius for hole in links.plates[0].holes if isinstance(hole, Circle)}
    # the side-crank's coulisse is on the arm's shaft
    side = load(str(repo.DESIGNS / "side-crank-z6.toml"))
    (bore,) = [
        h
        for h in drawn_links(side.mechanism, side.parts.outlines).plates[1].holes
        if h[0] == "BORE" and isinstance(h, Circle)
    ]
    arm = side.drawing("arm").shapes[1]
    assert bore.radius == arm.radius


@pytest.mark.parametrize(
    ("size", "said"),
    [
        (
            {"link_pin_mm": 44.0, "link_bore_mm": 40.0},
            "no plate is left around the holes of the crank: it lacks",
        ),
        ({"link_pin_mm": 6.0, "link_width_mm": 6.0}, "link_width_mm = 6: it must be above 6"),
        ({"link_pin_mm": 900.0}, "link_pin_mm = 900: it must be below"),
        (
            {"pin_mm": 2.0, "roller_radius_mm": 2.0, "press_fit_mm": 2.0},
            "the pin must be the larger",
        ),
    ],
)
def test_what_leaves_no_link_is_refused(size, said):
    with pytest.raises(GenevaError, match=said) as caught:
        four_bar(**{"roller_radius_mm": 2.0} | size).drawing("links")
    assert caught.value.key[0] == "size"


def test_machines_without_links():
    with pytest.raises(GenevaError, match='kind = "crank" has no links: its crank is --part arm'):
        Design.of(Spec(Wheel(6))).drawing("links")


def test_a_pin_may_be_left_out():
    design = four_bar(roller_radius_mm=2.0, pin_mm=0.0)
    assert len(holes(drawn_links(design.mechanism).plates[1])) == 3


def test_rollers_on_links_are_listed_without_a_wheel():
    """Wheels of more than 360 slots are not drawn; what moves their roller is."""
    keys = Keys("slider-crank", 40.0, 100.0, 80.0, 90.0)
    size = Size(roller_radius_mm=1.0)
    table = Design.of(Spec(Wheel(400), Drive("slider-crank"), keys, size=size)).part_table("parts")
    count = dict(zip(*(table.to_dict()[name] for name in ("name", "count")), strict=True))
    assert count["wheel"] is None  # a dimension alone
    assert (count["rod"], count["roller"], count["pin"]) == (1, 1, 1)


SHAFTS = {
    "side-crank-z6": {"input crank's shaft": ("input crank", "frame")},
    "four-bar-z4": {"crank's shaft": ("crank", "frame"), "rocker's pivot": ("rocker", "frame")},
    "slider-crank": {"crank's shaft": ("crank", "frame")},
    "geneva-pair": {"first crank's shaft": ("first locking disc", "frame")},
    "epicyclic-soft-z6": {"shaft of carrier, planet's arm, planet": ("carrier", None)},
    "gear-sector": {"wheel's shaft": ("wheel", "frame")},
    "noncircular-gears": {"driver gear's shaft": (None, "frame")},
}


@pytest.mark.parametrize("name", SHAFTS)
def test_shafts_that_carry_links_are_parts(name):
    """From the frame's lower face to the upper one of the link, and as wide as its bore."""
    rows = {r["name"]: r for r in shown(name, "parts") if r["row"] == "part"}
    for shaft, (link, frame) in SHAFTS[name].items():
        row = rows[shaft]
        if link:
            assert float(row["z_high_mm"]) == pytest.approx(float(rows[link]["z_high_mm"]))
        if frame:
            assert float(row["z_low_mm"]) == pytest.approx(float(rows[frame]["z_low_mm"]))
        assert float(row["z_low_mm"]) < float(row["z_high_mm"])


def test_nothing_passes_below_a_link_that_stands_beside_the_crank():
    """So its shaft reaches the frame: it lies in the lowest plane, with every design's drive."""
    for path in sorted(repo.DESIGNS.glob("*.toml")):
        mechanism = load(str(path)).mechanism
        L, turn = mechanism.center_distance_mm, np.linspace(-180.0, 180.0, 25)
        links = links_at(mechanism, turn)
        for link in links:
            for (x, y), kind in zip(link.joints, link.kinds, strict=True):
                at = x + 1j * y + 0.0 * turn
                stands = np.ptp(at.real) + np.ptp(at.imag) < 1e-9 * L
                beside = abs(at[0] - L) > 1e-9 * L and abs(at[0]) > 1e-9 * L
                if stands and beside and kind in (Joint.SHAFT, Joint.PIN):
                    assert link.plane == max(one.plane for one in links), (path.stem, link.name)


def test_kerf_and_solids(tmp_path):
    """Outlines grow by half the cut and holes shrink; the solids stand in their planes."""
    design = load(str(repo.DESIGNS / "slider-crank.toml"))
    plain, cut = design.drawing("links"), design.drawing("links", kerf_mm=0.2)
    radii = [[s.radius for s in d.shapes if isinstance(s, Circle)] for d in (plain, cut)]
    assert all(a - b == pytest.approx(0.1) for a, b in zip(*radii, strict=True))
    for part in ("links", "assembly"):
        out = tmp_path / f"{part}.step"
        spec = str(repo.DESIGNS / "slider-crank.toml")
        run = CliRunner().invoke(app, ["profile", spec, "--part", part, "-o", str(out)])
        assert run.exit_code == 0, run.output
        assert all(f"'{name}'" in out.read_text().replace("''", "'") for name in ("rod", "guide"))
