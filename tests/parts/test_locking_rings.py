"""Locking sectors without a middle: the widest that clear the wheel."""

import math

import numpy as np
import pytest

from geneva_cli.drives.cam import Cam
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.internal import Internal
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines import locking_rings
from geneva_cli.parts.outlines.cut_outlines import drawn
from geneva_cli.parts.outlines.locking_rings import polar_points, towards


@pytest.mark.parametrize(("z", "alpha0"), [(12, -30.0), (8, -30.0), (6, 0.0)])
def test_a_sector_is_the_widest_of_all_that_clear_the_wheel(monkeypatch, z, alpha0):
    """Every fiftieth of its width is tried, not only those that the halving meets."""
    spec = Spec(Internal(z), Cam(), motion=Motion(ModifiedSine(), alpha0_deg=alpha0))
    own, tried = drawn(*machine_sizes(build(spec))).crank, []

    def widest_of_all(whole, clears):
        fits = [half for k in range(40) if clears(half := (1.0 - 0.02 * k) * whole)]
        tried.append((whole, fits))
        return max(fits)

    monkeypatch.setattr(locking_rings, "widest", widest_of_all)
    assert drawn(*machine_sizes(build(spec))).crank == own
    assert tried
    # narrower ones clear it too
    assert all(
        fits == [(1.0 - 0.02 * k) * whole for k in range(40)][-len(fits) :] for whole, fits in tried
    )


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
