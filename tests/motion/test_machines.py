"""The contract of every machine: each kind of drive, each gearing, and what they make together.

Accuracy: against 50 digits at 60 angles, the error of position, velocity, acceleration and jerk is
at most 16 units in the last place of that quantity's own peak, times max(1, condition number),
|x q'(x)| / peak: what one such unit of the input angle x does. To this is added what the rounding
of the places of entry, middle and exit to doubles does whatever the method: |q'(x)| times half a
unit of the largest of the three. A linkage's lengths are rounded, too: how far its path
reaches, over the pin's least distance from the wheel's axis, counts as a condition number.
"""

import math
import re
from functools import cache
from itertools import pairwise

import machine_witness
import numpy as np
import pytest
from load_states import state
from witness import mp, to_degrees, to_radians
from words import load

from geneva_cli import Design
from geneva_cli.drives.transmission import Transmission
from geneva_cli.motion import registry
from geneva_cli.motion.motion_table import motion_table
from geneva_cli.motion.peaks import QUANTITIES, worst
from geneva_cli.motion.timing import timings

NAMES = ("position", "velocity", "acceleration", "jerk")
SIDE = 'kind = "side-crank", A = '
GEARS = 'kind = "elliptical-gears", eccentricity = '
QUICK = ', phase = "quick"'
SPHERE = 'gearing = "spherical"'
INSIDE = 'gearing = "internal"'
RACK = 'gearing = "linear"'
NONCIRCULAR = 'kind = "noncircular-gears", A = '
FOUR_BAR = 'kind = "four-bar", crank_mm = 40, ground_mm = 90, coupler_mm = 100, rocker_mm = 100, '
SLIDER = 'kind = "slider-crank", crank_mm = 40, rod_mm = 120, '
PAIR = 'kind = "geneva-pair", first_z = '
ORBIT = 'kind = "carousel"'
BEFORE = "before = {"
PLANET = 'kind = "epicyclic", planet_ratio = '


def text(wheel, drive="", motion=""):
    return f"wheel = {{{wheel}}}\ndrive = {{{drive}}}\nmotion = {{{motion}}}\n"


