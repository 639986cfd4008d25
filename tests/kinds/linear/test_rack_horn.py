"""Horns of a rack: the beam's own formula in 30 digits, and wheels of very many slots."""

import math

import mpmath
import pytest

from geneva_cli import Design, External, Internal, Linear, Load, Size
from geneva_cli.loads.strength.horn import horns
from geneva_cli.loads.strength.horn_search import greatest_stress

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


@pytest.mark.parametrize("wheel", [External, Internal])
def test_wheels_of_many_slots_have_the_horns_of_a_rack(wheel):
    """With L = R/sin(pi/z) and the torque F L: the pin's lever is L cos(pi/z) at the mouth.

    The wall of a wheel's slot is as far from its recess as that of a rack, and the roller moves
    along it by R (1 - cos a) but for R²/(2 L): 1e-3 at z = 2000 is some l = pi/z.
    """
    z = 2000
    L = R / math.sin(math.pi / z)
    load = Load(torque_Nm=FORCE * L / 1000.0)
    machine = Design(wheel(z), size=Size(center_distance_mm=L, roller_radius_mm=r), load=load)
    true = greatest_stress(horns, RACK.mechanism, (HALF, RECESS), WIDTH).single
    near = greatest_stress(horns, machine.mechanism, (HALF, RECESS), WIDTH).single
    assert near.stress_MPa == pytest.approx(true.stress_MPa, rel=2e-3)
    assert near.inwards_mm == pytest.approx(true.inwards_mm, rel=2e-2)
