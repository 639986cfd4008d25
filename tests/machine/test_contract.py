"""What every machine answers, it answers for an array of designs too: the same, design by design.

Each machine is asked as one design at one angle, as one design at an array of angles, and as an
array of designs at both kinds of array.
"""

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from machine_witness import motions
from words import Drive, Keys, Motion, Spec, Wheel

from geneva_cli.analysis.timing import timings
from geneva_cli.errors import GenevaError
from geneva_cli.machine import registry
from geneva_cli.machine.many import changed, groups, many, may_vary, taken
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.wheels.external import External

# The formulas are the same, but NumPy's sine and the C library's differ in the last place, and so
# do the places of entry, middle and exit, about which all is written. A motion passes that on as
# it does a unit in the last place of its input angle: UNITS of the greatest value, and of what one
# such unit of the angle makes of it. The most seen is 9.
UNITS = 16 * np.finfo(float).eps


def machine(wheel, kind="crank", motion=None, gearing="external", own=(), **keys):
    kept = {k: v for k, v in keys.items() if k in ("rollers", "roller_angles_deg")}
    rest = {k: v for k, v in keys.items() if k not in kept}
    drive = registry.drive(kind)(**kept, **rest)
    return Spec(Wheel(wheel, gearing, **dict(own)), drive, motion=motion)


SLOTS = ("wheel.z", 1, 16)  # whole numbers; the others are any
# every kind of drive, gearing and law, and what varies: key, least, greatest; some of it refused
MACHINES = {
    "crank": (machine(6), [SLOTS]),
    "internal": (machine(6, gearing="internal"), [SLOTS, ("size.roller_radius_mm", -1.0, 30.0)]),
    "side-crank": (machine(6, "side-crank", A=0.5), [("drive.A", -0.95, 1.05), SLOTS]),
    "inside": (
        machine(6, "side-crank", gearing="internal", A=0.5),
        [("drive.A", -0.95, 0.95), SLOTS],
    ),
    "two rollers": (
        machine(6, "side-crank", A=0.5, rollers=2),
        [("drive.A", -0.95, 0.95), SLOTS],
    ),
    "placed rollers": (
        machine(6, "side-crank", A=0.5, roller_angles_deg=[0.0, 130.0]),
        [("drive.A", -0.95, 0.95), SLOTS],
    ),
    "unequal steps": (
        machine(6, "side-crank", own={"steps_deg": (50.0, 70.0)}, A=0.5),
        [("drive.A", -0.95, 0.95)],
    ),
    "offset": (machine(6, own={"offset_mm": 1.0}), [("wheel.offset_mm", -80.0, 80.0), SLOTS]),
    "offset, slowed": (
        machine(6, "side-crank", own={"offset_mm": 10.0}, A=0.5),
        [
            ("wheel.offset_mm", -30.0, 30.0),
            ("drive.A", -0.9, 0.9),
            ("size.center_distance_mm", 20.0, 200.0),
        ],
    ),
    "spherical": (
        machine(6, gearing="spherical"),
        [("wheel.axes_deg", -5.0, 185.0), SLOTS],
    ),
    "spherical, slowed": (
        machine(6, "side-crank", gearing="spherical", A=0.5),
        [("wheel.axes_deg", 5.0, 175.0), ("drive.A", -0.9, 0.9)],
    ),
    "elliptical gears": (
        machine(6, "elliptical-gears", eccentricity=0.5),
        [("drive.eccentricity", 0.0, 0.95), SLOTS],
    ),
    "elliptical gears, quick": (
        machine(6, "elliptical-gears", eccentricity=0.5, phase="quick"),
        [("drive.eccentricity", -0.1, 0.9)],
    ),
    "noncircular gears": (machine(6, "noncircular-gears", A=0.4), [("drive.A", -0.95, 0.95)]),
    "geneva pair": (
        machine(4, "geneva-pair", first_z=4),
        [("wheel.z", 2, 8), ("drive.first_z", 2, 6)],
    ),
    "epicyclic": (
        machine(4, "epicyclic", planet_ratio=0.01),
        [("drive.planet_ratio", -0.1, 0.05), ("wheel.z", 3, 6)],
    ),
    "in a ring": (
        machine(4, "epicyclic", planet_ratio="shockless", fixed="ring"),
        [("wheel.z", 3, 6)],
    ),
    "cam": (
        machine(6, "cam", Motion("cycloidal")),
        [("motion.alpha0_deg", -200.0, 130.0), SLOTS],
    ),
    "cam inside": (
        machine(6, "cam", Motion("sine-group", 0.1), gearing="internal"),
        [("motion.lambda", -0.12, 0.12)],
    ),
    "gear sector": (
        machine(3, "gear-sector", sector_deg=60.0),
        [("drive.sector_deg", 0.0, 300.0), ("wheel.z", 3, 6)],
    ),
    "gear sector, any ratio": (
        machine(3, "gear-sector", sector_deg=60.0, gear_ratio=0.8),
        [("drive.sector_deg", 0.0, 130.0), ("drive.gear_ratio", 0.1, 3.0)],
    ),
    "tilted law": (
        machine(6, "side-crank", Motion("sine-group", 0.1), A=0.3),
        [("motion.lambda", -0.2, 0.2), ("drive.A", -0.9, 0.9)],
    ),
    "matched": (
        machine(6, motion=Motion("cycloidal", ratio="matched"), gearing="internal"),
        [("motion.alpha0_deg", -200.0, 230.0), SLOTS],
    ),
    **{
        law: (
            machine(6, motion=Motion(law)),
            [("motion.alpha0_deg", -200.0, 130.0), ("motion.ratio", -0.1, 1.1), SLOTS],
        )
        for law in registry.STANDARD_LAWS
    },
}


