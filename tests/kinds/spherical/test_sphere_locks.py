"""Play of a lock on a sphere, and its slopes."""

import math

import mpmath as mp
import pytest

from geneva_cli import Crank, Design, Size, Spherical, Tolerance
from geneva_cli.kinds.spherical.locking import sphere_locks
from geneva_cli.loads.tolerance.locking import Deviations, deviations, slope_of

ROUND = [(60.0, 1), (60.0, 2), (90.0, 1), (120.0, 1)]  # the corner's, the end's, both, the end's


def at(**values):
    """Deviations by name, the others 0; millimetres and radians."""
    return deviations([values.get(name, 0.0) for name in Deviations._fields])


def on_sphere(axes_deg, rollers):
    """A machine on a sphere with play, and its lock."""

    size = Size(slot_clearance_mm=0.1, lock_clearance_mm=0.1)
    drive = Crank(rollers=rollers)
    design = Design(Spherical(6, axes_deg=axes_deg), drive, size=size)
    lock, *_ = sphere_locks(design.parts, dict.fromkeys(Deviations._fields, 0.0))[0]
    return design, lock


@pytest.mark.sampled(4)
@pytest.mark.parametrize("axes_deg, rollers", ROUND)
def test_play_of_a_lock_on_a_sphere_is_that_of_a_whole_turn(axes_deg, rollers):
    """Found there from the regions' arcs, whose overlap by 1e-9 L still counts as touching."""
    design, lock = on_sphere(axes_deg, rollers)
    assert (lock.reach <= lock.half + 1e-9) == ((axes_deg, rollers) in ROUND[0:3:2])
    play, jams = lock(at())
    assert not jams
    assert math.degrees(play.c[0]) == pytest.approx(design.parts.turn.dwell.deg, rel=2e-6)


@pytest.mark.parametrize("axes_deg, rollers", ROUND)
def test_slopes_of_a_lock_on_a_sphere(axes_deg, rollers):
    """In vectors: the corner, or the end, turned about the wheel's axis onto disc or recess."""
    _, lock = on_sphere(axes_deg, rollers)
    S, L = mp.mpf(lock.axes), mp.mpf(lock.radius_mm)
    axis = mp.matrix([mp.sin(S), 0, mp.cos(S)])

    def turned(v, d):
        return mp.matrix([v[0] * mp.cos(d) - v[1] * mp.sin(d), v[0] * mp.sin(d) + v[1] * mp.cos(d),
                          v[2]])  # fmt: skip

    def place(angle, azimuth):  # about the crank's axis, from where the wheel's is
        to, aside = mp.matrix([-mp.cos(S), 0, mp.sin(S)]), mp.matrix([0, 1, 0])
        way = to * mp.cos(azimuth) + aside * mp.sin(azimuth)
        return axis * mp.cos(angle) + way * mp.sin(angle)

    def play(dk, dr):
        k = mp.asin(mp.sin(mp.mpf(lock.lock)) + dk / L)
        rho = mp.asin(mp.sin(mp.mpf(lock.recess)) + dr / L)
        if lock.reach <= lock.half:
            p = mp.mpf(lock.corner)
            reach = mp.acos((mp.cos(p) - mp.cos(S) * mp.cos(rho)) / (mp.sin(S) * mp.sin(rho)))
            point, onto = place(rho, reach), k  # the corner comes down on the disc
        else:
            point, onto = place(k, mp.mpf(lock.half)), rho  # the end runs up to the recess
        far = lambda d: (axis.T * turned(point, d))[0] - mp.cos(onto)  # noqa: E731
        return abs(mp.findroot(far, 0.001))

    # the smallest of both, that of no slope, is the difference of two azimuths of about 1
    assert abs(lock(at(lock_radius_mm=0.01))[0].c[0] - play(0.01, 0)) < 1e-14
    for i, way in ((5, (1, 0)), (6, (0, 1))):
        true = mp.diff(lambda h, w=way: play(h * w[0], h * w[1]), 0)
        assert abs(lock(slope_of(i))[0].c[1] - true) < 1e-13


@pytest.mark.long
def test_the_clearance_of_a_lock_on_a_sphere(axes_deg=60.0):
    """Radii of disc and recess, from the crank's axis, are L sin of their angles."""
    given = Tolerance(lock_radius_mm=0.01, recess_radius_mm=0.015)
    arm = Design(Spherical(6, axes_deg=axes_deg)).mechanism.ratio * 100.0
    disc = 0.85 * arm
    size = Size(lock_radius_mm=disc, slot_clearance_mm=0.01, lock_clearance_mm=0.0)
    design = Design(Spherical(6, axes_deg=axes_deg), size=size, tolerance=given)
    found = design.tolerance(64).to_dict()
    with mp.workdps(50):
        needed = 100 * (mp.asin((mp.mpf(disc) + 0.025) / 100) - mp.asin(disc / 100))
    assert found["clearances.lock_needed_mm"] == pytest.approx(float(needed), rel=1e-12)
    assert found["clearances.turns"] is False
    for share, turns in ((1.001, True), (0.999, False)):
        one = design.with_("size.lock_clearance_mm", share * float(needed)).tolerance(64).to_dict()
        assert one["clearances.turns"] is turns
