"""Rows of ``motion``: over a period, at chosen input angles, and the rates at the spec's speed."""

import math

import mpmath as mp
import numpy as np
import pytest
from typer.testing import CliRunner
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli import Crank, Design, External, Linear, Size
from geneva_cli.cli.app import app

SPECS = [
    Spec(Wheel(5, "internal")),
    Spec(Wheel(6), Drive("side-crank", rollers=2), Keys("side-crank", 0.6)),
    Spec(Wheel(6), motion=Motion("sine-group", 0.1, alpha0_deg=-20.0)),
]


@pytest.mark.parametrize("spec", SPECS)
def test_dwell_is_still_and_motion_is_not(spec: Spec) -> None:
    design = Design.of(spec)
    at = design.motion(7201)
    moving = np.zeros(7201, dtype=bool)
    for s in design.mechanism.engagements:
        local = at["input_deg"] - s.mid_deg
        inside = (local > s.entry_deg + 1e-9) & (local < s.exit_deg - 1e-9)
        moving |= (local > s.entry_deg - 1e-9) & (local < s.exit_deg + 1e-9)
        # every row is the engagement's own motion, evaluated one by one
        for i in np.flatnonzero(inside)[::97]:
            value = s.motion(float(local[i])).derivatives()
            for name, order in (("velocity", 1), ("acceleration", 2), ("jerk", 3)):
                # the row's angle in the machine is rounded once more: 1e-13 of the peak
                close = 2e-13 * np.abs(at[name]).max()
                assert at[name][i] == pytest.approx(value[order], abs=close)
    for name in ("velocity", "acceleration", "jerk"):
        assert (at[name][~moving] == 0.0).all()


def test_rates_against_the_closed_form_at_50_digits() -> None:
    """psi = atan2(l sin a, 1 - l cos a) of six slots at 30 rpm, differentiated by mpmath."""
    rows = Design(External(6), Crank(n_rpm=30.0)).motion(at_deg=[-30.0, 20.0, 45.0]).to_dict()
    with mp.workdps(50):
        omega = mp.pi

        def psi(t: mp.mpf) -> mp.mpf:
            a = omega * t
            return mp.atan2(mp.sin(a) / 2, 1 - mp.cos(a) / 2)

        for i, a_deg in enumerate((-30, 20, 45)):
            t = mp.radians(a_deg) / omega
            assert rows["omega_rad_s"][i] == pytest.approx(float(mp.diff(psi, t)), rel=1e-13)
            alpha = float(mp.diff(psi, t, 2))
            assert rows["alpha_rad_s2"][i] == pytest.approx(alpha, rel=1e-12)
            assert rows["wheel_deg"][i] == pytest.approx(math.degrees(psi(t)), rel=1e-13)
            assert rows["time_s"][i] == pytest.approx((a_deg + 60.0) / 180.0, rel=1e-14)


def test_a_rack_has_its_speed_in_metres() -> None:
    """At mid-motion the rack is as fast as the roller, R w."""
    rack = Design(Linear(6), Crank(n_rpm=60.0), size=Size(center_distance_mm=50.0))
    row = rack.motion(at_deg=[0.0]).to_dict()
    assert row["rack_speed_m_s"][0] == pytest.approx(0.05 * 2.0 * math.pi, rel=1e-14)
    assert "omega_rad_s" not in row


def test_any_turn_and_any_order() -> None:
    """The wheel's angle and the time go on from turn to turn; entry and exit are of the motion."""
    rows = Design(External(6)).motion(at_deg=[660.0, -60.0, 60.0, -100.0, 180.0]).to_dict()
    assert rows["input_deg"].tolist() == [660.0, -60.0, 60.0, -100.0, 180.0]
    assert rows["wheel_deg"].tolist() == pytest.approx([90.0, -30.0, 30.0, -30.0, 30.0])
    assert rows["time_s"].tolist() == pytest.approx([2.0, 0.0, 1 / 3, -1 / 9, 2 / 3])
    slope = math.tan(math.pi / 6.0)  # the jump at entry, tan(pi/z)
    accelerations = [slope, slope, -slope, 0.0, 0.0]
    assert rows["acceleration"].tolist() == pytest.approx(accelerations, rel=1e-12)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--at", "a"), "--at a: it must be numbers"),
        (("--at", "1..x"), '"x" is no number'),
        (("--at", "1,,2"), "neither a number nor a word"),
        (("--at", "1e9"), "at most 360000 degrees"),
        (("--at", "3", "--samples", "3"), "--at sets the rows: leave out"),
        (("--at", "3", "--turns", "2"), "--at sets the rows: leave out"),
        (("--at", "3", "--format", "cam"), "a cam has the points"),
    ],
)
def test_bad_angles_are_refused(options: tuple[str, ...], message: str) -> None:
    shown = CliRunner().invoke(app, ["motion", "designs/offset-slots.toml", *options])
    assert shown.exit_code == 2
    assert message in shown.stderr
