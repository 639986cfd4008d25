"""Everything that the program says is explained: names are those of the program itself."""

import ast
import json
import pickle
import re
import shlex
import shutil
import tomllib
from functools import cache
from itertools import chain
from pathlib import Path

import pytest
import repo
from typer.testing import CliRunner

from geneva_cli.cli.app import app
from geneva_cli.cli.command import say
from geneva_cli.design import load
from geneva_cli.drawings import parts_list
from geneva_cli.drawings.catalogue import PARTS
from geneva_cli.errors import GenevaError, Notice
from geneva_cli.loads import cycle_figures, load_tables
from geneva_cli.loads.sizing import WHEEL_INERTIA
from geneva_cli.loads.tolerance.random_machines import Spread
from geneva_cli.loads.vibration import vibration
from geneva_cli.manual import TOPICS
from geneva_cli.manual.explained import Entry, entries
from geneva_cli.motion import motion_table as motion
from geneva_cli.motion import registry
from geneva_cli.motion.path_and_slot import WALLED
from geneva_cli.motion.timing import CamFactors
from geneva_cli.parts.gears import gear_pair
from geneva_cli.parts.slots import groove
from geneva_cli.specfile.meanings import meanings, related
from geneva_cli.specfile.template import EXAMPLES
from geneva_cli.study import law_values, survey
from geneva_cli.study.sweep.run import ERROR
from geneva_cli.study.synth.synth_search import CELLS as SYNTH
from geneva_cli.study.verdicts import checks_table
from geneva_cli.verdict.checks import BEFORE_TURN, TURNING, checks
from geneva_cli.verdict.checks import PROOFS as PROVED
from geneva_cli.verdict.quantities import groups

WORDLESS = {"word", "yes or no", "list", "table", "text", "number"}  # not worked out by a formula
PACKAGE = repo.ROOT / "geneva_cli"
# Tests that hold what an entry says, by its group and first name. The wheel has no tests, so that
# they stand here and not in the pages.
PROOFS = tomllib.loads((repo.ROOT / "tests/cli/proofs.toml").read_text(encoding="utf-8"))


def explained(group: str) -> set[str]:
    """The names that a group's entries explain."""
    return {name for e in entries() if e.group == group for name in e.names}


@cache
def named_in_calls(function: str) -> set[str]:
    """The literal first arguments of all calls of a function in the program."""
    found = set()
    for file in PACKAGE.rglob("*.py"):
        text = file.read_text(encoding="utf-8")
        for node in ast.walk(ast.parse(text)) if f"{function}(" in text else ():
            if isinstance(node, ast.Call) and ast.unparse(node.func) == function and node.args:
                first = node.args[0]
                if isinstance(first, ast.Constant) and isinstance(first.value, str):
                    found.add(first.value)
    return found


def test_every_check_has_an_entry_and_no_entry_names_none():
    made = set().union(*map(named_in_calls, ("Check", "compared", "refused", "_struck")))
    assert made >= {"parts", "full_turn"}
    assert explained("check") == {*BEFORE_TURN, *TURNING, *PROVED, *made}


def test_every_warning_has_an_entry_and_no_entry_names_none():
    made = named_in_calls("Notice")
    assert explained("warning") == made


def test_a_warning_is_told_with_its_name(capsys):
    say("a.toml", [Notice("turns-back", "the wheel turns back"), "other"])
    told = capsys.readouterr().err.splitlines()
    assert told[0] == "a.toml: warning: the wheel turns back [turns-back]"
    assert told[1] == "a.toml: warning: other"
    copied = pickle.loads(pickle.dumps(Notice("undercut", "text")))
    assert (copied, copied.name) == ("text", "undercut")


def test_every_kind_law_and_part_has_an_entry_and_no_entry_names_none():
    kinds = {*registry.GEARINGS, *registry.DRIVES}
    assert kinds <= explained("kind") <= {*kinds, *EXAMPLES}
    assert explained("law") == set(registry.LAWS)
    assert explained("part") == set(PARTS)


@pytest.fixture(scope="module")
def quantities() -> set[str]:
    """The fields and columns of all commands, as whole as the program has them."""
    model = load(str(repo.DESIGNS / "turret.toml")).parts
    quick = [group for group in groups.GROUPS if not group.makes_parts]
    out = {*chain.from_iterable(group.values(model) for group in quick)}
    parts = [group for group in groups.GROUPS if group.makes_parts and group.table != "checks."]
    out |= {*chain.from_iterable(group.names for group in parts), "tolerance.warnings"}
    out |= {f"parts_list.{kind}" for kind in parts_list.KINDS} | {"checks.passes", "checks.failed"}
    out |= {"passes", "checks_failed", "not_proved", "warnings", "spec", "title"}  # the report's
    of_loads = {
        f"{q}.{s}" for q in load_tables.SHOWN_QUANTITIES for s in load_tables.LoadSummary._fields
    }
    out |= {f"loads.{name}" for name in of_loads} | {"loads.reversals_deg"}
    out |= {f"sizing.{WHEEL_INERTIA}", *(n for n in groups.GROUP_OF if n.startswith("sizing."))}
    out |= {f"vibration.avoid.{name}" for name in vibration.AVOID_COLUMNS}
    out |= {f"vibration.{name}" for name in (*vibration.NAMES, "avoid")}
    out |= {
        *vibration.SPECTRUM_COLUMNS,
        *survey.NAMES,
        *motion.motion_columns(load(str(repo.DESIGNS / "wandering-hours.toml")).mechanism),
        *cycle_figures.QUANTITIES,
        *CamFactors._fields,
    }
    out |= {"acceleration.exit", "jerk.exit", *law_values.LAW_COLUMNS, *SYNTH, ERROR}
    out |= set(checks_table([]).names)
    out |= {*WALLED, *groove.NAMES, *gear_pair.NAMES, *parts_list.NAMES}
    return out | {f"tolerance.{name}" for name in tolerance_names()}


