"""Summaries: what a designer tells a colleague, in lines that fit and values that hold."""

import math

import pytest
import repo

from geneva_cli.answer import Summary, SummaryLine
from geneva_cli.design import Design, load
from geneva_cli.loads.load_tables import RATED_kW, recommended_motor
from geneva_cli.study.summary.load_lines import of_loads
from geneva_cli.study.summary.report_summary import of_tolerance, of_vibration
from geneva_cli.study.verdicts import tightest

pytestmark = pytest.mark.usefixtures("made_once")


def design(name: str, *given: str) -> Design:
    return load(str(repo.DESIGNS / f"{name}.toml"), given)


def line(summary: Summary, label: str) -> SummaryLine:
    (found,) = (one for one in summary.lines if one.label == label)
    return found


@pytest.mark.parametrize(
    ("power_W", "rated"), [(118.3, 0.12), (120.0, 0.12), (120.1, 0.18), (1.0, 0.06), (3.1e3, 4.0)]
)
def test_the_motor_is_the_next_standard_power(power_W: float, rated: float) -> None:
    """Whichever of both powers is greater; beyond the largest there is none."""
    by = {"power_W": 0.0, "motor_torque_max_Nm": 0.0, "motor_rpm": 1400.0, "input_torque_Nm": 1.0}
    torque = power_W * 60.0 / 1400.0 / math.tau * (1.0 - 1e-15)
    for name, value in (("power_W", power_W), ("motor_torque_max_Nm", torque)):
        assert recommended_motor(by | {name: value}).rated_kW == rated
    assert recommended_motor(by | {"power_W": 1e3 * RATED_kW[-1] + 1.0}).rated_kW is None
    assert list(RATED_kW) == sorted(set(RATED_kW))


def test_a_turret_gets_one_motor() -> None:
    """By hand: 22.8 N m at 40 rpm, over the efficiencies 0.95 and 0.85, take 118 W."""
    first, powers = of_loads(design("turret"), True).summaries
    motor = line(first, "motor")
    assert motor.text == "0.12 kW, 1400 rpm, gear ratio 35"
    by_hand = 22.80584 * 40.0 * math.tau / 60.0 / 0.95 / 0.85
    assert f"{by_hand:.4g} W with service factor 1.5" in motor.note
    assert "22.81 N m on the input" in motor.note
    assert line(first, "input").text.endswith("the wheel never drives the motor")
    sizes = [float(one.label.removesuffix(" W")) for one in powers.lines]
    assert sizes == sorted(sizes, reverse=True)
    assert len(sizes) == 6
    peak = 0.603613 * 1400.0 * math.tau / 60.0
    assert line(powers, f"{peak:.4g} W").text.startswith("greatest at the motor")


def test_vibration_names_the_speeds_to_avoid() -> None:
    one = design("turret")
    record = one.vibration(3.3, 0.02)
    speeds = record.to_dict()["speeds_to_avoid_rpm"]
    (summary,) = of_vibration(one, record).summaries
    assert line(summary, "avoid").text == ", ".join(f"{rpm:.4g}" for rpm in speeds) + " rpm"
    (summary,) = of_vibration(one, design("cam-geneva").vibration(80.0, 0.01)).summaries
    assert "practically at rest" in line(summary, "residual").text


def test_tolerance_names_what_contributes_most() -> None:
    one = design("tolerances")
    record = one.tolerance(64)
    answer = of_tolerance(one, record)
    (summary,) = answer.summaries
    assert line(summary, "greatest").text.startswith("slot angle contributes 72.2 %")
    worst = record.to_dict()["dwell_position.worst_deg"]
    assert f"{worst:.4g}° at worst" in line(summary, "dwell").text
    assert answer.page is not None
    assert "not_known" in answer.page.names
    assert answer.data is record


def test_the_tightest_check_is_nearest_to_its_limit() -> None:
    """No other passing check uses more of its limit; 61.41 of 82.5 MPa here."""
    checks = design("turret").checks
    (told,) = tightest(checks)
    bounded = [c for c in checks if c.passes and not c.why and c.value and c.limit]
    used = {
        c.name: c.value / c.limit if c.must_be == "at most" else c.limit / c.value
        for c in bounded
        if c.name != "dwell_hold"  # yes or no
    }
    assert max(used, key=used.__getitem__) == "crank_shaft_stress_MPa"
    assert told.text == "crank shaft stress 61.41 MPa at -17.24°, at most 82.5"
