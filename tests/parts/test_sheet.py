"""Drawing sheets: nothing stands on anything else, and the sizes on them are the machine's."""

import io
import math
import re
from functools import cache

import ezdxf
import numpy as np
import pytest
import repo
import shapely
from drawing_witness import vertices
from shapely import affinity
from shapely.geometry import LineString, Polygon
from sheet_witness import (
    assert_as_listed,
    assert_measured,
    beyond,
    crossings,
    number,
    overlaps,
)
from words import Drive, Keys, Motion, Spec, Wheel

import geneva_cli
from geneva_cli import EllipticalGears, load
from geneva_cli.design import Design
from geneva_cli.drawings.sheet.cut import faces
from geneva_cli.drawings.sheet.paper import FORMATS, SCALES
from geneva_cli.drawings.sheet.points import gear_tables, polyline, tables
from geneva_cli.drawings.sheet.view import View
from geneva_cli.errors import GenevaError
from geneva_cli.geometry import marks
from geneva_cli.geometry.board import Board
from geneva_cli.geometry.measure import bounds, points
from geneva_cli.geometry.placed import in_place
from geneva_cli.geometry.shapes import Arc, Circle, Contour, Line
from geneva_cli.geometry.sheet import Label
from geneva_cli.output.sheets import sheet_dxf
from geneva_cli.parts.links.links import drawn_links
from geneva_cli.spec.tables import RollerMaterial, Size, TitleBlock, Tolerance, WheelMaterial

pytestmark = pytest.mark.usefixtures("made_once")
DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))

SPHERICAL = {"spherical-z6": "shafts 90°", "spherical-60deg": "shafts 60°"}
TOLERANCE = 0.05  # mm: coarse walls are quick, and look the same on paper


def of(spec, tolerance=TOLERANCE):
    return Design.of(spec).sheet(tolerance)


@pytest.fixture(scope="module")
def sheets():
    """A design's sheet by its name, each made once."""

    @cache
    def made(name):
        design = load(str(repo.DESIGNS / f"{name}.toml"))
        # the teeth of a small machine need finer walls: coarse ones move their mass
        return design, design.sheet(TOLERANCE * min(1.0, design.mechanism.center_distance_mm / 50))

    return made


@pytest.mark.sampled(64)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_no_text_of_a_design_stands_on_anything(path, sheets):
    design, found = sheets(path.stem)
    assert overlaps(found) == []
    assert beyond(found) == []
    # a bore beside others, or a line to a recess's centre, may leave no other place
    assert len(crossings(found)) <= 2
    assert (found.width, found.height) in [(f.width, f.height) for f in FORMATS]
    assert found.scale in SCALES
    assert_measured(found)
    if path.stem in SPHERICAL:
        assert SPHERICAL[path.stem] in {m.label.text for m in found.measures}
        return
    # the centre distance is on it, as the machine has it
    L = f"{design.mechanism.center_distance_mm:.3f}".rstrip("0").rstrip(".")
    name = "L" if design.spec.output.turns else "R"
    assert any(m.label.text.startswith(f"{name} = {L}") for m in found.measures)
    assert_as_listed(found, list(design.part_table("parts").to_rows()), 2e-3)


SMALL = [
    Spec(Wheel(3), size=Size(30.0)),
    Spec(Wheel(24), size=Size(30.0, roller_radius_mm=0.6)),
    Spec(Wheel(3), size=Size(900.0)),
    Spec(Wheel(24), size=Size(900.0)),
    Spec(Wheel(4, "internal"), size=Size(30.0)),
    Spec(Wheel(12, "internal"), size=Size(900.0)),
    Spec(Wheel(6), motion=Motion("cycloidal", ratio="matched"), size=Size(30.0)),
    Spec(Wheel(8), size=Size(77.7, lock_bolts=3, crank_bore_mm=12.0, crank_keyway="DIN 6885-1")),
    Spec(Wheel(4), Drive(rollers=3), size=Size(50.0, roller_radius_mm=3.0)),
    Spec(Wheel(6, offset_mm=8.0), size=Size(100.0, roller_radius_mm=4.0)),
    Spec(Wheel(6), Drive("cam"), motion=Motion("cycloidal"), size=Size(40.0)),
    Spec(Wheel(6), Drive("side-crank"), Keys("side-crank", 0.4), size=Size(3.0)),
]


