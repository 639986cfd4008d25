"""A roller that turns on its pin, against the journal that holds it and theory-loads.md, 8."""

import cmath
import math

import pytest
from words import Spec, Wheel

from geneva_cli import Design
from geneva_cli.loads.load_case import load_case
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Load, Size

# theory-loads.md, 8: a pin of radius 4 in a roller of radius 8
SIZE = Size(200.0, 8.0, face_width_mm=20.0, pin_mm=8.0)
LOAD = Load(0.4, 15.0, friction=0.1, friction_at="pin")
SPEC = Spec(Wheel(6), size=SIZE, load=LOAD)


def design(friction, size=SIZE, at="pin"):
    return Design.of(SPEC.replace(size=size, load=LOAD.replace(friction=friction, friction_at=at)))


@pytest.mark.parametrize("friction", [0.02, 0.1, 0.7])
@pytest.mark.parametrize("pin", [3.0, 8.0, 15.9])
def test_the_roller_is_in_balance(friction, pin):
    """Cut free it has the wall's force at its rim and the pin's within it, which rubs.

    The pin's force, the wall's reversed, meets its surface at the angle of friction from the
    normal; both have the same moment about the centre. The friction opposes the turning.
    """
    r = 8.0
    size = SIZE.replace(pin_mm=pin)
    along = load_case(build(SPEC.replace(size=size, load=LOAD.replace(friction=friction)))).friction
    wall, at = complex(-along, 1.0), complex(0.0, -r)  # from below, against rolling to the right
    rho = math.atan(friction)
    moments = []
    for side in (1.0, -1.0):
        normal = wall / abs(wall) * cmath.exp(1j * side * rho)  # of the pin's surface, at its top
        journal = 0.5 * pin * normal
        moments.append((at.conjugate() * wall).imag - (journal.conjugate() * wall).imag)
    # of the two places of the pin one is right: a few roundings of r N
    assert min(map(abs, moments)) <= 1e-15 * r * abs(wall)
    assert max(map(abs, moments)) > 0.01


def test_work_of_theory():
    """8.11450263554027 J a motion per unit of friction, for little of it: 5e-7 are its digits'
    error (see test_roller), 1e-6 the friction's own share of the force."""
    little = 1e-6
    assert design(little).life["friction_work_J"] / little == pytest.approx(
        8.11450263554027, rel=2e-6
    )


def test_the_cycle_is_that_of_less_friction():
    turning = design(0.1)
    along = load_case(turning.mechanism).friction
    rubs = design(along, at="slot")
    assert 0.0499 > along > 0.0497  # half of 0.1, less its square's share
    for name, one in turning.loads.items():
        assert one == rubs.loads[name], name
    known = {name: value for name, value in turning.life.items() if value is not None}
    assert {"friction_work_J", "equivalent_force_N"} <= set(known)
    assert known == {name: rubs.life[name] for name in known}


def test_a_roller_that_is_its_own_pin():
    own = design(0.1, SIZE.replace(pin_mm=0.0))
    assert own.loads == design(0.1, at="slot").loads
