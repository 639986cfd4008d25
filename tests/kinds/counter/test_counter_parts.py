"""A counter's teeth and rim: their outlines against the free angles, and the values of a spec.

The witness turns the outlines themselves, of arcs within 1e-6 L, and measures their distance point
by point.
"""

import functools
import math
from itertools import combinations

import numpy as np
import pytest
import repo
from sampling import some
from shapely.geometry import Polygon

from geneva_cli import Counter, Design, Size, load
from geneva_cli.errors import GenevaError
from geneva_cli.geometry import fit
from geneva_cli.geometry.distance import Polyarc
from geneva_cli.geometry.gear_teeth import involute
from geneva_cli.geometry.measure import bounds
from geneva_cli.geometry.plates import Group, Stack
from geneva_cli.geometry.shapes import Circle
from geneva_cli.kinds.counter.outlines import (
    counter_sizes,
    driver_rim,
    driver_teeth,
    number_teeth,
    pinion_teeth,
)
from geneva_cli.kinds.counter.play import counter_play
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.output.scene import value_at
from geneva_cli.study.animation.scene import scene
from geneva_cli.verdict.checks import single_check

L = 100.0
CASES = [(4, 20, 0.0), (4, 20, 0.3), (5, 20, 0.0), (7, 31, 0.1), (4, 12, 0.0)]


def machine(z, teeth, clearance=0.0, **size):
    return build(
        Spec(Counter(z, driver_teeth=teeth), size=Size(lock_clearance_mm=clearance, **size))
    )


def write(curve, a, b):
    return fit.arcs(curve, a, b, 1e-6 * L)


@functools.cache
def planes(sizes):
    """The driver's and the pinion's outline in each of both planes, and points on them."""
    pairs = (
        (driver_rim(sizes, write), pinion_teeth(sizes, write)[1]),
        (driver_teeth(sizes, write), pinion_teeth(sizes, write)[0]),
    )
    outlines = [[Polyarc([one]) for one in pair] for pair in pairs]
    return [
        (pair, [one.samples(1e-5 * L, 2e-3 * L).view(complex)[:, 0] for one in pair])
        for pair in outlines
    ]


def gap(sizes, input_deg, pinion_deg):
    """The least distance of both parts in both planes, mm; negative where they overlap."""
    turn = np.exp(1j * (math.pi - np.radians(input_deg)))
    own = np.exp(1j * np.radians(pinion_deg))
    out = []
    for (driver, pinion), points in planes(sizes):
        on_driver, on_pinion = L + points[0] * turn, points[1] * own
        on_driver = on_driver[abs(on_driver) < sizes.pinion.tip + 1.0]
        on_pinion = on_pinion[abs(on_pinion - L) < sizes.rim + 1.0]
        seen = on_driver / own, (on_pinion - L) / turn
        for part, there in zip((pinion, driver), seen, strict=True):
            if len(there):
                out.append(part.signed(np.column_stack((there.real, there.imag))).min())
    return min(out)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("z", "teeth", "clearance"), CASES)
