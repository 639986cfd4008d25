"""Where a curved slot lacks the wall that its load needs (the one-track theorem)."""

import cmath
import math

import numpy as np
import pytest
from words import Drive, Motion, Spec, Wheel

from geneva_cli.loads.positive_drive import positive_drives
from geneva_cli.motion import registry
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.undercut import undercut
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


def test_the_cycloid_s_branches():
    assert drive(Motion("cycloidal", ratio=0.5)).gap_mm / 441.89 == pytest.approx(0.019, abs=0.0005)


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
    said = motion_warnings(build(PRESS.replace(motion=Motion("cycloidal", ratio=0.5), load=MIXED)))
    assert any("not positively driven" in text and '"cam"' in text for text in said)
    cam = PRESS.replace(drive=Drive("cam"), motion=Motion("cycloidal"), load=MIXED)
    assert not motion_warnings(build(cam))


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


def uneven_gears():
    """Gears whose ratio 1 + 0.3 sin 6 x turns the crank by x + 0.05 (1 - cos 6 x) from the middle.

    So it leads by one angle at both mirrored input angles, and the roller is not equally far out.
    """
    degrees = np.arange(361.0)
    ratio = 1.0 + 0.3 * np.round(np.sin(np.radians(6.0 * (degrees % 60.0))), 6)
    ratio[::30] = 1.0
    points = tuple(zip(degrees.tolist(), ratio.tolist(), strict=True))
    return registry.drive("noncircular-gears")(ratio=points)


def test_an_uneven_drive_s_branches_are_compared_at_equal_radii():
    """Against both branches by the crank's angle, whose mirror image is as far out."""
    load = Load(1.0, 10.0)
    motion = Motion("cycloidal", ratio=0.48)
    spec = PRESS.replace(drive=uneven_gears(), motion=motion, load=load)
    found = positive_drives(build(spec))

    half, step = math.pi / 3.0, math.pi / 3.0
    x = np.linspace(-half, half, 200_001)
    crank = x + 0.05 * (1.0 - np.cos(6.0 * x))
    u = 0.5 * (x / half + 1.0)
    psi = step * (u - np.sin(2.0 * math.pi * u) / (2.0 * math.pi) - 0.5)
    polar = np.angle(1.0 - 0.48 * np.exp(-1j * crank)) - psi
    lead = polar - np.interp(-crank, crank, polar, left=np.nan, right=np.nan)
    far = np.abs(1.0 - 0.48 * np.exp(-1j * crank))
    gap = np.nan_to_num(441.89 * far * np.abs(lead))
    # at 60 rpm, whose input turns by 2 pi a second
    torque = np.sin(2.0 * math.pi * u) * step * 2.0 * math.pi / (2.0 * half) ** 2
    torque = torque * (2.0 * math.pi) ** 2 * load.inertia_kgm2 + load.torque_Nm
    loose = (gap > 0.01) & (np.nan_to_num(lead) * torque < 0.0)
    # of 1440 places, and a ratio of six decimals
    assert found.fraction == pytest.approx(loose.mean(), abs=2.0 / 1440.0)
    assert found.gap_mm == pytest.approx(gap[x < 0.0].max(), rel=1e-4)
    assert found.loose_gap_mm == pytest.approx(gap[loose].max(), rel=1e-3)


def test_the_undercut_of_a_machine_behind_gears_is_that_without():
    own = PRESS.replace(motion=Motion("modified-sine", ratio="matched"), size=Size(100.0, 30.0))
    one, other = (undercut(build(spec)) for spec in (own, own.replace(drive_before=uneven_gears())))
    assert other.depth_mm == one.depth_mm > 0.1
    assert other.wall == one.wall
    crank = math.radians(other.from_deg)
    assert crank + 0.05 * (1.0 - math.cos(6.0 * crank)) == pytest.approx(
        math.radians(one.from_deg), abs=1e-5
    )
