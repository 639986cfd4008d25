"""Tolerances against closed solutions at 50 digits, corners tried one by one, and whole turns."""

import json
import math
from itertools import product

import mpmath as mp
import numpy as np
import pytest

from geneva_cli import Design, External, Internal, Size, Spherical, Tolerance
from geneva_cli.design import load
from geneva_cli.errors import GenevaError
from geneva_cli.loads.tolerance import motion_error as errors
from geneva_cli.loads.tolerance.locking import Deviations, Lock, deviations, slope_of, used
from geneva_cli.motion.laws.law import Motion
from geneva_cli.motion.laws.standard import Cycloidal
from geneva_cli.motion.many import many
from geneva_cli.parts.parts import parts_of
from geneva_cli.verdict.checks import TURNING, applicable
from geneva_cli.verdict.tolerance import flat_locks
from tests.repo import ROOT

pytestmark = pytest.mark.usefixtures("made_once")
ALL = Tolerance(
    center_distance_mm=0.02,
    crank_radius_mm=0.03,
    roller_diameter_mm=0.01,
    slot_width_mm=0.02,
    slot_angle_deg=0.02,
    lock_radius_mm=0.015,
    recess_radius_mm=0.01,
)
EXACT = dict.fromkeys(Deviations._fields, 0.0)
PLAYS = Size(slot_clearance_mm=0.05, lock_clearance_mm=0.06, lock_radius_mm=38.0)


@pytest.fixture(autouse=True)
def digits():
    with mp.workdps(50):
        yield


def at(**values):
    """Deviations by name, the others 0; millimetres and radians."""
    return deviations([values.get(name, 0.0) for name in Deviations._fields])


def told(design, samples=4096, **more):
    return design.tolerance(samples, **more).to_dict()


# The lock ------------------------------------------------------------------------------------


@pytest.mark.sampled(5)
@pytest.mark.parametrize(
    "name", ["press-straight", "internal-z6", "three-rollers-z4", "unequal-steps", "offset-slots"]
)
def test_play_of_the_lock_is_that_of_a_whole_turn(name):
    """Found there from the outlines, in steps, without knowing what stops the wheel."""
    design = load(str(ROOT / "designs" / f"{name}.toml")).with_("size.lock_clearance_mm", 0.05)
    found = [lock(at())[0].c[0] for lock in flat_locks(design.parts, EXACT)[0]]
    # parts that overlap by rounding, 1e-9 L, still touch there: as much more clearance
    assert math.degrees(max(found)) == pytest.approx(design.parts.turn.dwell.deg, rel=1e-5)


@pytest.mark.parametrize("half, sign", [(2.0, 1.0), (0.3, 1.0), (0.3, -1.0), (1.2, -1.0)])
def test_slopes_of_the_lock(half, sign):
    """The corner, or the disc's end, of the formulas in their words; differences at 50 digits."""
    lock = Lock(100.0, sign, 38.0, 38.05, 86.7, half)
    L, p = mp.mpf(lock.L), mp.mpf(lock.corner)

    def angle(a, b, opposite):
        return mp.acos((a * a + b * b - opposite**2) / (2 * a * b))

    def play(dL, dk, dr):
        c, k, r = L + dL, mp.mpf(lock.lock) + dk, mp.mpf(lock.recess) + dr
        if lock.reach <= lock.half:
            return angle(L, p, r) - angle(c, p, k)
        end = c - sign * k * mp.expj(mp.mpf(half) * -sign)
        return angle(abs(end), L, r) - mp.arg(end)

    for i, name in ((0, "center_distance_mm"), (5, "lock_radius_mm"), (6, "recess_radius_mm")):
        way = [float(name == other) for other in Deviations._fields]
        true = mp.diff(lambda h, w=way: play(h * w[0], h * w[5], h * w[6]), 0)
        # the angle is a small difference of large ones, and so is the slope by L
        assert abs(lock(slope_of(i))[0].c[1] - true) < 1e-13


# The motion ----------------------------------------------------------------------------------