@pytest.mark.sampled(9)
@pytest.mark.parametrize("spec", SMALL, ids=lambda s: f"{s.wheel.z}-{s.size.center_distance_mm:g}")
def test_machines_of_every_size(spec):
    found = of(spec)
    assert overlaps(found) == []
    assert_measured(found)


def test_the_sizes_of_a_plain_wheel():
    """Against the closed forms: rim sqrt(L² cos² b + r²), R = L sin b, slot to L - R - r - end."""
    tolerance = Tolerance(slot_width_mm=0.01, crank_radius_mm=0.02, center_distance_mm=0.03)
    size = Size(120.0, 6.0, slot_clearance_mm=0.02, slot_bottom_clearance_mm=1.0)
    texts = [m.label.text for m in of(Spec(Wheel(6), size=size, tolerance=tolerance)).measures]
    rim = math.hypot(120.0 * math.cos(math.pi / 6.0), 6.0)
    end = 120.0 - 60.0 - 1.0 - 6.02
    mouth = math.sqrt(rim**2 - 6.02**2)
    wanted = [
        f"Ø {2.0 * rim:.3f}",
        "6× 12.04 ±0.01",
        f"{end:g}",
        f"6× {mouth - end:.3f}".rstrip("0"),
        "6× 60°",
        "6× 30°",
        "60 ±0.02",
        "120 ±0.03",
        "L = 120 ±0.03",
        "6× R 6.02",
        "Ø 12 h6 (0/-0.011)",
    ]
    assert [text for text in wanted if text not in texts] == []


def test_without_clearance_the_fit_gives_it():
    texts = [m.label.text for m in of(Spec(Wheel(6), size=Size(120.0, 6.0))).measures]
    assert {"6× 12 H7 (+0.018/0)", "Ø 12 g6 (-0.006/-0.017)"} <= set(texts)


def test_the_title_block_says_what_is_there(sheets):
    design, found = sheets("limits")
    texts = {label.text for label in found.labels}
    rows = design.part_table("parts").to_dict()
    parts = zip(rows["name"], rows["mass_kg"], rows["count"], strict=True)
    mass = sum(m * n for name, m, n in parts if m is not None and name in texts)
    assert {f"{mass:.4g} kg", "1:1", "A1", "ISO 2768-m", "steel", design.spec.title} <= texts
    # no date, no path: what has a stroke are limits of a fit
    rest = {re.sub(r"\([-+.\d]+/[-+.\d]+\)", "", text) for text in texts - {"1/1"}}
    assert not any(re.search(r"20\d\d-|/", text) for text in rest)


def test_the_roller_turns_on_a_pin_that_the_arm_holds():
    """A running and a pressed fit of one pin; a hole drawn for a press fit has its own size."""
    for press, hole in ((0.0, "Ø 6 P7 (-0.008/-0.02)"), (0.02, "Ø 5.98 H7 (+0.012/0)")):
        found = of(Spec(Wheel(6), size=Size(120.0, 6.0, press_fit_mm=press)))
        texts = {m.label.text for m in found.measures}
        assert {"Ø 6 F7 (+0.022/+0.01)", hole} <= texts
        labels = {label.text for label in found.labels}
        assert "turns on its pin Ø 6 h6 (0/-0.008), which is pressed in" in labels


FIELDS = ("drawing number", "revision", "date", "author", "roughness")


def under(found, heading):
    """The text of the title block's field with a heading; None if it is empty."""
    at = next(label.at for label in found.labels if label.text == heading)
    below = (at[0], pytest.approx(at[1] - 5.4))
    return next((label.text for label in found.labels if label.at == below), None)


def test_fields_without_a_key_are_empty(sheets):
    """No number, date or name is invented."""
    found = sheets("turret")[1]
    assert [under(found, heading) for heading in FIELDS] == [None] * len(FIELDS)
    assert under(found, "edges") == "free of burrs"
    assert under(found, "faces that roll, slide, lock") is None


