"""Holes across a plate's axis in all solids: volumes by integrals, meshes by trimesh, edges of STEP
files on both cylinders. `tests/stress/solids_in_cad.py` has a CAD kernel read such files.
"""

import math

import numpy as np
import pytest
import trimesh
from scipy.integrate import dblquad
from step_witness import File

from geneva_cli import Design, External, Size
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.mass import mass_properties
from geneva_cli.geometry.plates import Plate
from geneva_cli.geometry.round_holes import CrossHole
from geneva_cli.geometry.shapes import ORIGIN, Circle, Line, closed
from geneva_cli.geometry.sheet import Drawing
from geneva_cli.output.mesh.solids import bodies
from geneva_cli.output.step import chunks
from geneva_cli.parts.outlines.wheel_circles import wheel_hub

BORES = [{}, {"wheel_bore": "D"}, {"wheel_bore": "hex"}, {"wheel_keyway": "DIN 6885-1"}]


def hub_with(**size):
    """The wheel's hub of 30 mm and 10 mm long, on a bore of 16 mm, with an M4 set screw."""
    keys = {"wheel_hub_mm": 30.0, "wheel_bore_mm": 16.0, "wheel_screw_mm": 4.0} | size
    parts = Design(External(6), size=Size(**keys)).parts.outlines
    return wheel_hub(parts.assembly, parts.sizes)


def drawing(plate, tolerance=0.001):
    return Drawing("", (plate.outline, *plate.holes), solid=plate, tolerance=tolerance)


def start_of(size, y):
    """Where the bore's wall is at a distance y beside the hole's axis."""
    return {"D": 0.8 * 8.0, "hex": 8.0}.get(size.get("wheel_bore"), math.sqrt(64.0 - y * y))


@pytest.mark.parametrize("size", BORES)
def test_its_volume_and_inertia(size):
    """Integrals over the disc of 3.3 mm (ISO 2306) from the bore's wall to the hub's circle."""
    hub, r = hub_with(**size), 1.65
    (hole,) = hub.cross
    assert (hole.radius, hole.height) == (pytest.approx(r), -5.0)

    def over(power, y_power):
        def inner(t, s):  # y = s sin t keeps the integrand smooth to the disc's edge
            y = s * math.sin(t)
            high, low = math.sqrt(15.0**2 - y * y), start_of(size, y)
            return s * (high ** (power + 1) - low ** (power + 1)) / (power + 1) * y**y_power

        return dblquad(inner, 0.0, r, 0.0, math.tau, epsabs=1e-13, epsrel=1e-13)[0]

    whole, drilled = mass_properties(hub._replace(cross=()), 1e9), mass_properties(hub, 1e9)
    assert whole.mass_kg - drilled.mass_kg == pytest.approx(over(0, 0), rel=1e-11)
    moved = drilled.mass_kg * np.array(drilled.centroid_mm)
    moved -= whole.mass_kg * np.array(whole.centroid_mm)
    ahead = np.array((math.cos(hole.turn), math.sin(hole.turn)))
    assert moved == pytest.approx(-over(1, 0) * ahead, rel=1e-9, abs=1e-9)
    taken = 1e6 * (whole.inertia_kgm2 - drilled.inertia_kgm2)
    assert taken == pytest.approx(over(2, 0) + over(0, 2), rel=1e-10)


@pytest.mark.parametrize("size", BORES)
@pytest.mark.parametrize("tolerance", [0.3, 0.001])
def test_meshes_are_closed(size, tolerance):
    """Volumes differ by the chords alone, whose areas are less than a perimeter by the sagitta."""
    hub = hub_with(**size)
    (body,) = bodies(drawing(hub, tolerance), "mm", "STL")
    mesh = trimesh.Trimesh(*body.surface, process=False)
    assert mesh.is_watertight and mesh.is_winding_consistent and mesh.is_volume
    volume = 1e9 * mass_properties(hub, 1.0).mass_kg
    beside = tolerance * (math.pi * (30.0 + 16.0) * 10.0 + math.pi * 3.3 * 7.0)
    assert mesh.volume == pytest.approx(volume, abs=beside)
    assert mesh.euler_number == -2  # of a body with two handles: the bore, and the hole into it