def closed(design, phi, side, dev):
    """The wheel's angle of a machine with deviations, from its crank's angle, at 50 digits."""
    spec, m = design.spec, design.mechanism
    L, sign = mp.mpf(m.center_distance_mm), spec.wheel.SIGN
    dL, dR, dd, dw, da = (mp.mpf(dev.get(n, 0)) for n in Deviations._fields[:5])
    b = mp.pi / spec.wheel.z
    e = mp.mpf(vars(spec.wheel).get("offset_mm", 0.0))
    R = L * mp.sin(b) * mp.sqrt(1 - (e / L / mp.cos(b)) ** 2)
    c = (mp.mpf(spec.size.slot_clearance_mm) + (dw - dd) / 2) * side

    def wheel(R, L, c):
        x, y = L - sign * R * mp.cos(phi), R * mp.sin(phi)
        return mp.atan2(y, x) + mp.asin((e + c) / mp.hypot(x, y))

    return wheel(R + dR, L + dL, c) - wheel(R, L, mp.mpf(0)) + da


MACHINES = [
    Design(External(6), size=PLAYS, tolerance=ALL),
    Design(External(3), size=Size(slot_clearance_mm=0.02), tolerance=ALL),
    Design(Internal(5), size=Size(slot_clearance_mm=0.05), tolerance=ALL),
    Design(External(8, offset_mm=-6.0), size=Size(slot_clearance_mm=0.05), tolerance=ALL),
]


@pytest.mark.parametrize("design", MACHINES)
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_place_and_slopes_in_the_motion(design, side):
    [one] = errors.motion_errors(design.mechanism)
    dev = {"center_distance_mm": 0.02, "crank_radius_mm": -0.01, "slot_width_mm": 0.015}
    for share in (-0.97, -0.3, 0.0, 0.6):
        deg = share * one.engagement.exit_deg if share > 0 else -share * one.engagement.entry_deg
        phi = mp.radians(mp.mpf(deg))
        got = one(at(**dev), deg, side).c[0]
        assert abs(got - closed(design, phi, side, dev)) < 1e-15
        for i, name in enumerate(Deviations._fields[:5]):
            true = mp.diff(lambda h, n=name, p=phi: closed(design, p, side, {n: h}), 0)
            assert abs(one(slope_of(i), deg, side).c[1] - true) < 2e-15 / min(1, abs(true) * 1e3)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("design", MACHINES)
def test_worst_case_by_corners(design):
    """Each combination, at each of many angles, in the closed solution."""
    names = Deviations._fields[:5]
    sizes = [design.spec.tolerance.as_dict()[n] for n in names]
    sizes[4] = math.radians(sizes[4])
    [one] = errors.motion_errors(design.mechanism)
    with mp.workdps(20):
        worst = max(
            side * closed(design, mp.radians(deg), side, dict(zip(names, corner, strict=True)))
            for deg in np.linspace(one.engagement.entry_deg, one.engagement.exit_deg, 41)
            for side in (1, -1)
            for corner in product(*[(-s, s) for s in sizes[:2]], (-sizes[2],), (sizes[3],))
            for corner in [(*corner, side * sizes[4])]
        )
    found = told(design)["motion_play.worst_deg"]
    # between 41 angles the greatest may be missed by its curvature, never exceeded
    assert -1e-15 < found - float(mp.degrees(worst)) < 2e-3 * found


# Machines drawn ------------------------------------------------------------------------------