def test_the_title_block_has_the_keys_of_drawing():
    block = TitleBlock("G-106", "B", "M. Muster", "2026-11-27", 3.2, 1.6, 58.0)
    steel = WheelMaterial(grade="42CrMo4"), RollerMaterial(grade="100Cr6")
    size = Size(edge_chamfer_mm=0.3)
    found = of(
        Spec(Wheel(6), size=size, drawing=block, material_wheel=steel[0], material_roller=steel[1])
    )
    shown = [under(found, heading) for heading in FIELDS]
    assert shown == ["G-106", "B", "2026-11-27", "M. Muster", "Ra 3.2"]
    assert under(found, "edges") == "chamfered 0.3 × 45°"
    assert under(found, "faces that roll, slide, lock") == "Ra 1.6, 58 HRC"
    texts = [label.text for label in found.labels]
    assert (texts.count("42CrMo4"), texts.count("100Cr6")) == (4, 4)
    assert under(found, "material") == "see list"


@pytest.mark.sampled(8)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_no_dimension_is_without_a_place_on_a_designs_sheet(path, sheets):
    """One that fits nowhere stands below its view, as a bare number or a diameter."""
    _, found = sheets(path.stem)
    alone = r"(\d+× )?(Ø |R |L = )?[\d.]+( [HgPFh]\d \(.*| ±.*|°)?"
    cells = [label.at[0] for label in found.labels]  # of tables, numbers stand in columns
    below = [m for m in found.labels if re.fullmatch(alone, m.text) and cells.count(m.at[0]) == 1]
    assert below == []


@pytest.mark.sampled(8)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_each_item_of_the_list_has_one_balloon(path, sheets):
    design, found = sheets(path.stem)
    rows = [row for row in design.part_table("parts").to_rows() if row["row"] == "part"]
    # a circle of two arcs about a number, with a leader
    circled = [m.label.text for m in found.measures if len(m.main_lines) == 3]
    assert sorted(map(int, circled)) == list(range(1, len(rows) + 1))


@pytest.mark.parametrize("name", ["turret", "internal-z6", "cam-geneva", "side-crank-z6"])
def test_the_section_shows_what_the_plane_of_the_axes_cuts(name, sheets):
    """Against the polygons of the plates at their places, cut by a line in shapely."""
    parts = sheets(name)[0].parts.flat.within(TOLERANCE, "arcs")
    cut = faces(parts.members, 1.0)
    for own, plate in in_place(parts.members):
        rings = [vertices(shape, 0.01) for shape in (plate.outline, *plate.holes)]
        solid = Polygon(rings[0], rings[1:])
        x0, _, x1, _ = solid.bounds
        # a little beside the axis, since walls of slots may lie on it
        chord = solid.intersection(LineString([(x0 - 1.0, 1e-7), (x1 + 1.0, 1e-7)]))
        shown = [face for face in cut if face.plate == own]
        if shown and name != "side-crank-z6":
            assert len(shown) == len(getattr(chord, "geoms", [chord]))
        copies = sum(1 for other, _ in in_place(parts.members) if other == own)
        if copies == 1:
            # chords of 1.5 mm have sagittas of 0.06 mm on 5 mm, at a crossing aslant more
            length = sum(face.right - face.left for face in shown)
            assert length == pytest.approx(chord.length, abs=0.3)


def test_the_assembly_shows_where_the_section_is(sheets):
    """An arrow beyond each end of the line of centres, upwards, with the section's letter."""
    _, found = sheets("turret")
    marks_ = [m for m in found.measures if m.label.text == "A"]
    assert "A-A (1:5)" in {label.text for label in found.labels}
    (left,), (right,) = ([m.arrows[0] for m in one] for one in (marks_[:1], marks_[1:]))
    assert left.tip[1] == right.tip[1]
    assert left.turn == right.turn == 0.5 * math.pi
    (L,) = (m for m in found.measures if m.label.text.startswith("L = "))
    assert left.tip[0] < min(p[0] for p in L.points[:2])
    assert right.tip[0] > max(p[0] for p in L.points[:2])
    assert L.points[0][1] == pytest.approx(left.tip[1])


