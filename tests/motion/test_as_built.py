"""Cranks as built, whose R/L is not what straight slots need.

The witness draws the machine anew: a pin on a circle, a slot as a straight line that turns with the
wheel. Its crossings are roots by mpmath at 50 digits, and its velocities differences of angles.
"""

import math

import mpmath as mp
import numpy as np
import pytest

from geneva_cli import (
    Crank,
    Design,
    EllipticalGears,
    External,
    Internal,
    Limits,
    Load,
    SideCrank,
    Size,
    Tolerance,
)
from geneva_cli.errors import GenevaError
from geneva_cli.motion.drive import Drive
from geneva_cli.motion.many import many, worst_peaks
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.peaks import greatest_jumps, worst
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.verdict.checks import single_check
from geneva_cli.verdict.quantities.groups import Designs
from geneva_cli.verdict.quantities.motion_quantities import index_gained, peaks

mp.mp.dps = 50


def built(wheel: Gearing, L: float, R: float, own: Drive | None = None, **sizes: float) -> Design:
    """A design with both lengths."""
    return Design(wheel, own, size=Size(center_distance_mm=L, crank_radius_mm=R, **sizes))


@pytest.mark.parametrize(
    ("design", "at_deg", "entry", "exit_"),
    [
        # a cutter's wheel, of which the other crossing lies at 46.6 mm, beyond the rim
        (built(External(6), 50, 25.217025694, wheel_radius_mm=40), 52.4776, 0.082532, 0.082532),
        (built(External(6), 8, 4.618802), 30.0, 0.5, 0.5),
        (built(External(4), 100, 73.20508), 30.0, 0.3660254, 0.3660254),
        # a projector: 30 of 90 degrees at mid-motion, no jump at entry
        (built(External(4, offset_mm=-13.397459), 100, 73.20508), 30.0, 0.0, 0.732),
    ],
)
def test_published_machines(design: Design, at_deg: float, entry: float, exit_: float) -> None:
    values = design.peaks_table.to_dict()
    assert values["velocity.entry"] == pytest.approx(entry, abs=5e-7)
    assert values["velocity.exit"] == pytest.approx(exit_, abs=1e-4 if exit_ > 0.7 else 5e-7)
    (one,) = design.mechanism.engagements
    assert (one.entry_deg, one.exit_deg) == pytest.approx((-at_deg, at_deg), abs=6e-5)


def test_behind_gears_the_wheel_jumps_too() -> None:
    """By the jump of the same crank alone, times the rate of its shaft: a difference of angles."""
    alone = built(External(6), 100, 53, SideCrank(A=0.2))
    gears = EllipticalGears(eccentricity=0.2)
    behind = Design(External(6), SideCrank(A=0.2), size=alone.spec.size, drive_before=gears)
    (one,) = behind.mechanism.engagements
    a, b = one.own_deg(np.array([one.entry_deg, one.entry_deg + 1e-6]))
    jump = alone.peaks_table["velocity.entry"] * (b - a) / 1e-6
    assert jump < 0.82 * alone.peaks_table["velocity.entry"]
    assert behind.peaks_table["velocity.entry"] == pytest.approx(jump, rel=1e-6)
    assert [one.name for one in behind.motion_warnings] == ["taken-as-built"]
    assert single_check(behind.parts, "entry_velocity_max").passes is False


def witness(sign: int, z: int, l: mp.mpf, e: mp.mpf, crank: mp.mpf) -> mp.mpf:
    """Direction of the slot whose axis, e off the wheel's centre, holds the pin at a crank angle.

    The crank's angle counts from the line of centres, outside towards the wheel.
    """
    x, y = 1 - sign * l * mp.cos(crank), l * mp.sin(crank)
    return mp.atan2(y, x) + mp.asin(e / mp.hypot(x, y))