@pytest.mark.sampled(4)
@pytest.mark.parametrize("size", BORES)
def test_edges_of_a_step_file_are_on_both_faces(size):
    """Splines, nearer to the cylinder of the hole and to the wall than the file's 1e-6 mm."""
    hub = hub_with(**size)
    (hole,) = hub.cross
    file = File("".join(chunks(drawing(hub), "mm")))
    splines = [file.values(n) for n in file.all("B_SPLINE_CURVE_WITH_KNOTS")]
    assert len(splines) == 2
    for number, spline in enumerate(splines):
        poles = np.array([file.point(pole) for pole in spline[2]])
        counts, knots = np.array(spline[6]), np.array(spline[7], dtype=float)
        whole = np.repeat(knots, counts.astype(int))
        points = np.array([bspline(whole, poles, t) for t in np.linspace(0.0, 1.0, 997)])
        x, y = np.array([hole.seen(p[:2]) for p in points]).T
        assert np.hypot(y, points[:, 2] - hole.height) == pytest.approx(1.65, abs=1e-7)
        along = np.array([hole.seen(ORIGIN)[0]])
        walls = [start_of(size, v) if number == 0 else math.sqrt(225.0 - v * v) for v in y]
        assert x - along == pytest.approx(np.array(walls), abs=1e-7)


def bspline(knots, poles, t):
    """A cubic's point by de Boor's recursion."""
    k = min(int(np.searchsorted(knots, t, "right")) - 1, len(knots) - 5)
    d = [poles[k - 3 + j] for j in range(4)]
    for r in range(1, 4):
        for j in range(3, r - 1, -1):
            low, high = knots[k - 3 + j], knots[k + 1 + j - r]
            share = (t - low) / (high - low)
            d[j] = (1.0 - share) * d[j - 1] + share * d[j]
    return d[3]


def test_a_hole_through_flat_walls_is_a_cylinder():
    square = closed(
        "ARM",
        [
            Line((0.0, 0.0), (9.0, 0.0)),
            Line((9.0, 0.0), (9.0, 9.0)),
            Line((9.0, 9.0), (0.0, 9.0)),
            Line((0.0, 9.0), (0.0, 0.0)),
        ],
    )
    plate = Plate("block", "ARM", square, (), 0.0, 8.0, (CrossHole((4.0, 4.0), 0.0, 4.0, 2.0),))
    volume = 9.0 * 9.0 * 8.0 - math.pi * 4.0 * 9.0
    assert 1e9 * mass_properties(plate, 1.0).mass_kg == pytest.approx(volume, rel=1e-14)
    off = plate._replace(cross=(CrossHole((4.0, 8.0), 0.0, 4.0, 2.0),))
    with pytest.raises(GenevaError, match="a hole of 4 mm across the axis cuts an edge"):
        mass_properties(off, 1.0)


def test_a_flat_too_narrow_for_its_screw_is_refused():
    """A flat of 0.5 mm on a shaft of 5 mm is 3 mm wide: M3 has a hole of 2.5 mm, M4 of 3.3."""
    keys = {"wheel_bore": "D", "wheel_bore_mm": 5.0, "wheel_hub_mm": 20.0}
    assert hub_with(**keys, wheel_screw_mm=3.0).cross[0].radius == 1.25
    with pytest.raises(GenevaError, match=r"its hole of 3\.3 mm is too wide for the bore"):
        hub_with(**keys, wheel_screw_mm=4.0)
    with pytest.raises(GenevaError, match="no such metric screw; use 4"):
        hub_with(wheel_screw_mm=4.2)
    assert Circle("HUB", ORIGIN, 15.0) == hub_with().outline
