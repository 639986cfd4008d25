"""Advice is taken with the real reader: the check passes then, and nothing is broken by it."""

import re
from pathlib import Path

import pytest
import repo
from sampling import some
from strength_checks import judged
from words import load

from geneva_cli.motion.mechanism import Mechanism, build
from geneva_cli.spec.schema import fields
from geneva_cli.spec.tables import PLAIN
from geneva_cli.specfile.keys import all_keys, tables_with
from geneva_cli.specfile.writer import keys_of
from geneva_cli.verdict import advice
from geneva_cli.verdict.advice import NONE, STOPPED, remedies, words_of
from geneva_cli.verdict.checks import BEFORE_TURN, OF_TURN, PUSHED, Check, all_pass, checks

DESIGNS = repo.DESIGNS


def written(name):
    """The text of a design, empty without it."""
    return "".join(path.read_text(encoding="utf-8") for path in DESIGNS.glob(f"{name}.toml"))


CURVED = "[wheel]\nz = 6\n[motion]\nlaw = 'cycloidal'\nratio = 'matched'\n"
LOADED = (
    "[wheel]\nz = 6\n[size]\ncenter_distance_mm = 200\nroller_radius_mm = 8\nface_width_mm = 10\n"
    "[load]\ninertia_kgm2 = 0.4\ntorque_Nm = 15\n[limits]\n"
)
LIGHT = "[load]\ninertia_kgm2 = 0.05\n[limits]\n"

# What a person might write, the checks that then fail, and whether one change can help.
MOTIONS = {
    "acceleration": LOADED + "acceleration_max = 1.2\n",
    "pin": LOADED + "pin_force_max_N = 250\n",
    "side-crank": "[wheel]\nz = 6\n[drive]\nkind = 'side-crank'\nA = 0.1\n[limits]\n"
    "acceleration_max = 0.9\n",
    "convexity": "[wheel]\nz = 6\n[drive]\nkind = 'noncircular-gears'\nA = 0.9\n",
    "pressure": CURVED + "alpha0_deg = -40\n[limits]\npressure_angle_max_deg = 10\n",
    "slider-crank": written("slider-crank") + "[limits]\nacceleration_max = 0.40\n",
    "offset": "[wheel]\nz = 6\noffset_mm = 10\n" + LIGHT + "pin_force_max_N = 20\n",
    "two": CURVED + LIGHT + "pin_force_max_N = 20\ninput_torque_max_Nm = 0.3\n",
    "epicyclic": "[wheel]\nz = 6\n[drive]\nkind = 'epicyclic'\nplanet_ratio = 'shockless'\n"
    "[limits]\nvelocity_max = 1.0\n",
}
FOUR_BAR = written("four-bar-z4") + LIGHT + "pin_force_max_N = 100\n"
PARTS = {
    "rim": "[wheel]\nz = 6\n[size]\nwheel_radius_mm = 120\n",
    "bore": "[wheel]\nz = 8\n[size]\ncenter_distance_mm = 250\nroller_radius_mm = 12\n"
    "crank_bore_mm = 30\nrelief = 'arc'\n",
    "wheel-hub": "[wheel]\nz = 6\n[size]\nwheel_hub_mm = 90\n",
    "horn": "[wheel]\nz = 6\n[size]\nlock_radius_mm = 44.8\n",
    "thick": "[wheel]\nz = 12\nheld_by = 'brake'\n[size]\nroller_radius_mm = 9.5\n"
    "lock_radius_mm = 0\nwall_min_mm = 20\n",
    "wall-least": "[wheel]\nz = 10\n[size]\nwall_min_mm = 12\n",
    "clearance": "[wheel]\nz = 5\n[size]\nlock_clearance_mm = 12\n",
    "arc": "[wheel]\nz = 24\n[size]\nrelief = 'arc'\nroller_radius_mm = 2\n",
    "four-bar": FOUR_BAR,
    "bore-by-load": (DESIGNS / "press-straight.toml")
    .read_text(encoding="utf-8")
    .replace("face_width_mm = 30", "face_width_mm = 30\narm_bore_mm = 7"),
}
ALL = MOTIONS | PARTS
# A gear-Geneva without a jump has nothing to turn down.
HELPLESS = ("epicyclic",)


def table_of(mechanism: Mechanism, key: str) -> str:
    spec = mechanism.spec
    law = fields(type(mechanism.law)) if mechanism.law else ()
    for table, keys in keys_of(type(spec.wheel), type(spec.drive), law).items():
        if key in [f.key for f in keys]:
            return table
    raise AssertionError(key)