def test_the_outlines_touch_at_the_ends_of_the_free_angles(z, teeth, clearance):
    """At both ends the least distance is 0: arcs and samples leave 1e-5 L, and between them none
    overlap. The nominal motion lies between the ends at every angle."""
    built = machine(z, teeth, clearance)
    sizes, play = counter_sizes(built), counter_play(built)
    half, ratio = 360.0 / teeth, teeth / (2 * z)
    for i in range(0, len(play.input_deg), max(1, len(play.input_deg) // some(8, 4))):
        input_deg = float(play.input_deg[i])
        nominal = max(input_deg, -half) * ratio
        assert gap(sizes, input_deg, nominal) > -1e-5 * L
        for turned in (play.ahead_deg[i], -play.behind_deg[i]):
            assert gap(sizes, input_deg, nominal + turned) == pytest.approx(0.0, abs=2e-5 * L)


@pytest.mark.parametrize(("z", "teeth"), [(4, 20), (7, 31)])
def test_a_whole_turn_without_overlap(z, teeth):
    """Also after mid-motion, which the free angles take from before it."""
    sizes = counter_sizes(machine(z, teeth))
    half, ratio = 360.0 / teeth, teeth / (2 * z)
    for input_deg in np.linspace(-180.0, 180.0, some(61, 21)):
        pinion_deg = float(np.clip(input_deg, -half, half)) * ratio
        assert gap(sizes, float(input_deg), pinion_deg) > -1e-5 * L


def test_the_teeth_of_an_odometer():
    """Shifts, pressure angle and module by hand: x = 1 - z sin² 20° and 1 - N/2 sin² 20°."""
    sizes = counter_sizes(machine(4, 20))
    a = math.radians(20.0)
    x2, x1 = 1.0 - 4.0 * math.sin(a) ** 2, 1.0 - 10.0 * math.sin(a) ** 2
    assert (sizes.pinion.rack.shift, sizes.driver.rack.shift) == pytest.approx((x2, x1), rel=1e-14)
    w = sizes.pressure_angle
    assert involute(w) == pytest.approx(involute(a) + (x1 + x2) * math.tan(a) / 14.0, rel=1e-12)
    module = sizes.driver.rack.module
    assert 14.0 * module * math.cos(a) / math.cos(w) == pytest.approx(L, rel=1e-12)
    # pitch circles at work touch, and their teeth fill the pitch: no backlash
    pitch = [teeth.base / math.cos(w) for teeth in (sizes.driver, sizes.pinion)]
    assert sum(pitch) == pytest.approx(L, rel=1e-12)
    thick = [t.thickness(r) for t, r in zip((sizes.driver, sizes.pinion), pitch, strict=True)]
    assert sum(thick) == pytest.approx(math.tau * pitch[0] / 20.0, rel=1e-12)


def test_play_of_the_lock():
    """The rim of a clearance c lets the pinion turn until a wide tooth is c nearer to the axis.

    For small angles d the touching place at (r, b) moves towards the axis by r L sin b d/rim, to
    either side. The second order is below 1 % for 0.05 mm.
    """
    tight, loose = (machine(4, 20, c) for c in (0.0, 0.05))
    sizes = counter_sizes(tight)
    r = np.linspace(sizes.pinion.base, sizes.pinion.tip, 200001)
    side = np.array([sizes.pinion.half_angle(x) for x in r[::100]])
    b = math.pi / 4.0 - side
    away = np.sqrt(L * L + r[::100] ** 2 - 2.0 * L * r[::100] * np.cos(b))
    k = away.argmin()
    turn = 0.05 * away[k] / (r[::100][k] * L * math.sin(b[k]))
    play = counter_play(loose)
    assert play.whole_deg[0] == pytest.approx(math.degrees(2.0 * turn), rel=0.01)
    assert counter_play(tight).whole_deg[0] < 1e-3


def test_checks():
    names = "counter_free_deg", "counter_play_deg", "counter_lock_deg"
    free, play, lock = (single_check(machine(4, 20), name) for name in names)
    assert free.passes and free.value == 0.0
    assert play.passes and 0.0 < play.value < play.limit == 22.5
    assert lock.passes and lock.limit == 9.0
    assert not single_check(machine(3, 20), names[0]).passes
    assert [single_check(machine(4, 20, 9.0), name).passes for name in names] == [
        True,
        False,
        False,
    ]
    refused = single_check(machine(4, 20, 12.0), names[0])
    assert not refused.passes and "leaves the driver no teeth" in refused.why


def test_the_least_free_angle_is_between_the_teeth():
    """Half the backlash at the pinion's pitch radius, 4 L/14: the rim leaves more."""
    least, lock = (
        single_check(machine(4, 20, 0.3, gear_backlash_mm=0.3), name)
        for name in ("counter_free_deg", "counter_lock_deg")
    )
    pitch = 4.0 * L / 14.0
    # flanks are involutes, so that this angle is the same wherever two are near: rounding
    assert least.value == pytest.approx(math.degrees(0.5 * 0.3 / pitch), rel=1e-9)
    assert -18.0 <= least.at_deg < 0.0 and lock.value > 4.0 * least.value


@pytest.mark.parametrize(("z", "teeth"), [(4, 20), (5, 20), (8, 30), (12, 12)])
def test_the_number_wheel_meshes_with_the_pinion(z, teeth):
    """It has all the driver's teeth, in contact at every angle: at 20 places of a pitch none
    overlap. Turned on by a thousandth of a radian, in either sense, some do."""
    sizes = counter_sizes(machine(z, teeth))
    wheel, pinion = (
        Polyarc([c]) for c in (number_teeth(sizes, write), pinion_teeth(sizes, write)[0])
    )
    points = wheel.samples(1e-5 * L, 2e-3 * L).view(complex)[:, 0]
    for part in np.linspace(0.0, 1.0, 20):
        input_ = part * math.tau / teeth
        at = L + points * np.exp(1j * (math.pi - input_))
        at = at[abs(at) < sizes.pinion.tip + 1.0]  # all others are farther than 1 mm away
        for off, touches in ((0.0, False), (1e-3, True), (-1e-3, True)):
            seen = at * np.exp(-1j * (input_ * teeth / (2 * z) + off))
            least = pinion.signed(np.column_stack((seen.real, seen.imag))).min()
            # a thousandth of a radian is 0.01 mm and more on the base circle
            assert least < -5e-3 if touches else least > -1e-5 * L


@pytest.mark.parametrize(
    ("z", "teeth", "backlash", "text"),
    [
        (3, 12, 0.0, "driver_teeth = 12: teeth of number wheel and pinion lose contact"),
        (4, 20, 5.0, "gear_backlash_mm = 5: .* contact ratio is 0.823; use a smaller one"),
        (4, 20, 200.0, "contact ratio is 0; use a smaller one"),
    ],
)
def test_teeth_that_lose_contact_are_refused(z, teeth, backlash, text):
    with pytest.raises(GenevaError, match=text):
        counter_sizes(machine(z, teeth, gear_backlash_mm=backlash))


def test_the_rim_touches_the_wide_teeth():
    """Half a million points of a flank, from the involute's own equation, and none nearer."""
    for z, teeth in ((4, 20), (5, 20), (7, 31), (3, 24), (6, 60), (10, 10)):
        sizes = counter_sizes(machine(z, teeth))
        pinion, rack = sizes.pinion, sizes.pinion.rack
        start = pinion.radius * math.sin(rack.angle) - rack.straight / math.sin(rack.angle)
        along = np.linspace(start, pinion.tangent(pinion.tip), 500_001)
        roll = along / pinion.base
        # a string unwound from the base circle, from the middle of the space on
        begins = math.pi / z - (rack.half / pinion.radius + involute(rack.angle))
        unwound = pinion.base * np.exp(1j * (begins + roll)) * (1.0 - 1j * roll)
        least = min(abs(unwound - L).min(), L - pinion.root - 0.1 * rack.module)
        # points are 1e-4 mm apart, and the circle is 40 mm wide or more: 1e-8/80
        assert sizes.rim == pytest.approx(least, abs=1e-9)  # without a lock_clearance_mm


@pytest.mark.parametrize("backlash", [0.0, 0.05, 0.5])
def test_backlash_is_along_the_pitch_circles_at_work(backlash):
    """Both teeth there are thinner than the pitch by it, and no flank ends below the base circle:
    without this the kernel of a CAD finds an outline that crosses itself."""
    for z, teeth in ((4, 20), (3, 24), (20, 20)):
        sizes = counter_sizes(machine(z, teeth, gear_backlash_mm=backlash))
        w, gears = sizes.pressure_angle, (sizes.driver, sizes.pinion)
        pitch = [gear.base / math.cos(w) for gear in gears]
        thick = [gear.thickness(r) for gear, r in zip(gears, pitch, strict=True)]
        assert math.tau * pitch[0] / teeth - sum(thick) == pytest.approx(backlash, abs=1e-10)
        for gear in gears:
            # of the pinion below 18 teeth both sides are the same length
            assert gear.rack.least_radius <= gear.radius * (1.0 + 1e-12)


def ring(shape):
    """Points of an outline, whose chords are within 1e-3 mm of it."""
    if isinstance(shape, Circle):
        return complex(*shape.centre) + shape.radius * np.exp(1j * np.linspace(0.0, math.tau, 1441))
    return Polyarc([shape]).samples(1e-3, math.inf).view(complex)[:, 0]


def placed(member, at=0j, turn=1.0 + 0j):
    """The solids of a part at their places: name, heights, and shapely's polygon."""
    at, turn = at + turn * complex(*member.at), turn * np.exp(1j * member.turn)
    if isinstance(member.part, Group):
        for one in member.part.members:
            yield from placed(one, at, turn)
        return
    steps = member.part.plates if isinstance(member.part, Stack) else (member.part,)
    for step in steps:
        rings = [at + turn * ring(shape) for shape in (step.outline, *step.holes)]
        outline, *holes = [np.column_stack((r.real, r.imag)) for r in rings]
        yield member.part.name, step.low, step.high, Polygon(outline, holes)


WHOLE = {
    "plain": Design(Counter(4)),
    "turned": Design(Counter(4), size=Size(shafts="turned", crank_keyway="DIN 6885-1")),
    "keyed": Design(Counter(5, driver_teeth=24), size=Size(wheel_bore="D", crank_bore="hex")),
    "three": Design(
        Counter(4, number_wheels=4),
        size=Size(pin_gap_mm=0.5, shafts="turned", crank_bore="D", gear_backlash_mm=0.1),
    ),
    "odometer": load(str(repo.DESIGNS / "odometer.toml")),
}


@pytest.mark.parametrize("name", WHOLE)
def test_no_parts_share_space(name):
    """At mid-motion and at rest shapely's polygons of all solids at one height are apart.

    What shares an edge, as teeth in mesh or a shaft in its bore, overlaps by both polygons' own
    error: the overlap is nowhere wider than twice a thousandth of a millimetre."""
    design = WHOLE[name]
    parts = design.parts_model.built.within(1e-3, "arcs")
    half, ratio = design.mechanism.engagements[0].exit_deg, 2.5 if name != "keyed" else 2.4
    for input_deg in (0.0, -half, -2.0 * half):
        pinion = math.radians(max(input_deg, -half) * ratio)
        # number wheels are turned by their pinions, and the driver by the input
        turns = {"pinion": pinion, "driver": -math.radians(input_deg)}
        turns["number wheel"] = -pinion / ratio
        turns |= {"pinion's shaft": pinion, "driver's shaft": turns["driver"]}
        solids = [
            one
            for member in parts.members
            for one in placed(member._replace(turn=member.turn + turns.get(member.part.name, 0.0)))
        ]
        assert len({one[0] for one in solids}) >= 8
        for i, (own, low, high, shape) in enumerate(solids):
            for other, bottom, top, there in solids[:i]:
                if min(high, top) - max(low, bottom) > 1e-9 and own != other:
                    shared = shape.intersection(there).buffer(-1.01e-3)
                    assert shared.is_empty, (own, other, input_deg, shared.area)


def test_the_stack_is_as_high_as_its_planes():
    """By hand for a gap of 0.5: three planes of 10 and two gaps a pinion, and two between them."""
    parts = WHOLE["three"].parts_model.built
    spans = [(p.part.members[0].part.low, p.part.members[-1].part.high) for p in parts.pinions]
    assert spans == [(0.0, 31.0), (32.0, 63.0), (64.0, 95.0)]
    own = [[(m.part.low, m.part.high) for m in w.part.members] for w in parts.number_wheels]
    assert own[0] == [(0.0, 10.0)]
    # its gear meshes with the second pinion, teeth and rim drive and lock the first
    assert own[1] == [(31.5, 42.0), (10.5, 21.0), (21.0, 31.5)]
    driver = [(m.part.low, m.part.high) for m in parts.driver.part.members]
    assert driver == [(74.5, 85.0), (85.0, 95.0)]


def test_masses_and_counts_of_the_list():
    """Against shapely's areas: within a thousandth of a millimetre around each outline."""
    listed = WHOLE["odometer"].part_table("parts").to_rows()
    rows = [row for row in listed if row["row"] == "part"]
    counts = {}
    for row in rows:
        counts[row["name"]] = counts.get(row["name"], 0) + row["count"]
    assert counts == {
        "pinion's teeth": 5,
        "pinion's wide teeth": 5,
        "number wheel": 5,
        "number wheel's two teeth": 4,
        "number wheel's rim": 4,
        "driver's two teeth": 1,
        "driver's rim": 1,
        "pinions' shaft": 1,
        "driver's shaft": 1,
        "frame": 1,
    }
    parts = WHOLE["odometer"].parts_model.built.within(1e-3, "arcs")
    solids = [one for member in parts.members for one in placed(member)]
    for row in rows:
        high = row["thickness_mm"]
        alike = [
            shape
            for name, bottom, top, shape in solids
            if name == row["name"] and top - bottom == pytest.approx(high, abs=1e-9)
        ]
        assert len(alike) == row["count"]
        mass, near = 7850e-9 * alike[0].area * high, 7850e-9 * 1e-3 * alike[0].length * high
        assert row["mass_kg"] == pytest.approx(mass, abs=near)


@pytest.mark.usefixtures("no_advice")
def test_what_does_not_fit_is_refused_with_its_key():
    cases = (
        (Counter(4), Size(crank_bore_mm=130.0), "crank_bore_mm = 130: the teeth begin at"),
        (Counter(4), Size(crank_bore_mm=0.0), "gears stand on shafts"),
        (Counter(4, number_wheels=3), Size(wheel_bore="D"), "each pinion turns by itself"),
        (
            Counter(4),
            Size(shafts="turned", crank_bore_mm=100.0, center_distance_mm=90.0),
            "leave a wall of",
        ),
    )
    for spec, size, text in some(cases, cases[::3]):
        design = Design(spec, size=size)
        (check,) = [one for one in design.checks if one.name == "parts"]
        assert check.passes is False and text in check.why, text
    with pytest.raises(GenevaError, match="of this kind has none; it may have wheel, crank, "):
        Design(Counter(4)).drawing("links")


def test_the_sheet_names_and_sizes_all_parts():
    sheet = WHOLE["odometer"].sheet(0.01)
    texts = " | ".join([one.text for one in sheet.labels] + [m.label.text for m in sheet.measures])
    for text in (
        "L = 14",
        "20 teeth, m = ",
        "8 teeth, m = ",
        "2 teeth, m = ",
        "every second tooth",
    ):
        assert text in texts, text
    assert "not marked" not in texts
    sizes = WHOLE["odometer"].parts_model.built.sizes
    assert f"rim Ø {2.0 * sizes.rim:.3f}" in texts


def test_the_page_turns_the_number_wheel_with_the_driver():
    """By a tenth of a turn with two of its teeth, in the driver's sense, and it rests with both."""
    shown = scene(WHOLE["plain"])
    bodies = {body.name: body.angle for body in shown.bodies}
    number, driver, pinion = (bodies[name] for name in ("number wheel 2", "driver", "pinion 1"))
    for t in (0.0, 9.0, 18.0, 36.0):  # from entry on
        moved = [value_at(one, t) - value_at(one, 0.0) for one in (number, driver, pinion)]
        assert moved[0] == pytest.approx(-math.radians(t), abs=2e-7)
        # tracks are within 1e-7
        assert moved == pytest.approx([moved[1], moved[1], -2.5 * moved[1]], abs=4e-7)
    assert value_at(number, 200.0) == pytest.approx(value_at(number, 36.0), abs=1e-12)
    # a space of it lies about the pinion's wide tooth half-way
    assert value_at(number, 18.0) == pytest.approx(math.pi, abs=2e-7)


def test_the_page_has_each_pinion_and_number_wheel():
    """Five stations, apart. A carry reaches the k-th pinion in one of 10^(k - 1) turns."""
    shown = scene(WHOLE["odometer"])
    every = {body.name: body.every for body in shown.bodies}
    for k in range(1, 6):
        assert every[f"pinion {k}"] == every[f"number wheel {k + 1}"] == 10 ** (k - 1)
    # a number wheel's two teeth stand in the next station, and move with its gear
    assert [every[f"teeth of number wheel {k}"] for k in range(2, 6)] == [1, 10, 100, 1000]
    assert every["driver"] == 1 and len(every) == 15
    centres = [body.centre for body in shown.bodies if body.name.startswith("number")]
    tips = max(max(abs(v) for v in bounds(s)) for s in WHOLE["odometer"].drawing("crank").shapes)
    assert min(math.dist(a, b) for a, b in combinations(centres, 2)) > 2.0 * tips
    words = [state.words for state in shown.states]
    assert words == [
        "the driver moves the first pinion; at a carry number wheels move the others",
        "the pinion rests, locked by the rim",
    ]
    assert shown.figure.panels[0].y.label == "Speed of the pinion, relative to the input"
