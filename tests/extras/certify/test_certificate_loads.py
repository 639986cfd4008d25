"""Certificates of loads: they hold 50-digit formulas, and refuse false claims."""

import json
import math

import mpmath
import pytest
from load_states import greatest
from sampling import some
from typer.testing import CliRunner

from geneva_cli import Design, External, Load, Size
from geneva_cli.cli.app import app
from geneva_cli.extras.certify.certificate import LOADS
from geneva_cli.loads.load_case import load_case

LOADED = Design(External(6), load=Load(0.4, 15))


def exact(name, a, carried=LOADED.spec.load, radius=0):
    """A load of six slots, whose R/L is 1/2 exactly, at an angle in radians: 50 digits.

    The crank turns against the wheel, so that the roller rubs with its own turn, 1, and the
    wheel's, on the wall that bears.
    """
    given, l, f = load_case(LOADED.mechanism), mpmath.mpf(1) / 2, mpmath.mpf(carried.friction)

    def lever(a):
        return mpmath.hypot(l * mpmath.sin(a), 1 - l * mpmath.cos(a))

    def angle(a):
        return mpmath.atan2(l * mpmath.sin(a), 1 - l * mpmath.cos(a))

    rate = mpmath.diff(angle, a)
    torque = mpmath.diff(angle, a, 2) * given.inertia_Nm + given.resists_Nm
    if name == "wheel_torque_Nm":
        return torque
    rubs = mpmath.diff(lever, a) + mpmath.sign(torque) * radius * (1 + rate)
    force = torque / (lever(a) - f * mpmath.sign(rubs) * radius) / given.L
    if name == "pin_force_N":
        return force
    lost = abs(force * rubs) * f * given.L
    given_back = torque * rate + lost
    return given_back / carried.efficiency if given_back > 0 else given_back


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", LOADS)
def test_the_bounds_hold_formulas_of_fifty_digits(name):
    found = LOADED.certificate(name)
    assert found.proved
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


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", LOADS[1:])
@pytest.mark.parametrize("share", [0.05, 0.3])
def test_the_bounds_hold_friction_of_fifty_digits(name, share):
    """The bounds are reached, and no place of a whole motion rises above them."""
    carried = Load(0.4, 15, friction=share, efficiency=0.8)
    machine = Design(External(6), load=carried)
    case = load_case(machine.mechanism)
    found = machine.certificate(name)
    assert found.proved
    with mpmath.workdps(50):
        at = mpmath.radians(mpmath.mpf(found.at_deg))
        # a place within 1e-6 degrees: the load changes there by less than 1e-7 of it
        here = abs(exact(name, at, carried, mpmath.mpf(case.radius)))
        assert abs(here - found.low) < 1e-7 * found.low
        for i in some(range(-599, 600), range(-599, 600, 6)):
            here = abs(exact(name, mpmath.radians(i / 10), carried, case.radius))
            assert here <= found.high


@pytest.mark.long
def test_friction_that_holds_the_wheel_is_not_proved():
    """A coefficient of 3: where the grip vanishes the force has no bound."""
    machine = Design(External(3), load=Load(0.0, 15, friction=3.0), size=Size(100.0, 12.0))
    # 250 intervals are more than any design needs to be proved
    found = machine.certificate("pin_force_N", 250)
    assert not found.proved
    assert math.isinf(greatest(machine.mechanism, "pin_force_N").max)


def test_the_command(tmp_path):
    file = tmp_path / "spec.toml"
    loaded = "[load]\ninertia_kgm2 = 0.4\ntorque_Nm = 15\nfriction = 0.1\n"
    file.write_text(f"[wheel]\nz = 6\n{loaded}[motion]\nlaw = 'cycloidal'\n")
    said = CliRunner().invoke(app, ["loads", str(file), "--certify", "--format", "json"]).stdout
    found = json.loads(said)
    torque, force, _ = found["certificate"]
    assert found["spec"] == str(file) and found["title"] is None
    assert torque["proved"] and torque["low"] <= torque["high"] and torque["why"] is None
    assert not force["proved"] and force["why"].startswith("the slot is curved")
    said = CliRunner().invoke(app, ["loads", str(file), "--certify"]).stdout
    assert "pin_force_N.max not proved: the slot is curved" in said
