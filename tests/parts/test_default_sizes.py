"""Default sizes by hand: what the reference page of ``[size]`` says of keys that are left out.

Bores are those of standard bearings and other sizes are rounded numbers, so a fraction is tested
where it just reaches one, and a little below.
"""

import math

import pytest
from words import Spec, Wheel

from geneva_cli import Design
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.shafts.arm_and_shafts import crank_arm
from geneva_cli.spec.tables import Size

L = 100.0


def of(**size):
    return Design.of(Spec(Wheel(6), size=Size(center_distance_mm=L, roller_radius_mm=6.0, **size)))


def sizes_of(spec):
    """The sizes of a machine's parts, without the parts."""
    return machine_sizes(Design.of(spec).mechanism)[1]


def test_default_sizes_are_those_of_the_reference_page():
    """L = 150 mm, six slots: r = L/20 and R = L/2, whose keys are left out.

    The bore of the wheel is up to L/6, which is 25 mm, the bore of a standard bearing. The next
    smaller one has 20 mm. The hub is 1.6 bores wide, which is a rounded number too.
    """
    sizes = sizes_of(Spec(Wheel(6), size=Size(150.0)))
    assert sizes.roller == 7.5
    assert sizes.rim == pytest.approx(math.hypot(75.0 * math.sqrt(3.0), 7.5))
    assert sizes.slot_bottom == pytest.approx(7.5 / 20.0)
    assert sizes.slot_end == pytest.approx(150.0 - 75.0 - 7.5 - 7.5 / 20.0)
    assert sizes.lock == pytest.approx(75.0 - 7.5 - 7.5)  # the horn is as thick as r
    assert sizes.relief == sizes.wall_min == pytest.approx(150.0 / 200.0)
    assert (sizes.wheel_bore, sizes.wheel_hub, sizes.pin) == (12.5, 20.0, 3.5)
    assert sizes_of(Spec(Wheel(6), size=Size(149.9))).wheel_bore == 10.0


def test_default_sizes_of_the_arm():
    """An eye is twice as wide as its hole, up to what passes the wheel's hub; a hub is 1.6 bores.

    The bolts' holes are at most L/40 wide, and at most half as wide as the ring that they are in:
    for M2 and M1.6, whose threads in the arm have a pitch of 0.4 and 0.35 mm.
    """
    parts = of(arm_bore_mm=25.0, crank_bore_mm=0.0).parts.outlines
    arm = crank_arm(parts)
    assert (arm.hub, arm.eye) == (20.0, 6.0)
    assert [bolt.radius for bolt in arm.bolts] == [0.8, 0.8]
    wide = crank_arm(of(wheel_hub_mm=90.0, pin_mm=6.0).parts.outlines)
    # from the pin, at R = L/2, to the hub are 5 mm
    assert (wide.eye, wide.hub_gap) == (pytest.approx(5.0), pytest.approx(0.0, abs=1e-12))
    ring = crank_arm(of(lock_bolts=1, lock_bolt_circle_mm=72.0, crank_bore_mm=8.0).parts.outlines)
    (bolt,) = ring.bolts
    # the disc's radius is R - 2 r, so that 2 mm are left outside of the bolts' circle
    assert (*bolt.centre, bolt.radius) == pytest.approx((-36.0, 0.0, 0.625))


def test_the_shaft_goes_through_the_disc_where_it_leaves_a_hub():
    """Its radius is at most 0.6 of the space inside the relief, which is scaled from the wheel's.

    Of R = 50 the wheel leaves L (1 - cos 30°), so a disc of 40 leaves 0.8 of that: 10.7 mm.
    """
    space = 0.8 * L * (1.0 - math.cos(math.pi / 6.0))
    for share, bore in ((0.599, 0.599 * space), (0.601, 0.0)):
        size = Size(L, 5.0, arm_bore_mm=2.0 * share * space)
        assert sizes_of(Spec(Wheel(6), size=size)).crank_bore == pytest.approx(bore)


def test_the_default_bore_of_the_crank():
    """Its radius is at most 0.45 of that space, and a bearing's: 9 mm; none is below L/40.

    Of a disc of 20.73 mm, 0.45 of the space is L/40.
    """
    assert sizes_of(Spec(Wheel(6), size=Size(L))).crank_bore == 4.5
    for lock, bore in ((20.74, 2.5), (20.72, 0.0)):
        size = Size(L, lock_radius_mm=lock)
        assert sizes_of(Spec(Wheel(6), size=size)).crank_bore == bore