def test_a_keyways_direction_is_on_the_sheet():
    """The crank's keyway of this machine lies opposite to its roller."""
    size = Size(77.7, lock_bolts=3, crank_bore_mm=12.0, crank_keyway="DIN 6885-1")
    found = of(Spec(Wheel(8), size=size))
    texts = [label.text for label in found.labels]
    assert "keyway at 180°, counterclockwise from the right" in texts


LENGTHS = {
    "four-bar-z4": ("crank a", "coupler b", "rocker c"),
    "slider-crank": ("crank a", "rod b"),
    "side-crank-z6": ("input crank r",),
    "epicyclic-z4": ("carrier R0", "planet crank rp"),
    "geneva-pair": ("first crank radius",),
}


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", LENGTHS)
def test_links_have_their_views(name, sheets):
    """Each link by its name, with the lengths of the list of parts as dimensions on paper."""
    design, found = sheets(name)
    rows = design.part_table("parts").to_rows()
    titles = [re.sub(r", t = .*", "", label.text) for label in found.labels]
    bars = drawn_links(design.mechanism, design.parts.outlines)
    for i, row in enumerate((row for row in rows if row["row"] == "part"), 1):
        if row["name"] in {plate.name for plate in bars.plates}:
            assert f"{i} {row['name']}" in titles
    linear = {round(m.value, 3) for m in found.measures if m.kind == "length"}
    values = {row["name"]: row["value"] for row in rows if row["row"] == "dimension"}
    assert {round(values[one], 3) for one in LENGTHS[name]} <= linear
    # the first crank's roller is on a pin that is pressed into it, as the arm's is
    pressed = [label.text for label in found.texts if " P7 " in label.text]
    assert len(pressed) == (2 if name == "geneva-pair" else 1)


def test_a_gears_pitch_curves_are_on_the_sheet(sheets):
    """The printed points of both: they touch on the line of centres, C apart, and never cross."""
    design, found = sheets("noncircular-gears")
    L = design.mechanism.center_distance_mm
    driven, driver = gear_tables(design.mechanism, 0.01)
    rings = []
    for block in (driven, driver):
        points = printed(block)
        assert "mirror image" in " ".join(label.text for label in block.labels)
        turns = [math.atan2(y, x) for x, y in points]
        points = [p for _, p in sorted(zip(turns, points, strict=True))]
        rings.append(points + [(x, -y) for x, y in reversed(points)])
    C = design.spec.drive.gears.distance_mm
    one, other = Polygon(rings[0]), affinity.translate(Polygon(rings[1]), C)
    close = 1e-4 * L  # of the table's chords
    assert one.distance(other) < 2.0 * close
    assert one.intersection(other).area < close * C
    assert round(one.bounds[2] - other.bounds[0], 3) == 0.0
    assert any(m.value == pytest.approx(C) for m in found.measures if m.kind == "length")
    titles = {label.text for label in found.labels}
    assert any("driven gear, t = 16" in text for text in titles)


def test_small_machines_are_enlarged_and_large_ones_fill_their_paper(sheets):
    _, pair = sheets("geneva-pair")
    assert (pair.scale, pair.width) == (2.0, 594.0)
    for name in ("geneva-pair", "side-crank-z6", "epicyclic-z4"):
        _, found = sheets(name)
        reach = [at for label in found.labels for at in label.corners]
        reach += [p for m in found.measures for p in m.points]
        reach = [p for p in reach if p[0] < found.width - 190.0]  # beside list and title block
        x, y = zip(*reach, strict=True)
        filled = (max(x) - min(x)) * (max(y) - min(y))
        assert filled > 0.5 * (found.width - 190.0) * found.height


