"""Advice is taken with the real reader: the check passes then, and nothing is broken by it."""

import math
import re
import time
from pathlib import Path

import pytest
import repo
from words import load

from geneva_cli.machine.mechanism import Mechanism, build
from geneva_cli.numerics.budget import OutOfTime, time_limit
from geneva_cli.spec.schema import fields
from geneva_cli.specfile.writer import keys_of
from geneva_cli.verdict import advice
from geneva_cli.verdict.advice import Adviser, judged, rounded
from geneva_cli.verdict.checks import Check, checks
from geneva_cli.verdict.checks.check import NONE

DESIGNS = repo.DESIGNS
CURVED = "[wheel]\nz = 6\n[motion]\nlaw = 'cycloidal'\nratio = 'matched'\n"
LOADED = (
    "[wheel]\nz = 6\n[size]\ncenter_distance_mm = 200\nroller_radius_mm = 8\nface_width_mm = 10\n"
    "[load]\ninertia_kgm2 = 0.4\ntorque_Nm = 15\n[limits]\n"
)
LIGHT = "[load]\ninertia_kgm2 = 0.05\n[limits]\n"

# What a person might write, the checks that then fail, and whether one change can help.
MOTIONS = {
    "acceleration": LOADED + "acceleration_max = 1.2\n",
    "velocity": LOADED + "velocity_max = 0.7\n",
    "entry": LOADED + "acceleration_entry_max = 0.3\n",
    "jerk": LOADED + "jerk_max = 1.0\n",
    "pin": LOADED + "pin_force_max_N = 250\n",
    "stress": LOADED + "contact_stress_max_MPa = 250\n",
    "torque": LOADED + "input_torque_max_Nm = 20\n",
    "internal": "[wheel]\nz = 5\ngearing = 'internal'\n[limits]\nvelocity_max = 0.3\n",
    "spherical": "[wheel]\nz = 5\ngearing = 'spherical'\n[limits]\nvelocity_max = 0.7\n",
    "side-crank": "[wheel]\nz = 6\n[drive]\nkind = 'side-crank'\nA = 0.1\n[limits]\n"
    "acceleration_max = 0.9\n",
    "elliptical": "[wheel]\nz = 6\n[drive]\nkind = 'elliptical-gears'\neccentricity = 0.1\n"
    "[limits]\nacceleration_max = 0.8\n",
    "convexity": "[wheel]\nz = 6\n[drive]\nkind = 'noncircular-gears'\nA = 0.9\n",
    "law": CURVED + "[limits]\nacceleration_max = 1.2\n",
    "pressure": CURVED + "alpha0_deg = -40\n[limits]\npressure_angle_max_deg = 10\n",
    "mid": "[wheel]\nz = 6\n[motion]\nlaw = 'cycloidal'\nratio = 0.45\n",
    "sine": "[wheel]\nz = 6\n[motion]\nlaw = 'sine-group'\nlambda = 0.2\nratio = 'matched'\n",
    "undercut": "[wheel]\nz = 8\ngearing = 'internal'\n[motion]\nlaw = 'cycloidal'\n"
    "ratio = 'matched'\n[size]\ncenter_distance_mm = 90\nroller_radius_mm = 5\n",
    "slider": (DESIGNS / "slider-crank.toml").read_text() + "[limits]\nacceleration_max = 0.40\n",
    "offset": "[wheel]\nz = 6\noffset_mm = 10\n" + LIGHT + "pin_force_max_N = 20\n",
    "offset-2": "[wheel]\nz = 5\noffset_mm = -8\n" + LIGHT + "input_torque_max_Nm = 0.5\n",
    "two": CURVED + LIGHT + "pin_force_max_N = 20\ninput_torque_max_Nm = 0.3\n",
    "steps": "[wheel]\nz = 6\nsteps_deg = [70, 50]\n" + LIGHT + "pin_force_max_N = 20\n",
    "epicyclic": "[wheel]\nz = 6\n[drive]\nkind = 'epicyclic'\nplanet_ratio = 'shockless'\n"
    "[limits]\nvelocity_max = 1.0\n",
}
FOUR_BAR = (DESIGNS / "four-bar-z4.toml").read_text() + LIGHT + "pin_force_max_N = 100\n"
PARTS = {
    "rim": "[wheel]\nz = 6\n[size]\nwheel_radius_mm = 120\n",
    "rim-inside": "[wheel]\nz = 6\ngearing = 'internal'\n[size]\nwheel_radius_mm = 85\n",
    "bore": "[wheel]\nz = 8\n[size]\ncenter_distance_mm = 250\nroller_radius_mm = 12\n"
    "crank_bore_mm = 30\n",
    "hub": "[wheel]\nz = 8\n[size]\ncrank_hub_mm = 20\n",
    "wheel-hub": "[wheel]\nz = 6\n[size]\nwheel_hub_mm = 90\n",
    "horn": "[wheel]\nz = 6\n[size]\nlock_radius_mm = 44.8\n",
    "wall": "[wheel]\nz = 12\n[size]\nroller_radius_mm = 9.5\nlock_radius_mm = 0\n",
    "thick": "[wheel]\nz = 12\nheld_by = 'brake'\n[size]\nroller_radius_mm = 9.5\n"
    "lock_radius_mm = 0\nwall_min_mm = 20\n",
    "wall-least": "[wheel]\nz = 10\n[size]\nwall_min_mm = 12\n",
    "no-lock": "[wheel]\nz = 6\n[size]\nlock_radius_mm = 0\n",
    "clearance": "[wheel]\nz = 5\n[size]\nlock_clearance_mm = 12\n",
    "arc": "[wheel]\nz = 24\n[size]\nrelief = 'arc'\nroller_radius_mm = 2\n",
    "four-bar": FOUR_BAR,
}
ALL = MOTIONS | PARTS
# A gear-Geneva without a jump has nothing to turn down; a roller of any size undercuts this slot.
HELPLESS = ("epicyclic", "undercut")


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
    file.write_text(text)
    return load(str(file))


