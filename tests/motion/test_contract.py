"""What every machine answers, it answers for an array of designs too: the same, design by design.

Each machine is asked as one design at one angle, as one design at an array of angles, and as an
array of designs at both kinds of array.
"""

import numpy as np
import pytest
from design_arrays import MACHINES, alone, drawn, machine
from machine_witness import motions
from sampling import some

from geneva_cli.motion.many import many, may_vary
from geneva_cli.motion.mechanism import build
from geneva_cli.numerics.jet import turning

# The formulas are the same, but NumPy's sine and the C library's differ in the last place, and so
# do the places of entry, middle and exit, about which all is written. A motion passes that on as
# it does a unit in the last place of its input angle: UNITS of the greatest value, and of what one
# such unit of the angle makes of it. The most seen is 9.
UNITS = 16 * np.finfo(float).eps


@pytest.fixture(scope="module", params=MACHINES)
def case(request):
    """Designs of a machine together, and those of them that there are one by one."""
    spec, rules = MACHINES[request.param]
    count = some(60, 24)
    varied = drawn(rules, count, 7)
    return spec, varied, many(spec, varied), [alone(spec, varied, i) for i in range(count)]


def close(found, expected, rest=0.0):
    """Rows of a design each, held against the greatest value of the row."""
    scale = np.max(np.abs(expected), axis=-1, keepdims=True) + rest
    assert np.all(np.abs(found - expected) <= UNITS * scale)


def full(jet, shape):
    """The derivatives of a jet as one array."""
    return np.array([np.broadcast_to(c, shape) for c in jet.derivatives()])


def near(found, expected, deg):
    """Derivatives of one design at its angles, all but the last, which tells how steep the others
    are. A length that ought to be 0 is known as nearly as L is.
    """
    scale = 1.0 + np.max(np.abs(expected), axis=-1)
    steep = scale[1:] * np.max(np.abs(np.radians(deg)))
    assert np.all(np.abs(found - expected)[:-1] <= UNITS * (scale[:-1] + steep)[:, None])


@pytest.mark.sampled(4)
def test_the_same_designs_are_refused(case):
    _, _, found, singles = case
    assert found.refused.tolist() == [one is None for one in singles]
    assert len(found.which) > 5


@pytest.mark.sampled(40)
def test_the_same_motion_path_and_slot(case):
    _, _, found, singles = case
    singles = [one for one in singles if one is not None]
    n, m = len(singles), found.machine
    share = np.linspace(0.0, 1.0, 13)[1:-1]
    for i, engagement in enumerate(m.engagements):
        each = [one.engagements[i] for one in singles]
        close(
            np.hstack(
                [np.broadcast_to(x, (n, 1)) for x in (engagement.entry_deg, engagement.exit_deg)]
            ),
            np.array([[one.entry_deg, one.exit_deg] for one in each]),
            180.0,  # they are differences of input angles
        )
        x = engagement.entry_deg + engagement.motion_deg * share
        x = np.ascontiguousarray(np.broadcast_to(x, (n, len(share))))
        inside = min(min(-one.entry_deg, one.exit_deg) for one in each)
        level = np.linspace(-0.9, 0.9, 7) * inside  # the same angles for all
        for angles, own in ((x, x), (level, np.tile(level, (n, 1)))):
            for ask in (
                lambda e, x: [e.motion(x, 5)],
                lambda e, x: e.path(x),
                lambda e, x: e.slot(x),
                lambda e, x: [e.carrier(x, 2)],
            ):
                together = [full(jet, own.shape) for jet in ask(engagement, angles)]
                for row, one in enumerate(each):
                    for jet, expected in zip(together, ask(one, own[row]), strict=True):
                        near(jet[:, row], full(expected, own[row].shape), own[row])
                if own is not x:
                    for jet, at_one in zip(together, ask(engagement, float(level[4])), strict=True):
                        here = [4]
                        for row in range(n):
                            near(full(at_one, (n, 1))[:, row], jet[:, row, here], level[here])


@pytest.mark.parametrize("name", ["side-crank", "offset", "spherical", "epicyclic", "cycloidal"])
def test_against_50_digits(name):
    """Of an array of designs, four against the geometry."""
    spec, rules = MACHINES[name]
    found = many(spec, varied := drawn(rules, 20, 3))
    m, which = found.machine, found.which[:4]
    share = np.array([0.1, 0.45, 0.8])
    x = m.engagements[0].entry_deg + m.engagements[0].motion_deg * share
    values = m.engagements[0].motion(x).derivatives()
    for row, i in enumerate(which):
        one = alone(spec, varied, int(i))
        exact = motions(one.spec)[0]
        for j in range(3):
            for k, expected in enumerate(exact.derivatives(x[row, j])[:4]):
                # as of one design: test_machines
                assert abs(values[k][row, j] - float(expected)) <= 1e-13 * max(1.0, abs(expected))


def test_keys_that_cannot_vary():
    spec = machine(6, "elliptical-gears", eccentricity=0.1)
    with pytest.raises(ValueError, match="phase"):
        many(spec, {"drive.phase": np.array(["slow", "quick"])})
    with pytest.raises(ValueError, match="rollers"):
        many(spec, {"drive.rollers": np.array([1, 2])})
    with pytest.raises(ValueError, match="one length"):
        many(spec, {"drive.eccentricity": np.array([0.1, 0.2]), "wheel.z": np.array([6])})
    with pytest.raises(ValueError, match="excentricity"):
        many(spec, {"drive.excentricity": np.array([0.1, 0.2])})
    assert not may_vary(spec, "motion.alpha0_deg")


CARRIED = ["side-crank", "inside", "placed rollers", "noncircular gears", "tilted law", "cycloidal"]


@pytest.mark.parametrize("name", CARRIED)
def test_a_known_carrier_turns_as_its_pin_goes_round_the_crank_axis(name):
    """The crank's own rate, where it is known, against that of its pin's path."""
    for engagement in build(MACHINES[name][0]).engagements:
        assert engagement.body is not None
        deg = np.linspace(engagement.entry_deg, engagement.exit_deg, 21)
        x, y = engagement.path(deg, 3)
        own, seen = (
            full(jet, deg.shape) for jet in (engagement.carrier(deg, 2), turning(x - 1, y))
        )
        # three derivatives of the path, each of which takes the rounding of those before it along
        assert np.abs(own - seen).max() <= 4 * UNITS * max(1.0, np.abs(seen).max())
