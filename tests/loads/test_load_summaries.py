"""Loads of many designs: against bodies cut free, dense samples, and sums of many places."""

import numpy as np
import pytest
import repo
from design_arrays import MACHINES, alone
from loaded_arrays import NAMES, beyond, dense_means, loaded

from geneva_cli import design
from geneva_cli.loads.cycle import Cycle
from geneva_cli.loads.load_peaks import load_peaks, load_summaries
from geneva_cli.motion.many import many
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Load

ULP = 2.0**-52


KNOTTED = ("points of a law",)  # a spline's higher derivatives jump


@pytest.mark.sampled(8)
@pytest.mark.parametrize(
    "name", ["crank", "two rollers", "offset, slowed", "spherical", "matched", *KNOTTED]
)
def test_means_against_sums_of_many_places(name):
    """Beside poles 2e-12 of the size, as 80,000 places a stretch leave: elsewhere much less."""
    names = ("omega_rad_s", "power_W", *NAMES)
    spec, varied, found = loaded(name, 8, 3)
    together = load_summaries(found.machine, names)
    row, i = 0, found.which[0]
    cycle = Cycle(alone(spec, varied, i))
    for load in names:
        here = together[load]
        if np.isinf(here.rms[row]):
            assert np.isinf([here.max[row], here.min[row]]).any()
            continue
        mean, rms = dense_means(cycle, load)
        size = 2e-12 * max(abs(here.max[row]), abs(here.min[row]))
        assert here.mean[row] == pytest.approx(mean, abs=size), load
        assert here.rms[row] == pytest.approx(rms, abs=size), load


@pytest.mark.long
def test_a_reaction_that_nearly_vanishes_has_its_mean():
    """Of a planet's guide, at four places of its motion: dips of a ten-thousandth of a degree."""
    spec = design.load(str(repo.DESIGNS / "epicyclic-soft-z6.toml")).spec
    spec = spec.replace(load=Load(inertia_kgm2=0.5, torque_Nm=5.0, friction=0.1))
    cycle = Cycle(build(spec))
    mean, rms = dense_means(cycle, "guide_force_N", parts=20_000)
    found = cycle.extremes["guide_force_N"]
    assert found.mean == pytest.approx(mean, rel=1e-11)  # the dips, between so many places
    assert found.rms == pytest.approx(rms, rel=1e-12)


@pytest.mark.sampled(48)
@pytest.mark.parametrize("name", MACHINES)
def test_no_peak_is_missed(name):
    """Dense samples of a hundred designs pass no extreme by more than rounding."""
    _, _, found = loaded(name, 100, 5)
    assert (beyond(found, 150, 5) <= 1e-12).all()


def test_a_least_value_before_a_pole_is_found():
    """Of p v, where the roller hardly slides just before its wall is too sharp for it."""
    spec, _ = MACHINES["cycloidal"]
    spec = spec.replace(load=Load(torque_Nm=5.0), size=spec.size.replace(face_width_mm=10.0))
    spec = spec.with_("wheel.z", 8)
    found = many(spec, {"motion.alpha0_deg": np.array([-16.12715, -12.83089])})
    assert (beyond(found, 3000, 5, ("pv_W_m2",)) <= 1e-12).all()


def test_the_least_of_a_size_is_nothing():
    """Where a motion begins and ends nothing presses, nor where the torque changes its sign.

    Nearly free rollers were told to press by -0.4 N: at mid-motion the wall that friction alone
    would hold had a limit from beside it. What is left is rounding of a torque's zero.
    """
    names = ("wheel_bearing_N", "crank_bearing_N")
    for torque, of_each in ((0.0, (0, 3, 6)), (10.0, (0,))):
        _, _, found = loaded("cycloidal", 12, 5, torque_Nm=torque)
        together = load_summaries(found.machine, names, means=False)
        for row in of_each:
            for load in names:
                assert 0.0 <= together[load].min[row] < 1e-10


def test_no_friction_among_designs_with():
    """Where the force has no bound, the torque without friction has one: 28.93 N m."""
    spec = MACHINES["modified-sine"][0].replace(load=Load(inertia_kgm2=1.0, torque_Nm=5.0))
    found = many(spec, {"load.friction": np.array([0.1, 0.0, 0.2])})
    for one in (
        load_peaks(found.machine, ["input_torque_Nm"])["input_torque_Nm"].max,
        load_summaries(found.machine, ["input_torque_Nm"])["input_torque_Nm"].rms,
        load_summaries(found.machine, ["power_W"])["power_W"].rms,
    ):
        assert np.isinf(one).tolist() == [True, False, True]
    here = load_summaries(found.machine, ["input_torque_Nm"])["input_torque_Nm"]
    _, rms = dense_means(Cycle(build(spec)), "input_torque_Nm")
    assert here.max[1] == pytest.approx(28.93, abs=5e-3)
    assert here.rms[1] == pytest.approx(rms, rel=1e-12)