@pytest.mark.parametrize("distribution, std", [("uniform", 0.02 / 3**0.5), ("normal", 0.02 / 3)])
def test_one_dimension_alone_keeps_its_distribution(distribution, std):
    design = Design(
        External(6), tolerance=Tolerance(slot_angle_deg=0.02, distribution=distribution)
    )
    found = told(design, 1 << 16)
    for name in ("dwell_position", "motion_play"):
        assert found[f"{name}.worst_deg"] == pytest.approx(0.02, rel=1e-14)
        assert found[f"{name}.rss_deg"] == pytest.approx(0.02, rel=1e-14)
        assert abs(found[f"{name}.mean_deg"]) < 1e-5 * 0.02
        assert found[f"{name}.std_deg"] == pytest.approx(std, rel=1e-4)
    # 99.7 % of a normal distribution is within 2.9677 standard deviations
    p997 = 0.997 * 0.02 if distribution == "uniform" else 2.967738 * std
    assert found["dwell_position.p997_deg"] == pytest.approx(p997, rel=1e-3)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "wheel, key, s",
    [
        (External(3), "crank_radius_mm", 1e-7),
        (External(6), "center_distance_mm", 1e-6),
        (Internal(6), "crank_radius_mm", 1e-6),
    ],
)
def test_mean_jump_of_a_million(wheel, key, s):
    """0.411089479331229 tan b sqrt(2 s), for a normal error of R/L of standard deviation s.

    The jump's next term is about 2 sqrt(s) of it: of small errors it is less than chance.
    """
    b = math.pi / wheel.z
    size = 100.0 * (math.sin(b) if key == "crank_radius_mm" else 1.0)
    normal = Tolerance(distribution="normal", **{key: 3.0 * s * size})
    found = told(Design(wheel, tolerance=normal), 1_000_000)
    factor = 2 ** (-1 / 4) * math.gamma(3 / 4) / math.sqrt(2 * math.pi)
    assert factor == pytest.approx(0.411089479331229, rel=1e-14)
    true = factor * math.tan(b) * math.sqrt(2.0 * s)
    assert abs(found["entry_jump.mean"] - true) < 4.0 * found["entry_jump.std"] / 1000.0
    # E jump² = tan² b 2 s E max(n, 0) = tan² b 2 s / sqrt(2 pi)
    square = 2.0 * s * math.tan(b) ** 2 / math.sqrt(2.0 * math.pi)
    assert found["entry_jump.std"] == pytest.approx(math.sqrt(square - true**2), rel=3e-3)
    assert found["entry_jump.missed_share"] == pytest.approx(0.5, abs=1e-4)


def test_jumps_of_cranks_as_built_are_those_of_each_alone():
    """Too short to reach the slot's axis, as derived, and too long."""
    design, R = Design(External(6), size=Size(100.0), tolerance=ALL), np.array([49.9, 50.0, 50.2])
    batch = many(design.spec, {"size.crank_radius_mm": R}).machine
    jumps = errors.entry_jumps_worst(batch, used(batch.spec))
    for radius, jump in zip(R.tolist(), jumps, strict=True):
        one = design.with_("size.crank_radius_mm", radius).mechanism
        assert errors.entry_jumps_worst(one, errors.used(one.spec)) == pytest.approx(
            jump, rel=1e-12
        )


def test_machines_that_do_not_go_together_are_counted():
    """Without clearance every other roller is wider than its slot."""
    found = told(Design(External(6), tolerance=Tolerance(roller_diameter_mm=0.01)), 1 << 14)
    assert found["clearances.jam_share"] == pytest.approx(0.5, abs=1e-3)
    assert found["clearances.turns"] is False
    assert "slot_clearance_mm must be at least 0.005" in found["warnings"][0]


# Clearances ----------------------------------------------------------------------------------


@pytest.mark.long
def test_clearances_that_still_turn():
    found = told(MACHINES[0])
    [lock] = flat_locks(MACHINES[0].parts, EXACT)[0]
    # the tightest lock gives way by so much at the mouth, cos 30 deg of 100 mm off
    yields = lock(at(center_distance_mm=-0.02, lock_radius_mm=0.015, recess_radius_mm=-0.01))[0]
    mouth = 100.0 * math.cos(math.pi / 6)
    across = 0.03 + 0.02 * math.sin(math.pi / 6)
    across += mouth * (math.sin(math.radians(0.02)) - math.sin(yields.c[0]))
    assert found["clearances.slot_needed_mm"] == pytest.approx(0.015 + across, rel=1e-9)
    assert found["clearances.lock_needed_mm"] == pytest.approx(0.02 + 0.015 + 0.01)
    needed = found["clearances.slot_needed_mm"]
    for clearance, turns in ((needed * 1.001, True), (needed * 0.999, False)):
        design = MACHINES[0].with_("size.slot_clearance_mm", clearance)
        assert told(design)["clearances.turns"] is turns