CASES = {
    "external": text("z = 3"),
    "internal": text(f"z = 5, {INSIDE}"),
    "spherical-3": text(f"z = 3, {SPHERE}"),
    "spherical-60-deg": text(f"z = 5, {SPHERE}, axes_deg = 60"),
    "spherical-nearly-flat": text(f"z = 6, {SPHERE}, axes_deg = 0.7"),
    "linear": text(f"z = 6, {RACK}"),
    "linear-side-crank": text(f"z = 6, {RACK}", f"{SIDE}0.4"),
    "linear-gears": text(f"z = 6, {RACK}", f"{GEARS}0.3"),
    "linear-noncircular": text(f"z = 6, {RACK}", f"{NONCIRCULAR}-0.2"),
    "offset": text("z = 6, offset_mm = 20"),
    "offset-near-its-limit": text("z = 5, offset_mm = 40"),
    "steps": text("z = 6, steps_deg = [70, 50]"),
    "angles": text("z = 4", "roller_angles_deg = [0, 90]"),
    "side-crank": text("z = 6", f"{SIDE}0.6"),
    "side-crank-two-rollers": text("z = 8", f"{SIDE}0.4, rollers = 2"),
    "side-crank-internal": text(f"z = 6, {INSIDE}", f"{SIDE}0.3"),
    "side-crank-spherical": text(f"z = 5, {SPHERE}, axes_deg = 80", f"{SIDE}0.5"),
    "side-crank-offset": text("z = 6, offset_mm = 15", f"{SIDE}0.5"),
    "gears": text("z = 6", f"{GEARS}0.3"),
    "gears-internal": text(f"z = 6, {INSIDE}", f"{GEARS}0.2{QUICK}"),
    "gears-spherical": text(f"z = 6, {SPHERE}", f"{GEARS}0.35"),
    "gears-offset": text("z = 6, offset_mm = -20", f"{GEARS}0.25"),
    "gears-two-rollers": text("z = 8", f"{GEARS}0.3{QUICK}, rollers = 2"),
    "noncircular": text("z = 6", f"{NONCIRCULAR}0.5"),
    "noncircular-internal": text(f"z = 6, {INSIDE}", f"{NONCIRCULAR}-0.2"),
    "noncircular-spherical": text(f"z = 4, {SPHERE}", f"{NONCIRCULAR}0.3"),
    "noncircular-offset": text("z = 6, offset_mm = 10", f"{NONCIRCULAR}0.3"),
    "noncircular-two-rollers": text("z = 8", f"{NONCIRCULAR}0.3, rollers = 2"),
    "crank-offset-two-rollers": text("z = 8, offset_mm = 7", "rollers = 2"),
    "carousel": text("z = 6", ORBIT),
    "carousel-internal": text(f"z = 6, {INSIDE}", ORBIT),
    "carousel-offset-two-rollers": text("z = 8, offset_mm = 7", f"{ORBIT}, rollers = 2"),
    "geneva-pair": text("z = 4", f"{PAIR}3"),
    "geneva-pair-offset": text("z = 4, offset_mm = 5", f"{PAIR}3"),
    "gears-curved": text("z = 6", f"{GEARS}0.2", 'law = "cycloidal", ratio = "matched"'),
    "planet-sun-4": text("z = 4", f'{PLANET}"shockless"'),
    "planet-ring-4": text("z = 4", f'{PLANET}"shockless", fixed = "ring"'),
    "cam": text("z = 6", 'kind = "cam"', 'law = "cycloidal"'),
    "cam-internal": text(f"z = 8, {INSIDE}", 'kind = "cam"', 'law = "4-5-6-7"'),
    "four-bar": text("z = 6", f"{FOUR_BAR}point_mm = 170, point_deg = 0"),
    "slider-crank": text("z = 4", f"{SLIDER}point_mm = 200, point_deg = 20, height_mm = 10"),
    "planet-behind-gears": text("z = 4", f'{PLANET}"shockless", {BEFORE}{GEARS}0.2}}'),
    "four-bar-behind-gears": text(
        "z = 6", f"{FOUR_BAR}point_mm = 170, point_deg = 0, {BEFORE}{NONCIRCULAR}0.4}}"
    ),
    "side-crank-behind-gears": text("z = 6, offset_mm = 9", f"{SIDE}0.4, {BEFORE}{GEARS}0.2}}"),
    "gears-behind-side-crank": text(
        f"z = 6, {SPHERE}, axes_deg = 50", f"{GEARS}0.3, rollers = 2, {BEFORE}{SIDE}0.25}}"
    ),
    "curved-behind-side-crank": text(
        "z = 8", f"rollers = 2, {BEFORE}{SIDE}-0.3}}", 'law = "modified-sine", ratio = "matched"'
    ),
    "cam-behind-gears": text(
        f"z = 8, {INSIDE}",
        f'kind = "cam", {BEFORE}{NONCIRCULAR}-0.2}}',
        'law = "4-5-6-7", alpha0_deg = 5',
    ),
    "slider-crank-turned": text("z = 3", f"{SLIDER}point_mm = 60, point_deg = 30"),
}
KIND = re.compile('(?:kind|gearing) = "([^"]+)"')
KNOWN = {*registry.DRIVES, *registry.GEARINGS}  # the kinds that there are
CASES = {case: text for case, text in CASES.items() if {*KIND.findall(text)} <= KNOWN}
# Machines on a linkage's path, with places near which their wheel's entry and exit are.
ON_PATH = {
    "four-bar": (59.15, 289.43),
    "slider-crank": (239.58, 372.26),
    "slider-crank-turned": (50.82, 150.71),
    "four-bar-behind-gears": (59.15, 289.43),
}


@pytest.fixture(scope="module")
def machine(tmp_path_factory):
    """A function from a spec's text, or a case's name, to the mechanism, by the public reader."""
    folder = tmp_path_factory.mktemp("machines")

    @cache
    def make(case):
        path = folder / "spec.toml"
        path.write_text(CASES.get(case, case), encoding="utf-8")
        return load(path)

    return make


