"""Results do not depend on the speed of the computer."""

import itertools
import time
from pathlib import Path

import pytest
from typer.testing import CliRunner

from geneva_cli.cli.app import app

CLOCKS = ("time", "monotonic", "perf_counter", "process_time", "thread_time")
HOUR = 3600
LOAD = "load = {inertia_kgm2 = 0.1, torque_Nm = 2}\n"
SPECS = {
    "passing.toml": "wheel = {z = 6}\n" + LOAD,
    # with advice: one change of a size, and one of a key of the motion
    "hub.toml": "wheel = {z = 6}\nsize = {crank_hub_mm = 60}\n",
    "law.toml": 'wheel = {z = 6}\nmotion = {law = "cycloidal", ratio = "matched"}\n'
    "limits = {acceleration_max = 1.2}\n" + LOAD,
}


def printed(line: str, seconds_a_reading: int) -> str:
    """What a command prints while each reading of any clock is that much later than the last."""
    readings = itertools.count(0, seconds_a_reading)
    with pytest.MonkeyPatch.context() as patch:
        for name in CLOCKS:
            patch.setattr(time, name, lambda: float(next(readings)))
            patch.setattr(time, f"{name}_ns", lambda: next(readings) * 10**9)
        result = CliRunner().invoke(app, line.split())
    assert result.exit_code in (0, 1) and "Error" not in result.output, result.output
    return result.stdout


@pytest.mark.long
@pytest.mark.parametrize(
    ("line", "shown"),
    [
        ("check passing.toml", "checks pass, 1 warning"),
        ("check hub.toml", "passes with crank_hub_mm"),
        ("check law.toml", "passes with alpha0_deg"),
        ("report passing.toml --format json", '"passes": true'),
        ("report law.toml", "passes with alpha0_deg"),
        ("loads passing.toml --format json", '"pin_force_N"'),
        ("synth --motion-deg 120 --z 6 --check 1 --format csv", "epicyclic"),
    ],
)
def test_a_slow_computer_prints_the_same_bytes(
    line: str, shown: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An hour passes from one reading of the clock to the next, or no time at all."""
    monkeypatch.chdir(tmp_path)
    for name, text in SPECS.items():
        Path(name).write_text(text, encoding="utf-8")
    slow, fast = printed(line, HOUR), printed(line, 0)
    assert slow == fast
    assert shown in slow
