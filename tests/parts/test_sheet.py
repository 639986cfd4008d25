"""Drawing sheets: nothing stands on anything else, and the sizes on them are the machine's."""

import io
import math
import re
from functools import cache

import ezdxf
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
    overlaps,
)
from words import Motion, Spec, Wheel

from geneva_cli import load
from geneva_cli.design import Design
from geneva_cli.drawings.sheet.cut import faces
from geneva_cli.drawings.sheet.paper import FORMATS, SCALES
from geneva_cli.drawings.sheet.points import gear_tables, tables
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.placed import in_place
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
