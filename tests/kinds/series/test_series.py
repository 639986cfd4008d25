"""Drives in series: motions, refusals, links and gears.

Motions are in ``test_machines.py`` and loads in ``test_series_loads.py``, both by 50 digits.
"""

import math

import numpy as np
import pytest
from mpmath import mp

from geneva_cli import (
    Cam,
    Carousel,
    Crank,
    Cycloidal,
    Design,
    EllipticalGears,
    Epicyclic,
    External,
    FourBar,
    GearSector,
    GenevaPair,
    Internal,
    Motion,
    NoncircularGears,
    SCurve,
    SideCrank,
    Spherical,
)
from geneva_cli.drives.retimed import retimed
from geneva_cli.errors import GenevaError
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.specfile.tree import spec_of

GEARS = EllipticalGears(eccentricity=0.2, gear_distance_mm=50.0)
PLANET = Epicyclic(planet_ratio="shockless")
COUPLER = FourBar(
    crank_mm=40.0,
    ground_mm=90.0,
    coupler_mm=100.0,
    rocker_mm=100.0,
    point_mm=161.519,
    point_deg=-36.138,
    entry_deg=123.3,
)


@pytest.mark.parametrize(
    "wheel", [External(6), Internal(6), External(6, offset_mm=8.0), Spherical(6)], ids=repr
)
@pytest.mark.parametrize("front", [GEARS, SideCrank(A=0.4), NoncircularGears(A=-0.3)], ids=repr)
def test_a_retimed_crank_is_the_crank_behind_that_drive(wheel, front):
    """The drive's own machine writes the same path about its own anchors, without a chain rule."""
    plain = Crank().plan(wheel, None, 100.0)
    (ours,) = retimed(plain, Spec(wheel, drive_before=front), front).engagements
    (own,) = front.plan(wheel, None, 100.0).engagements
    assert (ours.entry_deg, ours.exit_deg) == (own.entry_deg, own.exit_deg)
    x = np.linspace(own.entry_deg, own.exit_deg, 41)
    for a, b in zip(ours.motion.derivatives(x), own.motion.derivatives(x), strict=True):
        # 16 units of the peak: the bar of every machine, in test_machines.py
        assert abs(a - b).max() <= 16.0 * math.ulp(abs(b).max())
    for a, b in zip(ours.slot.axis(x, 1), own.slot.axis(x, 1), strict=True):
        for k in (0, 1):
            assert abs(a.c[k] - b.c[k]).max() <= 16.0 * math.ulp(1.0)
    spins = [one.carrier(x, 1) for one in (ours, own)]
    assert abs(spins[0].c[1] - spins[1].c[1]).max() <= 16.0 * math.ulp(1.0)
    tau = np.radians(x - own.entry_deg)
    moved = [(*one.motion.entry.displacement(tau, 1), *one.slot(x, 1)) for one in (ours, own)]
    for a, b in zip(*moved, strict=True):
        for k in (0, 1):
            assert abs(a.c[k] - b.c[k]).max() <= 16.0 * math.ulp(1.0)


@pytest.mark.parametrize("drive", [PLANET, Epicyclic(planet_ratio=-0.01), COUPLER], ids=repr)
def test_speed_and_jump_scale_with_the_ratio_of_the_gears(drive):
    """psi' = G' i at mid-motion, and psi'' = G'' i² at entry, where G' = 0."""
    one, both = (Design(External(4), drive, drive_before=b).mechanism for b in (None, GEARS))
    (own,), (here,) = one.engagements, both.engagements
    e = GEARS.eccentricity
    middle = own.motion(0.0).c[1] * (1.0 - e) / (1.0 + e)
    assert here.motion(0.0).c[1] == pytest.approx(middle, rel=1e-14)
    # the gears' ratio at the input angle of entry: Kepler's, test_machines.py has its witness.
    # 1e-14: some ten roundings; a shockless planet has no jump
    ratio = (1.0 - e * e) / (1.0 + e * e + 2.0 * e * math.cos(math.radians(here.entry_deg)))
    jump = own.motion(own.entry_deg).derivatives()[2] * ratio**2
    assert here.motion(here.entry_deg).derivatives()[2] == pytest.approx(jump, rel=1e-14, abs=1e-14)
    assert both.center_distance_mm == one.center_distance_mm


LAWFUL = (
    Spec(External(6), motion=Motion(Cycloidal(), ratio="matched")),
    Spec(External(6), Cam(), Motion(Cycloidal())),
    Spec(External(3), GearSector(sector_deg=60.0)),
)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("spec", LAWFUL, ids=lambda spec: spec.drive.NAME)
def test_the_parts_of_wheel_and_crank_do_not_change(spec):
    """A law holds by the crank's angle, so that gears change when it is reached, not the slot."""
    plain, geared = (build(spec.replace(drive_before=before)) for before in (None, GEARS))
    assert geared.ratio == plain.ratio
    (here,), (own,) = geared.engagements, plain.engagements
    x = np.linspace(here.entry_deg, here.exit_deg, 61)[1:-1]
    for a, b in zip(here.slot(x, 0), own.slot(here.own_deg(x), 0), strict=True):
        assert np.abs(a.c[0] - b.c[0]).max() <= 1e-15
    assert here.inputs_deg(here.own_deg(x)) == pytest.approx(x, abs=1e-12)
    assert drawn(*machine_sizes(geared)).wheel == drawn(*machine_sizes(plain)).wheel


