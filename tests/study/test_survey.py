"""The table of wheels: closed forms against the general machinery, and the names it prints."""

import pytest
from sampling import some
from witness import Geneva, near, to_degrees

from geneva_cli.errors import GenevaError
from geneva_cli.motion.peaks import peak
from geneva_cli.motion.wheels import classic
from geneva_cli.numerics.angles import sin_cos_pi
from geneva_cli.study.survey import parse_z, survey

# As the interface fixes them; scripts depend on the order.
FIELDS = """
    z gearing rollers motion_deg dwell_deg index_deg k tau motion_s dwell_s cycle_s
    velocity_max acceleration_max acceleration_max_deg acceleration_entry jerk_entry rollers_max
    Am Vm Qm
"""
Z = range(3, 61)
SAME = 4e-15  # relative: two ways to one number, each within eight units in the last place


def row(*args):
    table = survey(*args)
    assert table.names == tuple(FIELDS.split())
    (values,) = table.rows()
    return dict(zip(table.names, values, strict=True))


@pytest.mark.sampled(6)
@pytest.mark.parametrize("gearing", ["external", "internal"])
@pytest.mark.parametrize("A", [0.0, 0.6, -0.5])
def test_rows_against_50_digits(gearing, A):
    for z in some((3, 4, 5, 6, 7, 12, 24, 60), (3, 6, 60)):
        got, w = row(str(z), gearing, 60.0, 1, A), Geneva(z, gearing, A)
        velocity, _ = w.peak("velocity")
        acceleration, at_deg = w.peak("acceleration")
        power, motion, step = w.peak("power")[0], 2 * w.half_motion, 2 * w.b
        entry = w.at(-w.half_motion)
        exact = {
            "motion_deg": 2 * to_degrees(w.half_motion),
            "dwell_deg": 360 - 2 * to_degrees(w.half_motion),
            "index_deg": 2 * to_degrees(w.b),
            "velocity_max": velocity,
            "acceleration_max": acceleration,
            "acceleration_entry": abs(entry[2]),
            "jerk_entry": abs(entry[3]),
            "Am": acceleration * motion**2 / step,
            "Vm": velocity * motion / step,
            "Qm": power * motion / (step * acceleration),
        }
        for name, value in exact.items():
            # with A the jerk at entry is a difference of two terms: 1e-14 of either
            bar = 1e-13 if A and name == "jerk_entry" else SAME
            assert got[name] == near(float(value), bar), (z, name)
        assert got["acceleration_max_deg"] == pytest.approx(float(at_deg), abs=1e-8)
        assert got["k"] == near(float(exact["motion_deg"] / exact["dwell_deg"]), SAME)


@pytest.mark.parametrize("gearing", ["external", "internal"])
def test_the_peak_of_power_in_closed_form(machine, gearing):
    sign = {"external": 1.0, "internal": -1.0}[gearing]
    for z in Z:
        got = classic.power_peak(sin_cos_pi(1, z)[0], classic.gap(sign, 1, z))
        found = peak(machine(z, gearing).engagements[0].motion, "power")
        assert got[0] == near(found.max, SAME), z
        assert got[1] == pytest.approx(-found.at_deg, abs=1e-7), z  # a root where power is flat


def test_factors_as_index_drive_makers_would_print_them():
    """theory-loads.md 2: external wheels as cam curves."""
    shown = {
        4: (8.493265948123835, 2.414213562373095, 1.8522842694596023),
        6: (5.65335, 2.00000, 1.46755),
        8: (4.94629, 1.85974, 1.31319),
    }
    for z, factors in shown.items():
        got = row(str(z), "external", 60.0, 1, 0.0)
        for name, value in zip(("Am", "Vm", "Qm"), factors, strict=True):
            digits = SAME if z == 4 else 5e-6 / value  # to the decimals printed
            assert got[name] == near(value, digits), (z, name)


def test_z_texts():
    assert parse_z("6") == [6]
    assert parse_z("3..5") == [3, 4, 5]
    assert parse_z("3,6..8, 12") == [3, 6, 7, 8, 12]
    assert [r[0] for r in survey("12,3..4", "internal", 60.0, 1, 0.0).rows()] == [12, 3, 4]


@pytest.mark.parametrize("text", ["2", "", "6..3", "three", "3.5", "-3", "3..", "1..10000000"])
def test_bad_z(text):
    with pytest.raises(GenevaError):
        parse_z(text)