def advised(mechanism: Mechanism, parts: bool) -> tuple[list[Check], float]:
    """The checks with their advice, and the longest that one advice took."""
    start = time.process_time()
    rows = checks(mechanism, parts=parts)
    adviser = Adviser(mechanism, rows, time.process_time() - start, parts)
    out, longest = [], 0.0
    for c in rows:
        start = time.process_time()
        said = adviser.advice(c) if c.passes is False and not c.nearest else c.nearest
        longest = max(longest, time.process_time() - start)
        out.append(c._replace(nearest=said))
    return out, longest


def stands(text: str, folder: Path, rows: list[Check], needed: bool, parts: bool) -> None:
    """Every advice holds; where it is needed there is one."""
    mechanism = read(folder, text)
    failing = [c for c in rows if c.passes is False]
    assert failing, "this spec is here because it fails"
    for c in failing:
        if not c.nearest:
            assert not needed, c.name
            continue
        taken = read(folder, take(text, c.nearest, mechanism))
        after = {r.name: r.passes for r in checks(taken, parts=parts)}
        broken = [r.name for r in rows if r.passes and after.get(r.name) is False]
        assert not broken, (c.name, c.nearest)
        assert after.get(c.name) is not False, (c.name, c.nearest)


@pytest.mark.parametrize("name", ALL)
def test_advice_passes_when_it_is_taken(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # However busy the machine is: the time has a test of its own.
    monkeypatch.setattr(advice, "SECONDS", 6.0)
    parts = name in PARTS  # of the others the motion and the limits: their parts take their time
    rows, _ = advised(read(tmp_path, ALL[name]), parts)
    stands(ALL[name], tmp_path, rows, name not in HELPLESS, parts)


def test_advice_takes_a_second_at_most(tmp_path: Path) -> None:
    """Of the processor: a trial that is begun is stopped there. It is asked in every loop; the
    longest way between two questions, drawing curved walls or building a linkage, takes 0.2 s,
    twice that on a busy day.
    """
    for name in ("rim-inside", "law", "slider", "bore", "four-bar"):
        rows, longest = advised(read(tmp_path, ALL[name]), parts=True)
        assert longest < advice.SECONDS + 0.4
        stands(ALL[name], tmp_path, rows, needed=False, parts=True)


def test_a_trial_that_is_begun_is_stopped() -> None:
    with time_limit(time.process_time()), pytest.raises(OutOfTime):
        checks(load(str(DESIGNS / "limits.toml")))


def test_without_time_there_is_no_advice(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(advice, "SECONDS", 0.0)
    (failing,) = [c for c in judged(read(tmp_path, ALL["rim"])) if c.passes is False]
    assert failing.nearest == NONE


def test_a_hub_is_not_proposed_below_its_bore(tmp_path: Path) -> None:
    """z = 8, L = 250, r = 12: 18.7 mm of room for a shaft of 15 and the hub around it."""
    rows, _ = advised(read(tmp_path, ALL["bore"]), parts=True)
    for c in rows:
        if "crank_hub_mm = " in c.nearest:
            assert float(c.nearest.split()[-1]) >= 30.0


def test_a_linkage_gets_more_slots(tmp_path: Path) -> None:
    """The centre distance that a linkage gives itself is none of the spec's: z = 9 has 0.396."""
    rows, _ = advised(read(tmp_path, ALL["slider"]), parts=False)
    assert {c.name: c.nearest for c in rows}["acceleration_max"] == "z = 9"


def test_the_spec_of_a_linkage_stays_as_it_was_given() -> None:
    mechanism = load(str(DESIGNS / "four-bar-z4.toml"))
    assert mechanism.spec.size.center_distance_mm is None
    again = build(mechanism.spec)
    assert again.spec == mechanism.spec
    assert again.center_distance_mm == mechanism.center_distance_mm != 100.0


@pytest.mark.parametrize("far", [100.0, -100.0, 1e-3])
@pytest.mark.parametrize("good", [12.3456, 0.001234567, -7.77777])
def test_rounding_leaves_what_fails(good: float, far: float) -> None:
    bad = good - math.copysign(0.1 * abs(good), far - good)
    shown = rounded(good, far, bad)
    assert (shown - good) * (good - bad) >= 0.0
    assert abs(shown - good) <= 0.02 * abs(good - bad)