def test_points_of_a_curved_slot_are_on_it():
    """The table as it is printed: chords within what it says, of the points that `slot` gives."""
    design = load(str(repo.DESIGNS / "press-curved.toml"))
    (block,) = tables(design.parts.outlines, 0.01)
    downwards = sorted(block.labels, key=lambda label: (-label.at[1], label.at[0]))
    texts = [label.text for label in downwards]
    numbers = [float(text) for text in texts if re.fullmatch(r"-?\d+\.\d{3}", text)]
    table = LineString(list(zip(numbers[::2], numbers[1::2], strict=True)))
    stated = float(re.search(r"within ([\d.]+) of it", " ".join(texts))[1])
    rows = design.slot(samples=2001).to_dict()
    half = rows["input_deg"] <= 0.0
    true = zip(rows["x_mm"][half], rows["y_mm"][half], strict=True)
    worst = max(table.distance(shapely.Point(p)) for p in true)
    assert stated == pytest.approx(1e-4 * design.mechanism.center_distance_mm, abs=5e-5)
    assert 0.2 * stated < worst < stated + 1e-3  # coordinates have three decimals


def printed(block):
    """The points of a table, as they are read from its texts."""
    downwards = sorted(block.labels, key=lambda label: (-label.at[1], label.at[0]))
    texts = [label.text for label in downwards if re.fullmatch(r"-?\d+\.\d{3}", label.text)]
    return [(float(x), float(y)) for x, y in zip(texts[::2], texts[1::2], strict=True)]


def test_a_polyline_is_as_near_as_asked():
    def circle(t):
        return np.column_stack((50.0 * np.cos(t), 50.0 * np.sin(t)))

    for close in (1.0, 0.01):
        points = polyline(circle, 0.0, math.tau, close)
        middles = 0.5 * (points[1:] + points[:-1])
        assert 0.2 * close < 50.0 - np.hypot(*middles.T).min() <= close


def test_what_finds_no_place_is_said_below():
    """A board full of text has no room for a leader; one text in the way moves it."""
    full, half = Board(), Board()
    full.write(Label("W" * 400, (-1000.0, -500.0), 700.0))
    half.write(Label("here", (4.0, 4.0), 3.0))
    tries = list(marks.diameter((0.0, 0.0), 5.0, marks.around(), "Ø 10", 10.0))
    assert full.first(tries) is None
    moved = half.first(tries)
    assert moved is not None
    assert moved != Board().first(tries)


@pytest.mark.parametrize(
    ("wheel", "A"),
    [
        (Wheel(6), 0.99993),  # its coulisse is one piece with its shaft: its slot is all its holes
        (Wheel(3, offset_mm=-6.6), 0.99988),  # likewise, with offset slots
    ],
)
def test_a_link_without_a_round_hole_has_a_view(wheel, A):
    """Random sheets that once broke off: a link with a slot alone is measured from its shaft."""
    found = of(Spec(wheel, Drive("side-crank"), Keys("side-crank", A)))
    assert "one piece with its shaft" in {label.text for label in found.labels}
    assert overlaps(found) == []
    assert_measured(found)


def test_dimensions_stay_clear_of_each_other_in_a_narrow_bore(sheets):
    """250 and 141.729 of the turret once met in its bore, arrow on arrow."""
    _, found = sheets("turret")
    texts = {m.label.text for m in found.measures}
    assert {"250", "141.729"} <= texts
    assert crossings(found) == []


def test_a_distance_that_has_no_place_says_what_it_is():
    """A rack of 24 slots is drawn at 1:10: texts of shorter distances are in the way of others."""
    design = Design(geneva_cli.Linear(24), EllipticalGears(eccentricity=0.3))
    notes = {label.text for label in design.sheet(TOLERANCE).labels}
    box = bounds(design.drawing("frame", TOLERANCE).shapes[0])
    assert f"{box.x1 - box.x0:g} wide" in notes
    assert f"{100.0 - box.x0:g} from the left edge to the crank's axis" in notes


