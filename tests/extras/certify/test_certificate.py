"""Certificates of the peaks: they hold what the closed forms and the search say, and no more."""

import json
import math

import mpmath
import pytest
import repo
from load_states import greatest
from sampling import some
from typer.testing import CliRunner

from geneva_cli import (
    Crank,
    Design,
    EllipticalGears,
    External,
    GenevaError,
    Load,
    ModifiedSine,
    Motion,
    SideCrank,
    SineConstantCosine,
    Size,
)
from geneva_cli.cli.app import app
from geneva_cli.design import load
from geneva_cli.extras.certify import certificate as module
from geneva_cli.extras.certify.certificate import LOADS, certificate
from geneva_cli.loads.load_case import load_case
from geneva_cli.motion.given_motion import LawMotion
from geneva_cli.motion.peaks import QUANTITIES

DESIGNS = sorted(path.stem for path in repo.DESIGNS.glob("*.toml"))
# Of a peak: the rounding of both bounds to doubles, and at most 64 units of an end.
WIDE = 5e-14


def design(name):
    return load(str(repo.DESIGNS / f"{name}.toml"))


@pytest.mark.sampled(72)
@pytest.mark.parametrize("name", DESIGNS)
def test_every_design_is_certified_and_its_peaks_confirmed(name):
    found = design(name)
    for quantity in QUANTITIES:
        proof, peak = found.certificate(quantity), getattr(found.peaks, quantity)
        assert proof.proved
        assert proof.high - proof.low <= WIDE * proof.high
        assert proof.confirms(*peak), f"{quantity}: {peak} against {proof.text}"


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", some(DESIGNS, ["side-crank-z6", "unequal-steps", "table-law"]))
def test_false_claims_are_refused(name):
    found = design(name)
    for quantity in QUANTITIES:
        proof, (size, at_deg) = found.certificate(quantity), getattr(found.peaks, quantity)
        for share in (1e-12, 1e-9, 1e-3):
            assert not proof.confirms(size * (1.0 + share), at_deg)
            assert not proof.confirms(size * (1.0 - share), at_deg)
        if all(b - a < module.NARROW_DEG for a, b in proof.places):
            assert not proof.confirms(size, at_deg + 1e-3)


def test_the_bounds_hold_a_closed_form():
    """A plain wheel's greatest velocity is l/(1 - l), with l = sin(pi/z) to 50 digits."""
    for z in (3, 5, 7, 12):
        with mpmath.workdps(50):
            l = mpmath.sin(mpmath.pi / z)
            found = Design(External(z)).certificate("velocity")
            assert found.low <= l / (1 - l) * (1 + WIDE) and found.high >= l / (1 - l) * (1 - WIDE)
            assert found.where == "unique"


def test_a_peak_at_a_jump_and_a_plateau():
    """Outside the wheel the acceleration peaks inside; inside it jumps at entry and exit."""
    inside = design("internal-z6").certificate("acceleration")
    assert inside.where == "at two mirrored places"
    entry_deg = design("internal-z6").mechanism.engagements[0].entry_deg
    assert inside.places[0].from_deg <= entry_deg <= inside.places[0].to_deg
    gears = design("gear-sector").certificate("velocity")
    assert gears.where.startswith("between ")
    (place,) = gears.places
    assert place.from_deg <= -30.0 and place.to_deg >= 30.0  # the gears drive for 60 degrees


def test_a_peak_where_two_formulas_meet():
    """The law's acceleration peaks where its first sine ends, at a double beside the exact place.

    The middle of an interval about it was rounded to the other formula's side.
    """
    motion = Motion(ModifiedSine(), alpha0_deg=16.54737042052723)
    drive = EllipticalGears(eccentricity=0.4245922304126838, phase="quick")
    found = Design(External(5), drive, motion)
    proof = found.certificate("acceleration")
    assert proof.confirms(*found.peaks.acceleration)
    assert proof.where == "at two mirrored places"
    seams = found.mechanism.engagements[0].motion.seams_deg
    assert proof.at_deg == pytest.approx(seams[1], abs=1e-9)


def test_a_seam_that_is_not_known_is_not_proved(monkeypatch):
    """Formulas hand over at 0.15 and 0.35 of the motion's time: unknown, nothing is claimed."""
    curved = Design(External(6), Crank(), Motion(SineConstantCosine(b=0.3, c=0.4, d=0.3)))
    assert curved.certificate("jerk").proved
    whole = property(lambda motion: (motion.entry_deg, 0.0, motion.exit_deg))
    monkeypatch.setattr(LawMotion, "seams_deg", whole)
    found = certificate(curved.mechanism, "jerk")
    assert not found.proved
    share = (found.open.to_deg - found.open.from_deg) / curved.timing.motion_deg
    at = 0.5 + found.open.from_deg / curved.timing.motion_deg
    assert share < 1e-6
    assert min(abs(at - cut) for cut in curved.spec.motion.law.breaks) < 1e-6


def test_what_is_printed_is_rounded_outwards():
    found = Design(External(6)).certificate("acceleration")
    low, high = found.text.partition("[")[2].partition("]")[0].split(", ")
    assert float(low) <= found.low and found.high <= float(high)
    assert float(high) - float(low) <= 2e-14


@pytest.mark.long
def test_the_command():
    path = str(repo.DESIGNS / "unequal-steps.toml")
    said = CliRunner().invoke(app, ["peaks", path, "--certify"]).stdout
    assert "velocity.max in [1.42591999815959, 1.42591999815960], unique, proved" in said
    said = CliRunner().invoke(app, ["peaks", path, "--certify", "--format", "json"]).stdout
    first = json.loads(said)["certificate"][0]
    assert first["quantity"] == "velocity" and first["proved"] is True
    assert first["low"] <= 1.4259199981595914 <= first["high"]
    assert first["places"][0][0] <= first["at_deg"] <= first["places"][0][1]
    assert first["open"] is None and first["intervals"] > 0


def test_without_flint_the_extra_is_named(monkeypatch):
    monkeypatch.setattr(module, "find_spec", lambda name: None)
    with pytest.raises(GenevaError, match=r'pip install "geneva-cli\[certify\]"'):
        Design(External(6)).certificate("velocity")


def test_few_intervals_are_not_proved_and_the_open_one_is_named():
    found = Design(External(6), SideCrank(A=0.6)).certificate("jerk", intervals=3)
    assert not found.proved and found.high is None and found.places == ()
    assert found.low > 0.0
    assert "not proved: open from " in found.text
    assert found.open.from_deg < found.open.to_deg
    assert not found.confirms(1.40625, 0.0)


def test_another_quantity_is_refused_with_the_nearest():
    with pytest.raises(GenevaError, match=r'"accelaration".*acceleration'):
        Design(External(6)).certificate("accelaration")


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


@pytest.mark.parametrize("name", ["four-bar-z4", "slider-crank"])
def test_the_input_of_a_linkage_takes_the_power_of_the_inertia(name):
    machine = design(name).with_("load.inertia_kgm2", 0.01)
    power, torque = (certificate(machine.mechanism, one) for one in ("power", LOADS[-1]))
    assert power.open is torque.open is None
    w = machine.spec.drive.n_rpm * math.pi / 30.0
    assert torque.low == pytest.approx(0.01 * w * w * power.low, rel=1e-13)


def test_the_command_for_loads(tmp_path):
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