@pytest.mark.sampled(3)
@pytest.mark.parametrize("axes_deg", [60.0, 90.0, 120.0])
def test_the_clearance_of_a_slot_on_a_sphere(axes_deg):
    """The arm is square to crank's axis and path; what of it is across the slot lies level."""
    given = Tolerance(crank_radius_mm=0.02, slot_width_mm=0.03, slot_angle_deg=0.01)
    found = told(Design(Spherical(6, axes_deg=axes_deg), tolerance=given), 64)
    S, b = math.radians(axes_deg), math.pi / 6
    th = math.asin(math.sin(S) * math.sin(b))
    half = math.acos(math.tan(th) / math.tan(S))
    x, y = -math.cos(S) * math.cos(half), math.sin(half)  # the arm's direction at entry
    rim = math.hypot(math.sin(S) * math.cos(th) + math.sin(th) * x, math.sin(th) * y)
    across = abs(x * math.sin(b)) + abs(y * math.cos(b))
    needed = 0.015 + 0.02 * across + 100.0 * rim * math.sin(math.radians(0.01))
    assert found["clearances.slot_needed_mm"] == pytest.approx(needed, rel=1e-12)


# What does not apply, and bad input ----------------------------------------------------------


@pytest.mark.long
def test_what_does_not_apply_is_null_and_said():
    angle = Tolerance(slot_angle_deg=0.01, center_distance_mm=0.01, crank_radius_mm=0.01)
    bent = Design(External(6), None, Motion(Cycloidal()), tolerance=angle)
    curved = told(bent, 64)
    assert curved["motion_play.worst_deg"] is None
    assert curved["entry_jump.mean"] is None
    assert curved["dwell_position.worst_deg"] > 0.01
    assert curved["warnings"][-1] == "micrometres of dwell_position: need --radius"
    curved_at_100 = told(bent, 64, radius_mm=100.0)
    sphere = told(Design(Spherical(6), tolerance=angle))
    assert sphere["dwell_position.rss_deg"] == pytest.approx(0.01, rel=1e-12)  # the slot's own
    assert sphere["clearances.turns"] is False  # without clearance, slots at other angles jam
    assert sphere["motion_play.worst_deg"] > 0.01
    # its mouth strikes harder than the axis, as there is no clearance at all
    assert "shafts meet" in sphere["warnings"][0]
    assert sphere["warnings"][-1].startswith("micrometres of dwell_position")
    assert not any("micrometres" in text for text in curved_at_100["warnings"])
    assert curved_at_100["dwell_position.worst_um"] > 0.0
    linkage = load(str(ROOT / "designs" / "four-bar-z4.toml")).with_("tolerance.crank_radius_mm", 1)
    found = told(linkage)
    assert "crank_radius_mm is left out" in found["warnings"][0]
    assert found["motion_play.rss_deg"] == 0.0
    names = [set(one) for one in (curved, sphere, found, told(MACHINES[0]))]
    assert all(one == names[0] for one in names)
    json.dumps(found["warnings"], allow_nan=False)


@pytest.mark.parametrize(
    "design, options, words",
    [
        (Design(External(6)), {}, "set one or more of center_distance_mm, crank_radius_mm"),
        (MACHINES[0], {"samples": 0}, "--samples 0: it must be from 1 to 10000000"),
        (MACHINES[0], {"radius_mm": -3.0}, "--radius -3"),
    ],
)
def test_refused(design, options, words):
    with pytest.raises(GenevaError) as error:
        told(design, **options)
    assert words in str(error.value)


@pytest.mark.parametrize("distribution, most", [("uniform", 49.94), ("normal", 16.64)])
def test_a_roller_that_could_come_to_the_wheels_axis_is_refused(distribution, most):
    """1 - l of 100 mm less the clearances; of a normal distribution nine deviations must fit."""
    wide = Tolerance(center_distance_mm=5.0, slot_width_mm=0.02, distribution=distribution)
    design = Design(External(6), size=Size(slot_clearance_mm=0.05), tolerance=wide)
    room = (50.0 - 0.05) / (3.0 if distribution == "normal" else 1.0) - 0.01
    assert room == pytest.approx(most, rel=1e-12)
    fits = told(design.with_("tolerance.crank_radius_mm", room - 5.001), 500)
    assert all(math.isfinite(v) for v in fits.values() if isinstance(v, float))
    with pytest.raises(GenevaError, match=f"must add up to less than {room:.6g} mm"):
        told(design.with_("tolerance.crank_radius_mm", room - 4.999))


