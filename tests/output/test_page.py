"""The page on which a machine turns: its script puts the wheel where the core has it."""

import json
import math
import re
from functools import cache

import numpy as np
import pytest
import repo
from py_mini_racer import MiniRacer

from geneva_cli import load
from geneva_cli.geometry.shapes import Circle
from geneva_cli.motion.pivots import Joint
from geneva_cli.output import page
from geneva_cli.output.scene import value_at
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.turn.gaps import Gaps
from geneva_cli.parts.turn.stops import Pose
from geneva_cli.study.animation.animated_turn import MachineTurn
from geneva_cli.study.animation.turning_scene import scene

pytestmark = pytest.mark.usefixtures("made_once")
DESIGNS = sorted(design.stem for design in repo.DESIGNS.glob("*.toml"))
# What the page promises: its series keep to 1e-7, and 10 digits of an angle of some turns to 1e-8.
ANGLE = 1e-6
# of the picture's size: a hundredth of a pixel
PLACE = 1e-5


@cache
def design_of(name):
    return load(str(repo.DESIGNS / f"{name}.toml"))


@cache
def text_of(name):
    return "".join(page.chunks(scene(design_of(name))))


def script(name):
    """The page's own script and data in an engine of its own."""
    return script_of(text_of(name))


def script_of(text):
    """The script and data of a page's text."""
    data = re.search(r'type="application/json">(.*?)</script>', text, re.DOTALL)
    motion = re.search(r"<script>\n(// Where things are.*?)</script>", text, re.DOTALL)
    engine = MiniRacer()
    engine.eval(f"const scene = {data[1]};\n{motion[1]}")
    return engine, json.loads(data[1])


def wheel_by_core(design, at):
    """The wheel's angle at shown input angles, from the rows of `geneva motion`."""
    turn = MachineTurn(design.mechanism)
    out, turned = np.zeros(len(at)), 0.0
    first = turn.passages[0].engagement.half_step
    for one in turn.passages:
        local = np.clip(
            at + turn.start - one.mid, one.engagement.entry_deg, one.engagement.exit_deg
        )
        psi = np.array([float(one.engagement.motion(float(x), 0).c[0]) for x in local])
        out += psi + one.engagement.half_step
        turned += 2.0 * one.engagement.half_step
    return out - first, turned


@pytest.mark.sampled(30)
@pytest.mark.parametrize("name", DESIGNS)
def test_the_wheel_and_the_rollers_are_where_the_core_has_them(name):
    design = design_of(name)
    engine, data = script(name)
    turn = MachineTurn(design.mechanism)
    at = np.sort(np.random.default_rng(14).uniform(0.0, data["turn_deg"], 60))
    asked = json.dumps(at.tolist())
    track, unit = "angle", 1.0
    if not design.spec.output.turns:  # the travel, from mid-motion
        track, unit = "travel", design.spec.output.per_radian
    wheel = json.loads(
        engine.eval(f"JSON.stringify({asked}.map(t => afterTurns(scene.bodies[0].{track}, t, 2)))")
    )
    expected, gain = wheel_by_core(design, at)
    assert np.abs(np.array(wheel) - unit * (expected + 2.0 * gain)).max() < ANGLE * unit
    ask = f"JSON.stringify({asked}.map(t => scene.rollers.map(p => p.map(v => valueAt(v, t)))))"
    rollers = np.array(json.loads(engine.eval(ask)))
    for i in range(rollers.shape[1]):
        there = turn.centre(i, turn.start + at)
        assert np.abs(rollers[:, i] - there).max() < PLACE * data["size"]


@pytest.mark.sampled(24)
@pytest.mark.parametrize("name", DESIGNS)
def test_what_is_said_of_the_wheel_is_what_it_does(name):
    """Where it is said to rest it rests; the stretches follow each other over the whole turn."""
    _, data = script(name)
    ends = [0.0, *(state["end"] for state in data["states"])]
    starts = [*(state["start"] for state in data["states"]), data["turn_deg"]]
    assert np.allclose(starts, ends, atol=2e-3)
    motion = design_of(name).motion(721).to_dict()
    still = [
        w
        for w, v, a in zip(
            *(motion[k] for k in ("input_deg", "velocity", "acceleration")), strict=True
        )
        if v == a == 0.0
    ]
    rests = sum(s["end"] - s["start"] for s in data["states"] if not s["moves"])
    whole, period = data["turn_deg"], design_of(name).mechanism.period_deg
    # the wheels of a carousel move one after the other, and the page says when none does
    moves = (720 - len(still)) * getattr(design_of(name).spec.drive, "wheels", 1)
    assert rests * period / whole == pytest.approx(
        (720 - moves) * period / 720.0, abs=1.1 * period / 360.0
    )


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", DESIGNS)
def test_a_page_stands_alone(name):
    text = text_of(name)
    assert len(text.encode()) <= 300_000
    assert "http" not in text.replace("http://www.w3.org/2000/svg", "")
    assert "%" not in re.sub(
        r"\d+%|% ", "", re.sub(r"<style>.*?</style>|<script.*?</script>", "", text, flags=re.DOTALL)
    )
    assert not re.search(r"\s(src|href)=", text)


