"""Rounded mouths and blunt horns against closed forms and polygons of their own."""

import math

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate

from geneva_cli import Design, External, Internal, Load, Size, Spherical
from geneva_cli.errors import GenevaError
from geneva_cli.geometry.plates import moments
from geneva_cli.geometry.shapes import Arc, Line
from geneva_cli.loads.impacts.entry import RestingAxis, mouth_contacts
from geneva_cli.loads.strength.horn import greatest_stress, horns
from geneva_cli.motion.wheels.gearing import Gearing
from geneva_cli.verdict.checks import checks, single_check

L, Z, R, W, CLEAR = 100.0, 6, 50.0, 5.05, 0.05
SIZES = {"roller_radius_mm": 5.0, "slot_clearance_mm": CLEAR, "lock_clearance_mm": CLEAR}
THIN = 44.9  # the locking disc whose horns have no thickness at their tips


def wheel(own: Gearing | None = None, **more: float) -> Design:
    return Design(own or External(Z), size=Size(**SIZES, **more))  # type: ignore[arg-type]


def wall_end(lock: float, tip: float, sign: int = 1) -> float:
    """Where the wall beside a flat ends along the slot: the horn is that thick there."""
    recess = lock + CLEAR
    inwards = math.sqrt(recess**2 - (R - W - tip) ** 2)
    return L * math.cos(math.pi / Z) - sign * inwards


def polygon(lock: float, tip: float) -> shapely.Polygon:
    """The wheel by boolean operations on polygons of fine circles."""
    fine = 1024
    out = shapely.Point(0, 0).buffer(math.hypot(L * math.cos(math.pi / Z), 5.0), fine)
    bottom = L - R - 0.25  # a twentieth of the roller's radius below the deepest roller
    slot = shapely.box(bottom, -W, 2 * L, W) | shapely.Point(bottom, 0).buffer(W, fine)
    flat = shapely.box(wall_end(lock, tip), -W - tip, 2 * L, W + tip) if tip else slot
    recess = shapely.Point(L, 0).buffer(lock + CLEAR, fine)
    for k in range(Z):
        out -= rotate(slot | flat, 360 / Z * k, origin=(0, 0))
        out -= rotate(recess, 360 / Z * (k + 0.5), origin=(0, 0))
    return out


@pytest.mark.parametrize(("lock", "tip"), [(40.0, 0.0), (43.0, 3.0), (THIN, 0.5), (THIN, 2.0)])
def test_the_wheel_is_that_of_polygons(lock: float, tip: float) -> None:
    outlines = wheel(lock_radius_mm=lock, horn_tip_mm=tip).parts.outlines
    assert moments(outlines.wheel).area == pytest.approx(polygon(lock, tip).area, rel=2e-6)


@pytest.mark.parametrize(("own", "sign"), [(External(Z), 1), (Internal(Z), -1)])
def test_a_flat_is_as_long_as_the_tip_and_square_to_its_slot(own: Gearing, sign: int) -> None:
    tip, lock = 6.0, 40.0
    parts = wheel(own, horn_tip_mm=tip, lock_radius_mm=lock).parts
    outlines = parts.outlines
    x = wall_end(lock, tip, sign)
    flats = [
        piece
        for piece in outlines.wheel.segments
        if isinstance(piece, Line)
        and abs(abs(piece.start[0]) - x) + abs(abs(piece.end[0]) - x) < 1e-9
        and abs(piece.start[1]) < 20.0
    ]
    assert len(flats) == 4  # of the two slots on the x axis
    for flat in flats:
        assert sorted((abs(flat.start[1]), abs(flat.end[1]))) == pytest.approx([W, W + tip])
    mouth = math.sqrt(math.hypot(L * math.cos(math.pi / Z), 5.0) ** 2 - W**2)
    assert parts.wall_lost == pytest.approx(sign * (mouth - x), abs=1e-9)


@pytest.mark.parametrize("own", [External(Z), Internal(Z), External(Z, offset_mm=9.0)])
def test_rounding_square_corners_takes_their_areas(own: Gearing) -> None:
    """Each of two corners a slot loses a square of the radius less a quarter of a circle."""
    keys = {"horn_tip_mm": 6.0}
    sharp, round_ = (wheel(own, **keys, mouth_radius_mm=c).parts.outlines.wheel for c in (0.0, 1.5))
    lost = abs(moments(sharp).area - moments(round_).area)
    assert lost == pytest.approx(2 * Z * 1.5**2 * (1.0 - math.pi / 4.0), rel=1e-9)
    arcs = [p for p in round_.segments if isinstance(p, Arc) and abs(p.radius - 1.5) < 1e-9]
    assert len(arcs) == 2 * Z


def test_horns_of_no_thickness_need_a_tip() -> None:
    with pytest.raises(GenevaError, match="to leave a horn"):
        _ = wheel(lock_radius_mm=THIN).parts.outlines
    design = wheel(lock_radius_mm=THIN, horn_tip_mm=0.1)
    assert design.parts.horn_mm == 0.1
    row = single_check(design.parts, "horn_mm")
    assert row and row.value == 0.1


