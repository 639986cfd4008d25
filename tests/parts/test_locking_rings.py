"""Locking sectors without a middle: the widest that clear the wheel."""

import pytest

from geneva_cli.drives.cam import Cam
from geneva_cli.motion.laws.standard import ModifiedSine
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.motion import Motion
from geneva_cli.motion.wheels.internal import Internal
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.outlines import crank_outline
from geneva_cli.parts.outlines.cut_outlines import drawn


@pytest.mark.parametrize(("z", "alpha0"), [(12, -30.0), (8, -30.0), (6, 0.0)])
def test_a_sector_is_the_widest_of_all_that_clear_the_wheel(monkeypatch, z, alpha0):
    """Every fiftieth of its width is tried, not only those that the halving meets."""
    spec = Spec(Internal(z), Cam(), motion=Motion(ModifiedSine(), alpha0_deg=alpha0))
    own, tried = drawn(*machine_sizes(build(spec))).crank, []

    def widest_of_all(whole, clears):
        fits = [half for k in range(40) if clears(half := (1.0 - 0.02 * k) * whole)]
        tried.append((whole, fits))
        return max(fits)

    monkeypatch.setattr(crank_outline, "widest", widest_of_all)
    assert drawn(*machine_sizes(build(spec))).crank == own
    assert tried
    # narrower ones clear it too
    assert all(
        fits == [(1.0 - 0.02 * k) * whole for k in range(40)][-len(fits) :] for whole, fits in tried
    )
