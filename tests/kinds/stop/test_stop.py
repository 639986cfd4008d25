"""A Geneva stop: its closed form against the collision engine, and against polygons."""

import json
import math
import re

import numpy as np
import pytest
import repo
from drawing_witness import polygon, vertices
from shapely.affinity import rotate, translate
from typer.testing import CliRunner

from geneva_cli import Crank, Design, External, Limits, Load, Size
from geneva_cli.cli.app import app
from geneva_cli.drives.side_crank import SideCrank
from geneva_cli.errors import GenevaError
from geneva_cli.kinds.stop.parts import clearances_before, wheel_stop
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search

STOPPED = {z: Design(External(z, stop=True)) for z in (3, 4, 5, 6, 8, 12)}


def stops_of(design):
    """The stops of a design whose parts can be built."""
    stop = wheel_stop(design.parts.outlines)
    assert stop is not None
    return stop


@pytest.mark.parametrize("z", STOPPED)
def test_the_collision_engine_touches_first_at_the_closed_form(z):
    """Bisection of the engine's gap between free and blocked, at both ends."""
    outlines, stop = STOPPED[z].parts.outlines, stops_of(STOPPED[z])
    gaps = Gaps(outlines.assembly, outlines.sizes, outlines.wheel, outlines.crank)
    for sense, end in ((1.0, stop.last_deg), (-1.0, stop.first_deg)):
        low, high = end - 5.0 * sense, end + 1.0 * sense  # degrees
        for _ in range(50):
            middle = 0.5 * (low + high)
            gap = gaps.locking(gaps.pose(np.array([middle - stop.drawn_deg])))[0]
            low, high = (middle, high) if gap > 0.0 else (low, middle)
        # 1e-12 L of rounding in a gap that falls by half of L a radian
        assert low == pytest.approx(end, abs=1e-9)


@pytest.mark.parametrize("z", STOPPED)
def test_polygons_are_apart_until_the_stop_and_overlap_beyond(z):
    """Dense polygons, placed by the wheel's and the crank's own formulas (psi = atan2)."""
    outlines, stop = STOPPED[z].parts.outlines, stops_of(STOPPED[z])
    wheel = polygon(outlines.wheel, 1e-4)
    (crank,) = (polygon(one, 1e-4) for one in outlines.crank)
    l, steps = math.sin(math.pi / z), z - 1 - z // 2  # the last engagement of the drawings

    def overlap_mm2(a):
        psi = math.atan2(l * math.sin(a), 1.0 - l * math.cos(a)) + math.tau * steps / z
        turned = rotate(wheel, psi, origin=(0.0, 0.0), use_radians=True)
        return turned.intersection(
            translate(rotate(crank, math.pi - a, origin=(0.0, 0.0), use_radians=True), 100.0)
        ).area

    entry = math.pi / z - 0.5 * math.pi
    end = math.radians(stop.crank_deg)
    # chords of 1e-4 mm leave slivers below 1e-3 mm²
    assert max(overlap_mm2(a) for a in np.linspace(entry, end, 25)) < 1e-2
    assert overlap_mm2(end + math.radians(1.0)) > 5.0 * overlap_mm2(end) + 1e-3


@pytest.mark.parametrize("z", STOPPED)
def test_the_lever_is_the_rate_at_which_the_gap_closes(z):
    """Virtual work: the gap falls by h per radian of the crank, wherever the wheel is."""
    stop, step = stops_of(STOPPED[z]), 0.5  # degrees, between positions of the way to a stop
    way = clearances_before(STOPPED[z].parts.outlines, stop)
    for closing in way:
        near, far = closing[-2], closing[-3]
        # the slope at the stop from two gaps: the curvature cancels, the third order is 1e-4
        rate = (4.0 * near - far) / (2.0 * math.radians(step))
        assert rate == pytest.approx(stop.lever_mm, rel=1e-4)


def test_a_watch_makes_four_turns_and_what_lies_beyond():
    """Five slots by hand: rk = 48.78 and the rim 81.06 mm at L = 100 give gamma = 53.45 deg."""
    d = STOPPED[5]
    stop, sizes = stops_of(d), d.parts.sizes
    gamma = math.acos((100.0**2 + sizes.lock**2 - sizes.rim**2) / (200.0 * sizes.lock))
    beyond = 2.0 * (54.0 - math.degrees(gamma))  # the arc of the relief begins at alpha_e = 54
    assert stop.turns == pytest.approx(4.0 + beyond / 360.0, abs=1e-12)
    assert stop.turns == pytest.approx(4.003, abs=5e-4)


def test_force_and_stress_by_hand():
    """F = T/h, and Hertz of steel on steel, 0.418 sqrt(F E/(b R))."""
    size = Size(face_width_mm=10.0, lock_edge_mm=1.0)
    d = Design(External(5, stop=True), size=size, load=Load(winding_torque_Nm=2.0))
    values = d.report.table.to_dict()
    force = 2000.0 / stops_of(d).lever_mm
    assert values["stop.force_N"] == pytest.approx(force, rel=1e-12)
    radius = 1.0 / (1.0 + 1.0 / d.parts.sizes.rim)
    usual = 0.418 * math.sqrt(force * 210e3 / (10.0 * radius))
    assert values["stop.contact_stress_MPa"] == pytest.approx(usual, rel=2e-3)  # 0.418 has 3 digits


