"""Drawing sheets: nothing stands on anything else, and the sizes on them are the machine's."""

import re
from functools import cache

import pytest
import repo
from drawing_witness import vertices
from shapely.geometry import LineString, Polygon
from sheet_witness import assert_as_listed, assert_measured, beyond, crossings, overlaps
from words import Spec, Wheel

from geneva_cli import load
from geneva_cli.design import Design
from geneva_cli.drawings.sheet.machine_sheet import cut_faces
from geneva_cli.drawings.sheet.paper import FORMATS, SCALES
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import in_place
from geneva_cli.spec.tables import RollerMaterial, Size, TitleBlock, WheelMaterial

pytestmark = pytest.mark.usefixtures("made_once")
NO_SHEET = ("linear", "spherical-60deg", "spherical-z6", "epicyclic-z4", "epicyclic-soft-z6")
NO_SHEET += ("behind-gears", "elliptical-gears", "elliptical-internal", "noncircular-gears")
NO_SHEET += ("gear-sector", "cam-geneva")
DESIGNS = [path for path in sorted(repo.DESIGNS.glob("*.toml")) if path.stem not in NO_SHEET]
TOLERANCE = 0.05  # mm: coarse walls are quick, and look the same on paper


def of(spec, tolerance=TOLERANCE):
    return Design.of(spec).sheet(tolerance)


@pytest.fixture(scope="module")
def sheets():
    """A design's sheet by its name, each made once."""

    @cache
    def made(name):
        design = load(str(repo.DESIGNS / f"{name}.toml"))
        return design, design.sheet(TOLERANCE * min(1.0, design.mechanism.center_distance_mm / 50))

    return made


@pytest.mark.long
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_no_text_of_a_design_stands_on_anything(path, sheets):
    design, found = sheets(path.stem)
    assert overlaps(found) == []
    assert beyond(found) == []
    # a bore beside others, or a line to a recess's centre, may leave no other place
    assert len(crossings(found)) <= 2
    assert (found.width, found.height) in FORMATS.values()
    assert found.scale in SCALES
    assert_measured(found)
    # the centre distance is on it, as the machine has it
    L = f"{design.mechanism.center_distance_mm:.3f}".rstrip("0").rstrip(".")
    assert any(m.label.text.startswith(f"L = {L}") for m in found.measures)
    assert_as_listed(found, list(design.part_table("parts").to_rows()), 2e-3)


@pytest.mark.parametrize("name", ["linear", "spherical-60deg", "epicyclic-z4", "cam-geneva"])
def test_racks_spheres_gears_and_grooves_have_no_sheet(name):
    with pytest.raises(GenevaError, match="no sheet for"):
        load(str(repo.DESIGNS / f"{name}.toml")).sheet()


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


FIELDS = ("drawing number", "revision", "date", "author", "roughness")


def under(found, heading):
    """The text of the title block's field with a heading; None if it is empty."""
    at = next(label.at for label in found.labels if label.text == heading)
    below = (at[0], pytest.approx(at[1] - 5.4))
    return next((label.text for label in found.labels if label.at == below), None)


@pytest.mark.long
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


@pytest.mark.long
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_each_item_of_the_list_has_one_balloon(path, sheets):
    design, found = sheets(path.stem)
    rows = [row for row in design.part_table("parts").to_rows() if row["row"] == "part"]
    # a circle of two arcs about a number, with a leader
    circled = [m.label.text for m in found.measures if len(m.main_lines) == 3]
    assert sorted(map(int, circled)) == list(range(1, len(rows) + 1))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", ["turret", "internal-z6", "side-crank-z6"])
def test_the_section_shows_what_the_plane_of_the_axes_cuts(name, sheets):
    """Against the polygons of the plates at their places, cut by a line in shapely."""
    parts = sheets(name)[0].parts.flat.within(TOLERANCE, "arcs")
    cut = cut_faces(parts.members, 1.0)
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