def test_play_in_the_dwell_is_that_of_the_corners_left() -> None:
    """The corner between flat and recess meets the disc: the law of cosines about both circles."""
    tip, clear = 2.0, 0.4
    design = Design(
        External(Z),
        size=Size(
            roller_radius_mm=5.0,
            slot_clearance_mm=CLEAR,
            lock_radius_mm=THIN - 0.5,
            lock_clearance_mm=clear,
            horn_tip_mm=tip,
        ),
    )
    recess = THIN - 0.5 + clear
    inwards = math.sqrt(recess**2 - (R - W - tip) ** 2)
    corner = math.hypot(L * math.cos(math.pi / Z) - inwards, W + tip)
    chi = [math.acos((L**2 + corner**2 - k**2) / (2.0 * L * corner)) for k in (recess, THIN - 0.5)]
    assert design.parts.turn.dwell.deg == pytest.approx(math.degrees(chi[0] - chi[1]), abs=1e-6)


def test_the_hand_over_sees_the_missing_walls() -> None:
    names = ("hand_over_play_deg", "hand_over_offset_mm")
    both = [wheel(lock_radius_mm=THIN, horn_tip_mm=tip) for tip in (0.02, 2.0)]
    small, large = ({c.name: c for c in checks(one.mechanism, one.parts)} for one in both)
    assert all(small[name].passes for name in names)
    assert not any(large[name].passes for name in names)
    # the roller finds a wall once it is past the flat
    a = math.radians(large["hand_over_play_deg"].at_deg or 0.0)
    rho = L * math.sqrt(1.25 - math.cos(a))
    assert rho >= wall_end(THIN, 2.0) - 1e-6


def test_the_stress_of_a_blunt_horn_by_a_scan() -> None:
    """The roller presses where there is a wall; sections beyond it carry 6 N (s - s0)/(b t²)."""
    tip, face, lock, inertia, torque, w = 2.0, 10.0, 45.0, 0.05, 2.0, 2.0 * math.pi
    size = Size(roller_radius_mm=5.0, face_width_mm=face, lock_radius_mm=lock, horn_tip_mm=tip)
    design = Design(External(Z), size=size, load=Load(inertia_kgm2=inertia, torque_Nm=torque))
    ends = math.sqrt(lock**2 - (lock - tip) ** 2)  # of the wall, from the mouth
    mouth = L * math.cos(math.pi / Z)
    a = np.linspace(-math.acos(1.25 - ((mouth - ends) / L) ** 2), 0.0, 801)
    d = 1.25 - np.cos(a)
    rho = L * np.sqrt(d)
    force = (inertia * w * w * -0.375 * np.sin(a) / d**2 + torque) / (rho / 1e3)
    s0 = mouth - rho
    s = np.linspace(ends, lock * 0.9, 1601)
    thick = lock - np.sqrt(lock**2 - s * s)
    arm = np.maximum(s - s0[:, None], 0.0)
    most = (6.0 * force[:, None] * arm / (face * thick**2)).max()
    found = greatest_stress(horns, design.mechanism, (5.0, lock))
    found = found._replace(stress_MPa=found.stress_MPa / face)
    assert found.stress_MPa == pytest.approx(most, rel=2e-3)


@pytest.mark.parametrize("error", [1e-4, -1e-4])
@pytest.mark.parametrize("own", [External(Z), Internal(Z)])
def test_a_roller_meets_a_rounded_mouth(own: Gearing, error: float) -> None:
    """A circle about the rounding's centre, and the wheel's angle that keeps the roller on it."""
    (one,) = Design(own).mechanism.engagements
    r, c, b, sign = 0.05, 0.02, math.pi / Z, own.SIGN
    found = mouth_contacts(RestingAxis.of(one), error, 0.0, (r, 0.0, c))
    assert found
    rim = math.hypot(math.cos(b), r)
    x = math.sqrt((rim - sign * c) ** 2 - (r + c) ** 2)
    l = 0.5 * (1.0 + error)

    def gap(at: float, turned: float, side: float) -> float:
        pin = complex(1.0 - sign * l * math.cos(at), l * math.sin(at))
        corner = complex(x, side * (r + c)) * np.exp(1j * (turned - b))
        return abs(pin - corner) - r - c

    at = math.radians(found.at_deg[0])
    side = min((1.0, -1.0), key=lambda k: abs(gap(at, 0.0, k)))
    assert gap(at, 0.0, side) == pytest.approx(0.0, abs=1e-12)
    assert min(gap(at - 1e-4, 0.0, k) for k in (1.0, -1.0)) > 0.0
    h = 1e-6
    slope = (gap(at + h, 0.0, side) - gap(at - h, 0.0, side)) / (
        gap(at, h, side) - gap(at, -h, side)
    )
    assert found.jump[0] == pytest.approx(-slope, rel=1e-7)


@pytest.mark.parametrize(
    ("design", "text"),
    [
        (Design(Spherical(Z), size=Size(mouth_radius_mm=1.0)), "external and internal wheels"),
        (wheel(mouth_radius_mm=8.0), "no space for this rounding"),
        (wheel(horn_tip_mm=30.0), "more than half of the slots"),
    ],
)
def test_what_is_not_cut_is_refused(design: Design, text: str) -> None:
    with pytest.raises(GenevaError, match=text):
        _ = design.mechanism, design.parts.outlines
