"""Locking sectors without a middle: a few places of the wheel tell what does not clear."""

import math

import numpy as np

from geneva_cli.kinematics.laws.standard import ModifiedSine
from geneva_cli.kinematics.motion import Motion
from geneva_cli.kinematics.wheels.internal import Internal
from geneva_cli.layout.assembly import assembly
from geneva_cli.layout.sizes import sizes
from geneva_cli.machine.drives.cam import Cam
from geneva_cli.machine.mechanism import build
from geneva_cli.machine.spec import Spec
from geneva_cli.outlines import locking_rings, outlines
from geneva_cli.outlines.locking_rings import PolarPoints, beyond, inner_arc, polar_points, towards


def test_what_is_beyond_is_so_by_the_whole_arc_too():
    """Some places say no only where all of them do: random ones, most of them near the disc."""
    size = sizes(assembly(build(Spec(Internal(6)))))
    limit, some = 0.9 * size.lock, np.random.default_rng(8)
    told = []
    for _ in range(2000):
        half = some.uniform(0.2, 3.0)
        radius = size.lock * (1.0 - some.exponential(0.3, 12)) ** 2
        places = PolarPoints(radius, some.uniform(-math.pi, math.pi, 12))
        told.append((beyond(size, places, half), max(inner_arc(size, half, places, 0.0)) < limit))
    assert {(True, False), (False, True)} <= set(told)
    assert (True, True) not in told


def test_sectors_are_those_of_all_places(monkeypatch):
    """Nothing is told from a few places that all of them would not."""
    wheel = Internal(12)
    motion = Motion(ModifiedSine(), alpha0_deg=-30.0)
    spec = Spec(wheel, Cam(), motion=motion)
    known = outlines.outlines(build(spec))
    monkeypatch.setattr(locking_rings, "beyond", lambda *_: False)
    assert outlines.outlines(build(spec)).crank == known.crank


def test_places_towards_a_direction_are_all_that_are():
    """None within the angle is missed, and few beside it are with them."""
    some = np.random.default_rng(4)
    for half in (0.0, 1e-3, 0.4, 0.5 * math.pi, 2.0, math.pi):
        middle = some.uniform(-7.0, 7.0)
        turn = np.concatenate((some.uniform(-math.pi, math.pi, 4000), (-half, half)))
        radius = 10.0 ** some.uniform(-3.0, 3.0, len(turn))
        x, y = radius * np.cos(middle + turn), radius * np.sin(middle + turn)
        near = towards(x, y, middle, half)
        assert np.isin(x[np.abs(turn) <= half], near[0]).all()
        off = polar_points(*near, middle)
        assert (np.abs(off.direction) <= half + 1e-4).all()
        assert np.isin(off.radius, np.hypot(x, y)).all()