@pytest.mark.parametrize(
    ("wheel", "sign", "R", "e", "guess"),
    [
        (External(6), 1, 53.0, 0.0, -0.7),
        (External(5), 1, 60.0, 0.0, -0.7),
        (External(12), 1, 27.0, 0.0, -1.0),
        (Internal(6), -1, 53.0, 0.0, -1.7),
        (External(8, offset_mm=6.0), 1, 41.0, 6.0, -0.6),
        (External(5, offset_mm=-3.0), 1, 62.0, -3.0, -0.5),
    ],
)
def test_crossings_against_roots_at_50_digits(
    wheel: Gearing, sign: int, R: float, e: float, guess: float
) -> None:
    """The slot at rest stands at its own angle: the pin meets its axis where that is the root's."""
    design = built(wheel, 100, R)
    (one,) = design.mechanism.engagements
    l, off, b = mp.mpf(R) / 100, mp.mpf(e) / 100, mp.pi / wheel.z
    # radial slots rest at b; others are tangent to the crank's circle at the steeper end
    steep = mp.asin(l + abs(off))
    rest = {0: (-b, b), 1: (steep - 2 * b, steep), -1: (-steep, 2 * b - steep)}[int(mp.sign(off))]
    slot = lambda crank: witness(sign, wheel.z, l, off, crank)  # noqa: E731
    # at a tangent end the crank is square to the slot, elsewhere it is a root
    entry = -(mp.pi / 2 + rest[0])
    if off >= 0:
        entry = mp.findroot(lambda crank: slot(crank) - rest[0], guess)
    exit_ = mp.pi / 2 - rest[1]
    if off <= 0:
        exit_ = mp.findroot(lambda crank: slot(crank) - rest[1], -guess)
    ends = one.entry_deg, one.exit_deg
    for end_deg, at, jump in zip(ends, (entry, exit_), one.jumps, strict=True):
        assert math.radians(end_deg) == pytest.approx(float(at), abs=1e-14)
        assert jump == pytest.approx(float(mp.diff(slot, at)), abs=1e-13)
    middle = sum(rest) / 2
    for crank_deg in np.linspace(one.entry_deg, one.exit_deg, 7):
        turned = slot(mp.radians(mp.mpf(float(crank_deg)))) - middle
        assert one.motion(float(crank_deg), 0).c[0] == pytest.approx(float(turned), abs=1e-14)


def test_a_side_crank_multiplies_the_jump_by_its_rate() -> None:
    """Its coulisse turns at (1 + A cos phi)/(1 + 2 A cos phi + A²) of the input."""
    plain, slow = (
        built(External(6), 100, 53.0, own).mechanism.engagements[0]
        for own in (None, SideCrank(A=0.4))
    )
    phi = math.radians(slow.entry_deg)
    rate = (1.0 + 0.4 * math.cos(phi)) / (1.0 + 0.8 * math.cos(phi) + 0.16)
    assert slow.jumps[0] == pytest.approx(rate * plain.jumps[0], rel=1e-13)


def test_check_of_the_jump() -> None:
    def row(limit: float | None, R: float) -> tuple[float | None, bool | None]:
        sizes = Size(center_distance_mm=100.0, crank_radius_mm=R)
        design = Design(External(6), size=sizes, limits=Limits(entry_velocity_max=limit))
        check = single_check(design.parts, "entry_velocity_max")
        assert check
        return check.limit, check.passes

    assert row(None, 50.01) == (0.01, False)
    assert row(None, 50.0005) == (0.01, True)
    assert row(0.1, 50.1) == (0.1, True)
    assert row(0.001, 50.0) == (0.001, True)  # as derived
    offset = built(External(4, offset_mm=-13.397459), 100, 73.20508)
    check = single_check(offset.parts, "entry_velocity_max")
    assert check and check.value == pytest.approx(0.732, abs=1e-4)
    assert check.at_deg == pytest.approx(30.0, abs=1e-4)


def test_index_gained() -> None:
    """The triangle of both axes and the roller at the rim, by its heights instead of a cosine."""
    L, R, rim = 8.0, 4.618802, 6.5
    design = built(External(6), L, R, wheel_radius_mm=rim)
    half = (L + R + rim) / 2.0
    area = math.sqrt(half * (half - L) * (half - R) * (half - rim))
    angle = math.degrees(math.asin(2.0 * area / (L * rim)))
    gained = design.peaks_table.to_dict()["index_gained_deg"]
    assert gained == pytest.approx(angle - 30.0, rel=1e-12)
    assert Design(External(6)).peaks_table.to_dict()["index_gained_deg"] is None


