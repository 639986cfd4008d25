"""The input stopped in each dwell: times, means and heat by hand, and what the brake takes."""

import math

import mpmath as mp
import pytest

from geneva_cli import (
    Carousel,
    Crank,
    Design,
    External,
    Load,
    Motor,
    RollerMaterial,
    Size,
)
from geneva_cli.errors import GenevaError
from geneva_cli.study.fields import values
from geneva_cli.verdict.quantities.groups import REPORT

STOPPED = Crank(n_rpm=60.0, stop_s=0.8, start_s=0.2, brake_s=0.1)
LOAD = Load(inertia_kgm2=0.4, torque_Nm=15.0)
OMEGA = 2.0 * math.pi  # 60 rpm


def test_times_by_hand() -> None:
    """Six slots move for 1/3 s and rest for 2/3 s of the turn, and 0.8 s longer."""
    timing = Design(External(6), STOPPED).timing
    assert (timing.motion_deg, timing.dwell_deg) == pytest.approx((120.0, 240.0), rel=1e-15)
    dwell, cycle = 2.0 / 3.0 + 0.8, 1.8
    assert (timing.dwell_s, timing.cycle_s) == pytest.approx((dwell, cycle), rel=1e-14)
    assert (timing.k, timing.tau) == pytest.approx((1 / 3 / dwell, 1 / 3 / cycle), rel=1e-14)


def test_means_and_heat_by_quadrature() -> None:
    """T = (I w² psi'' + M) psi' of the closed form, integrated by mpmath over the motion."""
    design = Design(External(6), STOPPED, load=LOAD, motor=Motor(gear_ratio=20.0))

    def torque(a: mp.mpf) -> mp.mpf:
        nenner = 5 - 4 * mp.cos(a)
        first = (2 * mp.cos(a) - 1) / nenner
        second = -6 * mp.sin(a) / nenner**2
        return (0.4 * (2 * mp.pi) ** 2 * second + 15) * first

    ends = [-mp.pi / 3, 0, mp.pi / 3]
    cycle = 1.8 * OMEGA  # as an angle
    mean = float(mp.quad(torque, ends)) / cycle
    rms = math.sqrt(float(mp.quad(lambda a: torque(a) ** 2, ends)) / cycle)
    loads = design.loads
    assert loads["input_torque_Nm"].mean == pytest.approx(mean, rel=1e-12)
    assert loads["input_torque_Nm"].rms == pytest.approx(rms, rel=1e-11)
    # a cycle does the work of the torque over the step
    assert loads["power_W"].mean == pytest.approx(15.0 * math.pi / 3.0 / 1.8, rel=1e-12)
    heat = design.strength["sizing.motor_torque_rms_Nm"]
    assert heat == pytest.approx(rms / 20.0, rel=1e-11)


def test_the_time_column_runs_on_as_the_speed_profile() -> None:
    """By hand: 93 degrees at full speed, 18 to a stop in 0.1 s, 0.65 s of rest, 36 in 0.2 s.

    Half-way through the time of braking and of starting 13.5 and 9 degrees have passed.
    """
    design = Design(External(6), STOPPED)
    rows = design.motion(at_deg=[60.0, 153.0, 166.5, 180.0, 207.0, 300.0]).to_dict()
    lead = 1.0 / 3.0 + 93.0 / 360.0
    by_hand = [1.0 / 3.0, lead, lead + 0.05, lead + 0.85, lead + 0.95, 1.8]
    assert rows["time_s"].tolist() == pytest.approx(by_hand, rel=1e-14)
    table = design.motion(50).to_dict()
    assert table["time_s"][-1] == pytest.approx(1.8, rel=1e-14)
    two = design.motion(at_deg=[table["input_deg"][0] + 720.0]).to_dict()
    assert two["time_s"].tolist() == pytest.approx([3.6], rel=1e-14)


def test_the_roller_lasts_as_many_motions_and_more_hours() -> None:
    size, roller = Size(face_width_mm=12.0), RollerMaterial(dynamic_capacity_N=5000.0)
    each = [
        Design(External(6), drive, load=LOAD, size=size, material_roller=roller).life
        for drive in (Crank(n_rpm=60.0), STOPPED)
    ]
    motions, hours = (
        [one[name] for one in each] for name in ("roller_life_motions", "roller_life_h")
    )
    assert motions[0] == motions[1]
    assert hours[1] == pytest.approx(1.8 * hours[0], rel=1e-13)


def test_what_the_brake_takes_by_hand() -> None:
    """0.002 kg m² behind 20 : 1 are 0.8 at the input, which turns at 2 pi rad/s."""
    motor = Motor(gear_ratio=20.0, inertia_kgm2=0.002)
    design = Design(External(6), STOPPED, load=LOAD, motor=motor)
    found = values(design.parts, [group for group in REPORT if group.table == "input_stop."])
    energy = 0.5 * 0.8 * OMEGA**2
    by_hand = {
        "stands_s": 0.8 - 0.15,
        "brake_deg": 18.0,  # half of 0.1 s at 360 degrees a second
        "start_deg": 36.0,
        "inertia_kgm2": 0.8,
        "brake_torque_Nm": 0.8 * OMEGA / 0.1,
        "start_torque_Nm": 0.8 * OMEGA / 0.2,
        "energy_J": energy,
        "power_W": energy / 1.8,
    }
    assert found == pytest.approx({f"input_stop.{k}": v for k, v in by_hand.items()}, rel=1e-13)
    runs = Design(External(6), Crank(), load=LOAD, motor=motor)
    none = values(runs.parts, [group for group in REPORT if group.table == "input_stop."])
    assert set(none.values()) == {None}


def test_a_stop_that_does_not_fit_is_a_warning() -> None:
    """A dwell of 240 degrees takes 3 n (brake_s + start_s) = 180 (0.7 + 0.7) = 252 not."""
    long = Crank(n_rpm=60.0, stop_s=2.0, start_s=0.7, brake_s=0.7)
    (text,) = Design(External(6), long).motion_warnings
    assert text.name == "stop-in-motion"
    assert "126° while it brakes" in text and "1.333 s together" in text
    fits = Crank(n_rpm=60.0, stop_s=2.0, start_s=0.6, brake_s=2.0 / 3.0 + 1.0 / 15.0)
    assert not Design(External(6), fits).motion_warnings


def test_what_makes_no_stop_is_refused() -> None:
    with pytest.raises(GenevaError, match=r"it must be at least 0\.2"):
        Crank(stop_s=0.1, start_s=0.2, brake_s=0.2)
    assert Crank(stop_s=0.15, start_s=0.1, brake_s=0.2).stands_s == pytest.approx(0.0, abs=1e-15)
    with pytest.raises(GenevaError, match="at constant speed: remove it"):
        _ = Design(External(4), Carousel(wheels=3, stop_s=0.5)).mechanism
