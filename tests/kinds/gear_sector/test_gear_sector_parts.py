"""A pair of slots a step: what two rollers sweep, what holds the wheel, and what it weighs.

The witness turns the machine by itself: crank, wheel and rollers by the angles of a plain slot and
of gears, in the notation of gear_sector.py.
"""

import math
from functools import cache

import numpy as np
import pytest
import shapely
from drawing_witness import polygon
from witness import mp

from geneva_cli import Design, External, GearSector, Load, Size
from geneva_cli.geometry.shapes import Arc
from geneva_cli.loads.cycle import cycle_warnings
from geneva_cli.loads.impacts.reversal import arrival
from geneva_cli.verdict.checks import single_check

MACHINES = {
    "the design": (3, 60.0, {"roller_radius_mm": 8.0}),
    "half a turn and more": (4, 150.0, {}),
    "a narrow pair": (8, 4.0, {"slot_clearance_mm": 0.2, "slot_bottom_clearance_mm": 0.7}),
    "a thick roller": (5, 40.0, {"roller_radius_mm": 14.0, "lock_clearance_mm": 0.1}),
}


@cache
def made(z, sector, **size):
    return Design(External(z), GearSector(sector_deg=sector), size=Size(**size))


def solved(design):
    """b and u of a machine: radians and a number, as its list of parts has them."""
    rows = design.part_table("parts").to_dict()
    d = dict(zip(rows["name"], rows["value"], strict=True))
    return math.radians(d["slot's half angle b"]), d["gears' ratio u"]


def slot_angle(l, a):
    return np.arctan2(l * np.sin(a), 1.0 - l * np.cos(a))


def turned(design, count):
    """Input angles from 60 degrees before the motion to 60 after it, radians; there both rollers in
    the wheel's frame, (2, n).
    """
    b, u = solved(design)
    l, half = math.sin(b), math.radians(0.5 * design.spec.drive.sector_deg)
    span = 0.5 * math.pi - b + half
    x = np.linspace(-span - 1.0, span + 1.0, count)
    beyond = np.minimum(np.abs(x), span) - half
    gears = u * half
    outside = slot_angle(l, beyond) + gears
    wheel = np.where(np.abs(x) < half, u * x, np.sign(x) * outside)
    ways = []
    for side in (1.0, -1.0):
        a = x + side * half
        ways.append((1.0 - l * np.exp(-1j * a)) * np.exp(-1j * wheel))
    return x, design.mechanism.center_distance_mm * np.array(ways)


def away(piece, z):
    """The distance of places from a line or an arc, by its ends or its foot."""
    a, b = complex(*piece.start), complex(*piece.end)
    ends = np.minimum(np.abs(z - a), np.abs(z - b))
    if isinstance(piece, Arc):
        c = complex(*piece.centre)
        within = np.angle((z - c) / (a - c)) * np.sign(piece.bulge) % math.tau
        return np.where(within <= abs(piece.sweep), np.abs(np.abs(z - c) - abs(a - c)), ends)
    t = ((z - a) / (b - a)).real
    return np.where((t >= 0.0) & (t <= 1.0), np.abs(((z - a) / (b - a)).imag) * abs(b - a), ends)


@pytest.mark.parametrize("name", MACHINES)
def test_no_roller_touches_what_is_not_its_wall(name):
    """At 4000 places: on its wall while it drives, to rounding of some 100 mm, else off it."""
    z, sector, size = MACHINES[name]
    design = made(z, sector, **size)
    contour, L = design.parts.outlines.wheel, design.mechanism.center_distance_mm
    r, inside = design.mechanism.roller_radius_mm, polygon(contour, 1e-3)
    shapely.prepare(inside)
    close = design.spec.size.allowances.slot_clearance_mm
    for way in turned(design, 4000)[1]:
        near = np.min([away(piece, way) for piece in contour.segments], axis=0)
        assert not shapely.contains_xy(inside, way.real, way.imag).any()
        assert near.min() >= r + close - 1e-12 * L  # and, in the slots, on the wall
        assert near.min() <= r + close + 1e-12 * L


