"""OpenSCAD files, read back by a small reader of what they use: areas, heights and positions.

`make cad` gives them to OpenSCAD itself, if that is installed.
"""

import json
import math
import re

import numpy as np
import pytest
import repo
import shapely
import trimesh
from test_mesh import DESIGNS, HOLES, SHAPE

from geneva_cli import Design, External
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.drawing import Drawing
from geneva_cli.geometry.mass import face
from geneva_cli.geometry.plates import Plate, solids
from geneva_cli.output.mesh import scad
from geneva_cli.output.mesh.solids import bodies

NUMBER = r"-?\d+(?:\.\d+)?"


def text_of(drawing):
    return b"".join(scad.data(drawing, "mm")).decode()


def flat(line):
    """A polygon or a moved circle, as OpenSCAD makes it: corners on the circle, from angle 0."""
    if line.startswith("polygon("):
        return shapely.Polygon(json.loads(line.removeprefix("polygon(").removesuffix(");")))
    moved = re.fullmatch(r"(?:translate\((.*?)\) )?circle\(r = (.*), \$fn = (\d+)\);", line)
    x, y = json.loads(moved[1] or "[0, 0]")
    r, n = float(moved[2]), int(moved[3])
    angles = [math.tau * k / n for k in range(n)]
    return shapely.Polygon([(x + r * math.cos(a), y + r * math.sin(a)) for a in angles])


def modules(text):
    """Each module's outline with its holes, and its lower and upper end; plates alone."""
    for name, body in re.findall(r"^module (\w+)\(\) \{\n(.*?)^\}$", text, re.S | re.M):
        if "polyhedron(" in body:
            continue
        one_line = re.sub(r"\[\n\s+", "[", re.sub(r",\n\s+\[", ", [", body))
        outline, *holes = [
            flat(line.strip())
            for line in one_line.splitlines()
            if line.strip().startswith(("polygon", "circle", "translate(["))
            and "extrude" not in line
        ]
        assert ("difference() {" in body) == bool(holes)
        low = re.search(rf"translate\(\[0, 0, ({NUMBER})\]\) linear", body)
        high = re.search(rf"linear_extrude\(height = ({NUMBER})\)", body)
        bottom = float(low[1]) if low else 0.0
        for hole in holes:
            outline = outline.difference(hole)
        yield name, (outline, bottom, bottom + float(high[1]))


def places(text):
    """The module and the matrix of each line that shows one."""
    for line in re.findall(r"^(?:translate|rotate|color|multmatrix).*;$", text, re.M):
        matrix = np.eye(4)
        if moved := re.search(r"translate\((\[.*?\])\) ", line):
            matrix[:3, 3] = json.loads(moved[1])
        if turned := re.search(r"rotate\((.*?)\) ", line):
            turn = math.radians(float(turned[1]))
            c, s = math.cos(turn), math.sin(turn)
            matrix[:2, :2] = ((c, -s), (s, c))
        if whole := re.search(r"multmatrix\((\[\[.*?\]\])\) ", line):
            matrix[:3] = json.loads(whole[1])
        yield re.search(r'color\("#[0-9a-f]{6}"\) (\w+)\(\);$', line)[1], matrix


@pytest.mark.parametrize("tolerance", [1.0, 0.01, 1e-4])
def test_a_plate_has_the_area_of_its_closed_form(tolerance):
    """The walls, 200 mm at most, are within the tolerance; corners have six decimals."""
    plate = Plate("a plate", "WHEEL", SHAPE, HOLES, -3.0, 9.0)
    text = text_of(Drawing("A title", (), solid=plate, tolerance=tolerance))
    assert text.startswith("// A title\n// millimetres\n\n")
    ((name, (outline, low, high)),) = modules(text)
    assert (name, low, high) == ("a_plate", -3.0, 9.0)
    assert outline.is_valid and len(outline.interiors) == 2
    assert outline.area == pytest.approx(face(plate).area, abs=200.0 * (tolerance + 1e-6))


@pytest.mark.sampled(12)
@pytest.mark.parametrize("design", DESIGNS, ids=lambda d: d.stem)
def test_designs_have_their_volumes_at_their_places(design):
    """Solid by solid as the mesh of the same drawing, which trimesh measures."""
    drawing = load(str(design)).drawing("assembly", 0.05)
    text = text_of(drawing)
    shown = dict(modules(text))
    kinds = bodies(drawing, "mm", "STL")
    lines = list(places(text))
    assert len(lines) == len(solids(drawing.shells or drawing.solid))
    at = iter(lines)
    for body in kinds:
        mesh = trimesh.Trimesh(body.surface.corners, body.surface.triangles, process=False)
        for place in body.places:
            name, matrix = next(at)
            assert matrix[:3, :3] == pytest.approx(place.turn, abs=1e-9)
            assert matrix[:3, 3] == pytest.approx(place.shift, abs=1e-6)
        if name in shown:
            outline, low, high = shown[name]
            # both are chords of one tolerance, and differ where a circle's first corner is
            assert outline.area * (high - low) == pytest.approx(mesh.volume, rel=2e-3)
            assert mesh.bounds[:, 2] == pytest.approx([low, high], abs=1e-6)


def test_names_are_names_of_modules():
    drawing = load(str(repo.DESIGNS / "turret.toml")).drawing("assembly", 0.1)
    names = [name for name, _ in modules(text_of(drawing))]
    assert "wheels_shaft" in names and all(re.fullmatch(r"[a-z]\w*", name) for name in names)
    assert scad._names(["2 plates", "2 plates", "'"]) == [
        "part_2_plates",
        "part_2_plates_2",
        "part",
    ]


def test_what_is_no_solid_is_refused():
    with pytest.raises(GenevaError, match="no solid to write as SCAD"):
        list(scad.data(Design(External(4)).drawing("slot", 0.1), "mm"))
    with pytest.raises(GenevaError, match="above 0 mm"):
        list(scad.data(Design(External(4)).drawing("wheel", 0.1)._replace(tolerance=0.0), "mm"))
