"""Chamfers and roundings in solids: volumes in closed form and by trimesh, insets by shapely.

OpenCASCADE reads such files in `tests/stress/solids_in_cad.py`.
"""

import math

import numpy as np
import pytest
import trimesh
from drawing_witness import polygon
from sampling import some
from step_witness import File

from geneva_cli import Design, External, Internal, Size
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.inset import inset, lines_and_arcs
from geneva_cli.geometry.mass import mass_properties
from geneva_cli.geometry.moments import with_material_left
from geneva_cli.geometry.plates import Edge, Plate, plates
from geneva_cli.geometry.shapes import Arc, Circle, Cubic, Line, as_contour, closed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.meshes import bodies
from geneva_cli.output.step import chunks

CUT = 0.5  # mm
KINDS = [Edge(CUT), Edge(CUT, rounded=True)]


def design_of(gearing, edge=KINDS[0], **size):
    return Design(gearing, size=Size(**{edge.key: edge.size}, **size))


def volume(plate):
    return 1e9 * mass_properties(plate, 1.0).mass_kg


def drawing(plate, tolerance=0.001):
    return Drawing("", (plate.outline, *plate.holes), solid=plate, tolerance=tolerance)


def test_rounds_and_blocks_in_closed_form():
    """A disc loses a ring with a triangle's section, by Pappus; a block two frusta's rest."""
    disc = Plate("", "ARM", Circle("", (3.0, 1.0), 20.0), (Circle("", (3.0, 1.0), 8.0),), 0.0, 9.0)
    ring = math.tau * 0.5 * CUT**2 * ((20.0 - CUT / 3.0) + (8.0 + CUT / 3.0))
    cut = disc._replace(edge=Edge(CUT))
    assert volume(cut) == pytest.approx(volume(disc) - 2.0 * ring, rel=1e-13)
    corners = [(0.0, 0.0), (30.0, 0.0), (30.0, 10.0), (0.0, 10.0)]
    sides = [Line(p, q) for p, q in zip(corners, [*corners[1:], corners[0]], strict=True)]
    block = Plate("", "ARM", closed("", sides), (), 0.0, 6.0, edge=Edge(CUT))
    bottom, middle, top = ((30.0 - 2.0 * s) * (10.0 - 2.0 * s) for s in (0.0, 0.5 * CUT, CUT))
    frustum = CUT / 6.0 * (top + 4.0 * middle + bottom)  # Simpson's rule is exact here
    assert volume(block) == pytest.approx(5.0 * 300.0 + 2.0 * frustum, rel=1e-13)
    # A rounding leaves a square without its quarter of a circle, whose centroid is 4 r/(3 pi) from
    # the middle. Its depth s at the height h is r - sqrt(r² - h²), and mitres in the corners take
    # the integral of (30 - 2 s) (10 - 2 s).
    left, quarter = CUT**2 * (1.0 - 0.25 * math.pi), 0.25 * math.pi * CUT**2
    off = (0.5 * CUT**3 - quarter * CUT * (1.0 - 4.0 / (3.0 * math.pi))) / left
    ring = math.tau * left * ((20.0 - off) + (8.0 + off))
    cut = disc._replace(edge=Edge(CUT, rounded=True))
    assert volume(cut) == pytest.approx(volume(disc) - 2.0 * ring, rel=1e-13)
    layer = 300.0 * CUT - 80.0 * left + 4.0 * CUT**3 * (5.0 / 3.0 - 0.5 * math.pi)
    cut = block._replace(edge=Edge(CUT, rounded=True))
    assert volume(cut) == pytest.approx(5.0 * 300.0 + 2.0 * layer, rel=1e-13)


@pytest.mark.long
@pytest.mark.parametrize("gearing", [External(6), Internal(6), External(4)])
def test_insets_are_those_of_shapely(gearing):
    design = Design(gearing)
    for part in ("wheel", "crank", "arm"):
        for plate in plates(design.drawing(part).solid):
            for k, shape in enumerate((plate.outline, *plate.holes)):
                if isinstance(shape, Circle):
                    continue
                own = with_material_left(shape, k == 0)
                inner = inset(lines_and_arcs(own), "", CUT)
                whole = polygon(own, 1e-5)
                found = polygon(inner, 1e-5)
                wanted = whole.buffer(-CUT if k == 0 else CUT, quad_segs=2000, join_style="mitre")
                assert found.is_valid
                assert found.symmetric_difference(wanted).area < 3e-5 * whole.length


@pytest.mark.sampled(4)
@pytest.mark.parametrize("gearing", [External(6), Internal(6)])
@pytest.mark.parametrize("tolerance", some([0.05, 0.0005], [0.05]))
@pytest.mark.parametrize("edge", KINDS)
def test_meshes_are_closed(gearing, tolerance, edge):
    """Volume and inertia about the axis agree within the chords."""
    for part in ("wheel", "arm", "crank"):
        for plate in plates(design_of(gearing, edge).drawing(part).solid):
            assert plate.edge == edge
            (body,) = bodies(drawing(plate, tolerance), "STL")
            mesh = trimesh.Trimesh(body.corners, body.triangles, process=False)
            assert mesh.is_watertight and mesh.is_winding_consistent
            around = mesh.area * tolerance
            assert mesh.volume == pytest.approx(volume(plate), abs=around)
            centre, far = mesh.center_mass, np.hypot(*mesh.vertices[:, :2].T).max()
            polar = mesh.moment_inertia[2, 2] + mesh.volume * (centre[0] ** 2 + centre[1] ** 2)
            inertia = 1e15 * mass_properties(plate, 1.0).inertia_kgm2
            assert polar == pytest.approx(inertia, abs=around * far * far)


