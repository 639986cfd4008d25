"""Sizing: a maker's printed examples, closed forms, and sums by other means."""

import math
from types import SimpleNamespace

import mpmath as mp
import numpy as np
import pytest
import repo

from geneva_cli import Design, External, Load, Mass, Motor, Support, load
from geneva_cli.loads.sizing import WHEEL_INERTIA, indexer_formula, sizing_needs
from geneva_cli.motion.timing import CamFactors
from geneva_cli.numerics.angles import omega

DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))
every = pytest.mark.parametrize("file", DESIGNS, ids=lambda file: file.stem)


def sized(design):
    return SimpleNamespace(**design.strength.table("sizing"))


def straight(z=6, n_rpm=60.0, **rest):
    return Design(External(z), **rest).with_("drive.n_rpm", n_rpm)


# theory-loads.md 3: an index drive maker's example, printed, and a copy of its form
PLATE = Mass("disc", mass_kg=11.026, diameter_mm=300.0)
FIXTURES = Mass("point", mass_kg=3.0, count=6, radius_mm=100.0)
PARTS = Mass("point", mass_kg=0.25, count=6, radius_mm=100.0)


def turret(Am, Vm, Qm):
    g = 9.807  # the maker's
    friction = 0.15 * (11.026 + 18.0 + 1.5) * g * 0.1
    carried = 0.124 + 0.18 + 0.015, friction, 0.0
    return indexer_formula(CamFactors(Am, Vm, Qm), 60.0, 270.0, 80.0, carried, 2.0)


def test_the_published_indexer():
    found = turret(4.89, 2.0, 1.655)
    assert found["acceleration_rad_s2"] == pytest.approx(16.184, abs=5e-4)
    assert found["inertia_torque_Nm"] == pytest.approx(5.16, abs=5e-3)
    assert found["total_torque_Nm"] == pytest.approx(5.163 + 4.490, abs=1e-3)
    assert found["design_torque_Nm"] == pytest.approx(2 * found["total_torque_Nm"])


def test_the_same_turret_on_a_geneva():
    """The form by hand: table's factors of six slots, in 120 degrees at 40 rpm."""
    support = Support(friction=0.15, radius_mm=100.0)
    motor = Motor(service_factor=2.0, gear_efficiency=0.6, gear_ratio=20.0)
    design = straight(n_rpm=40.0, mass=(PLATE, FIXTURES, PARTS), support=support, motor=motor)
    found = sized(design)
    J = (11.026 * 0.3**2 / 8) + 6 * 3.25 * 0.1**2
    t2 = 60.0 / 40.0 / 3.0
    alpha = 5.653347401312479 * (math.pi / 3) / t2**2
    Tt = J * alpha + 0.15 * (11.026 + 19.5) * 9.80665 * 0.1
    Tc = 0.5 * 1.467549913168491 * 2.0 * Tt
    hand = {
        "inertia_kgm2": J,
        "acceleration_rad_s2": alpha,
        "inertia_torque_Nm": J * alpha,
        "friction_torque_Nm": Tt - J * alpha,
        "total_torque_Nm": Tt,
        "design_torque_Nm": 2.0 * Tt,
        "input_torque_Nm": Tc,
        "power_W": omega(40.0) * Tc / 0.6,
        "motor_rpm": 800.0,
    }
    for name, value in hand.items():
        # 1e-12: the factors as they are printed, to 16 digits, and some products
        assert vars(found)[name] == pytest.approx(value, rel=1e-12), name


@pytest.mark.sampled(40)
@every
def test_with_inertia_alone_the_energy_swings_by_what_the_wheel_holds(file):
    """theory-loads.md 4: exactly I w² psi1max²/2, and the form is the exact cycle's peak.

    On a carrier the wheel turns by 1 + psi1, and by 1 in its dwell.
    """
    design = load(str(file))
    load_ = Load(inertia_kgm2=0.4)
    if not design.spec.output.turns:  # a rack's mass is as an inertia at the crank's radius
        load_ = Load(mass_kg=0.4 / design.spec.output.rate_per_radian**2)
    loaded = Design.of(design.spec.replace(load=load_, mass=(), support=Support()))
    loaded = loaded.with_("motor.gear_ratio", None).with_("motor.gear_efficiency", None)
    found = sized(loaded)
    w = omega(loaded.spec.drive.n_rpm)
    on_carrier = float(loaded.spec.drive.NAME == "carousel")
    fastest = on_carrier + loaded.peaks.velocity.max
    held = 0.4 * w * w * (fastest**2 - on_carrier) / 2
    # 1e-12: quadrature agrees to 1e-13 of the whole
    assert found.energy_fluctuation_J == pytest.approx(held, rel=1e-12)
    motor = loaded.peaks.power.max * 0.4 * w * w
    if not on_carrier:  # whose torque is proved in test_carousel.py
        assert found.motor_torque_max_Nm == pytest.approx(motor, rel=1e-12)


