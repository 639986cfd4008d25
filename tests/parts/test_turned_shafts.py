"""Turned shafts: standard parts on them, their steps, and their solids in every format."""

import pytest

from geneva_cli import Design, External, Internal, Size
from geneva_cli.geometry.plates import Stack, solids
from geneva_cli.geometry.shapes import Circle
from geneva_cli.parts.machine_sizes import machine_sizes
from geneva_cli.parts.shafts.shaft import DIN_471, SERIES_60, bearing_up_to, circlip_up_to
from geneva_cli.parts.stressed import stressed

TURNED = Size(shafts="turned", wheel_bore_mm=16.0, crank_bore_mm=10.0)


def of(**keys):
    return Design(External(6), size=TURNED.replace(**keys))


def every(design):
    return solids(design.drawing("assembly").solid)


def shaft(design, part):
    (one,) = [s for s in every(design) if s.name == f"{part}'s shaft"]
    return one


def steps(stack):
    """Name, diameter if it is round, and both ends of each step."""
    return [
        (p.name, 2.0 * p.outline.radius if isinstance(p.outline, Circle) else None, p.low, p.high)
        for p in stack.plates
    ]


def test_tables():
    """Rings: s of DIN 471 is m less 0.1 to 0.15; bearings: each wider one is larger in all."""
    for small, large in zip(SERIES_60, SERIES_60[1:], strict=False):
        assert small.bore < large.bore < large.outside > small.outside
        assert small.width <= large.width
    for small, large in zip(DIN_471, DIN_471[1:], strict=False):
        assert small.shaft < large.shaft and small.width <= large.width
        # grooves are between 1.7 % and 3.4 % of the diameter deep
        assert 0.017 < 0.5 * (large.shaft - large.groove) / large.shaft < 0.034
    # from makers' tables: 6004 is 20 x 42 x 12; DIN 471 - 20: d2 = 19, m = 1.3, n = 1.5
    assert bearing_up_to(24.9, "wheel's shaft", "wheel_bore_mm") == ("6004", 20, 42, 12)
    assert circlip_up_to(21.5) == (20, 19.0, 1.3) and circlip_up_to(21.5).edge == 1.5
    assert circlip_up_to(40.0).edge == pytest.approx(3.75)  # 3.8 in the table
    # least abutments by DIN 5418, which SKF's catalogue has: 608, 6001, 6004, 6010
    for name, least in (("608", 10.0), ("6001", 14.0), ("6004", 23.2), ("6010", 54.6)):
        (one,) = [b for b in SERIES_60 if b.name == name]
        assert least <= one.shoulder < 0.5 * (one.bore + one.outside)


def test_steps_of_the_wheels_shaft():
    """Frame: 2 mm of shoulder below the arm, so from -12 down to -22."""
    n, m = 1.5 * (15.0 - 14.3), 1.1
    low = -12.0 - 9.0 - m - n
    assert steps(shaft(of(), "wheel")) == [
        ("end", 15.0, pytest.approx(low), pytest.approx(low + n)),
        ("circlip groove, DIN 471", 14.3, pytest.approx(low + n), pytest.approx(-21.0)),
        ("seat of bearing 6002", 15.0, pytest.approx(-21.0), pytest.approx(-12.0)),
        ("shoulder", 20.0, pytest.approx(-12.0), pytest.approx(0.0, abs=1e-9)),
        ("seat of wheel", 16.0, pytest.approx(0.0, abs=1e-9), pytest.approx(10.0)),
        ("circlip groove, DIN 471", 15.2, pytest.approx(10.0), pytest.approx(11.1)),
        ("end", 16.0, pytest.approx(11.1), pytest.approx(12.3)),
    ]
    (frame,) = [s for s in every(of()) if s.name == "frame"]
    assert (frame.low, frame.high) == (-22.0, -12.0)
    assert {2.0 * h.radius for h in frame.holes if h.centre[1] == 0.0} == {32.0, 26.0}


def test_a_frame_is_as_thick_as_its_bearings_are_wide():
    (frame,) = [s for s in every(of(arm_thickness_mm=3.0)) if s.name == "frame"]
    assert frame.thickness == 9.0


def test_an_overhung_crank_has_no_circlip_above_its_arm():
    """The wheel turns above it."""
    size = Size(shafts="turned", arm_bore_mm=10.0, crank_bore_mm=0.0)
    names = [name for name, *_ in steps(shaft(Design(External(6), size=size), "crank"))]
    assert names[-2:] == ["shoulder", "seat of crank"]
    inside = Design(Internal(6), size=Size(shafts="turned", arm_bore_mm=10.0))
    assert [s.name for s in every(inside) if isinstance(s, Stack)] == ["crank's shaft"]


def test_stress_in_the_bearing():
    """A turned shaft is as thick as its bearing's bore, and longer by the shoulder."""
    plain, turned = (
        stressed(*machine_sizes(of(shafts=shafts).mechanism)).wheel_shaft
        for shafts in ("plain", "turned")
    )
    # to the frame: half of the wheel and the arm; then half of the frame of 10 mm, or 2 mm of
    # shoulder and half of the bearing 6002
    assert plain == (16.0, pytest.approx(5.0 + 10.0 + 5.0))
    assert turned == (15.0, pytest.approx(5.0 + 10.0 + 2.0 + 4.5))