@pytest.mark.long
def test_faces_of_a_step_file():
    """Each piece of a contour has a wall and two chamfers: a plane or a cone, of 45 degrees."""
    (wheel,) = plates(design_of(External(6)).drawing("wheel").solid)
    file = File("".join(chunks(drawing(wheel))))
    pieces = [piece for shape in (wheel.outline, *wheel.holes) for piece in lines_and_arcs(shape)]
    arcs = [piece for piece in pieces if isinstance(piece, Arc)]
    assert len(file.all("ADVANCED_FACE")) == 3 * len(pieces) + 2
    cones = [file.values(n) for n in file.all("CONICAL_SURFACE")]
    assert len(cones) == 2 * len(arcs)
    assert [angle for *_, angle in cones] == pytest.approx([0.25 * math.pi] * len(cones), abs=1e-15)
    radii = sorted(radius for _, _, radius, _ in cones)
    assert radii == pytest.approx(sorted(arc.radius for arc in arcs for _ in "12"), rel=1e-9)


def test_chamfers_that_do_not_fit():
    """A rounding of 0.3 mm is narrower than 0.5, and a spline has no parallel spline."""
    half = [Arc((1.0, 0.3), (0.0, 0.0), 0.3), Line((0.0, 0.0), (1.0, -9.0))]
    sharp = closed("ARM", [*half, Line((1.0, -9.0), (1.0, 0.3))])
    with pytest.raises(GenevaError, match=r"edge_chamfer_mm = 0\.5: it is wider than a rounding"):
        volume(Plate("", "ARM", sharp, (), 0.0, 5.0, edge=Edge(CUT)))
    bent = Cubic((9.0, 9.0), (6.0, 12.0), (3.0, 6.0), (0.0, 9.0))
    sides = [
        Line((0.0, 9.0), (0.0, 0.0)),
        Line((0.0, 0.0), (9.0, 0.0)),
        Line((9.0, 0.0), (9.0, 9.0)),
    ]
    wavy = Plate("", "ARM", closed("ARM", [*sides, bent]), (), 0.0, 5.0, edge=Edge(CUT))
    with pytest.raises(GenevaError, match="a spline has no parallel spline"):
        "".join(chunks(drawing(wavy)))
    thin = Plate("spacer", "ARM", Circle("", (0.0, 0.0), 9.0), (), 0.0, 1.0, edge=Edge(CUT))
    with pytest.raises(GenevaError, match="the spacer is 1 mm thick"):
        "".join(chunks(drawing(thin)))


@pytest.mark.usefixtures("no_advice")
def test_a_chamfer_wider_than_half_a_wall_fails():
    """Of a washer with a wall of 4 mm, and of an arm that is half an eye narrower than it."""
    washer = Plate(
        "washer", "ARM", Circle("", (0.0, 0.0), 9.0), (Circle("", (0.0, 0.0), 5.0),), 0, 9
    )
    assert volume(washer._replace(edge=Edge(1.99))) < volume(washer)
    with pytest.raises(GenevaError, match=r"the washer has a wall of 4 mm; it must be below 2"):
        volume(washer._replace(edge=Edge(2.0)))
    burst = washer._replace(holes=(Circle("", (0.0, 5.0), 5.0),), edge=Edge(0.1))
    with pytest.raises(GenevaError, match=r"0\.1: holes of the washer leave no wall to round"):
        volume(burst)  # its hole breaks through by 1 mm; no chamfer is below that
    wide = Design(External(6), size=Size(edge_chamfer_mm=1.5))
    (failed,) = [check for check in wide.checks if check.passes is False]
    assert failed.name == "parts" and "edge_chamfer_mm = 1.5: the arm has a wall" in failed.why
    with pytest.raises(GenevaError, match="the arm has a wall of"):
        list(chunks(wide.drawing("arm")))


@pytest.mark.long
def test_roundings_of_a_step_file():
    """A cylinder over each line and a torus over each arc; the material is inside of their tube."""
    (wheel,) = plates(design_of(External(6), KINDS[1]).drawing("wheel").solid)
    file = File("".join(chunks(drawing(wheel))))
    pieces = [piece for shape in (wheel.outline, *wheel.holes) for piece in lines_and_arcs(shape)]
    arcs = [piece for piece in pieces if isinstance(piece, Arc)]
    assert len(file.all("ADVANCED_FACE")) == 3 * len(pieces) + 2
    tori = [file.values(n) for n in file.all("TOROIDAL_SURFACE")]
    tori += [file.values(n) for n in file.all("DEGENERATE_TOROIDAL_SURFACE")]
    assert len(tori) == 2 * len(arcs)
    assert {minor for _, _, _, minor, *_ in tori} == {CUT}
    outer = plates(design_of(External(6)).drawing("wheel").solid)[0]
    sides = [
        with_material_left(as_contour(s), i == 0)
        for i, s in enumerate((outer.outline, *outer.holes))
    ]
    wanted = [
        arc.radius - math.copysign(CUT, arc.bulge)
        for side in sides
        for arc in lines_and_arcs(side)
        if isinstance(arc, Arc)
    ]
    majors = sorted(major for _, _, major, *_ in tori)
    assert majors == pytest.approx(sorted(one for one in wanted for _ in "12"), rel=1e-9)
