"""Pin force and input torque with friction, against bodies cut free (``load_witness``).

Those of our designs, with their bearings, are in test_load_designs.py.
"""

import load_states
import load_witness
import pytest
import repo
from words import Motion, Spec, Wheel, load

from geneva_cli.loads.contact import contact
from geneva_cli.motion import registry
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Load, Size

LOAD = Load(0.02, 3.0, friction=0.1)
LARGE = LOAD.replace(friction=0.2)


def curved(z, law, alpha0=0.0, ratio=None, gearing="external"):
    return Spec(Wheel(z, gearing), motion=Motion(law, alpha0_deg=alpha0, ratio=ratio), load=LOAD)


def pushed(kind, gearing="external", z=6, **keys):
    """Behind a drive whose lengths are known, and with them the forces in its joints."""
    if kind not in registry.DRIVES:
        return None
    return Spec(Wheel(z, gearing), registry.drive(kind)(**keys), load=LOAD)


MACHINES = {
    "external": Spec(Wheel(6), load=LARGE),
    "internal": Spec(Wheel(6, "internal"), load=LARGE),
    "offset towards entry": Spec(Wheel(6, offset_mm=-30.0), load=LARGE),
    "offset": Spec(Wheel(6, offset_mm=12.0), load=LOAD),
    "curved": curved(5, "cycloidal", -17.42),
    "curved, matched": curved(6, "3-4-5", -30.0, "matched"),
    "curved, internal": curved(6, "cycloidal", 20.0, gearing="internal"),
    "on a coulisse": pushed("side-crank", A=0.6, input_crank_mm=35.0),
    "on a coulisse, internal": pushed("side-crank", "internal", A=-0.3, input_crank_mm=35.0),
    "on ellipses": pushed("elliptical-gears", eccentricity=0.3, gear_distance_mm=70.0),
    "on ellipses, internal": pushed("elliptical-gears", "internal", eccentricity=0.2),
    "on gears": pushed("noncircular-gears", A=-0.4, gear_distance_mm=70.0),
    "on a wheel": pushed("geneva-pair", z=4, first_z=4, first_distance_mm=60.0),
    "curved, on ellipses": curved(6, "cycloidal", 20.0).replace(
        drive=registry.drive("elliptical-gears")(eccentricity=0.3)
    ),
}
MACHINES = {name: spec for name, spec in MACHINES.items() if spec}  # of the kinds that there are


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", MACHINES)
def test_forces_against_bodies_cut_free(name):
    """64 ulp: two dozen operations and a motion of 16 ulp; more where friction nearly holds.

    The power closes: what the input gives is what the wheel takes and what friction turns to heat.
    """
    mechanism = build(MACHINES[name])
    spec, engagement = mechanism.spec, mechanism.engagements[0]
    machine = load_witness.machine(spec, None)
    for share in (0.8, 0.2, -0.15, -0.6):
        x = share * (engagement.entry_deg if share > 0.0 else -engagement.exit_deg)
        true, speed = load_witness.loads(spec, *machine, x)
        found = load_states.state(mechanism, engagement, x)
        assert found.torque_Nm == pytest.approx(float(true.torque), rel=2e-14)
        assert found.pin_force_N == pytest.approx(float(true.force), rel=2e-14)
        assert found.input_torque_Nm == pytest.approx(float(true.shaft), rel=2e-14)
        taken = float(true.torque * speed + true.rubbing)
        assert found.input_torque_Nm == pytest.approx(taken, rel=1e-12)


@pytest.mark.parametrize("x", [-70.0, -15.0, 33.0])
def test_friction_on_the_sphere(x):
    spec = Spec(Wheel(6, "spherical", axes_deg=70.0), size=Size(80.0, 6.0), load=LARGE)
    mechanism = build(spec)
    _, pin, shaft, _ = load_witness.on_the_sphere(spec, x)
    found = load_states.state(mechanism, mechanism.engagements[0], x)
    assert found.pin_force_N == pytest.approx(float(pin), rel=1e-14)
    assert found.input_torque_Nm == pytest.approx(float(shaft), rel=1e-14)


def test_nothing_slides_while_gears_drive():
    mechanism = load(str(repo.DESIGNS / "gear-sector.toml"))
    at = contact(mechanism.engagements[0], 0.0)
    assert (at.touches.c[0], at.along.c[0], at.spin.c[0], at.arm.c[0]) == (0.0, 0.0, 0.0, 0.0)
