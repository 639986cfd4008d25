"""Horns of a rack: the beam's own formula in 30 digits, and wheels of very many slots."""

import mpmath
import pytest

from geneva_cli import Design, Linear, Load, Size

R, r, CLEARANCE, RECESS, FORCE, WIDTH = 50.0, 6.0, 0.1, 41.0, 30.0, 12.0
SIZE = Size(
    center_distance_mm=R,
    roller_radius_mm=r,
    slot_clearance_mm=CLEARANCE,
    lock_radius_mm=RECESS,
    face_width_mm=WIDTH,
)
LOAD = Load(force_N=FORCE)
RACK = Design(Linear(6), size=SIZE, load=LOAD)
HALF = r + CLEARANCE


def test_the_horn_of_a_rack_is_its_formula():
    """6 F (s - s0)/(b t²), t = h + k - sqrt(k² - s²), greatest with the roller at the mouth.

    1e-9: the search by grids stops where the stress is flat.
    """
    with mpmath.workdps(30):
        k = mpmath.mpf(RECESS)
        h = R - mpmath.mpf(HALF) - k

        def stress(s):
            t = h + k - mpmath.sqrt(k * k - s * s)
            return 6 * FORCE * s / (WIDTH * t * t)

        s = mpmath.findroot(lambda s: mpmath.diff(stress, s), 2 * h)
        expected = stress(s)
    values = RACK.report.table.to_dict()
    assert values["strength.horn.stress_MPa"] == pytest.approx(float(expected), rel=1e-9)
    assert values["strength.horn.inwards_mm"] == pytest.approx(float(s), rel=1e-4)
    assert values["strength.horn.at_deg"] == pytest.approx(-90.0, abs=1e-6)
    assert values["life.horn_stress_MPa"] == values["strength.horn.stress_MPa"]
    assert "horn_stress_MPa" in {one.name for one in RACK.checks}