@pytest.fixture(scope="module")
def witness(machine):
    """A function from a case's name to its witnesses, one an engagement."""

    @cache
    def make(case):
        spec = machine(case).spec
        if case in ON_PATH:
            return (machine_witness.on_path(spec, *ON_PATH[case]),)
        return tuple(machine_witness.motions(spec))

    return make


def angles(engagement):
    """60 input angles: even, both ends and their neighbourhoods, and around the middle."""
    first, last = engagement.entry_deg, engagement.exit_deg
    near = [1e-12, 1e-9, 1e-6, 1e-3, 0.1]
    out = {0.0, first, last, math.nextafter(first, 0.0), math.nextafter(last, 0.0)}
    out |= {first + abs(first) * t for t in near} | {last - abs(last) * t for t in near}
    out |= {s * t for t in (1e-12, 1e-6, 0.01, 0.05, 0.07) for s in (-1.0, 1.0)}
    even = np.linspace(first, last, 60 - len(out) + 2)[1:-1]
    return np.array(sorted(out | {float(x) for x in even}))


@pytest.fixture(scope="module")
def exact(machine, witness):
    """A function from a case and an engagement to angles with the witness's derivatives 0..4."""

    @cache
    def make(case, i):
        x = angles(machine(case).engagements[i])
        return x, np.array([witness(case)[i].derivatives(v) for v in x]).T

    return make


def slack(engagement):
    """Half a unit of the largest of the places that were rounded to doubles, radians."""
    far = abs(engagement.mid_deg) + max(-engagement.entry_deg, engagement.exit_deg)
    return float(to_radians(math.ulp(far))) / 2.0


def bars(engagement, x, reference, k, units, case=""):
    """The error allowed of derivative k at each angle: see the top of this file."""
    peak = float(np.max(np.abs(reference[k])))
    slope = np.abs(reference[k + 1]).astype(float)
    condition = np.abs(np.radians(x)) * slope / peak
    if case in ON_PATH:
        condition = np.maximum(condition, 1.0 / min(a.along for a in engagement.own.path.anchors))
    return units * math.ulp(peak) * np.maximum(1.0, condition) + slope * slack(engagement)


every = pytest.mark.parametrize("case", CASES)


@pytest.mark.long
def test_every_kind_and_every_gearing_has_an_entry(machine):
    specs = [machine(case).spec for case in CASES]
    # a motion in pieces has its witness in test_gear_sector.py
    assert {s.drive.NAME for s in specs} | {"gear-sector"} == set(registry.DRIVES)
    assert {s.wheel.NAME for s in specs} == set(registry.GEARINGS)
    gearings = {one.name: one.gearings for one in registry.KINDS}
    for kind in registry.DRIVES:  # and each transmission before each gearing and each kind of slot
        # a pair's first wheel turns its crank through less than half a turn, and back at once
        if issubclass(registry.drive(kind), Transmission) and kind != "geneva-pair":
            mine = [s for s in specs if kind == s.drive.NAME]
            driven = set(gearings[kind] or registry.GEARINGS)
            assert {s.wheel.NAME for s in mine} == driven, kind
            assert any(s.wheel.as_dict().get("offset_mm") for s in mine), kind
            assert any(s.drive.rollers > 1 for s in mine), kind


@pytest.mark.sampled(5)
@every
def test_stations_and_their_places(machine, witness, case):
    m, reference = machine(case), witness(case)
    assert len(m.engagements) == len(reference)
    for i, (s, w) in enumerate(zip(m.engagements, reference, strict=True)):
        # three roundings of a sum, and the crank's own angle, 45 degrees and more, is a double that
        # counts up to twice
        bar = 6 * math.ulp(max(45.0, abs(s.mid_deg) + max(-s.entry_deg, s.exit_deg)))
        for value, want in ((s.mid_deg, w.mid), (s.entry_deg, w.entry), (s.exit_deg, w.exit)):
            assert abs(mp.mpf(value) - to_degrees(want)) <= bar
        assert s.half_step == pytest.approx(float(w.b), rel=2e-16)
        assert m.spec.wheel.index_deg(i) == pytest.approx(float(to_degrees(2 * w.b)), rel=2e-16)
        # A second roller's motion is symmetric too, but its two ends are rounded apart.
        mirrored = abs(w.entry + w.exit) < mp.mpf(10) ** -30
        assert mirrored if s.motion.symmetric else i or not mirrored or case in ON_PATH