def drawn(rules, n, seed):
    random = np.random.default_rng(seed)
    return {
        key: random.integers(low, high + 1, n)
        if isinstance(low, int)
        else random.uniform(low, high, n)
        for key, low, high in rules
    }


def alone(spec, varied, i):
    """The i-th design built for itself; None where it is refused."""
    try:
        return build(changed(spec, {key: values[i].item() for key, values in varied.items()}))
    except GenevaError:
        return None


@pytest.fixture(scope="module", params=MACHINES)
def case(request):
    """Some sixty designs of a machine together, and those of them that there are one by one."""
    spec, rules = MACHINES[request.param]
    varied = drawn(rules, 60, 7)
    return spec, varied, many(spec, varied), [alone(spec, varied, i) for i in range(60)]


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


def test_the_same_designs_are_refused(case):
    _, _, found, singles = case
    assert found.refused.tolist() == [one is None for one in singles]
    assert len(found.which) > 5


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


def test_the_same_numbers(case):
    _, _, found, singles = case
    m, singles = found.machine, [one for one in singles if one is not None]
    for name in ("period_deg", "ratio", "rollers_max", "center_distance_mm"):
        expected = np.array([getattr(one, name) for one in singles])[:, None]
        close(np.broadcast_to(getattr(m, name), expected.shape), expected)
    for i, times in enumerate(timings(m)):
        for name, values in times._asdict().items():
            expected = np.array([timings(one)[i]._asdict()[name] for one in singles])[:, None]
            # a dwell is what motions leave of a turn
            rest = 360.0 / abs(times.dwell_deg) * expected if name == "k" else 360.0
            close(np.broadcast_to(values, expected.shape), expected, rest)


