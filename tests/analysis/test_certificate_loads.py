"""Certificates of loads without friction: they hold 50-digit formulas, and refuse false claims."""

import json

import mpmath
import pytest
import repo
from typer.testing import CliRunner

from geneva_cli import Design, External, GenevaError, Load
from geneva_cli.analysis.certificate_loads import LOADS
from geneva_cli.analysis.forces import load_case
from geneva_cli.app import app
from geneva_cli.design import load
from geneva_cli.loads.loads import greatest

LOADED = Design(External(6), load=Load(0.4, 15))
STRAIGHT = ("side-crank-z6", "spherical-60deg", "offset-slots", "unequal-steps", "four-bar-z4")


def loaded(name):
    return Design.of(load(str(repo.DESIGNS / f"{name}.toml")).spec.replace(load=Load(0.4, 15)))


def exact(name, a):
    """A load of six slots, whose R/L is 1/2 exactly, at an angle in radians: 50 digits."""
    given, l = load_case(LOADED.mechanism), mpmath.mpf(1) / 2

    def angle(a):
        return mpmath.atan2(l * mpmath.sin(a), 1 - l * mpmath.cos(a))

    torque = mpmath.diff(angle, a, 2) * given.inertia_Nm + given.resists_Nm
    if name == "input_torque_Nm":
        return torque * mpmath.diff(angle, a)
    if name == "pin_force_N":
        return torque / mpmath.hypot(l * mpmath.sin(a), 1 - l * mpmath.cos(a)) / given.L
    return torque


@pytest.mark.parametrize("name", LOADS)
def test_the_bounds_hold_formulas_of_fifty_digits(name):
    found = LOADED.certificate(name)
    assert found.proved and found.about == "the spec's numbers as doubles"
    with mpmath.workdps(80):
        start = mpmath.radians(mpmath.mpf(found.at_deg))
        top = mpmath.findroot(lambda a: mpmath.diff(lambda x: exact(name, x), a), start, tol=1e-30)
        size = abs(exact(name, top))
        # sizes of doubles: 1 unit in the last place of an end that is rounded outwards
        assert found.low <= size * (1 + mpmath.mpf(1e-15))
        assert size * (1 - mpmath.mpf(1e-15)) <= found.high
        assert found.high - found.low <= 1e-14 * found.high
        for share in (1e-9, -1e-9):
            assert not found.low <= size * (1 + mpmath.mpf(share)) <= found.high
        for i in range(-59, 60):  # no sample rises above the bounds
            assert abs(exact(name, mpmath.radians(i))) <= found.high


@pytest.mark.parametrize("design", STRAIGHT)
@pytest.mark.parametrize("name", LOADS)
def test_the_search_is_confirmed(design, name):
    machine = loaded(design)
    found, peak = machine.certificate(name), greatest(machine.mechanism, name)
    assert found.proved
    assert found.confirms(*peak), f"{peak} against {found.text}"
    for share in (1e-9, -1e-9):
        assert not found.confirms(peak.max * (1.0 + share), peak.at_deg)


REFUSED = {
    "friction": (Load(0.4, 15, friction=0.1), "side-crank-z6", "pin_force_N"),
    "efficiency": (Load(0.4, 15, efficiency=0.9), "side-crank-z6", "input_torque_Nm"),
    "curved": (Load(0.4, 15), "sine-group", "pin_force_N"),
    "gears drive": (Load(0.4, 15), "gear-sector", "pin_force_N"),
    "no load": (Load(), "side-crank-z6", "wheel_torque_Nm"),
}


@pytest.mark.parametrize("reason", REFUSED)
def test_a_load_that_is_not_proved_says_why(reason):
    carried, name, quantity = REFUSED[reason]
    machine = Design.of(load(str(repo.DESIGNS / f"{name}.toml")).spec.replace(load=carried))
    with pytest.raises(GenevaError, match=f"{quantity}.max is not proved: .*{reason}"):
        machine.certificate(quantity)


def test_the_torque_of_a_wheel_needs_no_straight_slot():
    assert loaded("sine-group").certificate("wheel_torque_Nm").proved


def test_the_command(tmp_path):
    file = tmp_path / "spec.toml"
    file.write_text("[wheel]\nz = 6\n[load]\ninertia_kgm2 = 0.4\ntorque_Nm = 15\nfriction = 0.1\n")
    said = CliRunner().invoke(app, ["loads", str(file), "--certify", "--format", "json"]).stdout
    found = json.loads(said)
    torque, force, _ = found["certificate"]
    assert found["spec"] == str(file) and found["title"] is None
    assert torque["proved"] and torque["low"] <= torque["high"] and torque["why"] is None
    assert not force["proved"] and force["why"].startswith("friction")
    said = CliRunner().invoke(app, ["loads", str(file), "--certify"]).stdout
    assert "pin_force_N.max not proved: friction" in said
    assert "about the spec's numbers as doubles" in said