def test_the_force_is_the_pin_force_and_pushes_the_wheel_the_way_it_is_driven():
    design = design_of("turret")
    engine, _ = script("turret")
    rows = design.load_cycle(721).to_dict()
    for t in (1.0, 40.0, 70.0, 120.0, 134.0):
        x, y, fx, fy = json.loads(engine.eval(f"JSON.stringify(pushAt(scene.pushes[0], {t}))"))
        at = rows["input_deg"][0] + t
        force = np.interp(at, rows["input_deg"], rows["pin_force_N"])
        torque = np.interp(at, rows["input_deg"], rows["wheel_torque_Nm"])
        # chords of 73 places, and of 721 rows
        assert np.hypot(fx, fy) == pytest.approx(abs(force), rel=2e-3)
        # friction turns with the normal's torque: 0.05 of it, on the wall's arm of a roller
        assert 1e-3 * (x * fy - y * fx) == pytest.approx(torque, rel=0.02)
    assert engine.eval("pushAt(scene.pushes[0], 200)") is None


def test_the_same_scene_gives_the_same_bytes_and_titles_are_no_markup():
    assert text_of("turret") == "".join(page.chunks(scene(load(str(repo.DESIGNS / "turret.toml")))))
    hostile = load(str(repo.DESIGNS / "three-slots.toml"), ['title="</script><b>x"'])
    text = "".join(page.chunks(scene(hostile)))
    assert "<b>x" not in text and "&lt;b&gt;x" in text


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["four-bar-z4", "slider-crank", "side-crank-z6", "cam-geneva"])
def test_links_turn_as_they_are_cut(name):
    """Holes for pins stay on the joints that the drive states, at any angle of the turn."""
    found, design = scene(design_of(name)), design_of(name)
    turn = MachineTurn(design.mechanism)
    plates = [bar for bar in found.bars if bar.plates]
    assert plates
    for t in (0.0, 77.0, 200.0, 301.0):
        at = (turn.start + t + 180.0) % 360.0 - 180.0
        for link, bar in zip(links_at(design.mechanism, np.array([at])), found.bars, strict=True):
            joints = [complex(value_at(x, t), value_at(y, t)) for x, y in bar.joints]
            there = [complex(float(x[0]), float(y[0])) for x, y in link.joints]
            L = design.mechanism.center_distance_mm
            assert np.abs(np.array(joints) - there).max() < 1e-5 * L
            for plate in bar.plates[:1]:
                ahead = joints[1] - joints[0]
                holes = [s for s in plate.shapes[1:] if isinstance(s, Circle)]
                drawn = [joints[0] + complex(*h.centre) * ahead / abs(ahead) for h in holes]
                pins = [z for z, k in zip(there, link.kinds, strict=True) if k is Joint.PIN]
                for z in pins:
                    assert min(abs(z - d) for d in drawn) < 2e-5 * L


def test_a_machine_with_stops_goes_back_and_forth_between_them():
    """Steps of 100 degrees turn back at both ends, where wheel and disc are as they are cut."""
    engine, data = script("geneva-stop")
    run = "let at = 0, sense = 1; const seen = []; for (let i = 0; i < 60; i++) "
    step = "{ [at, sense] = between(scene.stops, at + sense * 100, sense); seen.push(at); }"
    seen = np.array(json.loads(engine.eval(f"{run}{step} JSON.stringify(seen)")))
    low, high = data["stops"]
    assert (seen >= low).all()
    assert (seen <= high).all()
    assert seen.min() < low + 100.0
    assert seen.max() > high - 100.0
    outlines = design_of("geneva-stop").parts.outlines
    gaps = Gaps(outlines.assembly, outlines.sizes, outlines.wheel, outlines.crank)
    for end in (low, high):
        turns = math.floor(end / data["turn_deg"])
        ask = (
            f"scene.bodies.map(b => afterTurns(b.angle, {end} - {turns} * scene.turn_deg, {turns}))"
        )
        wheel, crank, *_ = json.loads(engine.eval(f"JSON.stringify({ask})"))
        pose = Pose(np.array([wheel]), np.array([crank]), np.empty((1, 0, 2)))
        assert abs(gaps.locking(pose)[0]) < PLACE * data["size"]


def test_an_input_that_is_stopped_stands_once_in_each_dwell():
    """Turning and standing take as long as the machine's cycles, over some turns of its crank."""
    design = design_of("two-pins-z4").with_("drive.stop_s", 0.8)
    engine, data = script_of("".join(page.chunks(scene(design))))
    assert data["pauses"] == pytest.approx([90.0, 270.0])  # the first dwell has no length
    turns, step, at, stood = 3, 7.3, 0.0, []
    while at < turns * data["turn_deg"]:
        there = engine.eval(f"pauseBetween(scene.pauses, scene.turn_deg, {at!r}, {at + step!r})")
        stood += [there] if there is not None else []
        at = at + step if there is None else there
    dwells = [k * data["turn_deg"] + pause for k in range(turns) for pause in data["pauses"]]
    assert stood == pytest.approx(dwells)
    cycles = turns * math.fsum(one.cycle_s for one in design.timings)
    spent = turns * data["seconds"] + len(stood) * data["stop_s"]
    assert spent == pytest.approx(cycles, rel=1e-12)
    assert scene(design_of("two-pins-z4")).pauses == ()
