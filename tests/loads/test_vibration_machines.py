"""A load on an elastic shaft behind every machine: against 50 digits, and against marching."""

import math
from itertools import pairwise

import numpy as np
import pytest
import repo
from words import law as load_law
from words import load

from geneva_cli import Design, External, Shaft
from geneva_cli.loads.vibration.swing import (
    Oscillator,
    greatest_accelerations,
    local_maxima,
    residual_swing,
)
from geneva_cli.loads.vibration.swing import motion_shapes as shape
from geneva_cli.loads.vibration.vibration import Oscillators, speeds_to_avoid
from geneva_cli.motion.given_motion import LawMotion
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build

DESIGNS = sorted(repo.DESIGNS.glob("*.toml"))


def of_law(law):
    """The panels of a law's own motion."""
    return shape(LawMotion(-60.0, 60.0, 0.5, law))


def swing(ratios, damping):
    ratios = np.array(ratios, dtype=float)
    return Oscillator(ratios, np.full(ratios.shape, damping))


def residuals(panels, ratios, damping):
    """Complex residual swings of the first motion among the panels."""
    return residual_swing(panels, np.zeros(len(ratios), dtype=np.intp), swing(ratios, damping))


def shares(panels, ratios, damping):
    """Residual amplitudes over the step."""
    return np.abs(residuals(panels, ratios, damping))


def greatest_acceleration(panels, ratio, damping):
    """The greatest acceleration of a load during the motion, over the step."""
    one = np.zeros(1, dtype=np.intp)
    return float(greatest_accelerations(panels, one, swing([ratio], damping))[0])


def rate(ratio, damping):
    return 2.0 * math.pi * ratio * complex(-damping, math.sqrt(1.0 - damping * damping))


def by_gauss(engagement, ratio, damping, parts=60):
    """The same integral by Gauss's rule on many short stretches of the motion."""
    motion, p = engagement.motion, rate(ratio, damping)
    x, w = np.polynomial.legendre.leggauss(20)
    whole = engagement.motion_deg
    total = 0j
    for a, b in pairwise(motion.breaks_deg):
        cuts = np.linspace(a, b, parts + 1)
        h = 0.5 * (b - a) / parts
        at = (0.5 * (cuts[1:] + cuts[:-1])[:, None] + h * x).ravel()
        bent = 2.0 * motion(at, 2).c[2] * math.radians(whole) ** 2 / (2.0 * motion.half_step)
        swing = np.exp(p * (motion.exit_deg - at) / whole)
        total += h / whole * (np.tile(w, parts) * bent * swing).sum()
    return -total / p.imag


@pytest.mark.sampled(2)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda p: p.stem)
def test_every_machine(path):
    """Stretches this short leave Gauss's rule with its rounding alone."""
    for engagement in load(path).engagements:
        for ratio, damping in ((0.4, 0.0), (3.3, 0.05), (11.0, 0.0)):
            found = residuals(shape(engagement.motion), [ratio], damping)[0]
            assert found == pytest.approx(by_gauss(engagement, ratio, damping), abs=1e-13)


@pytest.mark.parametrize(
    ("ratio", "factor"),
    [
        # r'' + Omega² r = -(pi²/2) cos pi u in closed form: the load's acceleration over pi²/2 is
        # (cos x - cos 2 l x) Omega²/(Omega² - pi²), x = pi u, at l = 1 greatest at the end,
        (1.0, 8.0 / 3.0),
        # and at l = 3/2, cos x - cos 3x, at cos² x = 1/3
        (1.5, math.sqrt(3.0)),
    ],
)
def test_dynamic_factor_of_the_harmonic(ratio, factor):
    found = greatest_acceleration(of_law(load_law("harmonic")), ratio, 0.0) / (math.pi**2 / 2.0)
    assert found == pytest.approx(factor, rel=1e-13)