@every
def test_the_wheel_turns_one_step_from_rest_to_rest(machine, witness, case):
    for s, w in zip(machine(case).engagements, witness(case), strict=True):
        x = np.array([s.entry_deg, s.exit_deg])
        for wheel, velocity in (
            tuple(zip(*[s.motion(v).derivatives()[:2] for v in x.tolist()], strict=True)),
            s.motion(x).derivatives()[:2],
            s.motion.derivatives(x, (0, 1)),
        ):
            assert list(velocity) == [0.0, 0.0]
            assert abs(mp.mpf(float(wheel[1])) - mp.mpf(float(wheel[0])) - 2 * w.b) <= 1e-14


@pytest.mark.sampled(96)
@every
def test_error_within_16_ulp_of_the_peak(machine, exact, case):
    over = []
    for i, s in enumerate(machine(case).engagements):
        x, reference = exact(case, i)
        for how, got in (
            ("jets", s.motion(x, 3).derivatives()),
            ("arrays", s.motion.derivatives(x)),
        ):
            for k, name in enumerate(NAMES):
                bar = bars(s, x, reference, k, 16.0, case)
                values = [mp.mpf(float(v)) for v in got[k]]
                error = np.abs(np.array(values) - reference[k]).astype(float)
                over += [
                    f"{name} ({how}) of engagement {i} at {x[j]:.17g}: {error[j] / bar[j]:.3g} bars"
                    for j in np.flatnonzero(~(error <= bar))
                ]
    assert not over, "\n".join(over[:40])


@pytest.mark.sampled(56)
@every
def test_the_pin_lies_on_its_slot(machine, witness, exact, case):
    """The pin's place, the slot's axis and the pitch curve are three views of one thing."""
    for i, s in enumerate(machine(case).engagements):
        w, x = witness(case)[i], exact(case, i)[0]
        px, py = (c.c[0] for c in s.path(x, 1))
        wheel = s.motion(x, 0).c[0]
        across = py * np.cos(wheel) - px * np.sin(wheel)
        along = px * np.cos(wheel) + py * np.sin(wheel)
        u, v = (c.c[0] for c in s.slot(x, 1))
        # 1e-14: a few roundings of lengths up to 2 L, and the anchors' of the input angle; 1e-12
        # where the law of sines divides two small angles, one of them known to 1e-16 of a step
        bar = 1e-12 if w.law and not s.slot.curved else 1e-14
        for j in range(0, len(x), 3):
            if x[j] == 0.0 and w.law:
                continue  # 0/0 in the law of sines
            true = w.path(to_radians(x[j]))
            assert abs(complex(px[j], py[j]) - complex(true)) <= bar
        if w.parallel:  # the rack has moved by its angle, and did not turn
            assert np.max(np.hypot(u - px, v - (py - wheel))) <= 1e-14
            continue
        if not machine(case).spec.wheel.FLAT:
            assert np.max(np.abs(across)) <= 1e-14
            polar = [float(w.polar(to_radians(t))) for t in x]
            assert np.max(np.abs(u - polar)) <= 1e-14
            assert not v.any()
            continue
        assert np.max(np.hypot(u - along, v - across)) <= 1e-14
        if s.slot.curved:
            continue
        # A straight slot: every place of the pin is on one line, offset from the wheel's centre.
        turn = np.polyfit(u, v, 1)[0] if np.ptp(u) else 0.0
        off = v * math.cos(math.atan(turn)) - u * math.sin(math.atan(turn))
        assert np.ptp(off) <= 2e-14  # the fitted slope is rounded, too
        assert abs(abs(off[0]) - abs(float(w.offset))) <= 2e-14