def test_warning_of_the_impact() -> None:
    size = Size(center_distance_mm=100.0, crank_radius_mm=53.0)
    design = Design(External(6), size=size, load=Load(inertia_kgm2=0.01, torque_Nm=1.0))
    [text] = [w for w in design.warnings if w.name == "taken-as-built"]
    assert "R/L = 0.53" in text and "entry_velocity_max" in text
    loads = design.loads
    assert math.isfinite(loads["pin_force_N"].max or math.nan)
    assert not [w for w in Design(External(6)).warnings if w.name == "taken-as-built"]


VARIED: list[tuple[Design, dict[str, list[float]]]] = [
    (built(External(6), 100, 50), {"size.crank_radius_mm": [48, 50, 50.00001, 50.2, 57]}),
    (built(Internal(5), 100, 60), {"size.center_distance_mm": [95, 100, 102, 110]}),
    (built(External(5), 100, 60), {"wheel.offset_mm": [0, 4, -9, 45]}),
    (built(External(6), 100, 52), {"size.wheel_radius_mm": [60, 80, 98]}),
    (built(External(6), 100, 52, SideCrank(A=0.3)), {"wheel.z": [5, 6, 9]}),
]


@pytest.mark.parametrize(("design", "keys"), VARIED)
def test_a_batch_has_the_numbers_of_its_designs(
    design: Design, keys: dict[str, list[float]]
) -> None:
    [(key, values)] = keys.items()
    batch = many(design.spec, {key: np.array(values)})
    assert batch.machine
    greatest = worst_peaks(batch.machine)
    names = ["velocity.entry", "velocity.exit"]
    ends = Designs(batch.machine, names).columns(peaks)
    gained = index_gained(Designs(batch.machine))["index_gained_deg"]
    for i, value in enumerate(values):
        one = design.spec.with_(key, value)
        if batch.refused[i]:
            with pytest.raises(GenevaError):
                build(one)
            continue
        machine, k = build(one), int((~batch.refused[:i]).sum())
        for name, peak in greatest.items():
            assert peak.max[k] == pytest.approx(getattr(worst(machine), name).max, rel=1e-13)
        for name, alone in zip(names, greatest_jumps(machine.engagements), strict=True):
            own = np.broadcast_to(ends[name], (batch.machine.designs,))[k]
            assert own == pytest.approx(
                math.nan if alone is None else alone, abs=1e-14, nan_ok=True
            )
        built = machine.engagements[0].built
        alone_deg = math.degrees(built.gained) if built else math.nan
        assert np.broadcast_to(gained, (batch.machine.designs,))[k] == pytest.approx(
            alone_deg, abs=1e-12, nan_ok=True
        )


def test_tolerances_spread_the_jump_about_that_of_the_machine() -> None:
    """Every drawn machine is one as built: the mean of their jumps by 11 x 11 single machines."""
    size = Size(center_distance_mm=100.0, crank_radius_mm=53.0)
    tolerance = Tolerance(center_distance_mm=0.2, crank_radius_mm=0.3)
    row = Design(External(6), size=size, tolerance=tolerance).tolerance(8192).to_dict()
    places = np.linspace(-1.0, 1.0, 12)[:-1] + 1.0 / 11.0  # middles of equal fractions
    each = [
        built(External(6), 100 + 0.2 * u, 53 + 0.3 * v).mechanism.engagements[0].jumps[0]
        for u in places
        for v in places
    ]
    assert row["entry_jump.mean"] == pytest.approx(np.mean(each), abs=5e-5)
    assert row["entry_jump.std"] == pytest.approx(np.std(each), rel=8e-3)
    ends = [built(External(6), 99.8, 53.3), built(External(6), 100.2, 52.7)]
    assert row["entry_jump.worst"] == pytest.approx(
        max(one.mechanism.engagements[0].jumps[0] for one in ends), rel=1e-12
    )
    tangent = Design(External(6), Crank(), size=Size(center_distance_mm=100.0)).mechanism
    assert tangent.engagements[0].jumps == (0.0, 0.0)
