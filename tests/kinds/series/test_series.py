"""Drives in series: batches, refusals, links and gears.

Motions are in ``test_machines.py`` and loads in ``test_series_loads.py``, both by 50 digits.
"""

import math

import numpy as np
import pytest

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
    Load,
    Motion,
    NoncircularGears,
    SCurve,
    SideCrank,
    Spherical,
)
from geneva_cli.drives.retimed import retimed
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.measure import bounds
from geneva_cli.loads.load_peaks import LoadSummary, load_summaries
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.many import many, worst_peaks
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.pivots import Joint
from geneva_cli.parts.assembly import links_at
from geneva_cli.parts.links.link_shafts import planes
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.specfile.tree import spec_of

GEARS = EllipticalGears(eccentricity=0.2, gear_distance_mm=50.0)
PLANET = Epicyclic(planet_ratio="shockless")
PAIR = GenevaPair(first_z=4, first_distance_mm=80.0)
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
    moved = [one.motion.entry.displacement(tau, 1) for one in (ours, own)]
    if own.slot.height:  # of the pin along a spherical wheel's axis
        moved = [
            (*jets, one.slot.height(np.radians(x), 1))
            for one, jets in zip((ours, own), moved, strict=True)
        ]
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


@pytest.mark.parametrize(
    "drive, key, values",
    [
        (PLANET, "drive.before.eccentricity", (0.0, 0.1, 0.3, 1.5)),
        (COUPLER, "drive.point_mm", (160.0, 161.5, 163.0)),
        (GearSector(sector_deg=40.0), "drive.sector_deg", (30.0, 60.0)),
        (Cam(), "motion.alpha0_deg", (0.0, 8.0)),
        (Crank(rollers=2), "drive.before.eccentricity", (0.0, 0.3)),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_a_batch_has_the_numbers_of_single_designs(drive, key, values):
    law = Motion(Cycloidal()) if drive.NAME in ("cam", "crank") else None
    wheel = External(8 if law and drive.rollers > 1 else 4)
    spec = Spec(wheel, drive, law, drive_before=GEARS)
    batch = many(spec, {key: np.array(values)})
    built = [x for x, refused in zip(values, batch.refused.tolist(), strict=True) if not refused]
    assert built == [x for x in values if x != 1.5]
    for i, value in enumerate(built):
        single = build(spec.with_(key, value))
        for one, of in zip(single.engagements, batch.machine.engagements, strict=True):
            places = (of.mid_deg, of.entry_deg, of.exit_deg)
            mid, entry, exit_ = (np.broadcast_to(x, (len(built), 1))[i, 0] for x in places)
            # a batch solves a linkage in long doubles
            wanted = (one.mid_deg, one.entry_deg, one.exit_deg)
            assert (mid, entry, exit_) == pytest.approx(wanted, rel=1e-13, abs=1e-13)
            x = np.linspace(0.9 * one.entry_deg, 0.9 * one.exit_deg, 7)
            for a, b in zip(of.motion(x, 3).arrays(), one.motion(x, 3).arrays(), strict=True):
                a = np.broadcast_to(a, (len(built), 7))[i]
                # 1e-14: some ten roundings of each derivative
                assert abs(a - b).max() <= 1e-14 * abs(b).max()


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
        (External(4), PLANET, GEARS.replace(n_rpm=30.0), None, "set them in .drive., not in"),
        (External(4), PLANET, GEARS.replace(rollers=2), None, "set them in .drive., not in"),
    ],
)
def test_what_cannot_stand_in_series_is_refused(wheel, drive, before, motion, message):
    with pytest.raises(GenevaError, match=message):
        _ = Design(wheel, drive, motion, drive_before=before).mechanism


@pytest.mark.parametrize(
    "before, message, key",
    [
        ({}, r"\[drive.before\] needs kind", ("drive", "before")),
        (3, r"before must be a table: write \[drive.before\]", ("drive", "before")),
        ({"kind": "side-crank", "A": 2.0}, "A = 2 must be above -1", ("drive", "before", "A")),
        (
            {"kind": "side-crank", "A": 0.2, "base": 3.0},
            r"unknown key base in \[drive.before\]; known: .*A, input_crank_mm$",
            ("drive", "before", "base"),
        ),
    ],
)
def test_an_error_names_the_key_of_the_drive_before(before, message, key):
    drive = {"kind": "epicyclic", "planet_ratio": "shockless", "before": before}
    with pytest.raises(GenevaError, match=message) as error:
        spec_of({"wheel": {"z": 4}, "drive": drive}, "spec.toml")
    assert error.value.key == key