@pytest.mark.sampled(6)
@pytest.mark.parametrize("kind", [External(3), External(6)])
@pytest.mark.parametrize(("ratio", "damping"), [(0.2, 0.0), (2.3, 0.1), (9.7, 0.01)])
def test_dynamic_factor_against_a_solver(kind, ratio, damping):
    """A general solver; on 20,001 samples the greatest is below the peak by 1e-6 at most."""
    from scipy.integrate import solve_ivp

    machine = build(Spec(kind))
    motion = machine.engagements[0].motion
    omega, whole = 2.0 * math.pi * ratio, math.radians(machine.engagements[0].motion_deg)
    scale = whole * whole / (2.0 * motion.half_step)

    def slope(u, y):
        x = motion.entry_deg + float(u) * (motion.exit_deg - motion.entry_deg)
        bent = 2.0 * motion(x, 2).c[2] * scale
        return [y[1], -bent - 2.0 * damping * omega * y[1] - omega * omega * y[0]]

    run = solve_ivp(
        slope, (0, 1), [0, 0], "DOP853", np.linspace(0, 1, 20001), rtol=1e-9, atol=1e-12
    )
    greatest = np.abs(2.0 * damping * omega * run.y[1] + omega * omega * run.y[0]).max()
    found = greatest_acceleration(shape(machine.engagements[0].motion), ratio, damping)
    assert found == pytest.approx(greatest, rel=2e-6)


def test_a_maximum_is_where_the_slope_of_the_closed_form_vanishes():
    """Of |sin pi l|/(pi l (l² - 1)): pi l cot pi l = 1 + 2 l²/(l² - 1), between two integers."""
    form = of_law(load_law("cycloidal"))
    l = local_maxima(lambda ratio: shares(form, ratio, 0.0)[None], 0, 0.6, 12.0)
    assert np.floor(l).tolist() == list(range(2, 12))
    slope = math.pi * l / np.tan(math.pi * l) - 1.0 - 2.0 * l * l / (l * l - 1.0)
    # its own slope is -pi² l there and steeper: the places are right to 1e-12
    assert np.abs(slope / (math.pi**2 * l)).max() < 1e-12
    exact = np.abs(np.sin(math.pi * l)) / (math.pi * l * (l * l - 1.0))
    assert shares(form, l, 0.0) == pytest.approx(exact, rel=1e-12)


@pytest.mark.long
def test_speeds_to_avoid_are_the_greatest_nearby():
    """Of unlike engagements the worst counts; none is missed by a fine scan over the speeds."""
    machine = build(Spec(External(6, steps_deg=(72.0, 48.0))))
    avoid = speeds_to_avoid(Oscillators(machine, Oscillator(np.array([4.0]), np.zeros(1))))
    n = np.geomspace(30.0, 120.0, 20001)
    ratio = 4.0 * 60.0 / n
    every = [
        shares(shape(e.motion), ratio * e.motion_deg / machine.engagements[0].motion_deg, 0.0)
        for e in machine.engagements
    ]
    worst = np.max(every, axis=0)
    at = 1 + np.flatnonzero((worst[1:-1] > worst[:-2]) & (worst[1:-1] > worst[2:]))
    assert [rpm for rpm, *_ in avoid] == pytest.approx(n[at].tolist(), rel=2e-4)
    assert [share for *_, share in avoid] == pytest.approx(worst[at].tolist(), rel=1e-5)
    for rpm, low, high, _ in avoid:
        assert (low / rpm) ** 2 == pytest.approx(0.8)
        assert (high / rpm) ** 2 == pytest.approx(1.2)


def test_units_and_the_shaft():
    """k, I and n in, the period ratio out: 0.4 kg m², 3000 N m/rad, 60 rpm, 120 of 360 deg."""
    design = Design(External(6), shaft=Shaft(stiffness_Nm_rad=3000.0, damping_ratio=0.01))
    design = design.with_("load.inertia_kgm2", 0.4)
    found = design.vibration().to_dict()
    natural = math.sqrt(3000.0 / 0.4)
    assert found["natural_Hz"] == pytest.approx(natural / math.tau)
    assert found["period_ratio"] == pytest.approx(natural / math.tau / 3.0)
    # I alpha / k with alpha = 1.3496 (2 pi)²
    alpha = 1.34963727590190292442655173495 * (2.0 * math.pi) ** 2
    assert found["windup_deg"] == pytest.approx(math.degrees(0.4 * alpha / 3000.0), rel=1e-13)
    assert found["residual_deg"] == pytest.approx(60.0 * found["residual_share"])
    given = Design(External(6)).vibration(found["period_ratio"], 0.01).to_dict()
    assert {k: v for k, v in given.items() if isinstance(v, float)} == pytest.approx(
        {k: v for k, v in found.items() if isinstance(v, float)}
    )