def take(text: str, said: str, mechanism: Mechanism) -> str:
    """The spec's text with the advice written into it."""
    key = said.removeprefix("leaving out ").partition(" = ")[0]
    text = re.sub(rf"(?m)^{key} = .*\n", "", text)
    if said.startswith("leaving out "):
        return text
    head = f"[{table_of(mechanism, key)}]\n"
    return text.replace(head, f"{head}{said}\n") if head in text else f"{text}{head}{said}\n"


def read(folder: Path, text: str) -> Mechanism:
    file = folder / "spec.toml"
    file.write_text(text, encoding="utf-8")
    return load(str(file))


def stands(text: str, folder: Path, rows: list[Check], parts: bool) -> None:
    """All checks that fail have the same advice, and with it all pass."""
    mechanism = read(folder, text)
    failing = [c for c in rows if c.passes is False]
    (said,) = {c.nearest for c in failing}
    assert said, [(c.name, c.why) for c in failing]
    # a reason may tell the size that the load needs, but none why there is no advice
    assert not any(NONE in c.why or STOPPED in c.why for c in failing)
    taken = read(folder, take(text, said, mechanism))
    assert all_pass(checks(taken, parts=parts)), said


@pytest.mark.sampled(36)
@pytest.mark.parametrize("name", [name for name in ALL if name not in HELPLESS])
def test_advice_passes_when_it_is_taken(name: str, tmp_path: Path) -> None:
    parts = name in PARTS  # of the others the motion and the limits: their parts take their time
    stands(ALL[name], tmp_path, judged(read(tmp_path, ALL[name]), parts=parts), parts)


@pytest.mark.parametrize("name", HELPLESS)
def test_where_there_is_no_advice_it_says_why(name: str, tmp_path: Path) -> None:
    rows = judged(read(tmp_path, ALL[name]), parts=False)
    failing = [c for c in rows if c.passes is False]
    assert failing
    assert all(c.nearest == "" and c.why.startswith(NONE) for c in failing)


# A spec, and the key that the advice changes.
NEAREST = {
    "wheel": ("[wheel]\nz = 6\n[size]\nwheel_radius_mm = 80\n", "wheel_radius_mm"),
    "toy": (
        "[wheel]\nz = 5\n[size]\ncenter_distance_mm = 40\nroller_radius_mm = 2\n"
        "lock_clearance_mm = 0.3\nslot_clearance_mm = 0.2\n",
        "lock_clearance_mm",
    ),
    "pin": (LOADED + "pin_force_max_N = 250\n", "n_rpm"),
}


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", NEAREST)
def test_no_nearer_value_passes(name: str, tmp_path: Path) -> None:
    """Values between the present one and the advice all fail, up to 3% of the change from it."""
    text, key = NEAREST[name]
    mechanism = read(tmp_path, text)
    rows = judged(mechanism)
    stands(text, tmp_path, rows, parts=True)
    said = next(c.nearest for c in rows if c.passes is False)
    assert said.startswith(f"{key} = ")
    table = table_of(mechanism, key)
    now, advised = mechanism.spec.table(table)[key], float(said.split()[-1])
    for share in some((0.97, 0.9, 0.7, 0.5, 0.3, 0.1), (0.97, 0.5)):
        nearer = mechanism.spec.with_(f"{table}.{key}", now + share * (advised - now))
        assert not all_pass(checks(build(nearer))), share


def test_no_requirement_is_relaxed(tmp_path: Path) -> None:
    """Walls of 40 mm leave no room in this machine; thinner ones are not what was wanted."""
    mechanism = read(tmp_path, "[wheel]\nz = 6\n[size]\nwall_min_mm = 40\n")
    failing = [c for c in judged(mechanism) if c.passes is False]
    assert failing
    assert not any("wall_min_mm =" in c.nearest + c.why for c in failing)


def test_trials_are_counted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without any left there is no advice, and the reason."""
    monkeypatch.setattr(advice, "TRIALS", 0)
    (failing,) = [c for c in judged(read(tmp_path, ALL["rim"])) if c.passes is False]
    assert (failing.nearest, failing.why) == ("", STOPPED)


def test_a_linkage_gets_more_slots(tmp_path: Path) -> None:
    """The centre distance that a linkage gives itself is none of the spec's: z = 9 has 0.396."""
    rows = judged(read(tmp_path, ALL["slider-crank"]), parts=False)
    assert {c.name: c.nearest for c in rows}["acceleration_max"] == "z = 9"


