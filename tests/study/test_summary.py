"""Summaries: what a designer tells a colleague, in lines that fit and values that hold."""

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import repo
from sampling import some
from typer.testing import CliRunner

from geneva_cli import Crank, External, Load, Motor
from geneva_cli.answer import FAILS, PASSES, WARNS, Summary, SummaryLine
from geneva_cli.cli.app import app
from geneva_cli.design import Design, load
from geneva_cli.loads.indexer_formula import RATED_kW, RecommendedMotor
from geneva_cli.output.terminal import terminal_tables as terminal
from geneva_cli.output.terminal.layout import Window
from geneva_cli.output.terminal.summary import chunks
from geneva_cli.study.summary.load_lines import of_loads
from geneva_cli.study.summary.report_summary import of_report
from geneva_cli.study.summary.vibration_summary import of_tolerance, of_vibration

pytestmark = pytest.mark.usefixtures("made_once")
TURRET = str(repo.DESIGNS / "turret.toml")


def test_a_terminal_says_what_extremes_and_means_are_over() -> None:
    """The least stress of the motions is above the mean, which counts the dwells too."""
    turret = design("turret")
    stress = turret.loads["contact_stress_MPa"]
    assert stress.min > stress.mean
    text = "".join(terminal.chunks(turret.loads_page, Window(80)))
    assert "max and min over the motions; mean and rms over the whole period" in text


def design(name: str, *given: str) -> Design:
    return load(str(repo.DESIGNS / f"{name}.toml"), given)


def line(summary: Summary, label: str) -> SummaryLine:
    (found,) = (one for one in summary.lines if one.label == label)
    return found


def shown(summary: Summary, width: int, unicode: bool = True) -> str:
    return "".join(chunks([summary], Window(width, unicode=unicode)))


@pytest.mark.parametrize(
    ("power_W", "rated"), [(118.3, 0.12), (120.0, 0.12), (120.1, 0.18), (1.0, 0.06), (3.1e3, 4.0)]
)
def test_the_motor_is_the_next_standard_power(power_W: float, rated: float) -> None:
    """Whichever of both powers is greater; beyond the largest there is none."""
    assert RecommendedMotor(power_W, 0.0, 1400.0, 1.0).rated_kW == rated
    assert RecommendedMotor(0.0, power_W, 1400.0, 1.0).rated_kW == rated
    assert RecommendedMotor(1e3 * RATED_kW[-1] + 1.0, 0.0, 1400.0, 1.0).rated_kW is None
    assert list(RATED_kW) == sorted(set(RATED_kW))


def test_a_turret_gets_one_motor() -> None:
    """By hand: 22.8 N m at 40 rpm, over the efficiencies 0.95 and 0.85, take 118 W."""
    first, powers = of_loads(design("turret")).summaries
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


def test_a_slow_input_without_a_reducer_gets_a_gear_ratio() -> None:
    first, *_ = of_loads(design("internal-z6")).summaries
    assert line(first, "motor").text.endswith("as gear ratio 46.7 from 1400 rpm")


def test_a_motor_on_the_input_shaft_keeps_its_ratio_and_shows_its_need() -> None:
    """A stepper without a reducer: the greatest T1 w of the cycle, and T1, far below 60 W.

    T1 = (I w² psi'' + T) psi' is greatest at the root of its derivative, here by a scan; a step of
    2e-5 of the motion is within 1e-8 of it.
    """
    w, a = 15.0 * math.tau / 60.0, np.linspace(-67.5, 67.5, 50_001) * math.pi / 180.0
    l = math.sin(math.pi / 8)
    D = 1.0 - 2.0 * l * np.cos(a) + l * l
    speed, rate = l * (np.cos(a) - l) / D, -l * (1.0 - l * l) * np.sin(a) / D**2
    torque = float(((0.01 * w * w * rate + 0.02) * speed).max())
    direct = Design(
        External(8), Crank(n_rpm=15.0), load=Load(0.01, 0.02), motor=Motor(gear_ratio=1.0)
    )
    first, *_ = of_loads(direct).summaries
    motor = line(first, "motor")
    assert motor.text == f"{torque * w:.4g} W, {torque:.4g} N m, 15 rpm, gear ratio 1"
    assert "less than the smallest motor of IEC 60072-1, 0.06 kW" in motor.note


def test_where_the_wheel_drives_the_motor_it_is_said() -> None:
    first, *_ = of_loads(design("limits")).summaries
    assert "drives the motor with up to 0.8559 N m" in line(first, "input").text
    assert first.state == WARNS


def test_without_a_load_no_motor_is_named() -> None:
    (only,) = of_loads(design("turret", "load.inertia_kgm2=0", "load.torque_Nm=0")).summaries
    assert "set inertia_kgm2 or torque_Nm in [load]" in line(only, "loads").text


def test_what_has_no_bound_gets_no_motor(tmp_path: Path) -> None:
    """Friction holds the wheel of three slots at mid-motion, however hard the roller presses."""
    file = tmp_path / "spec.toml"
    file.write_text("[wheel]\nz = 3\n[load]\ntorque_Nm = 3\nfriction = 3\n", encoding="utf-8")
    first, *_ = of_loads(load(str(file))).summaries
    assert line(first, "motor").state == WARNS
    assert "nothing bounds" in line(first, "motor").text


