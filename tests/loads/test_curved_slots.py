"""Curved slots: the roller against 50 digits, and where one lacks the wall that its load needs."""

import cmath
import math

import numpy as np
import pytest
from witness import mp, to_radians
from words import Drive, Motion, Spec, Wheel

from geneva_cli.loads.contact import contact
from geneva_cli.loads.positive_drive import positive_drives
from geneva_cli.motion.mechanism import build
from geneva_cli.spec.tables import Load, Size
from geneva_cli.verdict.motion_warnings import motion_warnings

PRESS = Spec(Wheel(6), Drive(n_rpm=60.0), size=Size(441.89, 20.0))
MIXED = Load(256.0 / (2.0 * math.pi) ** 2, 497.0)  # Krasniqi's: I w² = 256 and 497 N m


def drive(motion, load=MIXED):
    return positive_drives(build(PRESS.replace(motion=motion, load=load)))


def test_krasniqis_law_lacks_the_wall_on_a_third_of_the_motion():
    """Published analysis: about 30 %; branches 0.091 L apart."""
    found = drive(Motion("sine-group", ratio=0.5))
    assert found.fraction == pytest.approx(0.30, abs=0.05)
    assert found.gap_mm / 441.89 == pytest.approx(0.091, abs=0.001)


def test_inertia_alone_drives_a_slot_whose_way_in_leads():
    found = drive(Motion("cycloidal", ratio=0.5), Load(1.0, 0.0))
    assert found.loose_deg == []
    assert found.fraction == 0.0


def test_resistance_alone_leaves_one_way_loose():
    """The wall ahead is there on the way in only: half of the motion, less where branches meet."""
    found = drive(Motion("cycloidal", ratio=0.5), Load(0.0, 10.0))
    assert all(a >= 0.0 for a, _ in found.loose_deg)
    assert 0.45 < found.fraction < 0.5


def test_straight_slots_always_drive():
    assert positive_drives(build(PRESS.replace(load=MIXED))) is None


def test_the_warning_names_the_cam():
    said = [
        *motion_warnings(build(PRESS.replace(motion=Motion("cycloidal", ratio=0.5), load=MIXED)))
    ]
    assert any("not positively driven" in text and '"cam"' in text for text in said)
    cam = PRESS.replace(drive=Drive("cam"), motion=Motion("cycloidal"), load=MIXED)
    assert not [*motion_warnings(build(cam))]


def test_the_warning_s_gap_lies_where_it_says():
    """Between the branches at the places that lack the wall, not the slot's greatest elsewhere."""
    load = Load(4.0, 40.0)  # the wall is missing near mid-motion and mouth, not where most is cut
    mechanism = build(PRESS.replace(motion=Motion("sine-group", ratio=0.5), load=load))
    found, engagement = positive_drives(mechanism), mechanism.engagements[0]

    def apart(degrees):
        here, there = (
            complex(*[v.c[0] for v in engagement.slot(d, 0)]) for d in (degrees, -degrees)
        )
        return 441.89 * abs(here) * abs(cmath.phase(here / there))

    places = [a + (b - a) * i / 200 for a, b in found.loose_deg for i in range(201)]
    # The intervals end half a step, a sixth of a degree, beyond the places that were tried.
    assert found.loose_gap_mm == pytest.approx(max(map(apart, places)), rel=0.02)
    assert found.loose_gap_mm < 0.95 * found.gap_mm
    (said,) = [text for text in motion_warnings(mechanism) if "not positively" in text]
    assert f"up to {found.loose_gap_mm.item():.3g} mm off" in said


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
