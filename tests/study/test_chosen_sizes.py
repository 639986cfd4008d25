"""`geneva size`: what a rule or a load chose is written, and then the machine is the same."""

import json
import math
import shutil

import pytest
import repo
import tomli
from sampling import some
from typer.testing import CliRunner

from geneva_cli import Design, load
from geneva_cli.cli.app import app
from geneva_cli.specfile.writer import inserted
from geneva_cli.study.export import NOT_KEPT, sized_text

DESIGNS = sorted(path.stem for path in repo.DESIGNS.glob("*.toml"))
# Checks of parts whose keys the spec has: default arms and links always pass.
OF_KEYS = {"arm_wall_mm", "arm_to_hub_mm", "link_wall_mm"}
TURRET = """# the table of a press
title = "Turret"
[wheel]
z = 8
[size] # in steel
center_distance_mm = 250
roller_radius_mm = 12
face_width_mm = 18 # of the roller

# what it turns
[load]
inertia_kgm2 = 1.5
torque_Nm = 20
friction = 0.05
efficiency = 0.95
"""


pytestmark = pytest.mark.usefixtures("made_once")


@pytest.fixture
def turret(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    repo.put("turret.toml", f"{TURRET}[drive]\nn_rpm = 40\n")
    return load("turret.toml")


def run(*arguments):
    return CliRunner().invoke(app, [*map(str, arguments)])


def values(design):
    return {c.name: (c.value, c.limit, c.passes, c.at_deg) for c in design._judged}


@pytest.fixture(params=DESIGNS)
def pair(request, tmp_path):
    """A design, and the one that its sized text makes in another folder."""
    origin = load(str(repo.DESIGNS / f"{request.param}.toml"))
    for name in origin.spec.files[1:]:
        shutil.copy(name, tmp_path)
    text, note = sized_text(origin)
    assert note == ""
    path = tmp_path / "sized.toml"
    path.write_text(text, encoding="utf-8")
    return origin, load(str(path)), text


@pytest.mark.sampled(16)
def test_a_sized_spec_chooses_nothing_and_keeps_its_text(pair):
    origin, sized, text = pair
    assert origin.chosen
    assert sized.chosen == {} and sized.chosen_by_load.sizes == {}
    again, note = sized_text(sized)
    assert (again, note) == (text, "")
    rest = iter(text.splitlines())
    assert all(line in rest for line in origin.text.text.splitlines())  # in their order
    for key, (value, _) in origin.chosen.items():
        assert sized.spec.table("size")[key.removeprefix("size.")] == value


@pytest.mark.sampled(24)
def test_a_sized_spec_has_the_same_values_in_check(pair):
    origin, sized, _ = pair
    before, after = values(origin), values(sized)
    for name, (value, *rest) in before.items():
        assert after[name][1:] == tuple(rest)
        # the cube of an array or a number: a rounding
        assert value == after[name][0] or value == pytest.approx(after[name][0], rel=5e-16, abs=0.0)
    assert after.keys() - before.keys() <= OF_KEYS
    assert all(after[name][2] for name in after.keys() - before.keys())


def test_screws_and_hubs_are_written_and_drawn_as_they_were(tmp_path):
    settings = ["size.crank_hub_mm=60", "size.pin_gap_mm=0.1", "size.lock_thickness_mm=8"]
    origin = load(str(repo.DESIGNS / "turret.toml"), settings)
    keys = {"size.crank_hub_length_mm", "size.lock_bolts", "size.lock_bolt_mm"}
    assert keys <= origin.chosen.keys()
    path = tmp_path / "sized.toml"
    path.write_text(sized_text(origin)[0], encoding="utf-8")
    sized = load(str(path))
    assert sized.chosen == {}
    assert sized.drawing("assembly").shapes == origin.drawing("assembly").shapes


@pytest.mark.long
def test_a_machine_that_is_built_bears_what_it_bears(turret):
    """At 90 rpm the shaft of 12 mm fails; the advice is the speed at which it just holds."""
    fast = turret.sized.with_("drive.n_rpm", 90.0)
    (failing,) = [c for c in fast._judged if c.passes is False]
    assert (failing.name, failing.anew) == ("crank_shaft_stress_MPa", "")
    n_rpm = float(failing.nearest.removeprefix("n_rpm = "))

    def stress(n):
        one = turret.sized.with_("drive.n_rpm", n)
        return next(c.value for c in one._judged if c.name == failing.name)

    assert stress(n_rpm) <= 82.5 < stress(1.01 * n_rpm)
    # a shaft of d holds 16 M / (pi d^3): the size by load is the first whose cube is enough
    chosen = Design.of(turret.spec.with_("drive.n_rpm", 90.0)).chosen_by_load.sizes
    needed = 12.0 * (failing.value / 82.5) ** (1.0 / 3.0)
    assert 15.0 < needed < chosen["size.crank_bore_mm"].value == 17.0
    assert math.isclose(stress(90.0), failing.value)


def said(command):
    """What a command prints of the turret at 40 rpm and at 90, on one line each; and as json."""
    fast = command, "turret.toml", "--set", "drive.n_rpm=90"
    texts = (run(*words).stdout for words in ((command, "turret.toml"), fast))
    return *(" ".join(text.split()) for text in texts), run(*fast, "--format", "json").stdout


@pytest.mark.parametrize("command", some(["check", "loads", "report"], ["loads"]))
def test_every_run_says_what_its_load_chose(command, turret):
    plain, text, tree = said(command)
    sizes = "chosen by load: crank shaft 12, wheel shaft 40, pin 12, arm 18 thick"
    assert f"{sizes} (geneva size turret.toml writes them)" in plain
    assert "chosen anew" not in plain
    assert "sizes chosen anew: crank shaft 12 → 17 mm" in text
    assert "chosen by load: crank shaft 17, wheel shaft 40" in text
    found = json.loads(tree)["chosen"]
    bore = found["size.crank_bore_mm"]
    assert (bore["was"], bore["value"]) == (12.0, 17.0)
    assert found["size.pin_mm"]["was"] is None
    assert found["size.pin_mm"]["why"].startswith("by load: ")


def test_advice_says_which_sizes_it_changes(turret):
    repo.put("limited.toml", f"{TURRET}[drive]\nn_rpm = 90\n[limits]\npin_force_max_N = 500\n")
    anew = "crank shaft 17 → 15 mm"
    (row,) = [
        row
        for row in json.loads(run("check", "limited.toml", "--format", "json").stdout)["rows"]
        if not row["passes"]
    ]
    n_rpm = float(row["nearest"].removeprefix("n_rpm = "))  # a change that a script can make
    assert load("limited.toml", [f"drive.n_rpm={n_rpm}"]).chosen_by_load.changes == anew
    assert row["why"] == f"sizes chosen anew with {row['nearest']}: {anew}"
    for words in some([("check", "limited.toml")], []):
        text = run(*words).stdout
        assert f"passes with {row['nearest']} (sizes chosen anew: {anew})" in " ".join(text.split())


def test_a_sweep_says_that_each_row_has_its_own_sizes(turret):
    vary = "--vary", "drive.n_rpm=40,90"
    strong = run("sweep", "turret.toml", *vary, "--pick", "strength.crank_shaft.diameter_mm")
    assert "sizes that its own load needs, the spec crank shaft 12" in strong.stderr
    assert run("sweep", "turret.toml", *vary, "--pick", "velocity.max").stderr == ""


def test_the_table_and_the_file(turret):
    table = run("size", "turret.toml")
    assert table.stdout.startswith("Turret: 16 sizes chosen, 5 of them by the load\n")
    tree = json.loads(run("size", "turret.toml", "--format", "json").stdout)
    assert list(tree) == ["spec", "title", "rows"]
    assert all(list(row) == ["key", "value", "why"] for row in tree["rows"])
    repo.put("untitled.toml", "[wheel]\nz = 6\n")
    untitled = json.loads(run("size", "untitled.toml", "--format", "json").stdout)
    assert untitled["title"] == "" == load("untitled.toml").loads_table.to_dict()["title"]
    assert run("size", "turret.toml", "-o", "sizes.csv").exit_code == 0
    assert repo.get("sizes.csv").startswith("key,value,why\n")
    printed = run("size", "turret.toml", "-o", "-")
    assert printed.stdout == sized_text(turret)[0] and printed.stderr == ""
    refused = run("size", "turret.toml", "-o", "turret.toml")
    assert refused.exit_code == 2 and repo.get("turret.toml").startswith(TURRET)
    fast = run("size", "turret.toml", "--set", "drive.n_rpm=90", "-o", "fast.toml")
    assert fast.stderr == "" and "\nface_width_mm = 18 # of the roller\n" in repo.get("fast.toml")
    assert load("fast.toml").spec.size.crank_bore_mm == 17.0
    assert run("size", "fast.toml").stdout == "Turret: no size to choose\n"


def test_a_text_without_lines_of_its_tables_is_written_anew(turret):
    repo.put("flat.toml", "wheel = {z = 6}\nsize = {center_distance_mm = 80}\n")
    again = run("size", "flat.toml", "-o", "again.toml")
    assert again.stderr == f"again.toml: note: {NOT_KEPT}\n"
    assert load("again.toml").chosen == {}
    assert run("size", "turret.toml", "--set", "title=two words", "-o", "-").stdout.startswith(
        'title = "two words"\n'
    )


def test_what_cannot_be_sized_is_refused_at_its_line(turret):
    repo.put("wide.toml", "[wheel]\nz = 6\n[size]\nwheel_bore_mm = 190\n")
    wide = run("size", "wide.toml", "-o", "sized.toml")
    assert wide.exit_code == 2
    assert wide.stderr.startswith("wide.toml:4: wheel_bore_mm = 190: the slots reach down to ")
    picture = run("size", "turret.toml", "-o", "sizes.svg")
    assert picture.exit_code == 2 and "one of: toml" in picture.stderr


@pytest.mark.long
def test_exported_specs_have_the_sizes_of_the_parts_beside_them(turret):
    assert run("export", "turret.toml", "--for", "laser", "-o", "shop").exit_code == 0
    exported = load("shop/spec.toml")
    assert exported.chosen == {}
    after = values(exported)
    assert {name: after[name] for name in values(turret)} == values(turret)


@pytest.mark.parametrize(
    ("text", "out"),
    [
        ("[wheel]\nz = 6", "[wheel]\nz = 6\n\n[size]\npin_mm = 6.0  # why\n"),
        ("[size]\n# none\n\n[wheel]\n", "[size]\npin_mm = 6.0  # why\n# none\n\n[wheel]\n"),
        ("size = {relief = 'arc'}\n", None),
        ('title = """\n[size]\n"""\n', None),
        (
            "[size]\npin_mm = 4 # mine\nrelief = 'a#b' # two\n",
            "[size]\npin_mm = 6.0 # mine\nrelief = 'a#b' # two\n",
        ),
    ],
)
def test_keys_are_inserted_or_refused(text, out):
    found = inserted(text, "size", {"pin_mm": (6.0, "why")})
    assert found == out
    if found:
        assert tomli.loads(found)["size"]["pin_mm"] == 6.0
