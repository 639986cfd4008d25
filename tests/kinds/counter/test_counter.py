"""The counter drive: rolling pitch circles, published counters, and the impact at entry."""

import math

import mpmath
import pytest
from typer.testing import CliRunner

from geneva_cli import Counter, Crank, Design, Load, SideCrank, Size
from geneva_cli.cli.app import app
from geneva_cli.errors import GenevaError
from geneva_cli.kinds.counter.outlines import counter_sizes
from geneva_cli.loads.impacts.impacts import start_impacts
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.verdict.quantities.designs import Designs
from geneva_cli.verdict.quantities.motion import counter

ODOMETER = Design(Counter(4, driver_teeth=20))
SIZE = Size(face_width_mm=3.0)
HEAVY = Design(Counter(4, driver_teeth=20), size=SIZE, load=Load(inertia_kgm2=1e-6))


def test_a_published_odometer():
    """Two pins a turn move a pinion of 8 teeth, 4 of them longer, and the next wheel by a tenth.

    mechanisms.co, "Mechanical odometer 1". The next wheel has N teeth and meshes with the pinion.
    """
    pinion = ODOMETER.spec.wheel
    teeth, step_deg = 2 * pinion.z, ODOMETER.timing.index_deg
    assert teeth == 8
    assert step_deg == 2 * 360.0 / teeth  # two circular pitches: mechamechanisms.com
    assert step_deg * teeth / pinion.driver_teeth == 360.0 / 10.0
    # from 9 to 0 the driver turns by a tenth as well, and both number wheels move as one
    assert ODOMETER.timing.motion_deg == 360.0 / 10.0


@pytest.mark.parametrize(("z", "teeth"), [(4, 20), (3, 12), (4, 24), (7, 31)])
def test_the_step_and_the_ratio_agree(z, teeth):
    """Arcs on both pitch circles are equal: N t m/2 = 2 z s m/2, in exact fractions."""
    machine = build(Spec(Counter(z, driver_teeth=teeth)))
    (engagement,) = machine.engagements
    assert engagement.motion_deg == pytest.approx(720.0 / teeth, rel=1e-15)
    first, last = (
        engagement.motion(x).scalars() for x in (engagement.entry_deg, engagement.exit_deg)
    )
    # a rounding in the angle, in the ratio and in pi
    assert last[0] - first[0] == pytest.approx(2.0 * math.pi / z, rel=8e-16)
    assert first[1:] == last[1:] == (teeth / (2 * z), 0.0, 0.0)
    assert machine.ratio / (1.0 - machine.ratio) == pytest.approx(teeth / (2 * z), rel=4e-15)


def test_the_point_on_the_pinion_is_an_epicycloid():
    """The driver's circle of radius r rolls about the pinion's of radius q, which is 1 - r.

    In 50 digits: a point of a rolling circle, (q + r) e^(i t) - r e^(i t (q + r)/r), from its cusp.
    """
    machine = ODOMETER.mechanism
    slot = machine.engagements[0].slot
    for input_deg in (-18.0, -5.0, 0.0, 7.5, 18.0):
        x, y = (v.c[0] for v in slot(input_deg, 0))
        with mpmath.workdps(50):
            r, q = mpmath.mpf(5) / 7, mpmath.mpf(2) / 7
            t = (
                -mpmath.mpf(input_deg) * mpmath.pi / 180 * r / q
            )  # turned back by the pinion's angle
            point = mpmath.expj(t) - r * mpmath.expj(t * (q + r) / r)
        # distances below 1, from some roundings
        assert x == pytest.approx(float(point.real), abs=4e-16)
        assert y == pytest.approx(float(point.imag), abs=4e-16)


def test_peaks_have_no_bound():
    ends = ODOMETER.peaks.ends
    assert ODOMETER.peaks.velocity == (2.5, -18.0)
    for peak in (ODOMETER.peaks.acceleration, ODOMETER.peaks.jerk, ODOMETER.peaks.power):
        assert peak.max == math.inf
    assert set(ends) == {math.inf}


def test_certificates():
    """The velocity is proved, to a last digit; nothing is claimed of rates without a bound."""
    velocity = ODOMETER.certificate("velocity")
    assert velocity.proved and velocity.confirms(2.5, -18.0)
    for name in ("acceleration", "jerk", "power"):
        assert not ODOMETER.certificate(name).proved
        assert "no bound is known there" in ODOMETER.certificate(name).text


def test_the_impact():
    """J dw and J dw²/2 by hand, and the force of a spring of 14 N/(mm µm) 3 mm wide.

    An undamped mass on a spring: the greatest force is dw sqrt(k J) for any lever, in SI units. The
    search for it ends within 1e-12.
    """
    dw = 2.5 * 2.0 * math.pi  # 60 rpm
    impact = start_impacts(HEAVY.mechanism).only
    assert impact is not None and impact.force_N is not None
    assert (impact.at_deg, impact.jump) == (-18.0, 2.5)
    assert impact.moment_Nms == pytest.approx(1e-6 * dw, rel=1e-14)
    assert impact.force_N == pytest.approx(dw * math.sqrt(14e9 * 3e-3 * 1e-6), rel=1e-12)
    (notice,) = [text for text in HEAVY.warnings if text.name == "speed-jumps"]
    assert "1.571e-05 N m s" in notice and "0.0001234 J" in notice and "101.8 N" in notice
    assert start_impacts(Design(Counter(4)).mechanism).only.moment_Nms is None