def test_a_resistance_alone_by_its_integral():
    """T1 = Mr psi1: the work is Mr psi, less the mean line between the places psi1 = mean."""
    found = sized(straight(load=Load(torque_Nm=15.0)))
    l, mean = mp.mpf(1) / 2, mp.mpf(1) / 6  # a sixth of a turn in a turn

    def psi(a):
        return mp.atan2(l * mp.sin(a), 1 - l * mp.cos(a))

    a = mp.findroot(lambda a: mp.diff(psi, a) - mean, mp.mpf("0.8"))
    exact = 15 * 2 * (psi(a) - mean * a)
    assert found.energy_fluctuation_J == pytest.approx(float(exact), rel=1e-12)


@pytest.mark.sampled(6)
@pytest.mark.parametrize("name", ["two-rollers-side-crank", "press-curved", "unequal-steps"])
@pytest.mark.parametrize("friction", [0.0, 0.1])
def test_the_swing_of_the_work_against_sums_of_a_fine_table(name, friction):
    design = load(str(repo.DESIGNS / f"{name}.toml")).with_("load.friction", friction)
    design = design.with_("load.torque_Nm", 5.0).with_("load.inertia_kgm2", 0.4)
    design = design.with_("load.efficiency", 0.9)
    table = design.load_cycle(40001).to_dict()
    torque = np.asarray(table["input_torque_Nm"], dtype=float)
    step = math.radians(design.mechanism.period_deg) / 40000
    work = np.concatenate([[0.0], np.cumsum(0.5 * (torque[1:] + torque[:-1]) * step)])
    work -= np.linspace(0.0, work[-1], len(work))
    # 1e-4: trapezia over the jumps of the torque
    assert sized(design).energy_fluctuation_J == pytest.approx(work.max() - work.min(), rel=1e-4)


@pytest.mark.long
def test_motor_and_flywheel():
    """Against sums over a fine table, the reducer driving and driven."""
    motor = Motor(gear_ratio=35.0, gear_efficiency=0.8, inertia_kgm2=3e-4, speed_variation=0.1)
    design = straight(8, 40.0, load=Load(1.2, 5.0), motor=motor)
    found = sized(design)
    torque = np.asarray(design.load_cycle(200001).to_dict()["input_torque_Nm"], dtype=float)
    at_motor = np.where(torque > 0.0, torque / 0.8, torque * 0.8) / 35.0
    assert torque.min() < 0.0  # the wheel drives the motor somewhere
    assert found.motor_rpm == 1400.0
    # 1e-8: between two of so many samples a peak stands no higher; 1e-6: their trapezia
    assert found.motor_torque_max_Nm == pytest.approx(abs(at_motor).max(), rel=1e-8)
    assert found.motor_torque_rms_Nm == pytest.approx(math.sqrt(np.mean(at_motor**2)), rel=1e-5)
    w, psi1 = omega(40.0), 0.619914404421775
    assert found.flywheel_kgm2 == pytest.approx(found.energy_fluctuation_J / (0.1 * w * w))
    own = 3e-4 * 35.0**2
    assert found.flywheel_to_add_kgm2 == pytest.approx(found.flywheel_kgm2 - own)
    mu = 1.2 * psi1**2 / own
    assert found.inertia_ratio == pytest.approx(mu, rel=1e-14)
    assert sizing_needs(vars(found) | {WHEEL_INERTIA: 1.0}, ()) == [
        "friction_torque_Nm: needs friction and radius_mm in [support]"
    ]
