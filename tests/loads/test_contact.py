"""The roller in a curved slot, against 50 digits of the path turned back into the wheel."""

import numpy as np
import pytest
from witness import mp, to_radians
from words import Motion, Spec, Wheel

from geneva_cli.loads.contact import contact
from geneva_cli.motion.mechanism import build

SHARES = (-0.93, -0.4, -1e-3, 1e-4, 0.05, 0.77)  # of half a motion


def in_wheel(machine, t):
    """The roller's centre in the wheel at t radians of a cycloidal motion."""
    [engagement] = machine.engagements
    whole = 2 * to_radians(engagement.exit_deg)
    turns = 2 * mp.pi * t / whole
    psi = 2 * mp.mpf(engagement.motion.half_step) * (turns + mp.sin(turns)) / (2 * mp.pi)
    ratio = mp.mpf(machine.ratio)
    return (1 - ratio * mp.expj(-t)) * mp.expj(-psi)


def wanted(machine, t):
    """Lever, offset, along and curvature, by derivatives of that one complex number."""
    m, u, b = mp.diffs(lambda s: in_wheel(machine, s), t, 2)
    inner, outer = (mp.conj(m) * u).real, (mp.conj(m) * u).imag
    along = mp.sign(inner) * abs(u)
    return inner / along, outer / along, along, (mp.conj(u) * b).imag / along**3


@pytest.mark.parametrize(("z", "alpha0"), [(3, 25.0), (4, -60.0), (6, -20.0), (8, -35.0)])
def test_a_curved_slot_against_50_digits(z, alpha0):
    machine = build(Spec(Wheel(z), motion=Motion("cycloidal", alpha0_deg=alpha0)))
    x = np.array(SHARES) * machine.engagements[0].exit_deg
    found = contact(machine.engagements[0], x)
    every = zip(*[wanted(machine, to_radians(at)) for at in x], strict=True)
    for name, row in zip(("lever", "offset", "along", "curvature"), every, strict=True):
        exact = np.array([float(one) for one in row])
        np.testing.assert_allclose(getattr(found, name).c[0], exact, rtol=2e-13)
