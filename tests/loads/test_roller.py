"""The roller as a bearing: a published case at 40 digits, and bodies cut free on other machines."""

import math

import load_witness
import mpmath
import numpy as np
import pytest
import repo
from witness import mp
from words import Motion, Spec, Wheel, load

from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.load_case import load_case
from geneva_cli.loads.strength.roller import LIFE_EXPONENT, lives, passage, passages
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Load, RollerMaterial, Size

DESIGNS = repo.DESIGNS
CASE = Spec(Wheel(6), size=Size(200.0, 8.0, face_width_mm=20.0, pin_mm=8.0), load=Load(0.4, 15.0))
RUBS = Load(0.02, 3.0, friction=0.1)


def life(mechanism):
    """The lives by their names without "roller_" and "life_"."""
    lasts = lives(mechanism, passages(mechanism, by_roller=True))
    return {
        name.removeprefix("roller_").removeprefix("life_"): v.item() for name, v in lasts.items()
    }


def exact_case():
    """Turns, P and work of CASE at 40 digits, cut where torque or sliding change sign.

    I w² psi'' = -M twice: at 10.3447585591609 and at 43.0339138141048 deg. theory-loads.md, 8, has
    2.65486489086418 turns, P 196.037379843546 and 16.2290052710805 J: they are integrals that run
    over the second place, where the sliding jumps, without a cut.
    """
    l, L, r, w = mp.mpf(1) / 2, mp.mpf("0.2"), mp.mpf("0.008"), 2 * mp.pi
    inertia, resists = mp.mpf("0.4"), 15

    def torque(x):
        D = 1 + l * l - 2 * l * mp.cos(x)
        return resists - inertia * w * w * l * (1 - l * l) * mp.sin(x) / D**2

    def rubs(x, sign):  # rho' + sigma (1 + psi') r
        D = 1 + l * l - 2 * l * mp.cos(x)
        return L * l * mp.sin(x) / mp.sqrt(D) + sign * (1 + l * (mp.cos(x) - l) / D) * r

    def force(x):
        return abs(torque(x)) / (L * mp.sqrt(1 + l * l - 2 * l * mp.cos(x)))

    def zeros(f, a, b):
        grid = [a + (b - a) * i / 60 for i in range(61)]
        pairs = zip(grid, grid[1:], strict=False)
        return [mp.findroot(f, p, solver="anderson") for p in pairs if f(p[0]) * f(p[1]) < 0]

    reversals = zeros(torque, -mp.pi / 3, mp.pi / 3)
    assert [float(mp.degrees(x)) for x in reversals] == pytest.approx(
        [10.3447585591609, 43.0339138141048], rel=1e-14
    )
    cuts = [-mp.pi / 3, *reversals, mp.pi / 3]
    rolled = work = load = mp.mpf(0)
    for a, b in zip(cuts, cuts[1:], strict=False):
        sign = mp.sign(torque((a + b) / 2))
        inner = zeros(lambda x, sign=sign: rubs(x, sign), a, b)
        for p, q in zip([a, *inner], [*inner, b], strict=True):
            parts = [
                mp.quad(lambda x, n=n, sign=sign: force(x) ** n * rubs(x, sign), [p, q])
                for n in (0, 1, mp.mpf(10) / 3)
            ]
            rolled, work, load = (
                s + abs(t) for s, t in zip((rolled, work, load), parts, strict=True)
            )
    return rolled / (2 * mp.pi * r), (load / rolled) ** mp.mpf("0.3"), work


@pytest.mark.long
def test_the_case_of_the_theory():
    """To 1e-13: some hundred sums of products."""
    with mpmath.workdps(25):
        turns, force, work = exact_case()
    mechanism = build(CASE)
    (found,), lasts = passages(mechanism), life(mechanism)
    assert lasts["turns_per_motion"] == pytest.approx(float(turns), rel=1e-13)
    assert lasts["equivalent_force_N"] == pytest.approx(float(force), rel=1e-13)
    assert found.work == pytest.approx(float(work), rel=1e-13)
    assert found.work * 4.0 / 8.0 == pytest.approx(float(work) / 2.0, rel=1e-13)  # on its pin
    # 2 L (cos b - (1 - l))
    assert found.travel_m == pytest.approx(0.4 * (math.sqrt(0.75) - 0.5), rel=1e-14)
    # as printed in theory-loads.md, to the digits that are right there
    assert lasts["turns_per_motion"] == pytest.approx(2.65486489086418, rel=2e-4)
    assert lasts["equivalent_force_N"] == pytest.approx(196.037379843546, rel=5e-5)
    assert found.work == pytest.approx(16.2290052710805, rel=5e-7)