@pytest.mark.sampled(4)
@every
def test_lever_and_speed_in_the_slot(machine, witness, case):
    for s, w in zip(machine(case).engagements, witness(case), strict=True):
        for t in (0.9, 0.5, 0.2, -0.3, -0.7):
            x = t * (s.entry_deg if t > 0.0 else -s.exit_deg)
            if s.slot.curved:
                continue
            lever, place = s.slot.axis(x, 1)
            expected = [pytest.approx(float(v), rel=1e-13) for v in w.axis(to_radians(x))]
            assert [lever.c[0], place.c[1]] == expected


@every
def test_loads_keep_the_energy(machine, case):
    """Without friction the input does what the wheel takes, and nothing is lost between."""
    m = machine(case)
    L = m.center_distance_mm / 1000.0
    load_ = m.spec.load.replace(inertia_kgm2=0.02, torque_Nm=3.0)
    if not m.output.turns:  # a mass and a force at the pinion's radius
        load_ = m.spec.load.replace(mass_kg=0.02 / L**2, force_N=3.0 / L)
    loaded = m._replace(spec=m.spec.replace(load=load_))
    w = m.spec.drive.n_rpm * math.pi / 30.0
    for s in m.engagements:
        for t in (0.8, 0.3, -0.4):
            x = t * (s.entry_deg if t > 0.0 else -s.exit_deg)
            _, v, a, _ = s.motion(x).derivatives()
            found = state(loaded, s, x)
            torque = 0.02 * w * w * a + 3.0
            assert found.torque_Nm == pytest.approx(torque, rel=1e-12)
            # on a carrier the wheel's speed from the ground takes power too: 1 + v, or 1 - v inside
            side = -1.0 if m.spec.wheel.NAME == "internal" else 1.0
            turning = side if m.spec.drive.NAME == "carousel" else 0.0
            taken = torque * v + turning * 0.02 * w * w * a
            assert found.input_torque_Nm == pytest.approx(taken, rel=1e-12)
            if not s.slot.curved:
                lever = s.slot.axis(x)[0].c[0]
                assert math.tan(math.radians(found.pressure_deg)) == pytest.approx(
                    abs(s.slot.offset) / lever, rel=1e-12
                )
                assert found.pin_force_N * lever * L == pytest.approx(abs(torque), rel=1e-12)


@pytest.mark.sampled(16)
@every
def test_peaks_against_a_dense_grid(machine, case):
    m = machine(case)
    found = worst(m)
    for i, (quantity, peak) in enumerate(zip(QUANTITIES, found[:-1], strict=True)):

        def size(s, x, i=i):
            _, velocity, acceleration, jerk = s.motion(x, 3).derivatives()
            return abs((velocity, acceleration, jerk, velocity * acceleration)[i])

        grids = []
        for s in m.engagements:
            parts = [np.linspace(a, b, 4001) for a, b in pairwise(s.motion.breaks_deg)]
            grids.append(np.max(size(s, np.concatenate(parts))))
        # a grid this fine misses a smooth peak by less than 1e-5 of it, and never exceeds it
        assert max(grids) * (1.0 - 1e-12) <= peak.max <= max(grids) * (1.0 + 1e-5), quantity
        # shown between -180 and 180 from the machine's mid-motion: whole turns do not count
        turn = 360.0 * m.spec.drive.turns
        places = [(s, math.remainder(peak.at_deg - s.mid_deg, turn)) for s in m.engagements]
        there = [size(s, x) for s, x in places if s.entry_deg - 1e-9 <= x <= s.exit_deg + 1e-9]
        assert peak.max == pytest.approx(max(there), rel=1e-9), quantity
    ends = [(s.motion(s.entry_deg), s.motion(s.exit_deg)) for s in m.engagements]
    for k, first, last in (
        (2, found.ends.acceleration_entry, found.ends.acceleration_exit),
        (3, found.ends.jerk_entry, found.ends.jerk_exit),
    ):
        assert first == pytest.approx(max(abs(a.derivatives()[k]) for a, _ in ends), rel=1e-14)
        assert last == pytest.approx(max(abs(b.derivatives()[k]) for _, b in ends), rel=1e-14)


