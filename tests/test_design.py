"""Design, the Python API: the answers and the refusals of a file."""

import inspect
import math
import pickle
import subprocess
import sys
import types
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import repo
from sampling import some
from typer.testing import CliRunner

import geneva_cli
from geneva_cli import (
    Cam,
    Crank,
    Cycloidal,
    Design,
    External,
    GenevaError,
    Harmonic,
    Limits,
    Load,
    Motion,
    SideCrank,
    SineGroup,
    Size,
    Spherical,
    TableLaw,
    load,
)
from geneva_cli.cli.app import app
from geneva_cli.manual import page

PRESS = {
    "size": Size(center_distance_mm=441.89, roller_radius_mm=20, face_width_mm=30),
    "load": Load(inertia_kgm2=6.484556, torque_Nm=497),
}
POINTS = np.loadtxt(repo.DESIGNS / "table-law.csv", delimiter=",", skiprows=1)
# The files in designs/, as a Python user would write them.
DESIGNS = {
    "side-crank-z6": lambda: Design(
        External(6), SideCrank(A=0.6), size=Size(center_distance_mm=160, roller_radius_mm=9)
    ),
    "cam-geneva": lambda: Design(External(6), Cam(), Motion(Cycloidal()), **PRESS),
    "unequal-steps": lambda: Design(
        External(6, steps_deg=(72, 48)),
        Crank(n_rpm=30),
        size=Size(150, 8),
        load=Load(inertia_kgm2=0.05, torque_Nm=4),
    ),
    "table-law": lambda: Design(
        External(6),
        Crank(n_rpm=45),
        Motion(TableLaw(points=POINTS.tolist()), ratio="matched"),
        size=Size(140, 7),
    ),
}
FILES = {path.stem for path in repo.DESIGNS.glob("*.toml")}
DESIGNS = {name: make for name, make in DESIGNS.items() if name in FILES}


def file(text, tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def row(table):
    (values,) = table.rows()
    return dict(zip(table.names, values, strict=True))


# A design in Python and one in a file


@pytest.mark.parametrize("name", DESIGNS)
def test_the_same_machine_in_python_and_from_a_file(name):
    """A file has a name and a title, and that is all."""
    made, read = DESIGNS[name]().spec, load(str(repo.DESIGNS / f"{name}.toml")).spec
    points = {"motion": made.motion} if name == "table-law" else {}  # their file has a name
    assert made == read.replace(path="", files=(), title="", **points)


# What is wrong is said in the same words

WRONG = [
    ("[wheel]\nz = 2", lambda: External(2)),
    ("[wheel]\nz = 6\nsteps_deg = [72, 40]", lambda: External(6, steps_deg=(72, 40))),
    ('[wheel]\nz = 6\n[drive]\nkind = "side-crank"\nA = 1', lambda: SideCrank(A=1)),
    (
        '[wheel]\nz = 6\n[motion]\nlaw = "sine-group"\nlambda = 11',
        lambda: Motion(SineGroup(lambda_=11)),
    ),
    ("[wheel]\nz = 6\n[load]\ntorque_Nm = true", lambda: Load(torque_Nm=True)),
    # between two tables
    (
        "[wheel]\nz = 6\n[limits]\npin_force_max_N = 100",
        lambda: Design(External(6), limits=Limits(pin_force_max_N=100)),
    ),
    # between the keys of a machine
    (
        '[wheel]\nz = 6\n[motion]\nlaw = "harmonic"\nalpha0_deg = 300',
        lambda: Design(External(6), motion=Motion(Harmonic(), 300)).motion(),
    ),
    (
        "[wheel]\nz = 6\n[size]\ncenter_distance_mm = 100\nroller_radius_mm = 60",
        lambda: Design(External(6), size=Size(100, 60)).loads,
    ),
]


@pytest.mark.parametrize(("text", "make"), WRONG, ids=[text[8:] for text, _ in WRONG])
def test_a_wrong_value_raises_what_a_file_with_it_gets(text, make, tmp_path):
    path = file(text, tmp_path)
    with pytest.raises(GenevaError) as told:
        _ = load(path).mechanism
    where, _, wants = str(told.value).partition(": ")
    line = int(where.removeprefix(f"{path}:"))
    assert 1 <= line <= 1 + text.count("\n")
    with pytest.raises(GenevaError) as raised:
        make()
    assert str(raised.value) == wants


@pytest.mark.parametrize(
    "make",
    [
        lambda: Motion("cycloidal"),
        lambda: Design(6),
        lambda: Design(External(6), size=100.0),
    ],
    ids=range(3),
)
def test_another_object_is_refused_where_it_is_given(make):
    """A word of the file, a class or a number would else fail late, or be taken for nothing."""
    with pytest.raises(GenevaError, match="must be an object like"):
        make()


# What if

FULL = Design(
    External(6), Crank(), Motion(SineGroup(lambda_=0.1), alpha0_deg=-10), load=Load(torque_Nm=5)
)


@pytest.mark.parametrize(
    ("key", "value", "default"),
    [
        ("wheel.z", 8, None),
        ("drive.n_rpm", 90.0, 60.0),
        ("motion.lambda", 0.05, 0.0),
        ("motion.ratio", 0.45, None),
        ("size.center_distance_mm", 160.0, None),
        ("limits.velocity_max", 1.0, None),
    ],
)
def test_one_key_changed(key, value, default):
    """The key alone, in a new design that is built anew; None is its default again."""
    table, _, name = key.partition(".")
    before = FULL.spec
    timing = FULL.timing
    changed = FULL.with_(key, value)
    for other in ("wheel", "drive", "motion", "size", "load", "limits"):
        same = before.table(other)
        assert changed.spec.table(other) == same | ({name: value} if other == table else {})
    assert FULL.spec is before
    assert FULL.timing is timing
    assert changed.mechanism is not FULL.mechanism
    assert changed.timing.motion_deg > 0.0
    if key == "wheel.z":
        with pytest.raises(GenevaError, match=r"\[wheel\] needs z: number of slots"):
            changed.with_(key, None)
    else:
        assert changed.with_(key, None).spec.table(table)[name] == default


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("wheel.zz", 8, r"unknown key zz in \[wheel\] .*known: z, held_by"),
        ("motion.lamda", 0.2, r'unknown key lamda in \[motion\] \(did you mean "lambda"\?\)'),
        ("driver.n_rpm", 50, r"this spec has no \[driver\]"),
        ("n_rpm", 50, r"this spec has no \[n_rpm\]"),
        ("drive.n_rpm", -1, r"n_rpm = -1 must be above 0"),
        ("limits.contact_stress_max_MPa", 500, r"set face_width_mm in \[size\]"),
    ],
)
def test_a_key_or_value_that_cannot_be_changed_to(key, value, said):
    with pytest.raises(GenevaError, match=said):
        FULL.with_(key, value)


