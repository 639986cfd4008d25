"""The loads of every machine in designs/, with friction, against bodies cut free in 50 digits."""

import load_witness
import numpy as np
import pytest
import repo
from words import Motion, Spec, Wheel, load

from geneva_cli.loads.contact import contact
from geneva_cli.loads.cycle import Cycle
from geneva_cli.motion import registry
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Load, Support

LOAD = Load(0.02, 3.0, friction=0.1)
ULP = 2.0**-52
# Units in the last place of a quantity's peak. The rounding of one of a table's 41 points moves its
# second derivative by some 41² units, of a peak of 2 pi: 268. The solution may add half of that.
WITHIN = {"table-law": 128.0}
PLACES = (-0.85, -0.3, 0.05, 0.7)  # shares of the way to entry, and to exit
# Where a linkage's wheel has its entry and exit, nearly: degrees of its crank.
NEAR = {"slider-crank": (60.75, 225.23), "four-bar": (123.3, 236.7)}
NAMES = [path.stem for path in repo.wheels()]
QUANTITIES = (
    "omega_rad_s",
    "wheel_torque_Nm",
    "pin_force_N",
    "sliding_m_s",
    "input_torque_Nm",
    "wheel_bearing_N",
    "crank_bearing_N",
    "guide_force_N",
)


def loaded(name):
    """The design with this load alone, whatever it has of its own."""
    spec = load(str(repo.DESIGNS / f"{name}.toml")).spec
    return build(spec.replace(load=LOAD, mass=(), support=Support()))


def planar(mechanism, number, x):
    """The quantities that the witness knows of a machine in a plane, with their signs."""
    spec = mechanism.spec
    machine = load_witness.machine(spec, NEAR.get(spec.drive.NAME), number)
    meshed = load_witness.in_gear(spec, x) if spec.drive.NAME == "gear-sector" else None
    true, speed = meshed or load_witness.loads(spec, *machine, x)
    w = load_witness.speed(spec)
    side = load_witness.mp.sign(true.torque)
    values = (
        speed * w,
        true.torque,
        side * true.force,
        true.sliding * w,
        true.shaft,
        true.wheel_bearing,
        true.crank_bearing,
        true.guide,
    )
    return dict(zip(QUANTITIES, values, strict=True))


def spherical(mechanism, number, x):
    torque, force, shaft, speed = load_witness.on_the_sphere(mechanism.spec, x)
    force *= load_witness.mp.sign(torque)
    values = (speed * load_witness.speed(mechanism.spec), torque, force, shaft)
    names = ("omega_rad_s", "wheel_torque_Nm", "pin_force_N", "input_torque_Nm")
    return dict(zip(names, values, strict=True))


def agree(mechanism, number, shares, witness, within):
    """The loads of an engagement are a witness's, within units in the last place of their peaks.

    ``shares`` are places on the way to entry, below 0, and to exit.
    """
    cycle, engagement = Cycle(mechanism), mechanism.engagements[number]
    known = [name for name in QUANTITIES if name in cycle.sources]
    grid = np.linspace(engagement.entry_deg, engagement.exit_deg, 201)[1:-1]
    sizes = abs(cycle.moving(engagement, grid, known))
    peaks = np.where(np.isfinite(sizes), sizes, 0.0).max(axis=1)
    for share in shares:
        x = share * (engagement.exit_deg if share > 0.0 else -engagement.entry_deg)
        found = cycle.moving(engagement, np.array([x]), known)[:, 0].tolist()
        exact = witness(mechanism, number, x)
        assert all(exact[name] is None for name in exact.keys() - {*known})
        for name, value, peak in zip(known, found, peaks, strict=True):
            if name in exact:
                off = float(abs(load_witness.mp.mpf(value) - exact[name]) / (ULP * peak))
                assert off <= within, (name, x, off)


@pytest.mark.sampled(24)
@pytest.mark.parametrize("name", NAMES)
def test_loads_of_a_design(name):
    """Within 32 units in the last place of each quantity's peak; angles of all engagements."""
    mechanism = loaded(name)
    witness = planar if mechanism.spec.wheel.FLAT else spherical
    count = len(mechanism.engagements)
    for number in range(min(count, len(PLACES))):
        agree(mechanism, number, PLACES[number::count], witness, WITHIN.get(name, 32.0))


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


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", MACHINES)
def test_loads_of_other_machines(name):
    """64 ulp: two dozen operations and a motion of 16 ulp; more where friction nearly holds."""
    if MACHINES[name]:  # of the kinds that there are
        agree(build(MACHINES[name]), 0, (-0.8, -0.2, 0.15, 0.6), planar, 64.0)


def test_nothing_slides_while_gears_drive():
    mechanism = load(str(repo.DESIGNS / "gear-sector.toml"))
    at = contact(mechanism.engagements[0], 0.0)
    assert (at.touches.c[0], at.along.c[0], at.spin.c[0], at.arm.c[0]) == (0.0, 0.0, 0.0, 0.0)
