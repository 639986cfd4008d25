"""Geneva, cam indexer and servo, against closed forms of their laws."""

import math

import mpmath
import numpy as np
import pytest

from geneva_cli import GenevaError, SCurve, load
from geneva_cli.extras.servo.against import LAWS, against

TURRET = "designs/turret.toml"


def columns(path=TURRET, settings=(), names=tuple(LAWS)):
    table = against(path, settings, names)
    return {name: dict(zip(table.to_dict()["quantity"], column, strict=True))
            for name, column in table.to_dict().items() if name != "quantity"}  # fmt: skip


@pytest.mark.sampled(12)
@pytest.mark.parametrize("cruise", [0.0, 1.0 / 3.0, 0.8])
@pytest.mark.parametrize("ramp", [0.0, 0.1, 0.25, 0.5])
def test_s_curve(cruise, ramp):
    """Position and its derivatives, by integration of a step-wise jerk at 40 digits.

    The acceleration is written as lines through its corners; mpmath integrates it twice.
    """
    with mpmath.workdps(40):
        c, r = mpmath.mpf(cruise), mpmath.mpf(ramp)
        rise = (1 - c) / 2
        most = 4 / ((1 - c * c) * (1 - r))
        corners = [0, r * rise, rise - r * rise, rise, rise + c]

        def acceleration(u):
            u = mpmath.mpf(u)
            sign = 1
            if u > mpmath.mpf(1) / 2:
                u, sign = 1 - u, -1
            if u >= rise:
                return mpmath.mpf(0)
            edge = min(u, rise - u)
            size = most if edge >= r * rise else most * edge / (r * rise)
            return sign * size

        places = sorted({*corners, *[1 - x for x in corners], mpmath.mpf(1) / 2})

        def velocity(u):
            inner = [x for x in places if x < u]
            return mpmath.quad(acceleration, [*inner, u]) if u else mpmath.mpf(0)

        law = SCurve(cruise=cruise, ramp=ramp)
        for u in (0.03, 0.21, 0.4, 0.5, 0.61, 0.93):
            s = mpmath.quad(
                lambda t, u=u: (u - t) * acceleration(t), [x for x in places if x < u] + [u]
            )
            jet = law(u, 2).derivatives()
            # Some ten roundings of numbers near 1, and near 6 for the acceleration.
            assert float(jet[0]) == pytest.approx(float(s), abs=2e-15)
            assert float(jet[1]) == pytest.approx(float(velocity(u)), abs=1e-14)
            if ramp and u != 0.5:
                assert float(jet[2]) == pytest.approx(float(acceleration(u)), abs=1e-13)


def test_peaks_of_the_laws():
    """Modified sine: 1.75960 and 5.52796; S-curve: 2/(1 + c) and 4/((1 - c²)(1 - r))."""
    own = columns()
    step, time = math.radians(45.0), own["geneva"]["motion_s"]
    speed, acceleration = step / time, step / time**2
    assert own["cam"]["velocity_max_rad_s"] == pytest.approx(1.75960 * speed, rel=1e-5)
    assert own["cam"]["acceleration_max_rad_s2"] == pytest.approx(5.52796 * acceleration, rel=1e-5)
    assert own["servo"]["velocity_max_rad_s"] == pytest.approx(1.5 * speed, rel=1e-12)
    assert own["servo"]["acceleration_max_rad_s2"] == pytest.approx(6.0 * acceleration, rel=1e-12)


@pytest.mark.sampled(9)
@pytest.mark.parametrize("eta", [1.0, 0.85, 0.4])
@pytest.mark.parametrize("torque", [0.0, 1.5, 40.0])
def test_the_servo_turns_its_rotor(eta, torque):
    """Motor torque: T eta^(-+1)/i + J i alpha, with T = I alpha + M, where the load drives with +1.

    The mean square is a sum over 400,000 angles of the trapezoids of acceleration.
    """
    settings = (f"motor.gear_efficiency={eta}", f"load.torque_Nm={torque}")
    spec = load(TURRET, settings).spec
    own = columns(settings=settings)["servo"]
    i, rotor, inertia = spec.motor.ratio, spec.motor.inertia_kgm2, spec.load.inertia_kgm2
    motion, cycle = own["motion_s"], own["motion_s"] + own["dwell_s"]
    u = (np.arange(400_000) + 0.5) / 400_000
    corners = np.array([0.0, 0.25, 0.75, 1.0]) / 3.0
    shape = np.interp(u, [*corners, *(1.0 - corners[::-1])], [0, 1, 1, 0, 0, -1, -1, 0])
    alpha = 6.0 * math.radians(45.0) / motion**2 * shape
    carried = inertia * alpha + torque
    motor = np.where(carried > 0.0, carried / eta, carried * eta) / i + rotor * i * alpha
    assert own["motor_torque_max_Nm"] == pytest.approx(np.abs(motor).max(), rel=1e-4)
    rms = math.sqrt(np.mean(motor**2) * motion / cycle)
    assert own["motor_torque_rms_Nm"] == pytest.approx(rms, rel=1e-6)
    assert own["inertia_ratio"] == pytest.approx(inertia / (rotor * i * i), rel=1e-12)


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    "name",
    ["side-crank-z6", "internal-z6", "spherical-z6", "four-bar-z4", "geneva-pair", "gear-sector"],
)
def test_other_machines(name):
    """Drives and wheels of all kinds have alternatives with the same times."""
    own = columns(f"designs/{name}.toml")
    assert own["cam"]["motion_s"] == pytest.approx(own["geneva"]["motion_s"], rel=1e-9)
    assert own["servo"]["dwell_s"] == pytest.approx(own["geneva"]["dwell_s"], rel=1e-9)


@pytest.mark.parametrize(
    ("path", "names", "message"),
    [
        (TURRET, ["belt"], "--against belt: it must be one of cam, servo"),
        ("designs/unequal-steps.toml", ["cam"], "engagements differ"),
    ],
)
def test_refused(path, names, message):
    """What has no alternative is refused, with the reason."""
    with pytest.raises(GenevaError, match=message):
        against(path, (), names)