def test_both_rollers_of_gear_sectors_have_their_own_phase():
    """Each crosses the line of centres when gears have turned its own angle: Kepler's, by hand."""
    machine = build(LAWFUL[2].replace(drive_before=GEARS))
    (here,), k = machine.engagements, (1.0 + 0.2) / (1.0 - 0.2)
    for (passage, ahead), at in zip(here.passages, (-30.0, 30.0), strict=True):
        middle = 2.0 * math.degrees(math.atan(k * math.tan(math.radians(0.5 * at))))
        assert -ahead == pytest.approx(middle, rel=1e-14)
        y = passage.path(0.0, 0)[1].c[0]
        assert abs(y) <= 1e-16


@pytest.mark.parametrize(
    "wheel, drive, before, motion, message",
    [
        (External(6), Crank(), GEARS, None, 'set kind = "elliptical-gears" in .drive. instead'),
        (External(6), Carousel(), GEARS, None, "its carrier turns at a constant speed"),
        (External(4), PLANET, GenevaPair(first_z=4), None, "cannot turn the shaft of another"),
        (External(4), PLANET, GEARS.replace(rollers=2), None, "set it there, not in .drive.before"),
    ],
)
def test_what_cannot_stand_in_series_is_refused(wheel, drive, before, motion, message):
    with pytest.raises(GenevaError, match=message):
        _ = Design(wheel, drive, motion, drive_before=before).mechanism


def test_an_error_names_the_key_of_the_drive_before():
    before = {"kind": "side-crank", "A": 2.0}
    drive = {"kind": "epicyclic", "planet_ratio": "shockless", "before": before}
    with pytest.raises(GenevaError, match="A = 2 must be above -1") as error:
        spec_of({"wheel": {"z": 4}, "drive": drive}, "spec.toml")
    assert error.value.key == ("drive", "before", "A")


@pytest.mark.parametrize("A", [0.684, -0.31])
@pytest.mark.parametrize(("cruise", "ramp"), [(0.49, 0.166), (0.47, 0.0), (0.1, 0.4)])
def test_peaks_are_seen_on_both_sides_of_a_jump_of_the_law(A, cruise, ramp):
    """A grid over each segment, with its own polynomial up to both ends, by theory 1.8.

    1e-6: a smooth peak between two of its 4001 places.
    """
    law = Motion(SCurve(cruise=cruise, ramp=ramp), alpha0_deg=-4.6, ratio="matched")
    peaks = Design(External(6), Crank(), law, drive_before=SideCrank(A=A)).peaks
    rise = 0.5 * (1.0 - cruise)
    most = 2.0 / (1.0 + cruise) / (rise * (1.0 - ramp))
    jerk = most / (ramp * rise) if ramp else 0.0
    lengths = [ramp * rise, rise * (1.0 - 2.0 * ramp), ramp * rise, cruise]
    starts = [0.0, most if not ramp else 0.0]
    jerks = [jerk, 0.0, -jerk, 0.0, -jerk, 0.0, jerk]
    step, whole = math.pi / 3.0, math.radians(124.6)
    speed, gain, sizes = 0.0, starts[1], dict.fromkeys(("velocity", "acceleration", "jerk"), 0.0)
    sizes["power"], begin = 0.0, 0.0
    for number, length in enumerate([*lengths, *lengths[2::-1]]):
        if number in (3, 4):  # at constant velocity, and from there without a ramp
            gain = 0.0 if number == 3 or ramp else -most
        x = np.linspace(0.0, length, 4001)
        v = speed + gain * x + 0.5 * jerks[number] * x * x
        a = gain + jerks[number] * x
        theta = (begin + x - 0.5) * whole
        phi = theta + np.arcsin(A * np.sin(theta))
        W = 1.0 + 2.0 * A * np.cos(phi) + A * A
        f1, f2 = (1.0 + A * np.cos(phi)) / W, A * (1.0 - A * A) * np.sin(phi) / W**2
        third = (1.0 + A * A) * np.cos(phi) - 2.0 * A * np.cos(phi) ** 2 + 4.0 * A
        f3 = A * (1.0 - A * A) * third / W**3
        g1, g2, g3 = v * step / whole, a * step / whole**2, jerks[number] * step / whole**3
        rates = g1 * f1, g2 * f1**2 + g1 * f2, g3 * f1**3 + 3.0 * g2 * f1 * f2 + g1 * f3
        if length:
            for name, row in zip(sizes, (*rates, rates[0] * rates[1]), strict=True):
                sizes[name] = max(sizes[name], abs(row).max())
        begin, speed, gain = begin + length, v[-1], a[-1]
    for name, greatest in sizes.items():
        assert getattr(peaks, name).max == pytest.approx(greatest, rel=1e-6), name


PAIRS = [(first, z) for first in (3, 4, 5, 6) for z in range(3, 40) if first * (z - 2) <= 2 * z]


@pytest.mark.parametrize(("first", "z"), PAIRS)
def test_motion_angle_of_a_pair(first, z):
    """sin(a + psi) = sin psi / l at the second crank's half motion psi, in 50 digits."""
    (engagement,) = build(Spec(External(z), GenevaPair(first_z=first))).engagements
    with mp.workdps(50):
        psi = mp.pi / 2 - mp.pi / z
        sine = min(mp.sin(psi) / mp.sin(mp.pi / first), mp.mpf(1))
        exact = 2 * (mp.asin(sine) - psi) * 180 / mp.pi
    # 6: half a unit of psi's degrees, moved up to fourfold by the arc sine and doubled, and three
    # roundings; the arc sine less psi, which cancels, was up to 13 units off
    assert abs(float(engagement.motion_deg - exact)) <= 6.0 * math.ulp(engagement.motion_deg)