@pytest.mark.parametrize("drive", [PLANET, COUPLER], ids=repr)
def test_the_roller_of_the_links_is_on_the_path(drive):
    """Through a whole turn, dwell included: links and path count the same input angle."""
    machine = Design(External(4), drive, drive_before=GEARS).mechanism
    x = np.linspace(-179.0, 180.0, 360)
    (joint,) = (
        at
        for link in links_at(machine, x)
        for at, kind in zip(link.joints, link.kinds, strict=True)
        if kind is Joint.ROLLER
    )
    px, py = (c.c[0] * machine.center_distance_mm for c in machine.engagements[0].path(x, 0))
    assert np.hypot(joint[0] - px, joint[1] - py).max() <= 1e-11 * machine.center_distance_mm


SIDE = SideCrank(A=0.3, input_crank_mm=15.0)
SERIES = (
    *(spec.replace(drive_before=SIDE) for spec in LAWFUL),
    Spec(Internal(8), motion=Motion(Cycloidal()), drive_before=SIDE),
    Spec(External(4), PLANET, drive_before=SIDE),
    Spec(External(6), Epicyclic(planet_ratio=0.07, fixed="ring"), drive_before=SIDE),
    Spec(External(4), COUPLER, drive_before=SIDE),
)


@pytest.mark.parametrize("spec", SERIES, ids=lambda spec: f"{spec.wheel.NAME}-{spec.drive.NAME}")
def test_the_coulisse_turns_with_the_crank(spec):
    """Seen from the crank's shaft, coulisse and crank keep their angle through a whole turn.

    Where a linkage or the crank's arm carries the roller, the crank's direction is that of its pin.
    """
    machine = build(spec)
    x = np.linspace(-179.0, 179.0, 359)
    *own, crank, coulisse = links_at(machine, x)
    assert (crank.name, coulisse.name) == ("input crank", "coulisse")
    assert np.hypot(*(a - b for a, b in zip(crank.joints[1], coulisse.joints[1], strict=True))) == (
        pytest.approx(0.0, abs=1e-12)
    )
    L = machine.center_distance_mm
    if own and spec.drive.NAME != "gear-sector":
        px, py = own[0].joints[1] if len(own[0].joints) > 1 else own[-1].joints[1]
    else:
        passage, ahead = machine.engagements[0].passages[0]
        px, py = (L * c.c[0] for c in passage.path(x + ahead, 0))
    (ax, ay), (bx, by) = coulisse.joints
    turned = (px - L + 1j * py) / (bx - ax + 1j * (by - ay))
    unit = turned / abs(turned)
    # 1e-9: the roller in a cam's groove passes the dwell on an arc that is eased in
    assert abs(unit - unit[0]).max() <= 1e-9
    r, (x0, y0) = SIDE.input_crank_mm, crank.joints[0]
    assert abs(x0 - L).max() == pytest.approx(0.3 * r, rel=1e-12)
    assert np.hypot(crank.joints[1][0] - x0, crank.joints[1][1] - y0) == pytest.approx(r, rel=1e-12)


@pytest.mark.long
def test_an_input_crank_passes_the_spacers_of_a_sun():
    """The coulisse below a sun sweeps a circle, and four spacers stand around it: by hand."""
    design = Design.of(SERIES[4])
    spec = design.spec
    flat = design.parts.flat
    away = min(
        math.dist(one.at, (design.mechanism.center_distance_mm, 0.0)) for one in flat.spacers
    )
    outline = next(one.part.outline for one in flat.links.cut if one.part.name == "coulisse")
    reach = bounds(outline).x1  # its far end is round, about a point of its axis
    radius = flat.spacers[0].part.outline.radius
    gap = planes(flat.outlines, flat.links, flat.spacers).nearest.gap
    # 1e-3: the gap is sampled at 1441 angles, and its error is quadratic in their distance
    assert gap == pytest.approx(away - radius - reach, abs=1e-3)
    long = Design.of(spec.with_("drive.before.input_crank_mm", 30.0))
    assert [c.name for c in long.checks if c.passes is False] == ["link_gap_mm"]