MACHINES = {
    "internal": Spec(Wheel(6, "internal"), load=RUBS),
    "offset": Spec(Wheel(6, offset_mm=12.0), load=RUBS),
    "curved": Spec(Wheel(6), motion=Motion("3-4-5", alpha0_deg=-30.0, ratio="matched"), load=RUBS),
}
FILES = ["side-crank-z6", "cam-geneva", "epicyclic-z4"]


@pytest.mark.long
@pytest.mark.parametrize("name", [*MACHINES, *FILES])
def test_work_and_turns_of_bodies_cut_free(name):
    """Gauss's rule with 20 nodes over the pieces between reversals, of Newton's and Euler's forces.

    1e-10 is that rule's own error over pieces of up to 60 degrees.
    """
    mechanism = build(MACHINES[name]) if name in MACHINES else load(str(DESIGNS / f"{name}.toml"))
    mechanism = mechanism._replace(spec=mechanism.spec.replace(load=RUBS))
    engagement, given = mechanism.engagements[0], load_case(mechanism)
    machine = load_witness.machine(mechanism.spec, None)
    found = passage(engagement, given)
    node, weight = np.polynomial.legendre.leggauss(20)
    work = rolled = 0.0
    for owner, piece in Cycle(mechanism).stretches:
        if owner is not engagement:
            continue
        half = 0.5 * (piece.end - piece.start)
        for x, share in zip(node, weight, strict=True):
            at, _ = load_witness.loads(mechanism.spec, *machine, piece.start + half * (1.0 + x))
            heat = float(at.rubbing) / 0.1 * share * math.radians(half)
            work += heat
            rolled += heat / float(at.force)
    assert found.work == pytest.approx(work, rel=1e-10)
    assert found.rolled_m == pytest.approx(rolled, rel=1e-10)


def test_a_constant_force_is_its_own_mean():
    """The mean lies between the least and the greatest, and is a power mean of its exponent."""
    mechanism = build(CASE)
    (one,) = passages(mechanism)
    assert (one.work / one.rolled_m) < life(mechanism)["equivalent_force_N"] < 324.503703
    twice = build(CASE.with_("load.torque_Nm", 30.0).with_("load.inertia_kgm2", 0.8))
    assert passages(twice)[0].load == pytest.approx(2.0**LIFE_EXPONENT * one.load, rel=1e-13)


def test_life_in_turns_motions_and_hours():
    """ISO 281: a million turns under P = C; twice the capacity lasts 2^(10/3) times as long."""
    force = life(build(CASE))["equivalent_force_N"]
    rated = life(build(CASE.replace(material_roller=RollerMaterial(dynamic_capacity_N=force))))
    assert rated["turns"] == pytest.approx(1e6, rel=1e-13)
    assert rated["motions"] == pytest.approx(1e6 / rated["turns_per_motion"], rel=1e-13)
    assert rated["h"] == pytest.approx(rated["motions"] / 3600.0, rel=1e-13)  # 60 rpm, one roller
    twice = life(
        build(CASE.replace(material_roller=RollerMaterial(dynamic_capacity_N=2.0 * force)))
    )
    assert twice["turns"] == pytest.approx(1e6 * 2.0 ** (10.0 / 3.0), rel=1e-13)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("design", "a_turn"),
    [
        ("three-rollers-z4", 1.0),  # each roller of a crank passes one slot a turn
        ("two-cranks", 1.0),  # both turn once
        ("gear-sector", 1.0),
        ("geneva-pair", 1.0 / 4.0),  # the second crank turns once in four turns of the input
        ("wandering-hours", 3.0),  # three wheels come to the finger
    ],
)
def test_passages_of_one_roller_in_an_hour(design, a_turn):
    """Counted by hand: one roller's passages in a turn of the input."""
    mechanism = load(str(DESIGNS / f"{design}.toml"))
    capacity = RollerMaterial(dynamic_capacity_N=2000.0)
    spec = mechanism.spec.replace(material_roller=capacity, load=Load(torque_Nm=5.0))
    own = life(mechanism._replace(spec=spec))
    an_hour = 60.0 * spec.drive.n_rpm * a_turn
    assert own["motions"] / own["h"] == pytest.approx(an_hour, rel=1e-12)