def tolerance_names() -> set[str]:
    """Those of ``geneva tolerance``, of a wheel without parts to turn."""
    spec = [str(repo.DESIGNS / "spherical-z6.toml"), "--set", "tolerance.slot_width_mm=0.1"]
    words = ["tolerance", *spec, "--samples", "9", "--format", "json"]
    told = json.loads(CliRunner().invoke(app, words).stdout)
    out = set()
    for group, value in told.items():
        rows = value if isinstance(value, list) else [value]
        out |= {f"{group}.{name}" for row in rows if isinstance(row, dict) for name in row}
        out |= {group} if not isinstance(value, dict) else set()
    assert {f"motion_play.{angle}_um" for angle in Spread._fields[:-1]} <= out
    return out - {"spec", "title", "warnings"}


@pytest.mark.long
def test_every_quantity_has_an_entry(quantities: set[str]):
    unknown = []
    for name in sorted(quantities):
        try:
            found = meanings(name)
        except GenevaError:
            found = []
        if not found:
            unknown.append(name)
    assert not unknown


@pytest.mark.long
def test_no_entry_names_no_quantity(quantities: set[str]):
    def is_named(name: str) -> bool:
        if name.startswith("."):
            return any(q.endswith(name) for q in quantities)
        return any(f".{name}" in f".{q}" for q in quantities)

    assert not [name for name in explained("quantity") if not is_named(name)]


# A command, or lines of a spec, that shows the warning or the failing check, and one that does not.
EXAMPLES_OF = tomllib.loads((repo.ROOT / "tests/cli/examples.toml").read_text(encoding="utf-8"))

# Shown by points of a file, a value that is null without a word, and drawings.
WITHOUT_RUN = {"rounded-points", "not-known", "outline-units", "ideal-machine"}
WARNINGS = [e for e in entries() if e.group == "warning" and e.names[0] not in WITHOUT_RUN]

# A missing proof of the gap does not fail. The others need drawings: tests/extras/outline has them.
OF_DRAWINGS = {"turns", "turning_slack_mm", "turning_rests_deg", "drift_deg", "wall_mm"}
OF_DRAWINGS |= {"strike_velocity"}
WITHOUT_EXAMPLE = {"gap_proved_mm", *OF_DRAWINGS}
ONLY_FAILING = {"parts", "full_turn"}  # no row says that they pass
CHECKED = [e for e in entries() if e.group == "check" and e.names[0] not in WITHOUT_EXAMPLE]


def test_an_entry_is_whole():
    named = {(e.group, e.names[0]) for e in entries()}
    assert {(group, name) for group, some in PROOFS.items() for name in some} == named
    for entry in entries():
        for name in entry.names:
            assert re.fullmatch(r"\.?[\w.-]+", name), name
            (found,) = [m for m in meanings(name) if m.group == entry.group and m.name == name]
            needed = {"meaning", "source", "manual"}
            needed |= {"to_do"} if entry.group in ("check", "warning") else set()
            needed |= {"formula", "unit"} if entry.group in ("check", "quantity", "law") else set()
            if name.startswith("."):
                needed -= {"unit", "source"}  # those of what it ends
            if found.unit in WORDLESS or (found.unit or "").startswith("that of"):
                needed -= {"formula", "source"}
            missing = {field for field in needed if not found._asdict()[field]}
            assert not missing, (name, missing)
            assert found.meaning[0].isupper() and found.meaning.endswith("."), name
        assert set(entry.topics) <= TOPICS.keys(), entry.names
        for proof in PROOFS[entry.group][entry.names[0]]:
            path, _, test = proof.partition("::")
            text = (repo.ROOT / path).read_text(encoding="utf-8")
            assert path.startswith("tests/") and f"\ndef {test}(" in text, proof


@pytest.mark.parametrize(("group", "entries"), [("check", CHECKED), ("warning", WARNINGS)])
def test_every_check_and_warning_has_examples(group: str, entries: list[Entry]):
    assert EXAMPLES_OF[group].keys() == {entry.names[0] for entry in entries}
    assert all(len(pair) == 2 for pair in EXAMPLES_OF[group].values())