def test_a_row_of_number_wheels():
    """Counted by hand: 10 000 tenths of a turn of a counter of four wheels, wheel by wheel."""
    design = Design(Counter(4, driver_teeth=20, number_wheels=4), Crank(n_rpm=120.0))
    shown, steps = [0, 0, 0, 0], [0, 0, 0, 0]
    for _ in range(10_000):
        carries = True
        for k in range(4):
            if not carries:
                break
            shown[k], steps[k] = (shown[k] + 1) % 10, steps[k] + 1
            carries = shown[k] == 0
    assert shown == [0, 0, 0, 0]
    values = design.report.table.to_dict()
    turns = 1000.0
    assert (values["counter.digits"], values["counter.number_step_deg"]) == (10.0, 36.0)
    assert values["counter.turns_to_zero"] == turns
    for k, row in enumerate(values["number_wheels"]):
        assert row["number_wheel"] == k + 1
        assert row["turns_per_step"] == pytest.approx(turns / steps[k], rel=1e-15)
        assert row["turns_per_turn"] == pytest.approx(10.0 * turns / steps[k], rel=1e-15)
        assert row["step_s"] == pytest.approx(0.5 * turns / steps[k], rel=1e-15)
        assert row["moving_s"] == 0.05
    with pytest.raises(GenevaError, match="use 32"):
        Counter(7, driver_teeth=31, number_wheels=3)


def test_all_pinions_at_once():
    """Five equal inertias that jump together are one of five times the size."""
    five = Design(Counter(4, number_wheels=6), size=SIZE, load=Load(inertia_kgm2=1e-6))
    one = Design(Counter(4), size=SIZE, load=Load(inertia_kgm2=5e-6))
    values, other = (counter(Designs(d.mechanism)) for d in (five, one))
    dw = 2.5 * math.tau
    assert values["impulse_Nms"] == pytest.approx(5e-6 * dw, rel=1e-14)
    assert values["energy_J"] == pytest.approx(0.5 * 5e-6 * dw * dw, rel=1e-14)
    for name in ("impulse_Nms", "energy_J", "force_N"):
        assert values[name] == pytest.approx(other[name], rel=1e-12)


def test_what_a_counter_refuses():
    with pytest.raises(GenevaError, match='needs kind = "crank"'):
        build(Spec(Counter(4), SideCrank(A=0.3)))
    with pytest.raises(GenevaError, match="has one pair of teeth: remove rollers"):
        build(Spec(Counter(4), Crank(rollers=2)))  # the driver is drawn with one
    with pytest.raises(GenevaError, match="remove roller_angles_deg"):
        build(Spec(Counter(4), Crank(roller_angles_deg=(0.0, 100.0))))
    with pytest.raises(GenevaError, match="is for rollers in slots"):
        build(ODOMETER.spec.with_("tolerance.center_distance_mm", 0.1))
    with pytest.raises(GenevaError, match="computed for rollers in slots, not for the teeth"):
        ODOMETER.tolerance()
    with pytest.raises(GenevaError, match="at least 6"):
        Counter(4, driver_teeth=5)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("command", ["check", "peaks", "motion", "loads", "report", "vibration"])
def test_commands(command, tmp_path):
    """Each answers, and says of acceleration and forces that they have no bound."""
    file = tmp_path / "counter.toml"
    file.write_text('[wheel]\ngearing = "counter"\nz = 4\n[load]\ninertia_kgm2 = 1e-6\n')
    options = ["--period-ratio", "3"] if command == "vibration" else []
    shown = CliRunner().invoke(app, [command, str(file), *options, "--format", "json"])
    assert shown.exit_code == 0, shown.stderr
    assert "NaN" not in shown.stdout and "Infinity" not in shown.stdout


def stiffness_N_mm_um(z1, z2, x1, x2):
    """ISO 6336-1, method B: c' of a pair of steel teeth on solid discs, in theory."""
    q = 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x1 - 0.11654 * x1 / z1
    q += -0.00193 * x2 - 0.24188 * x2 / z2 + 0.00529 * x1**2 + 0.00182 * x2**2
    return 1.0 / q


def test_the_stiffness_of_a_tooth():
    """ISO/TR 6336-30, example 1: 17.8558 in theory. Of it 0.8 are real, and 0.975 with this rack.

    For counters of up to 60 wide teeth and a driver of 200, c' = 14 is 0.89 to 1.35 of that, and so
    a force, which goes with its root, is 6 % too low to 17 % too high."""
    assert stiffness_N_mm_um(18.905, 114.543, 0.145, 0.0) == pytest.approx(17.8558, abs=5e-5)
    for z, teeth in ((3, 15), (3, 27), (4, 20), (10, 10), (12, 60), (59, 198)):
        sizes = counter_sizes(build(Spec(Counter(z, driver_teeth=teeth))))
        both = sorted(zip((teeth, 2 * z), sizes.shifts, strict=True))
        real = 0.8 * 0.975 * stiffness_N_mm_um(*(n for n, _ in both), *(x for _, x in both))
        assert 10.38 < real < 15.65
        assert Counter.TOOTH_N_mm2 == 14e3
        assert 0.94 < math.sqrt(14.0 / real) < 1.162


def test_words():
    """Two teeth drive it, not a roller."""
    text = ODOMETER.report.table.prose
    assert text.startswith(
        "A counter pinion of 4 wide and 4 narrow teeth, driven by a driver with two of its 20 teeth"
    )
    assert "roller" not in text
    values = ODOMETER.report.table.to_dict()
    for name in ("roller_radius_mm", "slot_width_mm", "rollers_max"):
        assert values[f"sizes.{name}"] is None


def test_a_search_from_a_counter_is_refused(tmp_path):
    file = tmp_path / "counter.toml"
    file.write_text('[wheel]\ngearing = "counter"\nz = 4\n')
    shown = CliRunner().invoke(app, ["synth", "--from", str(file), "--tau", "0.3"])
    assert shown.exit_code == 2
    assert f'{file}:2: --from: gearing = "counter" has no motion to choose' in shown.stderr
    assert 'use "external"' in shown.stderr
