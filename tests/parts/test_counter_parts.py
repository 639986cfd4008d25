"""A counter's teeth and rim: their outlines against the free angles, and the values of a spec.

The witness turns the outlines themselves, of arcs within 1e-6 L, and measures their distance point
by point.
"""

import functools
import math

import numpy as np
import pytest
from sampling import some

from geneva_cli import Counter, Design, Size
from geneva_cli.curves import fit
from geneva_cli.curves.distance import Polyarc
from geneva_cli.curves.gear_teeth import involute
from geneva_cli.errors import GenevaError
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.outlines.counter import (
    counter_sizes,
    driver_rim,
    driver_teeth,
    number_teeth,
    pinion_teeth,
)
from geneva_cli.outlines.counter_play import counter_play
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
        (driver_rim(sizes, write), pinion_teeth(sizes, True, write)),
        (driver_teeth(sizes, write), pinion_teeth(sizes, False, write)),
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


def test_drawings():
    design = Design(Counter(4, driver_teeth=20))
    for part, plates in (("wheel", 2), ("crank", 2), ("number-wheel", 1), ("assembly", 3)):
        assert len(design.drawing(part).solid.members) == plates
    with pytest.raises(GenevaError, match="crank_bore_mm = 170"):
        Design(Counter(4), size=Size(crank_bore_mm=170.0)).drawing("crank")
    with pytest.raises(GenevaError, match="not available for a wheel, which has wheel, crank"):
        design.drawing("frame")


def test_the_number_wheel_meshes_with_the_pinion():
    """It is the whole driver: at 20 places of a pitch no tooth overlaps the pinion."""
    sizes = counter_sizes(machine(4, 20))
    wheel, pinion = (
        Polyarc([c]) for c in (number_teeth(sizes, write), pinion_teeth(sizes, False, write))
    )
    points = wheel.samples(1e-5 * L, 2e-3 * L).view(complex)[:, 0]
    for input_deg in np.linspace(0.0, 18.0, 20):
        seen = (L + points * np.exp(1j * (math.pi - math.radians(input_deg)))) * np.exp(
            -2.5j * math.radians(input_deg)
        )
        assert pinion.signed(np.column_stack((seen.real, seen.imag))).min() > -1e-5 * L