def test_the_key_that_a_reason_names_is_tried_first(tmp_path: Path) -> None:
    """A keyway without a table for its bore: before, five smaller rollers came first."""
    mechanism = read(
        tmp_path,
        "[wheel]\nz = 6\n[size]\nroller_radius_mm = 4\nwheel_keyway = 'DIN 6885-1'\n"
        "wheel_bore_mm = 5\n",
    )
    (parts,) = [c for c in checks(mechanism) if c.passes is False]
    first = next(remedies(parts, mechanism))
    assert (parts.name, first.key) == ("parts", "size.wheel_bore_mm")
    assert "wheel_bore_mm" in parts.why and "roller_radius_mm" not in parts.why


def test_each_word_of_a_check_names_a_key() -> None:
    """A word in capitals without a line of its own was a fault of the program, of stops."""
    for name in (*BEFORE_TURN, *OF_TURN, *PUSHED):
        for word in words_of(name).split():
            whole = re.split(r"[*:=?]", word)[0]
            table, _, key = whole.rpartition(".")
            assert (table or "size") in tables_with(key), (name, word)


def test_no_kind_has_a_key_of_a_plain_table() -> None:
    """The tables with a key are looked for in these alone, if one has it."""
    keys = {field.key for kind in PLAIN.values() for field in fields(kind)}
    own = [key for key in all_keys() if key.key in keys]
    assert {key.whole_table for key in own} == {*PLAIN}


def test_a_size_that_the_machine_cannot_have_is_left_out() -> None:
    """The least change is none of its value: the reason says to remove it."""
    internal = load(DESIGNS / "internal-z6.toml").spec.with_("size.wheel_bore_mm", 60.0)
    (parts,) = [c for c in judged(build(internal)) if c.passes is False]
    assert parts.nearest == "leaving out wheel_bore_mm"


def test_a_trial_may_have_a_slot_without_walls(tmp_path: Path) -> None:
    """Of a wheel in which the roller's path leaves at once, walls are shorter than rounding."""
    text = 'z = 32\ngearing = "internal"\n[motion]\nlaw = "4-5-6-7"\n[size]\n'
    text += "center_distance_mm = 100.0\nroller_radius_mm = 1.937064983183725\n"
    path = tmp_path / "thin.toml"
    path.write_text("[wheel]\n" + text, encoding="utf-8")
    reasons = {check.name: check.why for check in judged(load(path))}
    assert reasons["parts"].startswith("the walls of a slot do not close")


@pytest.mark.long
def test_no_requirement_is_broken_for_a_part(tmp_path: Path) -> None:
    """Each failing part has its own size, and with all of them at once all checks pass."""
    text = (
        "[wheel]\nz = 8\n[drive]\nn_rpm = 40\n[size]\npin_mm = 3\nwheel_bore_mm = 7\n"
        "[load]\ninertia_kgm2 = 0.8\ntorque_Nm = 12\n"
    )
    keys = {"pin_mm", "wheel_bore_mm"}
    mechanism = read(tmp_path, text)
    failing = [c for c in judged(mechanism) if c.passes is False]
    assert len(failing) == len(keys)
    (said,) = {c.nearest for c in failing}
    changes = dict(one.split(" = ") for one in said.split(" and "))
    assert changes.keys() == keys
    spec = mechanism.spec
    for key, value in changes.items():
        spec = spec.with_(f"size.{key}", float(value))
    assert all_pass(checks(build(spec)))
    for key, value in changes.items():  # the size that the text names is that of the remedy
        why = next((c.why for c in failing if c.why.startswith(key)), "")
        needs = re.search(r"this load needs ([\d.]+)", why)
        assert needs is None or float(needs[1]) <= float(value) <= 1.02 * float(needs[1])


@pytest.mark.long
def test_a_given_centre_distance_is_kept_for_a_part(tmp_path: Path) -> None:
    """A larger machine would bear the load; one of 60 mm is wanted."""
    text = (
        "[wheel]\nz = 6\n[size]\ncenter_distance_mm = 60\nroller_radius_mm = 3\n"
        "[load]\ninertia_kgm2 = 2\ntorque_Nm = 40\n"
    )
    for kept, given in ((True, text), (False, text.replace("center_distance_mm = 60\n", ""))):
        mechanism = read(tmp_path, given)
        names = {c.name for c in checks(mechanism) if c.passes is False}
        assert names
        tried = {
            change.key
            for c in checks(mechanism)
            if c.passes is False
            for change in remedies(c, mechanism)
        }
        assert ("size.center_distance_mm" in tried) is not kept
