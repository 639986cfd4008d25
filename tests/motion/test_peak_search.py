"""Peaks of a batch of designs: against each design alone, and against 50 digits."""

import numpy as np
import pytest
from design_arrays import MACHINES, alone, drawn, machine
from machine_witness import motions
from witness import QUANTITIES as EXACT

from geneva_cli.motion import registry
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.many import many, worst_peaks
from geneva_cli.motion.peak_search import QUANTITIES, motion_peaks, search_peaks
from geneva_cli.motion.peaks import worst
from geneva_cli.spec.schema import REQUIRED, fields


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", ["inside", "offset", "spherical", "epicyclic", "modified-sine"])
def test_against_50_digits(name):
    """The size is the quantity's at that place, and no place beside it or far away has more."""
    spec, rules = MACHINES[name]
    varied = drawn(rules, 12, 5)
    found = many(spec, varied)
    peaks = motion_peaks(found.machine.engagements[0].motion, ["velocity", "acceleration"])
    for row, i in enumerate(found.which[:2]):
        engagement = alone(spec, varied, int(i)).engagements[0]
        exact = motions(alone(spec, varied, int(i)).spec)[0]
        for quantity, peak in peaks.items():
            at_deg, size = peak.at_deg[row], peak.max[row]

            def true(deg, quantity=quantity, exact=exact):
                return abs(float(EXACT[quantity](exact.derivatives(deg))[0]))

            assert size == pytest.approx(true(at_deg), rel=1e-14), (quantity, i)
            places = np.linspace(engagement.entry_deg, engagement.exit_deg, 13)
            assert max(true(x) for x in places) <= size * (1.0 + 1e-14)


# laws that need no points of the user
WHOLE_LAWS = [
    name
    for name in registry.LAWS
    if all(key.default is not REQUIRED for key in fields(registry.law(name)))
]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("law", WHOLE_LAWS)
@pytest.mark.parametrize("drive", ["crank", "cam"])
def test_a_law_is_searched_once_for_all_designs(law, drive):
    """Each design of a law has the peaks that a search of its own motion gives."""
    kind = registry.law(law)
    tilted = {key.attribute: 0.05 for key in fields(kind) if key.key == "lambda"}
    spec = machine(6, drive, motion=Motion(kind(**tilted)))
    batch = many(spec, {"motion.alpha0_deg": np.linspace(-60.0, 60.0, 25)}).machine
    motion = batch.engagements[0].motion
    searched = search_peaks(motion, QUANTITIES)
    for name, peak in motion_peaks(motion).items():
        # the power's scale has six roundings
        assert peak.max == pytest.approx(searched[name].max, rel=2e-15), name
        assert peak.at_deg == pytest.approx(searched[name].at_deg, abs=1e-6), name


def test_a_pin_that_all_but_meets_the_wheels_centre():
    """The wheel turns 1980 times as fast as its input; sought by rough formulas, 7e-10 were lost.

    The two searches round the wheel's centre in different ways, which moves this peak by 1e-11.
    """
    spec, _ = MACHINES["slider-crank"]
    keys = {"drive.rod_mm": 49.80315879003328, "drive.height_mm": 7.639635438006863, "wheel.z": 16}
    varied = {key: np.array([value]) for key, value in keys.items()}
    found = worst_peaks(many(spec, varied).machine, ["velocity"])["velocity"].max[0]
    assert found == pytest.approx(worst(alone(spec, varied, 0)).velocity.max, rel=1e-10)