def test_a_leader_is_not_drawn_along_an_edge():
    """A line under a text that is nearly in the edge's direction, 1 mm away, is not used."""
    edge = Contour("", (Line((-40.0, 6.0), (40.0, 6.5)),), closed=False)
    board = Board()
    board.draw(edge)
    tries = list(marks.diameter((0.0, 0.0), 1.0, marks.around(), "Ø 2", 2.0))
    leader = board.first(tries).main_lines
    whole = LineString([p for piece in leader for p in piece])
    assert all(whole.distance(shapely.Point(x, 6.0 + (x + 40.0) / 160.0)) > 1.2 for x in (-8, 8))
    shelf = LineString(leader[1])
    assert shelf.distance(LineString(edge.segments[0])) > 1.4


def test_rounding_moves_no_dimension():
    """Rounding once chose the side of a disc's dimension, and turned its text by -360 degrees."""

    def drawn(y):
        view = View("", 1.0)
        view.draw_all([Circle("", (0.0, 0.0), 50.0)])
        view.linear((0.0, 0.0), (-40.0, y), math.atan2(y, -40.0), "40", near=True)
        (one,) = view.measures
        return one

    below, above = drawn(-1e-14), drawn(1e-14)
    assert below.label.at == pytest.approx(above.label.at, abs=1e-9)
    assert abs(below.label.turn) + abs(above.label.turn) < 1e-12
    assert below.turn == pytest.approx(above.turn)


def test_the_comparison_can_fail():
    found = of(Spec(Wheel(6)))
    on = found.measures[0].lines[0].start
    wrong = found._replace(labels=(*found.labels, Label("on a line", on, 2.5)))
    assert [text for text, _ in overlaps(wrong)] != []
    m = found.measures[0]
    with pytest.raises(AssertionError):
        assert_measured(found._replace(measures=(m._replace(value=2.0 * m.value),)))
    twice = (*found.measures, m._replace(label=m.label._replace(text="again")))
    assert ("again", m.label.text) in crossings(found._replace(measures=twice))


@pytest.mark.sampled(64)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_sheets_in_inches(path, sheets):
    """At a scale of the same series; texts stand free, and each is its millimetres over 25.4."""
    design, metric = sheets(path.stem)
    found = design.sheet(TOLERANCE, units="inch")
    assert overlaps(found) == []
    assert beyond(found) == []
    assert_measured(found)
    texts = {label.text for label in found.texts}
    assert "inch, degrees" in texts
    assert "inch, degrees" not in {label.text for label in metric.texts}
    # shorter texts may find a place for a larger scale
    assert found.scale >= metric.scale
    # a gear's module is in millimetres everywhere
    assert not [text for text in texts if re.search(r"\d mm", text) and "m = " not in text]


@pytest.mark.long
def test_fits_and_masses_in_inches():
    """H7 of 24 mm is +21 µm, 0.00083 in; ±0.02 mm is 0.0008 in; a pound is 0.45359237 kg."""
    spec = load(str(repo.DESIGNS / "turret.toml")).spec
    design = Design.of(spec.replace(tolerance=Tolerance(center_distance_mm=0.02)))
    found = design.sheet(TOLERANCE, units="inch")
    texts = {label.text for label in found.texts}
    assert "8× 0.9449 H7 (+0.0008/0)" in texts
    assert "9.8425 ±0.0008" in texts
    rows = design.part_table("parts").to_rows()
    kg = sum(row["mass_kg"] * row["count"] for row in rows if row["mass_kg"])
    assert f"{kg / 0.45359237:.2f} lb" in texts
    milled = Design.of(spec.with_("size.process", "mill")).sheet(TOLERANCE, units="inch")
    assert "Ra 3.2 µm" in {label.text for label in milled.texts}
    # another thread writes its own unit
    assert "mm, degrees" in {label.text for label in design.sheet(TOLERANCE).texts}


def test_a_dxf_in_inches_measures_inches():
    """The factor of each style makes inches of the paper's millimetres."""
    found = load(str(repo.DESIGNS / "turret.toml")).sheet(TOLERANCE, units="inch")
    document = ezdxf.read(io.StringIO("".join(sheet_dxf.chunks(found))))
    measures = [m for m in found.measures if m.kind in sheet_dxf.KINDS]
    dimensions = list(document.modelspace().query("DIMENSION"))
    for dimension, m in zip(dimensions, measures, strict=True):
        if m.kind != "angular":
            factor = document.dimstyles.get(dimension.dxf.dimstyle).dxf.dimlfac
            inches = dimension.get_measurement() * factor
            assert inches == pytest.approx(m.value / 25.4, rel=1e-8)
            assert dimension.dxf.actual_measurement == pytest.approx(m.value / 25.4, rel=1e-12)