@pytest.mark.parametrize("name", ["turret", "spherical-z6", "internal-curved-z8", "unequal-steps"])
def test_a_report_has_six_figures_and_a_motor(name: str) -> None:
    one = design(name)
    (summary,) = of_report(one).summaries
    plain = [each for each in summary.lines if each.state == "" or each.label == "motor"]
    assert len(plain) == 7
    assert plain[-1].label == "motor"
    assert summary.state == (WARNS if one.warnings else PASSES)
    assert len([each for each in summary.lines if each.label == "warning"]) == len(one.warnings)


def test_a_failing_report_begins_with_what_fails() -> None:
    (summary,) = of_report(design("turret", "limits.velocity_max=0.5")).summaries
    assert summary.state == FAILS
    assert summary.lines[0].label == "peak velocity"
    assert "geneva explain velocity_max" in summary.lines[0].note


def test_vibration_names_the_speeds_to_avoid() -> None:
    one = design("tuned-dial")
    record = one.vibration()
    (summary,) = of_vibration(one, record).summaries
    speeds = record.to_dict()["speeds_to_avoid_rpm"]
    assert line(summary, "avoid").text == ", ".join(f"{rpm:.4g}" for rpm in speeds) + " rpm"
    assert "practically at rest" in line(summary, "residual").text


def test_tolerance_names_what_contributes_most() -> None:
    one = design("tolerances")
    record = one.tolerance(1024)
    answer = of_tolerance(one, record)
    (summary,) = answer.summaries
    assert line(summary, "greatest").text.startswith("slot angle contributes 72.2 %")
    worst = record.to_dict()["dwell_position.worst_deg"]
    assert f"{worst:.4g}° at worst" in line(summary, "dwell").text
    assert answer.page is not None
    assert "not_known" in answer.page.names
    assert answer.data is record


def test_unknown_values_take_one_line_beside_a_cycle(tmp_path: Path) -> None:
    """Five notes on keys that are missing; a warning keeps a line of its own."""
    result = CliRunner().invoke(app, ["loads", TURRET, "-o", str(tmp_path / "cycle.csv")])
    assert result.exit_code == 0
    warned, note = result.stderr.splitlines()
    assert warned.endswith("[wheel-left-out]")
    assert note.endswith("`geneva loads SPEC` lists the keys that they need")


@pytest.mark.sampled(8)
@pytest.mark.parametrize("width", [60, 80, 100])
@pytest.mark.parametrize("name", ["turret", "press-345", "tuned-dial", "tolerances"])
def test_no_line_is_wider_than_the_window(name: str, width: int) -> None:
    """And no word of it is lost."""
    one = design(name)
    for answer in (of_report(one), of_loads(one)):
        for summary in answer.summaries:
            text = shown(summary, width)
            assert max(map(len, text.splitlines())) <= width
            for each in summary.lines:
                words = {word.replace("\u00a0", " ") for word in each.text.split()}
                assert words <= set(text.replace("\u00a0", " ").split()) | {
                    word for word in words if " " in word
                }


@pytest.mark.parametrize("width", range(20, 44))
def test_a_value_and_its_unit_stand_on_one_line(width: int) -> None:
    text = "up to 1.099 N m on the input and 9.4e-07 kg m² of the load at -61.18 deg of 7 mm"
    lines = shown(Summary("fine", (SummaryLine("pin", text),), PASSES), width).splitlines()[2:]
    assert " ".join(line.strip() for line in lines) == f"pin  {text}"
    for value in ("1.099 N m", "9.4e-07 kg m²", "-61.18 deg", "7 mm"):
        assert any(value in line for line in lines)


def test_an_ascii_terminal_gets_ascii() -> None:
    """Powers of ten as a program writes them, and a sign in letters."""
    summary = Summary(
        "fine", (SummaryLine("pin", "1.23\u00a0×\u00a010⁻⁵ N at -3.5°, 2 kg m²"),), PASSES
    )
    assert shown(summary, 80, unicode=False) == "ok fine\n\n  pin  1.23e-5 N at -3.5 deg, 2 kg m2\n"
    assert shown(summary._replace(state=FAILS, lines=()), 80, unicode=False) == "x fine\n"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("command", ["loads", "report", "vibration", "tolerance"])
def test_a_warning_stands_once_on_both_streams(command: str) -> None:
    spec = str(repo.DESIGNS / ("tuned-dial.toml" if command == "vibration" else "press-345.toml"))
    given = ["--set", "tolerance.slot_angle_deg=0.01"] if command == "tolerance" else []
    for format in some(("table", "md", "json", "csv"), ("table", "json")):
        found: Any = CliRunner().invoke(app, [command, spec, *given, "--format", format])
        both = " ".join(f"{found.stdout} {found.stderr}".split())
        names = re.findall(r"not positively driven from", both)
        assert len(names) == (0 if command == "vibration" else 1), format
