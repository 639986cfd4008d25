"""Meshes, read back by trimesh: closed, oriented, as large as the closed forms of their parts."""

import io
import zipfile
from xml.etree import ElementTree

import numpy as np
import pytest
import repo
import shapely
import shapely.affinity
import trimesh
from drawing_witness import polygon

from geneva_cli import Design, External, Size
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import Plate, Shell, face, solids
from geneva_cli.geometry.shapes import Arc, Circle, Cubic, Line, bounds, closed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.inks import INKS
from geneva_cli.output.mesh_files import stl, threemf
from geneva_cli.output.meshes import DECIMALS, bodies

DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))
NEAR = 10.0**-DECIMALS  # mm: rounding of coordinates
SHAPE = closed(
    "WHEEL",
    [
        Line((0.0, 0.0), (40.0, 0.0)),
        Arc((40.0, 0.0), (40.0, 30.0), 0.4),
        Cubic((40.0, 30.0), (30.0, 36.0), (10.0, 18.0), (0.0, 30.0)),
        Arc((0.0, 30.0), (0.0, 0.0), -0.2),
    ],
)
HOLES = Circle("BORE", (20.0, 15.0), 4.0), Circle("BORE", (32.0, 15.0), 3.0)


def mesh_of(body):
    return trimesh.Trimesh(body.corners, body.triangles, process=False)


def require_closed(mesh):
    """Each side is of two triangles, in opposite senses, and the outside is outside."""
    assert mesh.is_watertight and mesh.is_winding_consistent and mesh.volume > 0.0


def one(plate, tolerance):
    (body,) = bodies(Drawing("", (), solid=plate, tolerance=tolerance), "STL")
    return mesh_of(body)


@pytest.mark.parametrize("tolerance", [1.0, 0.1, 0.01, 1e-4])
def test_a_plate_is_as_large_as_its_closed_form(tolerance):
    """A chord is nearer to its curve than the tolerance: so is each wall, over its whole length."""
    plate = Plate("plate", "WHEEL", SHAPE, HOLES, -3.0, 9.0)
    mesh = one(plate, tolerance)
    require_closed(mesh)
    true, long = face(plate), 200.0  # mm: more than all contours
    assert mesh.volume == pytest.approx(12.0 * true.area, abs=12.0 * long * tolerance)
    assert mesh.center_mass[:2] == pytest.approx(true.centroid, abs=10.0 * tolerance)
    assert mesh.bounds[:, 2].tolist() == [-3.0, 9.0]
    assert mesh.euler_number == 2 * (1 - len(HOLES))  # a handle for each hole


@pytest.mark.sampled(3)
@pytest.mark.parametrize("tolerance", [0.5, 0.01, 1e-4])
def test_chords_keep_the_tolerance(tolerance):
    """Every curve, in thousands of places, is as near to a section of the mesh."""
    mesh = one(Plate("plate", "WHEEL", SHAPE, HOLES, -3.0, 9.0), tolerance)
    cut = shapely.multilinestrings(
        trimesh.intersections.mesh_plane(mesh, (0.0, 0.0, 1.0), (0.0, 0.0, 1.0))[:, :, :2]
    )
    for shape in (SHAPE, *HOLES):
        fine = shapely.points(polygon(shape, 1e-5).exterior.coords)
        assert shapely.distance(fine, cut).max() < tolerance + 2.0 * NEAR


@pytest.mark.parametrize("radius", [6e-9, 1.25e-11])
def test_a_part_thinner_than_the_decimals_is_refused(radius):
    """All corners of a pin of 12 nanometres are one corner; of a thinner one even the outline."""
    pin = Plate("pin", "LINK", Circle("LINK", (0.0, 0.0), radius), (), 0.0, 15.0)
    with pytest.raises(GenevaError, match="pin: its outline and holes leave no wall"):
        list(stl(Drawing("", (), solid=pin, tolerance=0.01)))


@pytest.mark.sampled(14)
@pytest.mark.parametrize("design", DESIGNS, ids=lambda p: p.stem)
def test_every_part_of_every_design(design):
    """Closed, and as large as its closed form, within the tolerance at every wall."""
    tolerance = 0.02
    drawing = load(str(design)).drawing("assembly", tolerance, "spline")
    whole = list(dict.fromkeys(solids(drawing.shells or drawing.solid)))
    for solid, body in zip(whole, bodies(drawing, "STL"), strict=True):
        mesh = mesh_of(body)
        require_closed(mesh)
        if isinstance(solid, Shell):
            require_near_spheres(mesh, solid, tolerance)
            assert mesh.euler_number == 2 * (1 - len(solid.holes))  # no slits between regions
            continue
        true = face(solid)
        walls = mesh.area_faces[abs(mesh.face_normals[:, 2]) < 0.5].sum()
        off = tolerance * walls  # mm³
        assert mesh.volume == pytest.approx(solid.thickness * true.area, abs=off)
        far = max(map(abs, bounds(solid.outline)))
        assert mesh.center_mass[:2] == pytest.approx(
            true.centroid, abs=2.0 * off * far / mesh.volume
        )