@pytest.mark.long
@pytest.mark.parametrize("entry", WARNINGS, ids=lambda e: e.names[0])
def test_a_warning_shows_in_its_bad_example_and_not_in_the_good_one(
    entry: Entry, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    shutil.copytree(repo.DESIGNS, tmp_path, dirs_exist_ok=True)
    (name,) = entry.names
    assert [name in warned(example) for example in examples_of(entry)] == [True, False]


@pytest.mark.sampled(96)
@pytest.mark.parametrize("entry", CHECKED, ids=lambda e: e.names[0])
def test_a_check_fails_in_its_bad_example_and_passes_in_the_good_one(entry: Entry):
    bad_example, good_example = examples_of(entry)
    good = passes(good_example)
    if entry.names[0] == "dwell_deg":  # a spec without a dwell is refused when it is read
        with pytest.raises(GenevaError, match="leave no dwell"):
            passes(bad_example)
        assert good["dwell_deg"]
        return
    bad = passes(bad_example)
    if entry.names[0] in ONLY_FAILING:
        assert False in (bad[name] for name in entry.names)
        assert all(good.values()) and not good.keys() & ONLY_FAILING
        return
    made = bad.keys() & good.keys() & set(entry.names)
    assert made and all(good[name] for name in made)
    assert any(bad[name] is False for name in made)


def examples_of(entry: Entry) -> list[str]:
    """A command that shows the warning or the failing check, and the one after the repair."""
    return EXAMPLES_OF[entry.group][entry.names[0]]


def passes(command: str) -> dict[str, bool | None]:
    """Whether each check passes that a command makes, without its advice, which takes seconds."""
    geneva, check, spec, *given = shlex.split(command)
    assert (geneva, check, *given[::2]) == ("geneva", "check", *["--set"] * (len(given) // 2))
    design = load(str(repo.DESIGNS / spec), given[1::2])
    return {row.name: row.passes for row in checks(design.mechanism)}


def warned(example: str) -> set[str]:
    """Names of the warnings that a command gives, or a spec with some more lines."""
    if not example.startswith("geneva "):
        whole = example.startswith("[wheel]")
        spec = (repo.DESIGNS / "press-straight.toml").read_text(encoding="utf-8")
        lines = example.split("; ") if whole else [spec, *example.split("; ")]
        Path("more.toml").write_text("\n".join(lines), encoding="utf-8")
        example = "geneva peaks more.toml" if whole else "geneva loads more.toml"
    result = CliRunner().invoke(app, shlex.split(example)[1:])
    assert result.exit_code <= example.startswith("geneva check"), result.output  # it may fail
    return set(re.findall(r"(?:explain |\[)([a-z-]+)", result.output))


@pytest.mark.parametrize(
    ("word", "groups"),
    [
        ("checks.horn_mm", ["check"]),
        ("jerk_max", ["check", "quantity", "key"]),
        ("loads.pin_force_N.max_at_deg", ["quantity"]),
        ("max", ["quantity"]),
        ("side-crank", ["kind"]),
        ("turns-back", ["warning", "key"]),
        ("crank", ["kind", "part", "key"]),
        ("inputs.drive.n_rpm", ["key"]),
        ("A", ["key"] * 4),  # of two kinds, in [drive] and in [drive.before]
    ],
)
def test_what_a_word_means(word: str, groups: list[str]):
    assert [m.group for m in meanings(word)] == groups


@pytest.mark.parametrize(
    ("words", "names"),
    [
        ("pin stress", ["pin_stress_MPa", "life.pin_stress_MPa"]),
        ("wheel torque, N m", ["loads.wheel_torque_Nm"]),
        ("Torque on the input", [f"{of}.input_torque_Nm" for of in ("loads", "sizing")]),
        ("Wheel left out", ["wheel-left-out", "accept.wheel-left-out"]),
    ],
)
def test_words_as_they_are_printed(words: str, names: list[str]):
    """Columns, headings and labels, whatever their unit, order and capitals."""
    assert [m.name for m in meanings(words)] == names


def test_a_word_without_an_entry_leads_to_what_it_is_part_of():
    """A group lists its names; texts and the manual's pages come last."""
    assert {group for group, _, _ in related("warnings")} == {"warning"}
    assert len(related("warnings")) == len(explained("warning"))
    assert ("quantity", "loads.wheel_bearing_N") in [one[:2] for one in related("bearings")]
    assert "page   help spec" in CliRunner().invoke(app, ["explain", "taplo"]).stdout
    refused = CliRunner().invoke(app, ["explain", "xyzzy"])
    assert refused.exit_code == 2 and '"xyzzy" is not explained' in refused.stderr


def test_without_a_word_people_get_groups_and_programs_all_names():
    """A screen of groups, not a thousand lines."""
    people = CliRunner().invoke(app, ["explain"]).stdout.splitlines()
    assert len(people) < 24 and sum("84" in line or "checks" in line for line in people) >= 1
    rows = json.loads(CliRunner().invoke(app, ["explain", "--format", "json"]).stdout)["rows"]
    assert {row["name"] for row in rows} == {name for e in entries() for name in e.names}
