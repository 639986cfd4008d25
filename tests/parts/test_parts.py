"""Parts as they are written: every design's drawings read back, options, refusals, tables.

Files are read by ``drawing_witness``, which has formulas of its own, and by ezdxf; shapely measures
them. In processes of their own, where the same bytes are looked for, nothing is made once and kept.
"""

import csv
import io
import math
import os
import re
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import repo
from drawing_witness import dxf_shapes, svg_shapes
from shapely.geometry import LineString, Point, Polygon
from typer.testing import CliRunner
from words import load

import geneva_cli
from geneva_cli.cli.app import app
from geneva_cli.motion.mechanism import build
from geneva_cli.verdict.checks import checks

ROOT = repo.ROOT
DESIGNS = {path.stem: path for path in sorted((ROOT / "designs").glob("*.toml"))}
ELSEWHERE = ("spherical-60deg", "spherical-z6")  # spheres
FLAT = [name for name in DESIGNS if name not in ELSEWHERE]
LINKAGES = ("four-bar-z4", "slider-crank")
UNLOCKED = (*LINKAGES, "internal-curved-z8")  # lock_radius_mm = 0
SEVERAL = {"geneva-pair": 2, "carousel": 3, "wandering-hours": 3}  # wheels of an assembly
PAIRED = ("gear-sector",)  # two rollers, one for each end of a step
INTERNAL = ("elliptical-internal", "internal-curved-z8", "internal-z6")
LAYERS = {"WHEEL", "CRANK", "ARM", "LINK", "ROLLER", "BORE", "PITCH", "GROOVE", "FRAME"}
# mm. An svg's last decimal is 1e-9, and its arcs come to ten times that (as in test_dxf.py).
SAME = 2e-8
TOLERANCE = 0.001  # mm, the default of --tolerance
SAGITTA = 1e-4  # mm, of the chords that shapely is given


pytestmark = pytest.mark.usefixtures("made_once")


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


def profile(spec, part, output, *options):
    """A run of `geneva profile`; what is neither success nor a refusal raises."""
    arguments = ["profile", str(spec), "--part", part, "-o", output, *options]
    found = CliRunner().invoke(app, arguments)
    if found.exception is not None and not isinstance(found.exception, SystemExit):
        raise found.exception
    return found


def written(spec, part, output, *options):
    """The text of a file that is written."""
    found = profile(spec, part, output, *options)
    assert found.exit_code == 0, found.output
    assert found.stdout == ""
    return Path(output).read_text(encoding="utf-8")


def refused(found, status, *wants):
    """Exit status and one line that holds all of ``wants``, and nothing else."""
    assert found.exit_code == status, found.output
    assert found.stdout == ""
    (said,) = found.stderr.splitlines()
    for want in wants:
        assert want in said, said
    return said


def spec(text, name="spec.toml"):
    Path(name).write_text(text, encoding="utf-8")
    return name


def size(*lines, wheel="z = 6"):
    return "[wheel]\n" + wheel + "\n[size]\n" + "\n".join(lines) + "\n"


def points(chain, count=None):
    """A chain's points, its last included; so many a piece, or else as many as SAGITTA takes."""
    found = []
    for _, _, point in chain:
        n = count or _chords(point)
        found += [point(i / n) for i in range(n)]
    return [*found, chain[-1][1]]


def _chords(point):
    """How many chords a piece takes: its eighths are nearly parabolas, whose sagitta falls with
    the square of that number; half as much again is to spare."""
    ends = [np.array(point(i / 16)) for i in range(17)]
    eighths = zip(ends[:-2:2], ends[1:-1:2], ends[2::2], strict=True)
    worst = max(math.dist(b, 0.5 * (a + c)) for a, b, c in eighths)
    return 8 * max(1, math.ceil(math.sqrt(1.5 * worst / SAGITTA)))


def ring(chain, count=None):
    return Polygon(points(chain, count)[:-1])


def chains(shapes, layer):
    return [shape for shape in shapes.get(layer, []) if isinstance(shape, list)]


def circles(shapes, layer):
    return [shape for shape in shapes.get(layer, []) if isinstance(shape, tuple)]


def require_end_to_end(chain, close=True):
    """Pieces end to end and, mostly, closed: to SAME, as arcs' ends are computed by the reader."""
    pairs = list(zip(chain, chain[1:], strict=False))
    pairs += [(chain[-1], chain[0])] if close else []
    for one, other in pairs:
        assert math.dist(one[1], other[0]) < SAME