def test_refusals():
    slots = Spec(Wheel(6), motion=Motion("cycloidal", ratio="matched"), size=Size(5e7))
    with pytest.raises(GenevaError, match="do not fit on one A1 sheet"):
        Design.of(slots).sheet(1e3)


@pytest.mark.parametrize(
    ("key", "across", "note"),
    [
        # the corners of a hexagon are on a circle 1/cos 30° wider than its flats
        ("wheel_bore=hex", f"Ø {40.0 / math.cos(math.pi / 6.0):.3f}", "hexagon 40 across flats"),
        ("wheel_bore=D", "Ø 40 h6 (0/-0.016)", "flat, 36 to the far side"),
        # DIN 6885-1, 38 to 44 mm: 12 wide, 5 deep in the shaft
        ("wheel_keyway=DIN 6885-1", "Ø 40 h6 (0/-0.016)", "keyway 12 P9, 5 deep"),
    ],
)
def test_a_plain_shaft_says_what_its_section_is(key, across, note):
    """A hexagonal shaft once had the fit of a round one, 46.188 h6, and no word of its flats."""
    sheet = load(str(repo.DESIGNS / "turret.toml"), [f"size.{key}"]).sheet(TOLERANCE)
    texts = [label.text for label in sheet.texts]
    assert across in texts
    assert note in texts[texts.index("6 wheel's shaft") :][:3]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("fit_mm", "bore"), [(0.0, "Ø 20 F7"), (0.1, "Ø 20.1 H7")])
def test_both_rollers_of_a_cam_have_bores_of_one_fit(fit_mm, bore):
    """Those in slot and groove are on pins of 20 mm; a bore that is wider already takes no F7."""
    design = load(str(repo.DESIGNS / "cam-geneva.toml"), [f"size.shaft_fit_mm={fit_mm}"])
    texts = [label.text for label in design.sheet(TOLERANCE).texts]
    assert sum(text.startswith(bore) for text in texts) >= 2
    assert not any("F7" in text and not text.startswith(bore) for text in texts)


@pytest.mark.parametrize("name", ["geneva-stop", "turret", "spherical-z6"])
def test_the_text_of_an_angle_stands_at_its_arc(name, sheets):
    """Half a text's diagonal and 3 mm from it; an arc goes on to a text beyond its legs."""
    _, found = sheets(name)
    angles = [measure for measure in found.measures if measure.kind == "angular"]
    assert angles
    for measure in angles:
        near = min(math.dist(measure.label.middle, p) for p in points(measure.lines[0], 200))
        corner, _, opposite, _ = measure.label.corners
        assert near < 0.5 * math.dist(corner, opposite) + 3.0, measure.label.text


def test_one_radius_is_written_once():
    """The horns of curved slots differ by rounding, at 204.9445 mm."""
    found = load(str(repo.DESIGNS / "sine-group.toml")).sheet(0.001)
    texts = [label.text for label in found.texts]
    assert [text for text in texts if "R 204.94" in text] == ["12× R 204.944"]


@pytest.mark.parametrize("name", ["three-rollers-z4", "two-cranks", "turret"])
def test_reliefs_of_one_size_are_counted(name, sheets):
    """As many as the outline of the disc has arcs about other points than its axis."""
    design, found = sheets(name)
    (outline,) = design.drawing("crank", TOLERANCE).shapes[:1]
    arcs = [piece for piece in outline.segments if isinstance(piece, Arc)]
    reliefs = [arc for arc in arcs if math.hypot(*arc.centre) > 1.0]
    count = f"{len(reliefs)}× " if len(reliefs) > 1 else ""
    assert f"{count}R {number(reliefs[0].radius)}" in [label.text for label in found.texts]
