"""What the wheel carries, and a roller that turns on its pin: published cases and closed forms."""

import cmath
import math

import mpmath
import pytest
from repo import DESIGNS
from words import load

from geneva_cli import External, Mass, Support
from geneva_cli.design import Design
from geneva_cli.errors import GenevaError
from geneva_cli.loads.load_case import (
    FREE,
    inertia_kgm2,
    load_case,
    load_key,
    mass_inertia_kgm2,
    resisting_torques_Nm,
    weight_kg,
)
from geneva_cli.loads.strength.part_loads import part_loads
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Load, Size


@pytest.mark.parametrize("key", FREE)
@pytest.mark.parametrize("name", ["linear", "press-curved", "spherical-z6"])
def test_loads_are_those_of_any_machine_with_the_same_key(name, key):
    """A key of [size] that a load depends on must not be left out of it, as the arm's eye was."""
    machine = load(DESIGNS / f"{name}.toml")
    other = build(machine.spec.with_(f"size.{key}", 3.0), machine)
    assert load_key(other) == load_key(machine)
    assert part_loads(other) == part_loads(machine)


def test_the_published_turret():
    """An index drive maker's example: three inertias, printed to three decimals."""
    plate = Mass(shape="disc", diameter_mm=300.0, mass_kg=11.026)
    fixtures = Mass(shape="point", mass_kg=3.0, count=6, radius_mm=100.0)
    parts = Mass(shape="point", mass_kg=0.25, count=6, radius_mm=100.0)
    each = [inertia_kgm2(Spec(External(6), mass=(m,))) for m in (plate, fixtures, parts)]
    assert [round(j, 3) for j in each] == [0.124, 0.18, 0.015]
    support = Support(friction=0.15, radius_mm=100.0)
    whole = Spec(External(6), mass=(plate, fixtures, parts), support=support)
    assert round(inertia_kgm2(whole), 3) == 0.319
    # 0.15 (11.026 + 18 + 1.5) 9.80665 0.1, by hand
    assert resisting_torques_Nm(whole)[1] == pytest.approx(4.4903669685, rel=1e-12)


@pytest.mark.parametrize(
    "mass",
    [
        Mass("ring", density_kgm3=7850.0, diameter_mm=80.0, bore_mm=50.0, thickness_mm=12.0),
        Mass("disc", density_kgm3=1190.0, diameter_mm=60.0, thickness_mm=6.0),
    ],
)
def test_a_round_body_is_its_integral(mass):
    """m and J as integrals over rings of radius r."""
    low, high = mpmath.mpf(mass.bore_mm or 0) / 2000, mpmath.mpf(mass.diameter_mm) / 2000
    per = mass.density_kgm3 * mpmath.mpf(mass.thickness_mm) / 1000
    weight = mpmath.quad(lambda r: 2 * mpmath.pi * r * per, [low, high])
    inertia = mpmath.quad(lambda r: 2 * mpmath.pi * r**3 * per, [low, high])
    assert weight_kg(mass) == pytest.approx(float(weight), rel=1e-14)
    assert mass_inertia_kgm2(mass) == pytest.approx(float(inertia), rel=1e-14)


def test_a_block_is_its_integral():
    mass = Mass("block", density_kgm3=7850.0, length_mm=40.0, width_mm=30.0, thickness_mm=20.0)
    per = mass.density_kgm3 * 0.020
    inertia = mpmath.quad(lambda x, y: per * (x * x + y * y), [-0.02, 0.02], [-0.015, 0.015])
    assert mass_inertia_kgm2(mass) == pytest.approx(float(inertia), rel=1e-14)


def test_gears_to_the_table_count_twice_for_inertia_and_once_for_friction():
    mass = (Mass("point", mass_kg=2.0, radius_mm=100.0),)
    straight = Spec(External(6), mass=mass, support=Support(friction=0.2, radius_mm=50.0))
    geared = straight.with_("support.gear_ratio", 0.5)
    assert inertia_kgm2(geared) == pytest.approx(0.25 * inertia_kgm2(straight), rel=1e-15)
    half = pytest.approx(0.5 * resisting_torques_Nm(straight)[1], rel=1e-15)
    assert resisting_torques_Nm(geared)[1] == half


def test_a_support_s_own_friction_is_a_load():
    """0.15 times 1 kN at 100 mm; a weight on the axis is such a force, and no inertia."""
    alone = Spec(External(6), support=Support(friction=0.15, radius_mm=100.0, force_N=1000.0))
    limited = Design.of(alone.with_("limits.pin_force_max_N", 400.0))
    assert limited.loads["wheel_torque_Nm"].max == 15.0
    assert limited.life["equivalent_force_N"] > 15.0 / 0.0866
    assert not Spec(External(6), support=Support(friction=0.15, radius_mm=100.0)).is_loaded
    with pytest.raises(GenevaError, match=r"no inertia: set radius_mm, or set its weight as"):
        Mass("point", mass_kg=1.0)


# theory-loads.md, 8: a pin of radius 4 in a roller of radius 8
SIZE = Size(200.0, 8.0, face_width_mm=20.0, pin_mm=8.0)
LOAD = Load(0.4, 15.0, friction=0.1, friction_at="pin")
SPEC = Spec(External(6), size=SIZE, load=LOAD)


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