# From several threads


def test_one_design_serves_several_threads():
    one, alone = (load(str(repo.DESIGNS / "turret.toml")) for _ in range(2))
    with ThreadPoolExecutor(4) as pool:
        answers = [*pool.map(lambda _: (repr(one.peaks), repr(one.loads)), range(4))]
    assert answers == [(repr(alone.peaks), repr(alone.loads))] * 4


FORKED = """
import os
import signal
import threading
from geneva_cli import Design, External, design

build, begins, ends = design.build, threading.Event(), threading.Event()
def slowly(spec):
    begins.set()
    ends.wait()
    return build(spec)

one = Design(External(6))
design.build = slowly
thread = threading.Thread(target=lambda: one.mechanism)
thread.start()
begins.wait()
child = os.fork()
if not child:
    signal.alarm(20)  # ends a child that waits for ever
    design.build = build
    known = one.timing.motion_deg, Design(External(5)).timing.motion_deg
    os._exit(known != (120.0, 108.0))
status = os.waitpid(child, 0)[1]
ends.set()
thread.join()
assert status == 0 and one.timing.motion_deg == 120.0
"""


@repo.posix("fork")
def test_a_child_that_is_forked_while_a_thread_computes():
    """Python 3.11 held a lock for all designs, which the child waited for: 180° - 360°/z."""
    command = [sys.executable, "-W", "ignore::DeprecationWarning", "-c", FORKED]
    result = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=60)
    assert result.returncode == 0, result.stderr


def test_a_design_with_answers_can_be_pickled():
    """The inputs alone are in the pickle, with the file's lines for messages."""
    read = load(str(repo.DESIGNS / "offset-slots.toml"), ["size.center_distance_mm=8 in"])
    made = Design(External(6), load=Load(0.4, 15.0))
    for first in some((made, read, read.backwards), (made, read.backwards)):
        answers = first.peaks, first.checks, repr(first.loads)
        again = pickle.loads(pickle.dumps(first))
        assert (again.peaks, again.checks, repr(again.loads)) == answers
        assert again.is_backwards == first.is_backwards


# What a program may use


def test_every_name_can_be_imported():
    for name in geneva_cli.__all__:
        scope = {}
        exec(f"from geneva_cli import {name}", scope)
        assert scope[name] is getattr(geneva_cli, name), name
        if isinstance(scope[name], type):
            assert inspect.getdoc(scope[name]), name


# What the interpreter shows, and what it takes


def test_a_design_shows_itself_as_python_writes_it():
    every = [make() for make in DESIGNS.values()]
    for made in every:
        names = vars(geneva_cli) | {name: getattr(geneva_cli, name) for name in dir(geneva_cli)}
        shown = repr(made)
        if "..." not in shown:  # points of a table are cut
            assert eval(shown, names).spec == made.spec, shown
    assert repr(Design(External(6))) == "Design(wheel=External(z=6), drive=Crank())"
    assert max(len(repr(made)) for made in every) < 500