@pytest.mark.long
def test_gears_before_stand_on_the_shaft_that_they_turn():
    """On the input crank's axis of a side-crank, and on the first crank's of two wheels."""
    for drive, x in ((SideCrank(A=0.4, input_crank_mm=40.0), 100.0 - 16.0), (PAIR, 100.0 + 80.0)):
        design = Design(External(4), drive, drive_before=GEARS)
        driven, driver = design.parts.flat.gear_pair
        assert (driven.at, driver.at) == ((x, 0.0), (x + 50.0, 0.0))
        assert {"driver gear axis"} <= {one.name for one in design.mechanism.layout}
        assert all(check.passes for check in design.checks), drive.NAME


def test_a_batch_of_pairs_behind_a_side_crank():
    """At mid-motion all three ratios are greatest: l/(1-l) of both wheels, and 1/(1+A)."""
    spec = Spec(External(4), GenevaPair(first_z=4), drive_before=SideCrank(A=0.3))
    batch = many(spec, {"drive.first_z": np.array([3, 4, 5])})
    assert batch.refused.tolist() == [False, False, True]  # 36 deg to either side, but 45 needed
    l = np.sin(np.pi / np.array([3.0, 4.0]))
    slow = math.sqrt(0.5) / (1.0 - math.sqrt(0.5)) / 1.3
    peaks = worst_peaks(batch.machine, ("velocity",))["velocity"]
    # 1e-13: 1 - l of three slots has lost a digit
    np.testing.assert_allclose(peaks.max, l / (1.0 - l) * slow, rtol=1e-13)


@pytest.mark.parametrize("A", [0.684, 0.352, -0.31, 0.1])
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


@pytest.mark.parametrize("friction", [0.0, 0.1])
@pytest.mark.parametrize("eccentricity", [0.0, 0.3])
def test_loads_on_both_sides_of_a_jump_at_mid_motion(eccentricity, friction):
    """The law of constant acceleration reverses it at its middle: loads have a limit on each side.

    On a plain crank the torque is (I w² psi'' + M) psi', psi' = 1 and psi'' = +-3/pi for 60 in 120
    degrees: 2 +- 12 pi. Otherwise lines through the values beside mid-motion have the limits.
    """
    law = Motion(SCurve(cruise=0.0, ramp=0.0), ratio="matched")
    before = EllipticalGears(eccentricity=eccentricity) if eccentricity else None
    loaded = Load(inertia_kgm2=1.0, torque_Nm=2.0, friction=friction)
    design = Design.of(Spec(External(6), motion=law, load=loaded, drive_before=before))
    names = ["input_torque_Nm", "wall_force_N"]  # both with signs
    both = load_summaries(design.mechanism, names, means=False)
    torque, force = (LoadSummary(*(float(row[0]) for row in both[n][:4])) for n in names)
    if not (eccentricity or friction):
        # 1e-9: the digits of a matched R/L
        assert torque.max == pytest.approx(2.0 + 12.0 * math.pi, rel=1e-9)
        assert torque.min == pytest.approx(2.0 - 12.0 * math.pi, rel=1e-9)
    mid = design.mechanism.engagements[0].mid_deg
    states = design.cycle.states(mid + np.array([-2e-3, -1e-3, 1e-3, 2e-3]))
    for row, one in ((states.input_torque_Nm, torque), (states.pin_force_N, force)):
        # 1e-7: what a line over 1e-3 degrees leaves of a curve
        assert one.max >= (2.0 * row[1] - row[0]) * (1.0 - 1e-7)
        assert one.min <= (2.0 * row[2] - row[3]) * (1.0 - 1e-7)
        if not (eccentricity or friction):  # else another place has the greatest one
            assert one.min == pytest.approx(2.0 * row[2] - row[3], rel=1e-7)