def require_no_doubles(shapes):
    """No piece of no length, and none that lies on another one, either way round."""
    for layer, found in shapes.items():
        seen = set()
        for shape in found:
            if isinstance(shape, tuple):
                keys = [(round(shape[1], 6), *(round(x, 6) + 0.0 for x in shape[0]))]
            else:
                keys = []
                for start, end, point in shape:
                    middle = point(0.5)
                    assert math.dist(start, middle) + math.dist(middle, end) > 1e-9, layer
                    places = [tuple(round(x, 6) + 0.0 for x in p) for p in (start, end, middle)]
                    keys.append((frozenset(places[:2]), places[2]))
            for key in keys:
                assert key not in seen, (layer, key)
                seen.add(key)


def require_sound(shapes, inside=False, wheels=1):
    """One closed contour a part, bores apart; ``inside`` where a wheel has an outer circle."""
    assert set(shapes) <= LAYERS
    require_no_doubles(shapes)
    for layer, found in shapes.items():
        for chain in (shape for shape in found if isinstance(shape, list)):
            require_end_to_end(chain, close=layer != "PITCH")
            if layer != "PITCH":
                assert ring(chain, 24).is_valid, layer
    if "WHEEL" in shapes:
        assert len(chains(shapes, "WHEEL")) == wheels
        assert len(circles(shapes, "WHEEL")) == inside
    assert all(isinstance(shape, tuple) for k in ("BORE", "ROLLER") for shape in shapes.get(k, []))


# 1. Every design