def test_a_column_is_an_array_that_stays_as_it_is():
    made = Design(External(6), load=Load(torque_Nm=15))
    table = made.load_cycle(4)
    force = table["pin_force_N"]
    assert isinstance(force, np.ndarray) and force.shape == (4,)
    with pytest.raises(ValueError, match="read-only"):
        force[0] = 1.0
    assert table.columns[0].flags.writeable  # only what is handed out is not
    assert made.peaks_table["velocity.max"] == 1.0
    with pytest.raises(GenevaError, match=r'no column pin_force \(did you mean "pin_force_N"'):
        table["pin_force"]


def test_a_table_as_a_frame(monkeypatch):
    table = Design(External(6)).motion(3)
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(GenevaError, match="pip install pandas"):
        table.to_pandas()
    monkeypatch.setitem(sys.modules, "pandas", types.SimpleNamespace(DataFrame=dict))
    assert list(table.to_pandas()) == list(table.names)
    assert table.to_pandas()["input_deg"] == [-60.0, 120.0, 300.0]
    record = Design(External(6)).peaks_table.to_pandas()
    assert record["velocity.max"] == [1.0]


@pytest.mark.parametrize("kind", [np.float32, np.float64, np.int64, np.int8])
def test_numbers_of_numpy_are_numbers(kind):
    whole = int if issubclass(kind, np.floating) else kind  # slots are counted
    made = Design(External(whole(6)), size=Size(kind(100)), load=Load(torque_Nm=kind(15)))
    assert made.spec == Design(External(6), size=Size(100), load=Load(torque_Nm=15)).spec
    assert type(made.spec.size.center_distance_mm) is float
    assert len(made.motion(whole(5))) == len(made.load_cycle(samples=whole(5))) == 5
    assert made.with_("drive.n_rpm", kind(30)).timing.cycle_s == 2.0
    assert made.vibration(kind(5), kind(0))["period_ratio"] == 5.0


@pytest.mark.parametrize(
    ("ask", "said"),
    [
        (lambda: Size(centre_distance_mm=100), 'Size has no centre_distance_mm .*"center_dist'),
        (lambda: Design(External(6), sizes=Size()), r'Design has no sizes \(did you mean "size"'),
        (lambda: SideCrank(A=0.1, n_rmp=60), r'SideCrank has no n_rmp \(did you mean "n_rpm"'),
        (lambda: Design(External(6)).motion(sample=3), r"motion\(\) has no sample .*samples"),
    ],
    ids=range(4),
)
def test_a_wrong_keyword_is_refused_with_the_nearest(ask, said):
    with pytest.raises(GenevaError, match=said):
        ask()


def test_sizes_that_are_not_given_are_those_of_the_parts():
    """Given to the machine, they are its own: its parts are the same."""
    made = Design(External(6), SideCrank(A=0.3))
    size = made.size
    assert (size.center_distance_mm, size.roller_radius_mm) == (100.0, 5.0)
    assert size.wheel_radius_mm > 100.0 * math.cos(math.pi / 6)  # a roller enters on the rim
    again = Design(External(6), SideCrank(A=0.3), size=size)
    ours, theirs = (one.report.table.to_dict() for one in (made, again))
    cut = [name for name in ours if name.startswith(("sizes.", "parts.")) and ours[name]]
    assert len(cut) > 15
    for name in cut:
        if isinstance(ours[name], float):
            assert theirs[name] == pytest.approx(ours[name], rel=1e-9), name  # rounding of halves
    assert Design(Spherical(6)).size.center_distance_mm == 100.0  # no flat parts


@pytest.mark.usefixtures("no_advice")
def test_a_design_is_saved_as_the_command_writes_it(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    spec = str(repo.DESIGNS / "offset-slots.toml")
    made = load(spec)
    for file, part in [("slot.csv", ""), ("a.svg", "crank"), ("sheet.pdf", "")]:
        made.save(file, part)
        part = part or file.partition(".")[0]
        run = CliRunner().invoke(app, ["profile", spec, "--part", part, "-o", f"c-{file}"])
        assert run.exit_code == 0
        with open(file, "rb") as ours, open(f"c-{file}", "rb") as theirs:
            assert ours.read() == theirs.read()
    with pytest.raises(GenevaError, match="one of: "):
        made.save("wheel.xyz")
    jams = Design(External(6), size=Size(100, 5, wheel_radius_mm=88))  # its rim meets a roller
    with pytest.raises(GenevaError, match=r"jam\.dxf: not written: "):
        jams.save("jam.dxf", "wheel")
    jams.save("jam.dxf", "wheel", force=True)


def test_the_reference_page_names_all_that_a_design_answers():
    answers = {name for name in vars(Design) if not name.startswith("_")}
    text = page("python")
    assert {name for name in answers if f"`{name}" not in text and f".{name}" not in text} == set()
