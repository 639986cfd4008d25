"""Friction in the guide of a rack: loads against bodies cut free, in 50 digits.

Unknown are the force of the roller and those at both ends of the guide. Three balances of the rack
give them for each choice of their signs, and one choice agrees with what it gives.
"""

import itertools
import math

import mpmath
import numpy as np
import pytest
from load_states import integrals

from geneva_cli import Design, Linear, Load, Size

R, r, CLEARANCE = 50.0, 6.0, 0.1
SIZE = Size(center_distance_mm=R, roller_radius_mm=r, slot_clearance_mm=CLEARANCE)
HALF = R - r - CLEARANCE
# the eye of the arm, twice its pin's hole, passes the rail a quarter of a bar away
BAR = R / 10.0
MIDDLE = -(2.0 * 3.0 + 0.25 * BAR + 1.5 * BAR + CLEARANCE)
# mass, force, friction of the slot and of the guide
CASES = [
    (4.0, 30.0, 0.1, 0.1),
    (4.0, 30.0, 0.1, 0.0),
    (4.0, 0.0, 0.3, 0.2),
    (0.0, 9.0, 0.0, 0.25),
    (4.0, 5.0, 0.6, 0.05),  # both ends bear on one side near mid-motion
    (4.0, 30.0, 1.4, 0.02),  # friction in the slot turns the rack the other way
]


def design(mass: float, force: float, mu: float, nu: float | None, **more: float) -> Design:
    load = Load(mass_kg=mass, force_N=force, friction=mu, guide_friction=nu, **more)
    return Design(Linear(6), size=SIZE, load=load)


def in_digits(rows, sums):
    return list(mpmath.lu_solve(mpmath.matrix(rows), mpmath.matrix(sums)))


def cut_free(case, input_deg, number=mpmath.mpf, of=mpmath, solve=in_digits):
    """Force of the roller along the travel, input torque, forces at both ends of the guide."""
    mass, push, mu, nu = map(number, case)
    a = number(input_deg) * of.pi / 180
    radius, x0, half, own = (number(mm) / 1000 for mm in (R, MIDDLE, HALF, r))
    axis, pin = (radius, 0), (radius * (1 - of.cos(a)), radius * of.sin(a))
    needed = push - mass * radius * (2 * of.pi) ** 2 * of.sin(a)  # at 60 rpm
    out = []
    for d, upper, lower in itertools.product((1, -1), repeat=3):
        touch = (pin[0], pin[1] + d * own)
        s = 1 if touch[1] > 0 else -1  # the crank turns by -w: x of its points rises above its axis
        matrix = [
            [s * mu, 1, 1],
            [d, -nu * upper, -nu * lower],
            [(touch[0] - x0) * d - touch[1] * s * mu, -half, half],
        ]
        force, first, last = solve(matrix, [0, needed, 0])
        if force >= 0 and first * upper >= 0 and last * lower >= 0:
            on_crank = (-force * s * mu, -force * d)
            arm = (touch[0] - axis[0], touch[1] - axis[1])
            out.append([force * d, arm[0] * on_crank[1] - arm[1] * on_crank[0], first, last])
    assert len(out) == 1, out
    return out[0]


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("at_deg", [-89.0, -60.0, -20.0, -1.0, 10.0, 45.0, 89.0])
def test_loads_are_those_of_bodies_cut_free(case, at_deg):
    """64 ulp, as for other machines: some dozen operations."""
    loaded = design(*case)
    with mpmath.workdps(50):
        force, torque, *_ = cut_free(case, at_deg)
    names = ["pin_force_N", "input_torque_Nm"]
    force_N, torque_Nm = loaded.cycle.states(np.array([at_deg]), names)[:, 0]
    assert force_N == pytest.approx(float(force), rel=2e-14)
    assert torque_Nm == pytest.approx(float(torque), rel=2e-14, abs=1e-15)


@pytest.mark.long
@pytest.mark.parametrize("case", CASES)
def test_greatest_force_on_the_guide_and_work(case):
    """The scan has steps of 0.018 degrees: within 1e-7 of a smooth peak, and both ends."""
    loaded = design(*case)
    values = loaded.report.table.to_dict()
    scan = np.linspace(-90.0, 90.0, 10_000)  # none at 0, where nothing may press
    rows = [cut_free(case, x, float, math, np.linalg.solve) for x in scan.tolist()]
    forces, torques, *ends = np.array(rows, dtype=float).T
    most = max(np.abs(end).max() for end in ends)
    assert values["guide.force_N"] == pytest.approx(most, rel=1e-6)
    loads = loaded.loads_table.to_dict()
    assert loads["pin_force_N.max"] == pytest.approx(abs(forces).max(), rel=1e-6)
    assert loads["pin_force_N.min"] == pytest.approx(max(forces.min(), 0.0), rel=1e-6)
    (work,) = integrals(loaded.cycle, lambda at: at.input_torque_Nm)
    step = math.pi / 9_999
    assert work == pytest.approx(np.trapezoid(torques, dx=step), rel=1e-5)  # jumps of one step
    mean = np.trapezoid(torques**2, dx=step) / (2.0 * math.pi)
    assert loads["input_torque_Nm.rms"] == pytest.approx(math.sqrt(mean), rel=1e-5)
    assert values["guide.length_mm"] == pytest.approx(2.0 * HALF)