@pytest.mark.long
@pytest.mark.parametrize("distribution", ["normal", "uniform"])
def test_plays_in_motion_are_the_greatest_over_it(distribution):
    """The play is widest at mid-motion, but the worst machine's error elsewhere.

    There the roller is L - R = 100 mm from the wheel's axis: its clearance turns the wheel by c/100
    and errors of L and R do not. They add less than a millionth beside it.
    """
    allowed = Tolerance(
        center_distance_mm=0.015,
        crank_radius_mm=0.012,
        roller_diameter_mm=0.006,
        slot_width_mm=0.01,
        slot_angle_deg=0.008,
        distribution=distribution,
    )
    size = Size(200.0, 10.0, slot_clearance_mm=0.045, lock_clearance_mm=0.04)
    machine = Design(External(6), size=size, tolerance=allowed)
    found = told(machine, 65536)
    free = math.degrees(math.asin(0.045 / 100.0))
    slope = math.degrees(1.0 / 100.0) / math.cos(math.radians(free))  # by the clearance, mm
    parts = [0.008, slope * 0.003, slope * 0.005]
    rss = free + math.hypot(*parts)
    assert rss <= found["motion_play.rss_deg"] <= rss * (1.0 + 1e-6)
    assert abs(found["motion_play.at_deg"]) > 10.0  # of the worst machine
    rng = np.random.default_rng(1)
    normal, even = rng.normal(size=(3, 10**6)) / 3.0, rng.uniform(-1.0, 1.0, (3, 10**6))
    drawn = parts @ (normal if distribution == "normal" else even)
    p997 = float(np.quantile(abs(free + drawn), 0.997))
    # the quantiles of 65536 and of a million machines differ by some 1e-3 of their spread
    assert found["motion_play.p997_deg"] == pytest.approx(p997, rel=1e-3)
    batch = many(machine.spec, {"tolerance.slot_angle_deg": np.array([0.008, 0.02])})
    plays = errors.motion_plays(batch.machine)
    assert plays["rss_deg"][0] == found["motion_play.rss_deg"]
    assert plays["rss_deg"][1] == pytest.approx(free + math.hypot(0.02, *parts[1:]), rel=1e-6)


@pytest.mark.long
def test_clearances_too_small_for_the_tolerances_fail():
    """R 0.05 and L 0.05 sin 30° add up in the slot; disc, recess and L in the lock."""
    every = ("tolerance_slot_mm", "tolerance_lock_mm")
    allowed = Tolerance(
        center_distance_mm=0.05, crank_radius_mm=0.05, lock_radius_mm=0.05, recess_radius_mm=0.05
    )
    size = Size(100.0, 6.0, slot_clearance_mm=0.01, lock_clearance_mm=0.01)

    def rows(slot_mm, lock_mm, **more):
        play = size.replace(slot_clearance_mm=slot_mm, lock_clearance_mm=lock_mm)
        model = parts_of(Design(External(6), size=play, **more).mechanism)
        checks = {one.name: one for one in applicable(TURNING, model)}
        return {name: checks[name] for name in every if name in checks}

    tight = rows(0.01, 0.01, tolerance=allowed)
    assert {name: one.passes for name, one in tight.items()} == dict.fromkeys(every, False)
    assert [one.limit for one in tight.values()] == pytest.approx([0.075, 0.15], rel=1e-12)
    wide = rows(0.075, 0.15, tolerance=allowed)
    assert {name: one.passes for name, one in wide.items()} == dict.fromkeys(every, True)
    assert rows(0.0749, 0.15, tolerance=allowed)["tolerance_slot_mm"].passes is False
    assert rows(0.075, 0.1499, tolerance=allowed)["tolerance_lock_mm"].passes is False
    assert not rows(0.01, 0.01)
