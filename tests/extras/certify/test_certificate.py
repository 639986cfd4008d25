"""Certificates of the peaks: they hold what the closed forms and the search say, and no more."""

import json

import mpmath
import pytest
import repo
from sampling import some
from typer.testing import CliRunner

from geneva_cli import (
    Crank,
    Design,
    EllipticalGears,
    External,
    GenevaError,
    ModifiedSine,
    Motion,
    SideCrank,
    SineConstantCosine,
)
from geneva_cli.cli.app import app
from geneva_cli.design import load
from geneva_cli.extras.certify import certificate as module
from geneva_cli.extras.certify.certificate import certificate
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
        if all(place.is_narrow for place in proof.places):
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