@every
def test_motions_and_dwells_fill_the_period(machine, case):
    m = machine(case)
    times = timings(m)
    total = math.fsum(t.motion_deg + t.dwell_deg for t in times)
    assert total == pytest.approx(m.period_deg, rel=1e-14)
    assert min(t.dwell_deg for t in times) >= 0.0
    columns = motion_table(m, 721).columns
    wheel, velocity = np.array(columns[2]), np.array(columns[3])
    assert np.all(np.diff(wheel) >= -1e-12)  # never back
    moved = math.fsum(t.index_deg or t.index_mm for t in times)
    assert wheel[-1] - wheel[0] == pytest.approx(moved, abs=1e-12)
    assert np.min(velocity) >= -1e-15


# ---- numbers in print, and closed forms ----

# Shafts at 90 degrees: z, peak velocity tan b, sine of the angle of the peak acceleration, the
# peak and the jump at entry sin(2 b)/2. Theory notes, section 7, 30 digits.
SPHERICAL = """
3 1.73205080756887729352744634151 0.313740917148940420072438293397 2.1715525461288102377631236099 0.433012701892219323381861585376
4 1.0 0.505408105853053508532167527628 0.88008629652304345970259232485 0.5
6 0.577350269189625764509148780502 0.801363405952288776094330211485 0.455969184010703339921157703529 0.433012701892219323381861585376
8 0.41421356237309504880168872421 1.0 0.353553390593273762200422181052 0.353553390593273762200422181052
24 0.13165249758739585347152645741 1.0 0.129409522551260381174449418812 0.129409522551260381174449418812
"""  # noqa: E501


def rows(table):
    return [line.split() for line in table.strip().split("\n")]


@pytest.mark.parametrize("row", rows(SPHERICAL), ids=lambda row: f"z{row[0]}")
def test_spherical_constants(machine, row):
    z, *exact = row
    m = machine(text(f"z = {z}, {SPHERE}"))
    s, found = m.engagements[0], worst(m)
    # Motion and dwell are half a turn each, whatever z.
    assert (s.entry_deg, s.exit_deg, timings(m)[0].k) == (-90.0, 90.0, 1.0)
    assert found.velocity.max == pytest.approx(float(exact[0]), rel=1e-15)
    # 1e-8: at a maximum, an angle is half as sharp as its value
    at = math.sin(math.radians(-found.acceleration.at_deg))
    assert at == pytest.approx(float(exact[1]), rel=1e-8)
    assert found.acceleration.max == pytest.approx(float(exact[2]), rel=2e-15)
    assert found.ends.acceleration_entry == pytest.approx(float(exact[3]), rel=1e-15)
    assert found.ends.jerk_entry <= 1e-15


def test_unequal_steps_are_wheels_of_their_own(machine):
    """Roller i has R_i = L sin b_i, and moves the wheel as a wheel of equal steps 2 b_i would."""
    m = machine(text("z = 6, steps_deg = [72, 48]"))
    assert [t.index_deg for t in timings(m)] == [72.0, 48.0]
    assert [t.motion_deg for t in timings(m)] == [108.0, 132.0]
    assert [t.dwell_deg for t in timings(m)] == [60.0, 60.0]
    five = machine(text("z = 5")).engagements[0]
    for x in (-54.0, -20.0, 7.0, 54.0):
        wanted = pytest.approx(five.motion(x).derivatives(), rel=1e-14, abs=1e-15)
        assert m.engagements[0].motion(x).derivatives() == wanted
    x, y = (c.c[0] for c in m.engagements[1].path(30.0, 0))
    assert math.hypot(1.0 - x, y) == pytest.approx(math.sin(math.radians(24.0)), rel=1e-15)


def test_shockless_gear_geneva(machine):
    """In print for z = 4: peak velocity 3.778 and acceleration 13.73, against 2.414 and 5.407."""
    found = worst(machine("planet-sun-4"))
    assert found.velocity.max == pytest.approx(3.778, abs=5e-4)
    assert found.acceleration.max == pytest.approx(13.73, abs=5e-3)
    assert found.ends.acceleration_entry <= 1e-15
    plain = worst(machine(text("z = 4")))
    assert plain.velocity.max == pytest.approx(2.414, abs=5e-4)
    assert plain.acceleration.max == pytest.approx(5.407, abs=5e-4)