def test_two_rollers_on_the_crank():
    """D apart; each where the engagement has the one that drives."""
    design = made(3, 100.0, roller_radius_mm=3.0)
    where, L = design.parts.assembly, design.mechanism.center_distance_mm
    engagement = design.mechanism.engagements[0]
    b, _ = solved(design)
    at = np.linspace(-180.0, 180.0, 37)
    arms = [(where.pin(i, at) - (L, 0.0)) @ (1.0, 1.0j) for i in (0, 1)]
    assert np.abs(np.abs(arms) - L * math.sin(b)).max() < 1e-12 * L
    apart = np.degrees(np.angle(arms[1] / arms[0]))  # outside the crank turns clockwise
    assert apart == pytest.approx(100.0, rel=1e-12)
    rows = design.part_table("parts").to_dict()
    listed = dict(zip(rows["name"], rows["value"], strict=True))
    assert listed["between the rollers"] == pytest.approx(apart[0])
    # two slots and the recess between pairs take up a step
    assert listed["between a pair's slots"] + 2.0 * math.degrees(b) == pytest.approx(120.0)
    slots = np.linspace(engagement.entry_deg, -50.0, 9)
    for number, x in ((0, slots), (1, -slots)):
        assert where.pin(number, x) == pytest.approx(where.pin(0, x, drives=True), abs=1e-12 * L)
    (room,) = (c.value for c in design.checks if c.name == "rollers_apart_mm")
    chord = 2.0 * L * math.sin(b) * math.sin(math.radians(50.0))
    assert room == pytest.approx(chord - 6.0, rel=1e-12)
    assert where.geared(np.array([-50.1, -49.9, 0.0, 49.9, 50.1])).tolist() == [0, 1, 1, 1, 0]


def loaded(torque, inertia=0.01, sector=60.0, z=3):
    drive = GearSector(sector_deg=sector, n_rpm=60.0 / math.tau)  # 1 rad/s
    return Design(External(z), drive, load=Load(inertia_kgm2=inertia, torque_Nm=torque))


def coasting(b, drag, steps=20000):
    """The exit by small steps of a wheel of inertia 1 that one wall holds back: how short it is."""
    l, end = math.sin(b), 0.5 * math.pi - b
    x = np.linspace(0.0, end, steps + 1)
    h = x[1]
    wall = slot_angle(l, x)
    D = 1.0 - 2.0 * l * np.cos(x) + l * l
    rate = l * (np.cos(x) - l) / D
    psi, v = 0.0, rate[0]
    for i in range(steps):
        psi, v = psi + h * (v - 0.5 * h * drag), max(0.0, v - h * drag)
        if psi >= wall[i + 1]:
            psi, v = wall[i + 1], rate[i + 1]
    return wall[-1] - psi


@pytest.mark.parametrize(("z", "sector"), [(3, 60.0), (12, 20.0), (4, 20.0)])
def test_the_torque_with_which_the_wheel_comes_to_its_dwell(z, sector):
    """In 50 digits; with a percent less it arrives by small steps, with a third more it is short.

    Which of the two conditions is the sharper depends on b: of small slots it is the way.
    """
    design = loaded(0.0, sector=sector, z=z)
    engagement = design.mechanism.engagements[0]
    b = mp.mpf(engagement.through.half_step)
    l, way = mp.sin(b), mp.pi / 2 - b
    u = l / (1 - l)
    late = 2 * (u * way - b) / way**2
    most = arrival(design.mechanism)[1] / 0.01
    assert most == pytest.approx(float(min(mp.tan(b), late)), rel=1e-12)
    assert (late < mp.tan(b)) == (z == 12)
    short = coasting(float(b), 0.99 * most)
    assert short == pytest.approx(0.0, abs=1e-4)
    assert coasting(float(b), 1.3 * most) > 2e-4


def test_what_is_said_of_a_wheel_that_lags():
    for torque, passes in ((0.0, True), (0.004, True), (0.02, False)):
        design = loaded(torque)
        assert single_check(design.parts, "stopping_torque_Nm").passes is passes
        said = {c.name for c in cycle_warnings(design.mechanism)}
        assert ("lags-behind" in said) is (torque == 0.004)
    check = single_check(loaded(1.0, 0.0).parts, "stopping_torque_Nm")
    assert (check.limit, check.passes) == (0.0, False) and "inertia_kgm2" in check.why
