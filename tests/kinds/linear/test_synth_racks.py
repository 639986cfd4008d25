"""Racks and carousels from requirements: closed forms, and all combinations built one by one.

A roller at a right angle to the travel enters a rack, f = 90° from mid-motion. There a side-crank
stands across its base: the crank turns as fast as the input. So no side-crank has a lower peak than
the plain crank's R w², and elliptical gears turn the crank faster there, by (1 + e²)/(1 - e²).
"""

import math

import pytest

from geneva_cli import Carousel, External, GenevaError, Internal
from geneva_cli.motion.machine_spec import Spec
from geneva_cli.motion.mechanism import build
from geneva_cli.motion.timing import timings
from geneva_cli.study.synth.reading import read_target
from geneva_cli.study.synth.synth_search import search


def rows_of(**options):
    return search(read_target(**options)).rows


@pytest.mark.parametrize("motion", [120.0, 150.0, 180.0, 200.0, 300.0])
def test_a_drive_gives_the_rack_its_motion(motion):
    """The motion ends where the coulisse stands across: A = -cos(M/2); tan(M/4) = (1+e)/(1-e)."""
    rows = rows_of(motion_deg=str(motion), index_mm="40")
    by_drive = {row.spec.drive.NAME: row for row in rows}
    if motion == 180.0:
        assert set(by_drive) == {"crank"}
    else:
        assert set(by_drive) == {"side-crank", "elliptical-gears"}
        A = by_drive["side-crank"].candidate.A
        assert pytest.approx(-math.cos(math.radians(motion / 2.0)), abs=1e-12) == A
        t = math.tan(math.radians(motion / 4.0))
        e = (t - 1.0) / (t + 1.0)
        assert by_drive["elliptical-gears"].candidate.eccentricity == pytest.approx(abs(e))
    for row in rows:
        (time,) = timings(build(row.spec))
        assert time.motion_deg == pytest.approx(motion, rel=1e-9)
        assert time.index_mm == 40.0
        assert row.candidate.index_mm == 40.0


def test_times_and_the_peak_in_metres():
    """In 1.2 s the plain crank moves for 0.6 s, with R w² at entry."""
    (row,) = rows_of(index_mm="40", dwell_s="0.6", cycle="1.2")
    w = 2.0 * math.pi / 1.2
    assert row.spec.drive.n_rpm == pytest.approx(50.0, rel=1e-14)
    assert row.candidate.acceleration_max_m_s2 == pytest.approx(0.02 * w * w, rel=1e-13)
    assert row.candidate.acceleration_max_rad_s2 is None


@pytest.mark.parametrize("inside", [False, True])
def test_carousels_are_all_that_do_not_meet(inside):
    """Wheels or fingers, one after the other in a turn: each is built, or refused, by itself."""
    kind, name = (Internal, "internal") if inside else (External, "external")
    rows = rows_of(carousel="1..4", z="3..7", **{name: True}, tau="0.01..0.99")
    found = {(r.spec.wheel.z, r.spec.drive.rollers, r.spec.drive.wheels) for r in rows}
    expected = set()
    for z in range(3, 8):
        for rollers in range(1, 9):
            for wheels in range(1, 5):
                try:
                    spec = Spec(kind(z), Carousel(rollers=rollers, wheels=wheels))
                    (engagement, *_) = build(spec).engagements
                except GenevaError:
                    continue
                if 0.01 <= engagement.motion_deg * rollers / 360.0 <= 0.99:
                    expected.add((z, rollers, wheels))
    assert found == expected
    assert found


def test_the_whole_turn_of_a_carousel_is_a_requirement():
    """A carrier's turn and a step for each finger: 360° + 360° m/z."""
    rows = rows_of(carousel="1", subject_to=["carousel.turn_deg >= 449.9999"])
    assert rows
    for row in rows:
        assert 360.0 + 360.0 * row.spec.drive.rollers / row.spec.wheel.z >= 449.9999
        assert row.candidate.wheels == 1