def test_cam_groove(machine, witness):
    """R(0) = L V/(1 + V); R' by the law of sines; at entry R'/R = cot(phi1 + b)."""
    for case in ("cam", "cam-internal"):
        m, w = machine(case), witness(case)[0]
        s, g = m.engagements[0], -1 if m.spec.wheel.NAME == "internal" else 1
        V = s.motion(0.0).derivatives()[1]
        assert m.ratio == pytest.approx(V / (1 + g * V), rel=1e-14)
        # by the series of psi about mid-motion, whose first term is all that is left there
        assert m.ratio == pytest.approx(s.groove.distances(0.0, 0)[1].c[0], rel=1e-15)
        for t in np.linspace(0.02, 1.0, 23):
            phi = to_radians(x := float(t * s.exit_deg))
            psi, psi1, *_ = w.derivatives(x)
            both = mp.sin(phi + g * psi)
            R = mp.sin(psi) / both
            R1 = (psi1 * mp.sin(phi) - mp.sin(psi) * mp.cos(phi + g * psi)) / both**2
            rho, found = s.groove.distances(x, 3)
            # psi is known to 1e-16 of a step and divided by a small angle: digits of R'' go first
            assert found.c[0] == pytest.approx(float(R), rel=1e-13)
            assert found.c[1] == pytest.approx(float(R1), rel=1e-9, abs=1e-10)
            assert rho.c[0] == pytest.approx(float(mp.sin(phi) / both), rel=1e-13)
            gx, gy = s.path(x, 1)
            assert math.hypot(gx.c[0] - 1.0, gy.c[0]) == pytest.approx(float(R), rel=1e-12)
        end = math.radians(s.exit_deg)
        _, last = s.groove.distances(s.exit_deg, 1)
        assert last.c[0] == pytest.approx(math.sin(s.half_step) / math.sin(end + g * s.half_step))
        angle = 1.0 / math.tan(end + g * s.half_step)
        assert last.c[1] / last.c[0] == pytest.approx(-angle, abs=1e-12)


@pytest.mark.sampled(4)
@every
def test_backwards_is_the_witness_in_a_mirror(machine, witness, case):
    """psi'(x) = -psi(-x): the machine that the spec in the mirror makes, solved for anew.

    Even derivatives change sign. What is rounded are the places of two machines: twice the bars.
    """
    m = machine(case)
    turned = Design.of(m.spec).backwards.mechanism
    n = len(m.engagements)
    assert (len(turned.engagements), turned.period_deg) == (n, m.period_deg)
    for i, (s, w) in enumerate(zip(m.engagements, witness(case), strict=True)):
        back = turned.engagements[-i % n]
        places = (back.mid_deg + s.mid_deg) / m.period_deg
        assert places == pytest.approx(round(places), abs=1e-13)
        # a linkage's exit is found anew, to some units of a whole turn
        assert back.entry_deg == pytest.approx(-s.exit_deg, abs=2e-13)
        x = np.array([0.9 * s.entry_deg, 0.3 * s.entry_deg, 0.5 * s.exit_deg, 0.8 * s.exit_deg])
        reference = np.array([w.derivatives(v) for v in x]).T
        got = back.motion(-x, 3).derivatives()
        for k in range(4):
            values = np.array([mp.mpf(float(v)) for v in got[k]]) * (1 if k % 2 else -1)
            error = np.abs(values - reference[k]).astype(float)
            slope = np.abs(reference[k + 1]).astype(float)
            # the places of these four angles against those of the new linkage
            moved = 2e-13 * math.pi / 180.0 * slope if case in ON_PATH else 0.0
            assert (error <= 2.0 * bars(s, x, reference, k, 16.0, case) + moved).all(), k
        for curve, other in ((s.path, back.path), (s.slot, back.slot)):
            here, there = curve(x, 0), other(-x, 0)
            assert here[0].c[0] + 0.0 * x == pytest.approx(there[0].c[0] + 0.0 * x, abs=1e-13)
            assert here[1].c[0] + 0.0 * x == pytest.approx(-there[1].c[0] + 0.0 * x, abs=1e-13)
