"""Vibration of bodies off the axis of a wheel on a carrier, against its differential equation."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from geneva_cli import Carousel, Crank, Design, External, Load, Mass, Shaft
from geneva_cli.loads.vibration.oscillator import Oscillator, oscillator
from geneva_cli.loads.vibration.vibration import Oscillators

ANGLE = math.radians(30.0)
W = 2.0 * math.pi  # 60 rpm
BODY = Mass("point", mass_kg=2.0, radius_mm=50.0, angle_deg=30.0)
INERTIA = 0.02 + 2.0 * 0.05**2
U = 2.0 * 0.05 * 0.1 * W * W  # m e L w², with the wheel's axis 100 mm from the carrier's


def carousel(stiffness: float, damping: float = 0.0, wheels: int = 1, body: Mass = BODY) -> Design:
    return Design(
        External(6),
        Carousel(n_rpm=60.0, wheels=wheels),
        load=Load(inertia_kgm2=0.02),
        mass=(body,),
        shaft=Shaft(stiffness_Nm_rad=stiffness, damping_ratio=damping),
    )


def residuals(design: Design, *, follows: bool) -> list[float]:
    """Residuals of each motion over the step, from I (psi'' + r'') = -k r - c r' + U sin x.

    x is the body's direction, with r where the body ``follows`` the load, or else without.
    """
    shaft, out = design.spec.shaft, []
    k, zeta = shaft.stiffness_Nm_rad, shaft.damping_ratio
    natural = math.sqrt(k / INERTIA)
    for one in design.mechanism.under_load.engagements:
        first = one.mid_angle + ANGLE

        def pull(turned: float, r: float, first: float = first) -> float:
            return U * math.sin(first + turned + (r if follows else 0.0))

        def rest(turned: float, pull=pull) -> float:
            r = 0.0
            for _ in range(60):  # the load's angle at rest, by iteration
                r = pull(turned, r) / k
            return r

        def rates(t: float, y: np.ndarray, one=one, pull=pull) -> list[float]:
            at = one.motion(np.array([one.entry_deg + 360.0 * t]), 2).derivatives()
            turned, _, acceleration = (float(row[0]) for row in at)
            torque = pull(turned, y[0]) - k * y[0] - 2.0 * zeta * natural * INERTIA * y[1]
            return [y[1], torque / INERTIA - acceleration * W * W]

        span = (0.0, one.motion_deg / 360.0)
        start = [rest(-one.half_step), 0.0]
        end = solve_ivp(rates, span, start, "DOP853", rtol=1e-11, atol=1e-15).y[:, -1]
        r, speed = end[0] - rest(one.half_step), end[1]
        turn = math.cos(first + one.half_step) if follows else 0.0
        square, drag = (k - U * turn) / INERTIA, zeta * natural
        swung = math.hypot((speed + drag * r) / math.sqrt(square - drag * drag), r)
        out.append(swung / (2.0 * one.half_step))
    return out


@pytest.mark.long
@pytest.mark.parametrize("damping", [0.0, 0.05])
def test_the_force_alone_is_exact(damping):
    """Without its stiffness. 1e-8: the integration's 1e-11 of a swing that is 100 residuals."""
    design = carousel(200.0, damping)
    own = Oscillators(
        design.mechanism,
        Oscillator(np.array([oscillator(design.mechanism).ratio]), np.array([damping])),
    )
    for index in own.indices:
        index.pull = index.pull._replace(moving=np.zeros(1))
    assert own.share[:, 0] == pytest.approx(residuals(design, follows=False), rel=1e-8)


@pytest.mark.long
@pytest.mark.parametrize(("stiffness", "damping"), [(200.0, 0.0), (200.0, 0.05), (20.0, 0.0)])
def test_the_stiffness_of_the_force_counts_by_its_mean(stiffness, damping):
    """Within U/k of the greatest residual; it alone would change them by more than pi U/k."""
    design = carousel(stiffness, damping)
    true = residuals(design, follows=True)
    table = design.vibration().to_dict()
    own = [row["residual_share"] for row in table["stations"]]
    assert own == pytest.approx(true, abs=U / stiffness * max(true))
    assert table["residual_share"] == max(own)


def test_a_body_on_the_carriers_side_softens_the_shaft():
    """At mid-motion it is nearest: k falls by U cos x, so that fewer periods pass."""
    near, far = (
        Oscillators(one.mechanism, Oscillator(np.array([10.0]), np.zeros(1)))
        .indices[0]
        .pull.moving[0]
        for one in (carousel(1e3, body=BODY.replace(angle_deg=turn)) for turn in (0.0, 180.0))
    )
    assert near > 0.0
    assert far == pytest.approx(-near, rel=1e-14)


def test_the_steady_state_is_the_sum_of_all_earlier_residuals():
    """Slowly built up: 60 turns of the wheel, each motion a kick between free swings."""
    design = carousel(200.0, 0.02)
    own = Oscillators(
        design.mechanism,
        Oscillator(np.array([oscillator(design.mechanism).ratio]), np.array([0.02])),
    )
    kicks = [complex(one[0]) for one in own.residual]
    z, most = 0.0j, []
    for _ in range(60):
        most = []
        for number, index in enumerate(own.indices):
            dwell = own.mechanism.dwell_deg((number - 1) % 6)
            before = own.indices[(number - 1) % 6]
            (motion, _), (_, rest) = (
                index.spans_deg(0.0, own.swing),
                before.spans_deg(dwell, own.swing),
            )
            passed = (motion + rest) / 120.0  # of the motion's time
            z = z * np.exp(own.swing.p * passed)[0] + kicks[number]
            most.append(abs(z))
    assert own.steady_share[:, 0] == pytest.approx(most, rel=1e-9)


def test_a_shaft_too_soft_for_the_force_has_no_values():
    table = carousel(1.5).vibration().to_dict()
    assert table["residual_share"] is None
    (text,) = table["warnings"]
    assert "times the shaft's stiffness, above 0.2: use a stiffer shaft" in text


def test_on_the_ground_and_in_balance_nothing_pulls():
    """The bodies are inertia only: with it on the wheel itself the load vibrates alike."""
    balanced = carousel(200.0, body=BODY.replace(count=2))
    shaft, load = Shaft(stiffness_Nm_rad=200.0), Load(inertia_kgm2=0.02)
    ground = Design(External(6), Crank(n_rpm=60.0), load=load, mass=(BODY,), shaft=shaft)
    for design, inertia in ((balanced, 2.0 * INERTIA - 0.02), (ground, INERTIA)):
        alone = Design.of(design.spec.replace(mass=(), load=Load(inertia_kgm2=inertia))).vibration()
        values, own = alone.to_dict(), design.vibration().to_dict()
        assert own["stations"] is None
        for name in ("period_ratio", "residual_deg", "residual_share_worst", "dynamic_factor"):
            assert own[name] == pytest.approx(values[name], rel=1e-12), name