@pytest.mark.usefixtures("no_advice")
def test_checks_can_fail():
    limits, load = Limits(stop_stress_max_MPa=100.0), Load(winding_torque_Nm=2.0)
    sharp = Design(External(5, stop=True), load=load, limits=limits, size=Size(face_width_mm=10.0))
    by_name = {check.name: check for check in sharp.checks}
    assert by_name["stop_stress_max_MPa"].passes is None
    rounded = Size(face_width_mm=10.0, lock_edge_mm=0.1)
    d = Design(External(5, stop=True), load=load, limits=limits, size=rounded)
    by_name = {check.name: check for check in d.checks}
    assert by_name["stop_stress_max_MPa"].passes is False
    assert by_name["stop_turns"].passes
    assert by_name["stop_overlap_mm"].passes
    rim = sharp.parts.sizes.rim
    for overlap_mm, failing in (
        (0.1, ["stop_overlap_mm"]),
        (1e-5, ["stop_turns", "stop_overlap_mm"]),
    ):
        small = Size(lock_radius_mm=100.0 - rim + overlap_mm)
        checks = Design(External(5, stop=True), size=small).checks
        assert [c.name for c in checks if c.passes is False and "stop" in c.name] == failing


def test_a_drive_behind_the_crank_moves_the_stops_of_the_input():
    plain, quick = STOPPED[5], Design(External(5, stop=True), SideCrank(A=0.3))
    one, other = stops_of(plain), stops_of(quick)
    assert other.crank_deg == pytest.approx(one.crank_deg, abs=1e-12)
    # near mid-motion a side-crank's input turns 1 + A times as far as its crank
    assert other.last_deg - 1440.0 == pytest.approx(1.3 * one.crank_deg, rel=1e-3)


@pytest.mark.parametrize(
    ("build", "words"),
    [
        (lambda: Design(External(5, stop=True), Crank(rollers=2)).mechanism, "one roller"),
        (lambda: Design(External(5, offset_mm=5.0, stop=True)).mechanism, "radial slots"),
        (
            lambda: Design(External(5, stop=True), size=Size(lock_radius_mm=0.0)).mechanism,
            "locking disc",
        ),
        (lambda: Design(External(5), load=Load(winding_torque_Nm=1.0)).mechanism, "stop = true"),
        (lambda: Design(External(5, stop=True)).motion(turns=4), "at most 3"),
        (lambda: External(5, stop=1), "true or false"),
    ],
)
def test_what_has_no_stop_is_refused(build, words):
    with pytest.raises(GenevaError, match=words):
        build()


def test_check_shows_both_ends_and_the_page_goes_back_and_forth(tmp_path):
    spec = str(repo.DESIGNS / "geneva-stop.toml")
    shown = CliRunner().invoke(app, ["check", spec])
    assert shown.exit_code == 0
    assert "blocks the crank at -0.8219 and 1440.82°" in " ".join(shown.stdout.split())
    file = tmp_path / "page.html"
    assert CliRunner().invoke(app, ["animate", spec, "-o", str(file)]).exit_code == 0
    data = re.search(r'type="application/json">(.*?)</script>', file.read_text(), re.DOTALL)
    scene = json.loads(data[1])
    low, high = scene["stops"]
    assert high - low == pytest.approx(4.004566 * 360.0, abs=1e-3)
    # the turn of the page, from the middle engagement's entry, lies between the stops
    assert low < 0.0
    assert high > scene["turn"]


def test_the_wheel_as_cut_has_one_convex_face():
    """Only the face reaches the rim between two mouths, opposite the slot ahead."""
    for z, design in STOPPED.items():
        points = np.array(vertices(design.parts.outlines.wheel, 1e-3))
        ahead = np.mod(np.arctan2(points[:, 1], points[:, 0]), math.tau)
        rim = design.parts.sizes.rim
        for k in range(z):
            middle = (2 * k + 1) * math.pi / z
            far = np.hypot(*points[np.abs(ahead - middle) < 0.3 * math.pi / z].T).max()
            assert (far > rim - 1e-3) == (k == z // 2)


@pytest.mark.long
def test_synth_grants_turns():
    frame = Design(External(5, stop=True)).spec
    rows = search(read_target(z="5..8", frame=frame, subject_to=["stop.turns >= 6"])).rows
    assert rows
    for row in rows:
        assert row.spec.wheel.stopped
        assert row.spec.wheel.z >= 7  # z - 1 turns, and a little
    for wrong in ({"internal": True}, {"rollers": 2}):
        with pytest.raises(GenevaError, match="the spec has a stop"):
            read_target(frame=frame, **wrong)