def test_it_pickles_and_can_be_taken_apart(case):
    _, _, found, _ = case
    again = pickle.loads(pickle.dumps(found.machine))
    some = found.which % 2 == 0
    part = taken(again, some)
    x = 0.3 * found.machine.engagements[0].entry_deg
    whole = np.broadcast_to(found.machine.engagements[0].motion(x).c[1], (len(found.which), 1))
    x = x if np.ndim(x) == 0 else x[some]
    assert np.array_equal(
        np.broadcast_to(part.engagements[0].motion(x).c[1], (some.sum(), 1)), whole[some]
    )


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


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(sorted(MACHINES)), st.integers(0, 2**32 - 1))
def test_refused_together_as_alone(name, seed):
    spec, rules = MACHINES[name]
    varied = drawn(rules, 5, seed)
    random = np.random.default_rng(seed)
    for key, values in varied.items():  # and what no range allows
        if values.dtype.kind == "f" and random.random() < 0.3:
            values[random.integers(5)] = random.choice([np.nan, np.inf, -1e13, 0.0])
            varied[key] = values
    found = many(spec, varied)
    assert found.refused.tolist() == [alone(spec, varied, i) is None for i in range(5)]


def test_a_design_refused_is_nan_in_the_results():
    found = many(machine(6, "side-crank", A=0.5), {"drive.A": np.array([0.6, 2.0, 0.0])})
    motion = found.spread(found.machine.engagements[0].motion_deg)
    assert motion[2] == 120.0
    assert np.isnan(motion).tolist() == [False, True, False]


def test_none_of_them_can_be_built():
    found = many(machine(6), {"wheel.z": np.array([1, 2])})
    assert found.machine is None
    assert found.refused.all()
    assert many(machine(6), {"wheel.z": np.array([], dtype=int)}).machine is None


def test_what_is_wrong_with_all_of_them_refuses_all():
    spec = machine(6, "side-crank", A=0.5, rollers=4)
    assert many(spec, {"drive.A": np.array([0.1, 0.2])}).refused.all()


def test_keys_that_cannot_vary():
    spec = machine(6, "elliptical-gears", eccentricity=0.1)
    with pytest.raises(ValueError, match="phase"):
        many(spec, {"drive.phase": np.array(["slow", "quick"])})
    with pytest.raises(ValueError, match="rollers"):
        many(spec, {"drive.rollers": np.array([1, 2])})
    with pytest.raises(ValueError, match="one length"):
        many(spec, {"drive.eccentricity": np.array([0.1, 0.2]), "wheel.z": np.array([6])})
    with pytest.raises(GenevaError, match="eccentricity"):
        many(spec, {"drive.excentricity": np.array([0.1, 0.2])})
    with pytest.raises(GenevaError, match=r"no \[motion\]"):
        may_vary(spec, "motion.alpha0_deg")


def test_an_array_needs_the_door():
    with pytest.raises(GenevaError, match="many"):
        External(np.array([[4], [5]]))


def test_groups_of_words_and_rollers():
    spec = machine(6, "elliptical-gears", eccentricity=0.1)
    phase, rollers = ["slow", "quick", "slow", "odd", "slow"], [1, 1, 2, 1, 1]
    e = [0.1, 0.2, 0.3, 0.4, 1.5]
    found = {
        tuple(which.tolist()): (common, built)
        for which, common, built in groups(
            spec,
            {"drive.phase": phase, "drive.rollers": rollers, "drive.eccentricity": e},
        )
    }
    assert set(found) == {(0, 4), (1,), (2,), (3,)}
    common, built = found[0, 4]
    assert common == {"drive.phase": "slow", "drive.rollers": 1}
    assert built.refused.tolist() == [False, True]
    assert len(found[2,][1].machine.engagements) == 2
    assert found[3,][1].refused.all()


def test_groups_of_a_machine_that_no_array_can_be():
    spec = Spec(
        Wheel(8, held_by="detent"),
        Drive("slider-crank"),
        Keys("slider-crank", crank_mm=40.0, rod_mm=100.0, point_mm=80.0, point_deg=90.0),
    )
    found = list(groups(spec, {"drive.crank_mm": [40.0, 41.0, 400.0]}))
    assert [which.tolist() for which, _, _ in found] == [[0], [1], [2]]
    assert found[1][2].machine.spec.drive.crank_mm == 41.0
    assert "cannot turn" in str(found[2][2])