@pytest.mark.sampled(48)
@pytest.mark.parametrize("name", FLAT)
def test_assembly_of_every_design(name):
    """As svg: its shapes are sound, and the parts lie beside each other at input angle 0."""
    path = DESIGNS[name]
    text = written(path, "assembly", "machine.svg")
    shapes = svg_shapes(text)
    wheels = SEVERAL.get(name, 1)
    require_sound(shapes, name in INTERNAL, wheels)
    machine = load(str(path))
    L = machine.center_distance_mm

    root = ElementTree.fromstring(text)
    box = [float(x) for x in root.get("viewBox").split()]
    assert (root.get("width"), root.get("height")) == tuple(f"{x:.9f}mm" for x in box[2:])
    assert "SCALE_BAR" in [element.get("id") for element in root.iter()]

    rollers = machine.spec.drive.rollers
    angles = machine.spec.drive.roller_angles_deg
    count = len(angles) if angles else rollers * len(machine.spec.wheel.steps or [0])
    count *= 1 + (name in PAIRED)
    centres = {tuple(round(x, 6) for x in centre) for centre, _ in circles(shapes, "ROLLER")}
    assert len(centres) == count
    # Input angle 0 is where a roller crosses the line of centres (a linkage's mid-motion is no such
    # place); 1e-6 mm are their rounding here.
    assert any(abs(y) <= 1e-6 for _, y in centres) or name in (*LINKAGES, *PAIRED)

    cranks = chains(shapes, "CRANK")
    cranks = cranks[: len(cranks) // (1 + (name == "geneva-pair"))]  # a first wheel's follow
    dwells = count // (1 + (name in PAIRED))
    # A locking sector for each dwell where the wheel sweeps over the crank's axis.
    assert len(cranks) == 0 if name in UNLOCKED else len(cranks) in (1, dwells)

    wheel = chains(shapes, "WHEEL")[0]
    around, t = ring(wheel, 64), 1e-3 * L  # chords of 64 a piece: far less than that
    if name in INTERNAL:
        ((centre, radius),) = circles(shapes, "WHEEL")
        assert math.dist(centre, (0.0, 0.0)) < 1e-9
        assert Point(centre).buffer(radius, 256).contains(around)
    others = [ring(chain, 64) for chain in cranks]
    others += [Point(centre).buffer(radius) for centre, radius in circles(shapes, "ROLLER")]
    for other in others:
        if name in INTERNAL:
            assert around.buffer(t).contains(other)
        else:
            assert not around.buffer(-t).intersects(other)


# 2. Curves, units, tolerance


def table_of(name, part, *options):
    text = written(DESIGNS[name], part, "table.csv", *options)
    rows = list(csv.DictReader(io.StringIO(text)))
    return [{k: float(v) for k, v in row.items()} for row in rows]


# 3. Parts that are tables, and the groove


@pytest.mark.parametrize(("name", "axes"), [("spherical-z6", 90.0), ("spherical-60deg", 60.0)])
def test_the_slots_of_a_sphere_are_meridians_of_it(name, axes):
    """theory.md 1.3: sin th = sin S sin b, mouth at d = atan2(sin S cos b, cos S), bottom S - th.

    To 1e-9 of degrees: a few roundings of numbers of this size.
    """
    S, b, design = math.radians(axes), math.pi / 6, geneva_cli.load(str(DESIGNS[name]))
    values = design.report.table.to_dict()
    assert values["sizes.sphere_radius_mm"] == design.mechanism.center_distance_mm
    mouth = math.degrees(math.atan2(math.sin(S) * math.cos(b), math.cos(S)))
    bottom = math.degrees(S - math.asin(math.sin(S) * math.sin(b)))
    assert values["sizes.slot_mouth_polar_deg"] == pytest.approx(mouth, abs=1e-9)
    assert values["sizes.slot_bottom_polar_deg"] == pytest.approx(bottom, abs=1e-9)


def bend(one, other):
    """The angle between the end of a piece and the start of the next, degrees."""
    h = 1e-5
    before = [a - b for a, b in zip(one[2](1.0), one[2](1.0 - h), strict=True)]
    after = [a - b for a, b in zip(other[2](h), other[2](0.0), strict=True)]
    turn = math.atan2(after[1], after[0]) - math.atan2(before[1], before[0])
    return abs(math.degrees(math.remainder(turn, math.tau)))


@pytest.mark.long
@pytest.mark.parametrize("curves", ["arcs", "spline"])
def test_groove_of_a_cam(curves):
    name = "cam-geneva"
    text = written(DESIGNS[name], "groove", "groove.dxf", "--curves", curves)
    shapes = dxf_shapes(text)
    assert {k: len(v) for k, v in shapes.items()} == {"GROOVE": 2, "PITCH": 1}
    lines = {}
    for layer, found in shapes.items():
        for chain in found:
            require_end_to_end(chain)
            # closed and smooth: the chords of ``bend`` turn by some 1e-4 degrees along a piece
            assert max(map(bend, chain, [*chain[1:], chain[0]])) < 0.001
            lines.setdefault(layer, []).append(LineString(points(chain)))
    (pitch,) = lines["PITCH"]
    rings = [Polygon(line.coords) for line in (*lines["GROOVE"], pitch)]
    assert all(found.is_valid and found.contains(Point(0.0, 0.0)) for found in rings)

    # In the motion: the table's distance from the crank's axis, and its flanks.
    for row in table_of(name, "groove", "--samples", "181"):
        x, y, R = row["x_mm"], row["y_mm"], row["radius_mm"]
        assert math.hypot(x, y) == pytest.approx(R, abs=1e-9)
        # a ray may slip between two chords that meet on it: the distance is taken instead
        assert pitch.distance(Point(x, y)) < TOLERANCE + SAGITTA
        for side in ("left", "right"):
            flank = Point(row[f"{side}_x_mm"], row[f"{side}_y_mm"])
            near = min(line.distance(flank) for line in lines["GROOVE"])
            assert near < TOLERANCE + SAGITTA
    # All round the flanks are a roller's radius from the pitch line: two tolerances apart.
    r = load(str(DESIGNS[name])).roller_radius_mm
    for chain in shapes["GROOVE"]:
        for p in points(chain, 5):
            assert pitch.distance(Point(p)) == pytest.approx(r, abs=2.0 * TOLERANCE + SAGITTA)


# 4. Refusals

RIM = math.hypot(20.0 * math.cos(math.pi / 4.0), 2.0)  # where the roller enters: see above
JAMS = size(
    "center_distance_mm = 20",
    "roller_radius_mm = 2",
    f"wheel_radius_mm = {RIM + 0.2:.6f}",
    wheel="z = 4",
)
OLD = "the old file, whole\n"


@pytest.mark.long
def test_a_machine_that_jams():
    name = spec(JAMS)
    Path("old.dxf").write_text(OLD, encoding="utf-8")
    said = refused(profile(name, "wheel", "old.dxf"), 1, "spec.toml: not written: ", "--force")
    assert Path("old.dxf").read_text(encoding="utf-8") == OLD
    refused(profile(name, "crank", "new.svg"), 1, "not written")
    assert sorted(os.listdir()) == ["old.dxf", "spec.toml"]

    assert "roller and slot overlap" in said
    # Half a motion is 45 degrees: it collides just before it enters, or just after it has left.
    (at,) = re.findall(r"input angle (-?[\d.]+)°", said)
    assert 45.0 < abs(math.remainder(float(at), 360.0)) < 50.0
    value = float(re.search(r"wheel_radius_mm = ([\d.]+) would free it", said)[1])
    # It frees, and is no smaller than it need be: to a tenth of the change.
    wider = value + 0.1 * (RIM + 0.2 - value)
    rims = [load(name).spec.with_("size.wheel_radius_mm", rim) for rim in (value, wider)]
    rows = [row for rim in rims for row in checks(build(rim)) if row.name == "gap_mm"]
    assert RIM <= value < wider and [row.passes for row in rows] == [True, False]

    forced = profile(name, "wheel", "old.dxf", "--force")
    assert forced.exit_code == 0
    (warning,) = forced.stderr.splitlines()
    assert warning.startswith("spec.toml: warning: ")
    assert "overlap" in warning
    assert chains(dxf_shapes(Path("old.dxf").read_text(encoding="utf-8")), "WHEEL")