def require_near_spheres(mesh, shell, tolerance):
    """Each corner is within the tolerance of one of the spheres, or between them.

    The middle of a face that has three corners near one sphere is as near to it.
    """
    assert mesh.volume == pytest.approx(shell.volume, abs=tolerance * mesh.area)
    far = np.linalg.norm(mesh.vertices, axis=1)
    assert shell.inner - tolerance < far.min() and far.max() < shell.outer + NEAR
    for radius in (shell.inner, shell.outer):
        near = (abs(far[mesh.faces] - radius) < tolerance + NEAR).all(axis=1)
        middles = mesh.vertices[mesh.faces[near]].mean(axis=1)
        assert near.any()
        assert abs(np.linalg.norm(middles, axis=1) - radius).max() < tolerance + NEAR


@pytest.fixture(scope="module")
def small():
    """A crank of several parts, in few triangles."""
    return Design(External(4), size=Size(center_distance_mm=30)).drawing("crank", 0.1)


def test_stl(small):
    mesh = trimesh.load(io.BytesIO(b"".join(stl(small))), file_type="stl")
    volume = sum(solid_volume(one) for one in solids(small.solid))
    assert mesh.volume == pytest.approx(volume, rel=0.02)
    normals = np.cross(*(mesh.triangles[:, k] - mesh.triangles[:, 0] for k in (1, 2)))
    assert (np.einsum("ij,ij->i", normals, mesh.face_normals) > 0.0).all()


def test_3mf(small):
    """Objects in mm with name and colour, an item for each place, and no date."""
    archive = zipfile.ZipFile(io.BytesIO(b"".join(threemf(small))))
    assert {entry.date_time for entry in archive.infolist()} == {(1980, 1, 1, 0, 0, 0)}
    root = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    assert root.get("unit") == "millimeter"
    space = {"m": root.tag[1:].partition("}")[0]}
    colours = [one.get("displaycolor") for one in root.iterfind(".//m:base", space)]
    objects = {one.get("id"): one for one in root.iterfind(".//m:object", space)}
    items = root.findall(".//m:item", space)
    assert len(items) == len(solids(small.solid))
    for solid, item in zip(solids(small.solid), items, strict=True):
        part = objects[item.get("objectid")]
        assert part.get("name") == solid.name
        assert colours[int(part.get("pindex"))] == INKS[solid.layer].rgb.upper()
        corners = [[float(v.get(k)) for k in "xyz"] for v in part.iterfind(".//m:vertex", space)]
        sides = [
            [int(t.get(k)) for k in ("v1", "v2", "v3")]
            for t in part.iterfind(".//m:triangle", space)
        ]
        mesh = trimesh.Trimesh(corners, sides, process=False)
        require_closed(mesh)
        assert mesh.volume == pytest.approx(solid_volume(solid), rel=0.1)
        x = [float(v) for v in item.get("transform").split()]
        assert np.linalg.det(np.reshape(x[:9], (3, 3))) == pytest.approx(1.0, abs=1e-9)


def solid_volume(solid):
    return solid.volume if isinstance(solid, Shell) else solid.thickness * face(solid).area


@pytest.mark.parametrize("written", [stl, threemf])
def test_refused(written):
    with pytest.raises(GenevaError, match="no solid to write"):
        list(written(Design(External(4)).drawing("slot", 0.1)))


def test_a_plate_has_every_part_once_for_each_in_the_machine():
    """On z = 0 and apart: no two outlines meet."""
    made = load(str(repo.DESIGNS / "side-crank-z6.toml"))
    drawing = made.drawing("plate", 0.1)
    laid = [
        shapely.affinity.translate(polygon(m.part.outline, 0.1), *m.at)
        for m in drawing.solid.members
    ]
    rows = made.part_table("parts").to_rows()
    assert len(laid) == sum(row["count"] for row in rows if row["row"] == "part")
    assert all(m.part.low == 0.0 for m in drawing.solid.members)
    for i, a in enumerate(laid):
        assert a.bounds[0] > 4.9 and a.bounds[1] > 4.9
        assert all(a.distance(b) > 4.9 for b in laid[:i])
